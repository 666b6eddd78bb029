// Several runs beside each other: figures over the study's parameters, and a table from which a run is picked.

import { sequence } from "./colormap";
import { ComparisonView, mostOverlaid } from "./comparison_view";
import type { Report, Run } from "./data";
import { figure, h, segmented } from "./dom";
import { FilmFields } from "./film_fields";
import { statusName } from "./header";
import { filmLoss, isOfCycle, keyRow, keyValue, moft, pofp } from "./key_figures";
import { LinePlot, type Curve } from "./line_plot";
import { axisName, surfaceOf } from "./surface";
import { capital } from "./summary_table";
import { Study } from "./study";
import { isDark, onThemeChange } from "./theme";
import { degree, format, megapascal, micrometre, plain, type Display } from "./units";

interface EndValue {
  name: string;
  label: string;
  series: string;
  /** The row of the closing table that tells it of the whole cycle, and how that is called. */
  row: string;
  ofCycle: string;
  display: Display;
  fromZero: boolean;
}

const endValues: EndValue[] = [
  { name: "film-thickness", label: "minimum film thickness", series: "h_min", row: moft, ofCycle: "minimum film thickness (MOFT)", display: micrometre, fromZero: true },
  { name: "peak-pressure", label: "peak film pressure", series: "p_max", row: pofp, ofCycle: "peak film pressure (POFP)", display: megapascal, fromZero: true },
  { name: "eccentricity-ratio", label: "eccentricity ratio", series: "eccentricity_ratio", row: "largest eccentricity ratio", ofCycle: "largest eccentricity ratio", display: plain, fromZero: true },
  { name: "middle-thickness", label: "film thickness at the pad’s middle", series: "film_thickness_middle", row: "", ofCycle: "film thickness at the pad’s middle", display: micrometre, fromZero: true },
  { name: "power-loss", label: "power loss in the film", series: "power_film", row: filmLoss, ofCycle: "mean power loss in the film", display: { factor: 1, unit: "W" }, fromZero: true },
];

export class StudyView {
  readonly element = h("section", { class: "study", "aria-label": "Study" });
  private readonly study: Study;
  private bearing: string;
  /** Whether figures show values at the end of the runs or of their cycles. */
  private basis: "end" | "cycle";

  constructor(
    report: Report,
    private readonly select: (run: Run) => void,
  ) {
    this.study = new Study(report);
    this.bearing = this.study.runs[0]!.children("/bearings")[0] ?? "";
    this.basis = this.hasCycles() ? "cycle" : "end";
    this.render();
    onThemeChange(() => this.render());
  }

  get runs(): Run[] {
    return this.study.runs;
  }

  label(run: Run): string {
    return this.study.label(run);
  }

  /** Shows which run the detailed view is about. */
  highlight(run: Run): void {
    this.element.querySelectorAll<HTMLElement>("tr[data-run]").forEach((row) => {
      const chosen = row.dataset["run"] === run.name;
      row.classList.toggle("chosen", chosen);
      row.querySelector("button")?.setAttribute("aria-pressed", chosen ? "true" : "false");
    });
  }

  private hasCycles(): boolean {
    return this.study.runs.some((run) => isOfCycle(keyRow(run, this.bearing, moft)));
  }

  private render(): void {
    const chosen = this.element.querySelector<HTMLElement>("tr.chosen")?.dataset["run"];
    const bearings = this.study.runs[0]!.children("/bearings");
    const ofCycle = this.hasCycles() ? "Of the last cycle" : "Of the whole run";
    const basis = segmented("Values of the figures", [{ value: "end", label: "At the end" }, { value: "cycle", label: ofCycle }], this.basis, (b) => {
      this.basis = b as "end" | "cycle";
      this.render();
    });
    const controls =
      bearings.length > 1
        ? h("div", { class: "controls view-controls" }, segmented("Bearing of the study", bearings.map((b) => ({ value: b, label: b.replaceAll("_", " ") })), this.bearing, (b) => {
            this.bearing = b;
            this.render();
          }), basis)
        : h("div", { class: "controls view-controls" }, bearings.length > 0 ? basis : null);
    const figures = h("div", { class: "figures" }, ...this.midplaneFigures(), ...this.endFigures());
    const overlay = this.study.runs.length <= mostOverlaid ? new ComparisonView(this.study.runs, (run) => this.label(run), this.bearing).element : h("div", {});
    // Runs that no study has made are compared first; a study is about its parameters.
    const parts = this.study.isComparison ? [this.table(), overlay, figures] : [figures, this.table(), overlay];
    this.element.replaceChildren(h("h2", {}, this.heading()), controls, ...parts);
    const run = this.study.runs.find((r) => r.name === chosen);
    if (run) this.highlight(run);
  }

  private heading(): string {
    if (this.study.isComparison) return `${this.study.runs.length} runs compared`;
    return `Study over ${this.study.parameters.map((p) => p.replaceAll("_", " ")).join(" and ")}`;
  }

  /** One figure per combination: a curve per value of the first parameter, all at the end of the run. */
  private midplaneFigures(): HTMLElement[] {
    const { study } = this;
    const highest = Math.max(0, ...study.runs.map((run) => Math.max(0, ...(this.midplane(run)?.y ?? []))));
    return study.combinations.flatMap(({ label, runs }) => {
      const colours = study.numbers() ? sequence(runs.length, isDark()) : [];
      const curves: Curve[] = runs.flatMap((run, i) => {
        const midplane = this.midplane(run);
        return midplane ? [{ label: study.value(run, study.abscissa) || study.label(run), y: midplane.y, unit: "MPa", ...(colours[i] ? { colour: colours[i] } : {}) }] : [];
      });
      const places = runs.map((run) => this.midplane(run)?.x).find((x) => x !== undefined);
      if (curves.length === 0 || !places) return [];
      const regular = curves.filter((c) => c.y.length === places.length);
      const { along, whole, middle } = surfaceOf(runs[0]!, this.bearing);
      const plot = new LinePlot({
        name: "study-midplane",
        x: { label: axisName(along), unit: along.display.unit, values: places },
        left: { label: `pressure at ${middle}`, unit: "MPa", fromZero: true, highest },
        curves: regular,
        height: 280,
      });
      const caption = `Pressure along the middle of ${whole} at the end of the run, a curve per ${study.abscissa.replaceAll("_", " ")}${label ? `; ${label}` : ""}.`;
      return [figure("study-midplane", caption, plot.tools, plot.element)];
    });
  }

  private midplane(run: Run): { x: number[]; y: number[] } | null {
    const fields = FilmFields.of(run, this.bearing);
    const y = fields?.midplane("pressure", fields.instants - 1, megapascal.factor);
    return fields && y ? { x: fields.along.shown(), y } : null;
  }

  /** Values at the end of the run over the first parameter, a curve per combination of the others. */
  private endFigures(): HTMLElement[] {
    const { study } = this;
    const numbers = study.numbers();
    const texts = [...new Set(study.runs.map((run) => study.value(run, study.abscissa) || run.name))];
    const place = (run: Run) => (numbers ? numbers.of(run) : texts.indexOf(study.value(run, study.abscissa) || run.name));
    const x = [...new Set(study.runs.map(place))].sort((a, b) => a - b);
    return endValues.flatMap((end) => {
      const curves: Curve[] = study.combinations.map(({ label, runs }) => ({
        label: label || (this.basis === "cycle" ? end.ofCycle : end.label),
        unit: end.display.unit,
        ...(numbers ? { points: true } : { dots: true }),
        y: x.map((value) => {
          const run = runs.find((r) => place(r) === value);
          return run ? this.atEnd(run, end) : null;
        }),
      }));
      if (curves.every((c) => Array.from(c.y).every((v) => v === null))) return [];
      const plot = new LinePlot({
        name: `study-${end.name}`,
        x: { label: study.abscissa.replaceAll("_", " "), unit: numbers?.unit ?? "", values: x, ...(numbers ? {} : { categories: texts }) },
        left: { label: this.basis === "cycle" ? end.ofCycle : end.label, unit: end.display.unit, fromZero: end.fromZero },
        curves,
      });
      const title = this.basis === "cycle" ? `${capital(end.ofCycle)} ${this.hasCycles() ? "of the last cycle" : "of the whole run"}` : `${capital(end.label)} at the end of the run`;
      const over = numbers ? ` over ${study.abscissa.replaceAll("_", " ")}` : "";
      return [figure(`study-${end.name}`, `${title}${over}.`, plot.tools, plot.element)];
    });
  }

  private atEnd(run: Run, end: EndValue): number | null {
    if (this.basis === "cycle") return keyValue(run, this.bearing, end.row);
    const values = run.column(`/bearings/${this.bearing}/${end.series}`);
    return values ? values[values.length - 1]! * end.display.factor : null;
  }

  private table(): HTMLElement {
    const { study } = this;
    const path = (name: string) => `/bearings/${this.bearing}/${name}`;
    const last = (run: Run, name: string, display: Display) => {
      const values = run.column(path(name));
      return values ? format(values[values.length - 1]! * display.factor) : "–";
    };
    const summary = (run: Run, name: string) => format(run.summary.find((r) => r.name === name && r.group === this.bearing)?.value);
    type Column = [string, string, (run: Run) => string];
    /** Of what not every kind of bearing has. */
    const ofKind = (name: string, short: string, long: string, display: Display): Column[] =>
      study.runs.some((run) => run.column(path(name))) ? [[short, long, (run) => last(run, name, display)]] : [];
    const columns: Column[] = [
      ...ofKind("eccentricity_ratio", "ε", "eccentricity ratio at the end", plain),
      ...ofKind("attitude", "attitude °", "attitude angle at the end", degree),
      ...ofKind("film_thickness_middle", "h middle µm", "film thickness at the pad’s middle at the end", micrometre),
      ["h min µm", "minimum film thickness at the end", (run) => last(run, "h_min", micrometre)],
      ["p max MPa", "peak film pressure at the end", (run) => last(run, "p_max", megapascal)],
      ["MOFT µm", "minimum film thickness of the run", (run) => summary(run, "minimum film thickness (MOFT)")],
      ["POFP MPa", "peak film pressure of the run", (run) => summary(run, "peak film pressure (POFP)")],
      ["power W", "mean power loss in the film", (run) => summary(run, "mean power loss in the film")],
      ["side flow mm³/s", "mean flow over both edges", (run) => sideFlow(run, this.bearing)],
      ["mass error", "worst mass-balance error", (run) => summary(run, "worst mass-balance error of the film")],
    ];
    if (study.runs.some((run) => run.attribute("/", "status") !== "completed"))
      columns.push(["status", "how the run ended", statusName]);
    const varied = [...study.parameters, ...study.differing];
    const head = [
      ...varied.map((p) => h("th", { scope: "col" }, p.replaceAll("_", " "))),
      ...columns.map(([short, long]) => h("th", { scope: "col", class: "number", title: long }, short)),
      h("th", { scope: "col" }, h("span", { class: "visually-hidden" }, "Detail")),
    ];
    const rows = study.runs.map((run) =>
      h(
        "tr",
        { "data-run": run.name },
        ...varied.map((p) => h("td", {}, study.value(run, p))),
        ...columns.map(([, , value]) => h("td", { class: "number" }, value(run))),
        h("td", {}, h("button", { type: "button", class: "quiet", "aria-label": `Show ${study.label(run)} in detail`, click: () => this.select(run) }, "Show")),
      ),
    );
    return h("div", { class: "wide-table" }, h("table", { class: "comparison" }, h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...rows)));
  }
}

function sideFlow(run: Run, bearing: string): string {
  const value = (side: string) => run.summary.find((r) => r.group === bearing && r.name === `mean side flow, ${side}`)?.value;
  const [left, right] = [value("left"), value("right")];
  return typeof left === "number" && typeof right === "number" ? format(left + right) : "–";
}
