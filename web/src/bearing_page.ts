// A bearing by itself: its operating point, or a sweep with one of its solutions in detail.

import type { BearingKind, SweepCurve, SweepFigure } from "./bearing_kind";
import { kindOf } from "./bearing_kinds";
import { figureOf, Sweep, type Line } from "./bearing_sweep";
import { bearingVerdict, placeOf } from "./bearing_verdict";
import { sweepDrawings } from "./canvas";
import { fieldsOnly, type BearingText, type FigureText, type FilmText, type SolutionText } from "./data";
import { figure, h, segmented, tableButton } from "./dom";
import { FieldMap, type Mark } from "./field_map";
import { errorText, unitText, valueText } from "./figure_text";
import { FilmFields, type FieldKind } from "./film_fields";
import { assumptions, date, themeButton } from "./header";
import { LinePlot, sweepPlots, type Curve } from "./line_plot";
import { Locus } from "./locus";
import { capital } from "./summary_table";
import { axisName } from "./surface";
import { megapascal, micrometre, shownUnit, typeset } from "./units";

const groups: [string, string][] = [
  ["operating point", "Operating point"],
  ["film", "Film"],
  ["films", "Films"],
  ["arcs", "Arcs"],
  ["pads", "Pads"],
  ["deformation", "Deformation"],
  ["force of the orbit", "Force of the orbit"],
  ["friction", "Friction"],
  ["power", "Power"],
  ["oil", "Oil"],
  ["heat", "Heat"],
  ["numbers", "Numbers"],
  ["stability", "Stability of a rigid rotor"],
];

export function showBearing(page: HTMLElement, title: string, bearing: BearingText): void {
  const sweep = new Sweep(bearing);
  const kind = kindOf(bearing);
  const solved = bearing.solutions.flatMap((s, i) => (s.error ? [] : [i]));
  page.append(head(title, kind, bearing, solved.length), bearingVerdict(bearing, kind, sweep));
  const notes = assumptions(bearing.conditions);
  if (notes) page.append(notes);
  if (bearing.solutions.length === 1) {
    page.append(solved.length === 1 ? new SolutionView(bearing, kind, sweep, 0).element : h("p", { class: "fault" }, bearing.solutions[0]!.error));
    return;
  }
  showSweep(page, bearing, kind, sweep, solved);
}

function head(title: string, kind: BearingKind, bearing: BearingText, solved: number): HTMLElement {
  document.title = `${title} · hersey`;
  const count = bearing.solutions.length;
  const facts = [
    bearing.file,
    `${kind.title} ${bearing.name.replaceAll("_", " ")} by itself`,
    ...(count > 1 ? [`${count} operating points, ${solved === count ? "all" : solved} solved`] : []),
    `hersey ${bearing.version}`,
    date(bearing.created),
  ];
  const ended = solved === count ? "completed" : "failed";
  return h(
    "header",
    { class: "title-block" },
    h("div", { class: "title-row" }, h("h1", {}, title), themeButton()),
    bearing.description ? h("p", { class: "lead" }, bearing.description) : null,
    h("p", { class: "facts" }, facts.join(" · "), " ", h("span", { class: `status ${ended}` }, ended === "completed" ? "solved" : "not all solved")),
  );
}

function showSweep(page: HTMLElement, bearing: BearingText, kind: BearingKind, sweep: Sweep, solved: number[]): void {
  const detail = h("section", { class: "detail", "aria-label": "Operating point in detail" });
  const picker = h("select", { "aria-label": "Operating point shown in detail", change: () => show(Number(picker.value), false) });
  for (const i of solved) picker.append(h("option", { value: i }, sweep.label(i)));
  const view = new SweepView(bearing, kind, sweep, (index) => show(index, true));
  const show = (index: number, scroll: boolean) => {
    picker.value = String(index);
    view.choose(index);
    detail.replaceChildren(h("div", { class: "detail-head" }, h("h2", {}, "Operating point in detail"), picker), new SolutionView(bearing, kind, sweep, index).element);
    sweepPlots();
    sweepDrawings();
    if (scroll) detail.scrollIntoView({ behavior: "smooth" });
  };
  page.append(view.element, detail);
  if (solved.length > 0) show(solved[solved.length - 1]!, false);
}

/** Positions of journals over their clearance, of the k-th film; of other kinds there are none. */
function lines(sweep: Sweep, solutions: SolutionText[], k: number): ConstructorParameters<typeof Locus>[0]["lines"] {
  return sweep.lines.map((line, colour) => ({
    colour,
    points: line.solutions.flatMap((index) => {
      const { e, clearance } = solutions[index]!.films[k] ?? {};
      return !e || !clearance ? [] : [{ label: sweep.label(index), x: e[0] / clearance, y: e[1] / clearance, index }];
    }),
  }));
}

/** The centre of what moves in the k-th film in its clearance circle; nothing where there is no journal. */
function locusOf(sweep: Sweep, solutions: SolutionText[], k: number, only: number | null, pick: (index: number) => void): Locus | null {
  const all = lines(sweep, solutions, k).map((line) => ({ ...line, points: line.points.filter(({ index }) => only === null || index === only) }));
  if (all.every(({ points }) => points.length === 0)) return null;
  const clearance = (i: number) => solutions[i]!.films[k]?.clearance || (solutions.find((s) => !s.error)?.films[k]?.clearance ?? 0);
  return new Locus({ lines: all, load: (i) => solutions[i]!.load ?? [0, 0], clearance }, only ?? 0, pick);
}

/** Films of the first solution. */
const filmsOf = (solutions: SolutionText[]): FilmText[] => solutions.find(({ films }) => films.length > 0)?.films ?? [];

/** What moves in a film and what is around it. */
const centre = ({ name }: FilmText): string => (name === "outer" ? "ring’s centre in the shell" : name === "inner" ? "journal’s centre in the ring" : "journal’s centre");

/** Figures over the abscissa, and a table from which an operating point is picked. */
class SweepView {
  readonly element = h("section", { class: "study", "aria-label": "Sweep" });
  private readonly figures = h("div", { class: "figures" });
  private readonly loci: Locus[] = [];
  private readonly plots: LinePlot[] = [];

  constructor(
    private readonly bearing: BearingText,
    private readonly kind: BearingKind,
    private readonly sweep: Sweep,
    private readonly pick: (index: number) => void,
  ) {
    filmsOf(bearing.solutions).forEach((film, k) => {
      const locus = locusOf(sweep, bearing.solutions, k, null, pick);
      if (!locus) return;
      this.loci.push(locus);
      this.figures.append(figure(named("locus", film), `Locus of the ${centre(film)} in the clearance circle over ${sweep.abscissa}, bearing axes; the point shown in detail with its load (arrow). A click on a point shows it.`, null, locus.element));
    });
    this.addAll();
    this.element.append(h("h2", {}, `Sweep over ${sweep.parameters.map((p) => p.replaceAll("_", " ")).join(" and ")}`), this.figures, this.table(), ...this.failures());
  }

  choose(index: number): void {
    for (const locus of this.loci) locus.show(index);
    for (const plot of this.plots) plot.mark(this.sweep.place(index));
    this.element.querySelectorAll<HTMLElement>("tr[data-run]").forEach((row) => {
      const chosen = row.dataset["run"] === String(index);
      row.classList.toggle("chosen", chosen);
      row.querySelector("button")?.setAttribute("aria-pressed", chosen ? "true" : "false");
    });
  }

  private add({ name, caption, left, right, curves: specs, line }: SweepFigure): void {
    const isOfSeveral = specs.filter(({ alone }) => !alone).length > 1;
    const curves = specs.flatMap((spec) => this.curves(spec, isOfSeveral, line));
    const values = curves.flatMap((c) => Array.from(c.y).filter((v) => v !== null && Number.isFinite(v)));
    // A pad that cannot tilt has no slopes to show.
    if (values.length === 0 || (name === "tilt" && values.every((v) => v === 0))) return;
    const shown = curves.filter((c) => Array.from(c.y).some((v) => v !== null && Number.isFinite(v)));
    const { sweep } = this;
    const pickFrom = line ?? sweep.lines[0]!;
    const plot = new LinePlot({
      name: `${this.bearing.name}-${name}`,
      x: { label: sweep.abscissa, unit: typeset(sweep.unit), values: sweep.x, ...(sweep.isLog ? { log: true } : {}) },
      left,
      ...(right && shown.some((c) => c.axis === "right") ? { right } : {}),
      curves: shown,
      pick: (k) => {
        const index = sweep.at(pickFrom, k);
        if (index !== undefined && !this.bearing.solutions[index]!.error) this.pick(index);
      },
    });
    this.plots.push(plot);
    this.figures.append(figure(name, caption, plot.tools, plot.element));
  }

  /** A curve for each line of the sweep, or for the one that the figure is about. */
  private curves({ key, label, alone, sign, ...look }: SweepCurve, isOfSeveral: boolean, only?: Line): Curve[] {
    const { sweep } = this;
    if (alone && sweep.lines.length > 1) return [];
    return (only ? [only] : sweep.lines).map((line) => {
      const y = sweep.along(line, key);
      const sized = sign ? y.map((v) => (v !== null && sign * v > 0 ? sign * v : null)) : y;
      const name = only || !line.label ? label : isOfSeveral ? `${line.label}, ${label}` : line.label;
      return { points: true, ...look, label: name, y: sized };
    });
  }

  private addAll(): void {
    const { sweep } = this;
    const rough = sweep.solutions.some((s) => (figureOf(s, "asperity_share")?.value ?? 0) > 0);
    for (const one of this.kind.sweep({ over: `over ${sweep.abscissa}`, lines: sweep.lines, isStribeck: sweep.isStribeck, rough })) this.add(one);
  }

  private table(): HTMLElement {
    const { solutions } = this.bearing;
    const columns = this.kind.columns.filter(([key, , optional]) => !optional || solutions.some((s) => figureOf(s, key)?.value));
    const sample = solutions.find((s) => !s.error);
    const unit = (key: string) => shownUnit((sample ? figureOf(sample, key)?.unit : "") ?? "");
    const header = [
      ...this.sweep.parameters.map((p) => h("th", { scope: "col" }, p.replaceAll("_", " "))),
      ...columns.map(([key, name]) => h("th", { scope: "col", class: "number" }, `${name} ${unit(key)}`.trim())),
      h("th", { scope: "col" }, h("span", { class: "visually-hidden" }, "Detail")),
    ];
    const rows = this.sweep.lines.flatMap((line) => line.solutions).flatMap((index) => {
      const s = solutions[index]!;
      if (s.error) return [];
      return [
        h(
          "tr",
          { "data-run": index },
          ...s.values.map(([, text]) => h("td", {}, typeset(text))),
          ...columns.map(([key]) => h("td", { class: "number" }, valueText(figureOf(s, key)))),
          h("td", {}, h("button", { type: "button", class: "quiet", "aria-label": `Show ${this.sweep.label(index)} in detail`, click: () => this.pick(index) }, "Show")),
        ),
      ];
    });
    return h("div", { class: "wide-table" }, h("table", { class: "comparison" }, h("thead", {}, h("tr", {}, ...header)), h("tbody", {}, ...rows)));
  }

  private failures(): HTMLElement[] {
    const failed = this.bearing.solutions.flatMap((s, i) => (s.error ? [h("li", {}, `${this.sweep.label(i)}: ${s.error}`)] : []));
    return failed.length > 0 ? [h("section", { class: "note" }, h("h3", {}, "Without a solution"), h("ul", {}, ...failed))] : [];
  }
}

/** One operating point: key figures, tables, coefficients, figures of the film. */
class SolutionView {
  readonly element = h("div", { class: "run solution" });
  private readonly solution: SolutionText;

  constructor(
    bearing: BearingText,
    private readonly kind: BearingKind,
    sweep: Sweep,
    index: number,
  ) {
    this.solution = bearing.solutions[index]!;
    const figures = h("div", { class: "figures" });
    this.solution.films.forEach((film, k) => {
      const locus = locusOf(sweep, bearing.solutions, k, index, () => undefined);
      if (locus) figures.append(figure(named("locus", film), `The ${centre(film)} in the clearance circle, bearing axes, and the direction of the load (arrow).`, null, locus.element));
      this.addFilm(figures, film);
    });
    this.element.append(...[this.headline(), figures, kind.coefficients(this.solution), this.tables()].filter((e) => e !== null));
  }

  private value(key: string): number | null {
    return figureOf(this.solution, key)?.value ?? null;
  }

  private headline(): HTMLElement {
    return h(
      "div",
      { class: "tiles" },
      ...this.kind.tiles.flatMap(([key, label]) => {
        const f = figureOf(this.solution, key);
        return f ? [tile(label, f, placeOf(this.kind.surface, this.solution, key))] : [];
      }),
    );
  }

  private addFilm(figures: HTMLElement, film: FilmText): void {
    const fields = FilmFields.of(fieldsOnly(this.solution.datasets), film.bearing);
    if (!fields) return;
    const kinds = fields.kinds();
    const map = new FieldMap(fields, kinds[0]!, "run", film.features);
    // Figures know places between nodes; of the films of a ring there are none.
    const marks = film.name ? [...extremeMark(fields, "pressure", 1, "cross"), ...extremeMark(fields, "thickness", -1, "ring")] : [...this.mark("p_max", "cross"), ...this.mark("h_min", "ring")];
    map.show(0, marks);
    const choices = kinds.map(({ key, label }) => ({ value: key, label: capital(label.replace("Film ", "")) }));
    const controls = h("div", { class: "controls" }, segmented("Field shown", choices, kinds[0]!.key, (key) => map.choose(kinds.find((k: FieldKind) => k.key === key)!)));
    const drawn = film.features.length > 0 ? " White outlines: where oil is fed." : "";
    const which = film.name ? `The ${film.name} film, unwrapped` : `The film on ${fields.surface.map}`;
    figures.append(figure(named("map", film), `${which}.${drawn} Thin white line: edge of the full film; cross: peak pressure; ring: smallest film thickness.`, tableButton(`${film.bearing}-film`, () => map.numbers()), controls, map.element));
    const midplane = this.midplane(fields, film);
    if (midplane) figures.append(midplane);
  }

  /** Where a quantity has its extreme. */
  private mark(key: string, symbol: Mark["symbol"]): Mark[] {
    const { along, across } = this.kind.surface;
    const [x, y] = [along, across].map(({ figure: suffix, display }) => {
      const value = this.value(`${key}_${suffix}`);
      return value === null ? null : value / display.factor;
    });
    return typeof x === "number" && typeof y === "number" ? [{ along: x, across: y, symbol }] : [];
  }

  private midplane(fields: FilmFields, film: FilmText): HTMLElement | null {
    const { along, surface } = fields;
    const [pressure, thickness] = [fields.midplane("pressure", 0, megapascal.factor), fields.midplane("thickness", 0, micrometre.factor)];
    if (!pressure) return null;
    const curves: Curve[] = [{ label: "pressure", y: pressure, unit: "MPa", fill: true }];
    if (thickness) curves.push({ label: "film thickness", y: thickness, unit: "µm", axis: "right" });
    const plot = new LinePlot({
      name: `${film.bearing}-midplane`,
      x: { label: axisName(along.coordinate), unit: along.coordinate.display.unit, values: along.shown() },
      left: { label: `pressure at ${surface.middle}`, unit: "MPa", fromZero: true },
      ...(thickness ? { right: { label: "film thickness", unit: "µm", fromZero: true } } : {}),
      curves,
      height: 260,
    });
    return figure(named("midplane", film), `Pressure and film thickness along the middle of ${film.name ? `the ${film.name} film` : surface.whole}.`, plot.tools, plot.element);
  }

  private tables(): HTMLElement {
    const tables = groups.flatMap(([group, title]) => {
      const rows = this.solution.figures.filter((f) => f.group === group && !isNothing(f));
      return rows.length === 0 ? [] : h("table", {}, h("caption", {}, title), h("tbody", {}, ...rows.map((f) => row(f))));
    });
    return h("section", { class: "summary", "aria-label": "Figures" }, ...tables, this.solution.remark ? h("p", { class: "note" }, capital(this.solution.remark) + ".") : null);
  }
}

/** Name of a figure of one of several films. */
function named(name: string, film: FilmText): string {
  return film.name ? `${name}-${film.name}` : name;
}

/** The node at which a field is largest (sign 1) or smallest. */
function extremeMark(fields: FilmFields, key: string, sign: 1 | -1, symbol: Mark["symbol"]): Mark[] {
  const values = fields.at(key, 0);
  if (!values) return [];
  let best = 0;
  for (let i = 1; i < values.length; i++) if (sign * values[i]! > sign * values[best]!) best = i;
  const across = fields.across.nodes;
  return [{ along: fields.along.nodes[Math.floor(best / across.length)]!, across: across[best % across.length]!, symbol }];
}

/** A moment that symmetry makes zero but for round-off. */
function isNothing(f: FigureText): boolean {
  return f.key.startsWith("moment_") && Math.abs(f.value ?? 0) < 1e-9;
}

/** Greek letters and powers in names of figures: "S = µ N (R/c)² L D/W". */
function symbols(name: string): string {
  return name.trim().replace(/\bmu\b/g, "µ").replace(/\bomega\b/g, "ω").replaceAll("^2", "²").replace("sqrt(c/g)", "√(c/g)").replace("h_min/sigma", "h/σ");
}

function heading(name: string): string {
  const text = symbols(name);
  return /^[a-z]/.test(text) ? capital(text) : text;
}

function row(f: FigureText): HTMLElement {
  const error = errorText(f);
  return h("tr", { "data-quantity": f.key }, h("th", { scope: "row" }, heading(f.name), error ? h("span", { class: "where" }, error) : null), h("td", { class: "number" }, valueText(f), unitText(f)));
}

function tile(label: string, f: FigureText, where: string): HTMLElement {
  return h(
    "div",
    { class: "tile", "data-tile": f.key },
    h("div", { class: "tile-label" }, label),
    h("div", { class: "tile-value" }, valueText(f), unitText(f)),
    h("div", { class: "tile-where" }, [errorText(f), where].filter((text) => text).join("; ") || "\u00a0"),
  );
}
