// The page of `hersey study`: what the study says in a table, its figures, and the run that is clicked.

import { bandOverTime } from "./band_plot";
import { drawingButtons, figure, h, segmented } from "./dom";
import { themeButton } from "./header";
import { histogram, indices, parallelCoordinates, paretoFront, progress, response, scatterMatrix, tornado } from "./sampling_figures";
import { shortName, type StudyText } from "./sampling_data";
import { campbell, studyWaterfall } from "./speed_diagrams";
import { capital } from "./summary_table";
import { format, shownUnit, typeset, withUnit } from "./units";

const mostRows = 500;

function head(study: StudyText): HTMLElement {
  document.title = `${study.title} · hersey`;
  const failed = study.failed.reduce((sum, f) => sum + f.count, 0);
  const facts = [
    study.model.split("/").slice(-2).join("/"),
    `${study.completed} of ${study.planned} runs, plan ${study.plan.replaceAll("_", " ")}`,
    ...(failed ? [`${failed} failed`] : []),
    `hersey ${study.version}`,
  ];
  return h("header", {}, h("div", { class: "title-row" }, h("h1", {}, study.title), themeButton()), h("p", { class: "facts" }, facts.join(" · ")));
}

function scatterTable(study: StudyText): HTMLElement {
  const names = ["Figure", "mean", "std. deviation", "5 %", "median", "95 %", "smallest", "largest", "surrogate's error"];
  const rows = study.figures.map((f) => {
    const s = f.scatter;
    const cells = s ? [s.mean, s.standard_deviation, s.percentiles["5"], s.percentiles["50"], s.percentiles["95"], s.smallest, s.largest].map((v) => format(v)) : [];
    const error = f.surrogate ? `${format(100 * f.surrogate.cross_validated_error, 2)} % of the variance` : "–";
    return h(
      "tr",
      {},
      h("th", { scope: "row", title: f.name }, `${shortName(f.key)}${f.unit ? ` [${shownUnit(f.unit)}]` : ""}`),
      ...cells.map((text) => h("td", { class: "number" }, text)),
      h("td", { class: "number" }, error),
    );
  });
  return h(
    "div",
    { class: "wide-table", tabindex: 0, role: "region", "aria-label": "Scatter of the figures" },
    h("table", { class: "comparison" }, h("thead", {}, h("tr", {}, ...names.map((n, i) => h("th", { scope: "col", class: i ? "number" : "" }, n)))), h("tbody", {}, ...rows)),
  );
}

function verdict(study: StudyText): HTMLElement | null {
  const best = study.best.map((name) => study.runs.find((run) => run.run === name)).find((run) => run !== undefined);
  if (study.objectives.length === 0) return null;
  const wish = study.objectives.map((o) => `${o.maximise ? "largest" : "smallest"} ${shortName(o.name)}`).join(" and ");
  const bounds = study.constraints.map((c) => typeset(c.text.replace(c.name, shortName(c.name)))).join(", ");
  if (!best) return h("p", { class: "fault" }, `No run keeps to every bound: ${bounds}.`);
  const values = study.parameters.map((p, k) => `${shortName(p.name)} ${typeset(best.texts[k]!)}`).join(", ");
  const figures = study.figures.map((f, k) => `${shortName(f.key)} ${withUnit(best.outputs[k], shownUnit(f.unit))}`).join(", ");
  const among = study.best.length > 1 ? `${study.best.length} runs that none other beats; the first: ` : "";
  return h("p", { class: "study-best" }, h("strong", {}, `${wish}${bounds ? `, ${bounds}` : ""}: `), `${among}${values}. ${figures}.`);
}

/** The run that is chosen: values, figures, its report. */
class Detail {
  readonly element = h("section", { class: "detail", "aria-label": "Run in detail", "aria-live": "polite" });
  private readonly study: StudyText;

  constructor(study: StudyText) {
    this.study = study;
  }

  show(i: number, scroll: boolean): void {
    const { study } = this;
    const run = study.runs[i]!;
    const row = (name: string, value: string) => h("tr", {}, h("th", { scope: "row" }, name), h("td", { class: "number" }, value));
    const again = ["hersey", study.analysis === "steady" ? "bearing" : "run", study.model, ...study.parameters.map((p, k) => `--set '${p.name}=${run.texts[k]}'`)].join(" ");
    this.element.replaceChildren(
      h("h2", {}, `Run ${i + 1} of ${study.runs.length}`),
      h(
        "table",
        { class: "comparison" },
        h("tbody", {}, ...study.parameters.map((p, k) => row(shortName(p.name), typeset(run.texts[k]!))), ...study.figures.map((f, k) => row(shortName(f.key), withUnit(run.outputs[k], shownUnit(f.unit))))),
      ),
      run.report ? h("p", {}, h("a", { href: run.report }, "Report of this run")) : h("p", {}, "Once more, with its report: ", h("code", {}, `${again} --${study.analysis === "steady" ? "report run.html" : "output run"}`)),
    );
    document.querySelectorAll<SVGElement>("[data-run].chosen").forEach((e) => e.classList.remove("chosen"));
    document.querySelectorAll<SVGElement>(`[data-run="${i}"]`).forEach((e) => e.classList.add("chosen"));
    if (scroll) this.element.scrollIntoView({ behavior: "smooth", block: "nearest" });
  }
}

function runsTable(study: StudyText, show: (i: number) => void): HTMLElement {
  const names = [...study.parameters.map((p) => shortName(p.name)), ...study.figures.map((f) => `${shortName(f.key)}${f.unit ? ` [${shownUnit(f.unit)}]` : ""}`)];
  const rows = study.runs.slice(0, mostRows).map((run, i) =>
    h(
      "tr",
      {},
      ...run.texts.map((text) => h("td", {}, typeset(text))),
      ...run.outputs.map((value) => h("td", { class: "number" }, format(value))),
      h("td", {}, h("button", { type: "button", class: "quiet", "aria-label": `Show run ${i + 1}`, click: () => show(i) }, "Show")),
    ),
  );
  const more = study.runs.length > mostRows ? h("p", { class: "note" }, `The first ${mostRows} of ${study.completed} runs; all are in runs.csv.`) : null;
  const table = h("table", { class: "comparison" }, h("thead", {}, h("tr", {}, ...names.map((n) => h("th", { scope: "col" }, n)), h("th", { scope: "col" }, h("span", { class: "visually-hidden" }, "Detail")))), h("tbody", {}, ...rows));
  return h("details", {}, h("summary", {}, "All runs"), h("div", { class: "wide-table", tabindex: 0, role: "region", "aria-label": "All runs" }, table), more);
}

/** A figure that follows what is chosen above it. */
function choosable(kind: string, label: string, names: string[], draw: (k: number) => { caption: string; plot: SVGElement }): HTMLElement {
  const holder = h("div", { class: "svg-holder" });
  const caption = h("span", {});
  const show = (k: number) => {
    const { caption: text, plot } = draw(k);
    holder.replaceChildren(plot);
    caption.textContent = text;
  };
  show(0);
  const controls = names.length > 1 ? h("div", { class: "controls" }, segmented(label, names.map((n, k) => ({ value: String(k), label: n })), "0", (v) => show(Number(v)))) : null;
  return h("figure", { class: `figure ${kind}`, "data-figure": kind }, h("div", { class: "figure-body" }, controls, holder), h("figcaption", {}, h("span", { class: "caption" }, caption), h("span", { class: "tools" }, ...drawingButtons(kind))));
}

function figures(study: StudyText, pick: (i: number) => void): HTMLElement[] {
  const list: HTMLElement[] = [];
  const add = (kind: string, caption: string, plot: SVGElement | null) => {
    if (plot) list.push(figure(kind, caption, null, plot));
  };
  if (study.campbell) add("campbell", "Natural frequencies of damped motion over the speed, with the first three orders; hollow: damping ratio above 0.3, red: unstable.", campbell(study));
  if (study.run_up) add("run-up", `Spectra of ${study.run_up.series} at each speed.`, studyWaterfall(study));
  add("pareto", "The objectives of all runs; joined: those that none other beats, grey: those that break a bound.", paretoFront(study, pick));
  if (study.plan === "optimise") add("progress", "The objective over the search, and the best run so far that keeps to every bound.", progress(study, pick));
  const names = study.figures.map((f) => shortName(f.key));
  const scattered = study.figures.flatMap((f, k) => (f.scatter && f.scatter.count > 5 && f.scatter.largest > f.scatter.smallest ? [k] : []));
  const isDrawn = ["sobol", "halton", "latin_hypercube"].includes(study.plan);
  if (isDrawn && scattered.length)
    list.push(choosable("histogram", "Figure", scattered.map((k) => names[k]!), (i) => ({ caption: `${study.figures[scattered[i]!]!.name}: how often, with its 5th, 50th and 95th percentile.`, plot: histogram(study, scattered[i]!) })));
  if (study.bands?.length) {
    const { bands } = study;
    list.push(choosable("bands", "Series", bands.map((one) => shortName(one.key)), (i) => ({ caption: `${capital(bands[i]!.name)} over time: median, mean (dashed), and the band between the 5th and 95th percentile of ${bands[i]!.runs} runs.`, plot: bandOverTime(bands[i]!) })));
  }
  const modelled = study.figures.flatMap((f, k) => (f.surrogate ? [k] : []));
  if (modelled.length) {
    const ofModelled = (kind: string, caption: (name: string) => string, draw: typeof indices) =>
      list.push(choosable(kind, "Figure", modelled.map((k) => names[k]!), (i) => ({ caption: caption(study.figures[modelled[i]!]!.name), plot: draw(study, study.figures[modelled[i]!]!) })));
    ofModelled("indices", (name) => `Sobol indices of ${name}: dark, the parameter by itself; light, with others.`, indices);
    ofModelled("tornado", (name) => `${name}, by the surrogate, as each parameter goes to its smallest (blue) and largest value (red), the others in the middle.`, tornado);
  }
  if (study.parameters.length && study.figures.length) {
    const pairs = study.figures.flatMap((_, f) => study.parameters.map((__, p) => [f, p] as const)).slice(0, 12);
    list.push(choosable("response", "Figure over parameter", pairs.map(([f, p]) => `${names[f]} / ${shortName(study.parameters[p]!.name)}`), (i) => ({ caption: `A figure over a parameter, a dot per run${study.figures[pairs[i]![0]]!.surrogate ? "; the curve is the surrogate's with all other parameters in the middle" : ""}.`, plot: response(study, pairs[i]![0], pairs[i]![1], pick) })));
  }
  return list;
}

export function showSampling(page: HTMLElement, study: StudyText): void {
  const detail = new Detail(study);
  const pick = (i: number) => detail.show(i, true);
  page.append(...[head(study), verdict(study), scatterTable(study)].filter((e) => e !== null));
  page.append(h("div", { class: "figures" }, ...figures(study, pick)));
  if (study.runs.length > 1) {
    const marks = study.objectives.length ? " Red: the best; grey: runs that break a bound." : "";
    page.append(
      h(
        "div",
        { class: "figures one-column" },
        figure("parallel", `A line per run; a click shows it.${marks}`, null, parallelCoordinates(study, pick)),
        figure("scatter-matrix", `Parameters and figures in pairs, a dot per run; a click shows it.${marks}`, null, scatterMatrix(study, pick)),
      ),
    );
  }
  page.append(detail.element, runsTable(study, pick));
  if (study.failed.length) page.append(h("section", {}, h("h2", {}, "Failed runs"), h("ul", {}, ...study.failed.map((f) => h("li", {}, `${f.count}: ${f.reason}`)))));
  const first = study.runs.findIndex((run) => study.best.includes(run.run));
  if (study.runs.length) detail.show(Math.max(0, first), false);
}
