// A bearing by itself: its operating point, or a sweep with one of its solutions in detail.

import { figureOf, Sweep, type Line } from "./bearing_sweep";
import { bearingVerdict, placeOf } from "./bearing_verdict";
import { sweepDrawings } from "./canvas";
import { fieldsOnly, type BearingText, type FigureText, type SolutionText } from "./data";
import { figure, h, segmented, tableButton } from "./dom";
import { FieldMap } from "./field_map";
import { FilmFields, type FieldKind } from "./film_fields";
import { assumptions, date, themeButton } from "./header";
import { LinePlot, sweepPlots, type Curve, type LineFigure } from "./line_plot";
import { Locus } from "./locus";
import { capital } from "./summary_table";
import { format, megapascal, micrometre, shownUnit, typeset } from "./units";

const groups: [string, string][] = [
  ["operating point", "Operating point"],
  ["film", "Film"],
  ["deformation", "Deformation"],
  ["friction", "Friction"],
  ["oil", "Oil"],
  ["heat", "Heat"],
  ["numbers", "Numbers"],
  ["stability", "Stability of a rigid rotor"],
];

/** What stands large above the figures. */
const tiles: [string, string][] = [
  ["h_min", "Minimum film thickness"],
  ["p_max", "Peak film pressure"],
  ["eccentricity_ratio", "Eccentricity ratio"],
  ["attitude", "Attitude angle"],
  ["friction_journal", "Friction coefficient"],
  ["side_flow", "Side flow"],
];

export function showBearing(page: HTMLElement, title: string, bearing: BearingText): void {
  const sweep = new Sweep(bearing);
  const solved = bearing.solutions.flatMap((s, i) => (s.error ? [] : [i]));
  page.append(head(title, bearing, solved.length), bearingVerdict(bearing, sweep));
  const notes = assumptions(bearing.conditions);
  if (notes) page.append(notes);
  if (bearing.solutions.length === 1) {
    page.append(solved.length === 1 ? new SolutionView(bearing, sweep, 0).element : h("p", { class: "fault" }, bearing.solutions[0]!.error));
    return;
  }
  showSweep(page, bearing, sweep, solved);
}

function head(title: string, bearing: BearingText, solved: number): HTMLElement {
  document.title = `${title} · hersey`;
  const count = bearing.solutions.length;
  const facts = [
    bearing.file,
    `bearing ${bearing.name.replaceAll("_", " ")} by itself`,
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

function showSweep(page: HTMLElement, bearing: BearingText, sweep: Sweep, solved: number[]): void {
  const detail = h("section", { class: "detail", "aria-label": "Operating point in detail" });
  const picker = h("select", { "aria-label": "Operating point shown in detail", change: () => show(Number(picker.value), false) });
  for (const i of solved) picker.append(h("option", { value: i }, sweep.label(i)));
  const view = new SweepView(bearing, sweep, (index) => show(index, true));
  const show = (index: number, scroll: boolean) => {
    picker.value = String(index);
    view.choose(index);
    detail.replaceChildren(h("div", { class: "detail-head" }, h("h2", {}, "Operating point in detail"), picker), new SolutionView(bearing, sweep, index).element);
    sweepPlots();
    sweepDrawings();
    if (scroll) detail.scrollIntoView({ behavior: "smooth" });
  };
  page.append(view.element, detail);
  if (solved.length > 0) show(solved[solved.length - 1]!, false);
}

function lines(sweep: Sweep, solutions: SolutionText[]): ConstructorParameters<typeof Locus>[0]["lines"] {
  return sweep.lines.map((line, colour) => ({
    colour,
    points: line.solutions.flatMap((index) => {
      const s = solutions[index]!;
      return s.error ? [] : [{ label: sweep.label(index), x: s.e[0] / s.clearance, y: s.e[1] / s.clearance, index }];
    }),
  }));
}

/** Figures over the abscissa, and a table from which an operating point is picked. */
class SweepView {
  readonly element = h("section", { class: "study", "aria-label": "Sweep" });
  private readonly figures = h("div", { class: "figures" });
  private readonly locus: Locus;
  private readonly plots: LinePlot[] = [];

  constructor(
    private readonly bearing: BearingText,
    private readonly sweep: Sweep,
    private readonly pick: (index: number) => void,
  ) {
    const { solutions } = bearing;
    this.locus = new Locus({ lines: lines(sweep, solutions), load: (i) => solutions[i]!.load, clearance: (i) => solutions[i]!.clearance || solutions.find((s) => !s.error)!.clearance }, 0, pick);
    this.figures.append(figure("locus", `Locus of the journal’s centre in the clearance circle over ${sweep.abscissa}, bearing axes; the point shown in detail with its load (arrow). A click on a point shows it.`, null, this.locus.element));
    this.addAll();
    this.element.append(h("h2", {}, `Sweep over ${sweep.parameters.map((p) => p.replaceAll("_", " ")).join(" and ")}`), this.figures, this.table(), ...this.failures());
  }

  choose(index: number): void {
    this.locus.show(index);
    for (const plot of this.plots) plot.mark(this.sweep.place(index));
    this.element.querySelectorAll<HTMLElement>("tr[data-run]").forEach((row) => {
      const chosen = row.dataset["run"] === String(index);
      row.classList.toggle("chosen", chosen);
      row.querySelector("button")?.setAttribute("aria-pressed", chosen ? "true" : "false");
    });
  }

  private add(name: string, caption: string, left: LineFigure["left"], curves: Curve[], right?: LineFigure["right"], pickFrom: Line = this.sweep.lines[0]!): void {
    const shown = curves.filter((c) => Array.from(c.y).some((v) => v !== null && Number.isFinite(v)));
    if (shown.length === 0) return;
    const { sweep } = this;
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

  /** A curve per line of the sweep. */
  private each(key: string, label: string, unit: string, extra: Partial<Curve> = {}): Curve[] {
    return this.sweep.lines.map((line) => ({ label: line.label || label, unit, points: true, y: this.sweep.along(line, key), ...extra }));
  }

  /** Only where a single parameter is varied: a second quantity would drown among many lines. */
  private alone(key: string, label: string, unit: string, extra: Partial<Curve> = {}): Curve[] {
    return this.sweep.lines.length === 1 ? this.each(key, label, unit, extra) : [];
  }

  private addAll(): void {
    const over = `over ${this.sweep.abscissa}`;
    this.add("film", `Smallest film thickness ${over}.`, { label: "minimum film thickness", unit: "µm", fromZero: true }, this.each("h_min", "smallest", "µm"));
    this.add("eccentricity", `Eccentricity ratio${this.sweep.lines.length === 1 ? " and attitude angle" : ""} ${over}.`, { label: "eccentricity ratio", unit: "", fromZero: true }, [
      ...this.each("eccentricity_ratio", "eccentricity ratio", ""),
      ...this.alone("attitude", "attitude", "°", { axis: "right", dash: [6, 4] }),
    ], { label: "attitude angle", unit: "°" });
    const rough = this.sweep.solutions.some((s) => (figureOf(s, "asperity_share")?.value ?? 0) > 0);
    this.add("friction", `Friction coefficient ${over}${this.sweep.isStribeck ? ": the Stribeck curve" : ""}${rough ? ", with the share of the load on asperities" : ""}.`, { label: "friction coefficient", unit: "", log: true }, [
      ...this.each("friction_journal", "friction coefficient", ""),
      ...(rough ? this.alone("asperity_share", "share on asperities", "", { axis: "right", dash: [6, 4] }) : []),
    ], { label: "share on asperities", unit: "", fromZero: true });
    this.add("pressure", `Peak film pressure ${over}.`, { label: "peak film pressure", unit: "MPa", fromZero: true }, this.each("p_max", "peak pressure", "MPa"));
    for (const line of this.sweep.lines.slice(0, 4)) this.addCoefficients(line);
    this.add("stability", `Critical mass of a rigid rotor${this.sweep.lines.length === 1 ? " and its whirl ratio (whirl frequency by the journal’s speed)" : ""} ${over}; gaps: stable at every mass.`, { label: "critical mass", unit: "kg", log: true }, [
      ...this.each("critical_mass", "critical mass", "kg"),
      ...this.alone("whirl_ratio", "whirl ratio", "", { axis: "right", dash: [6, 4] }),
    ], { label: "whirl ratio", unit: "", fromZero: true });
    this.add("flow", `Oil leaving over both edges ${over}.`, { label: "side flow", unit: "mm³/s", fromZero: true }, this.each("side_flow", "side flow", "mm³/s"));
    this.add("power", `Power lost to friction ${over}.`, { label: "friction power", unit: "W", fromZero: true }, [
      ...this.each("power_film", "oil film", "W"),
      ...(rough ? this.alone("power_asperity", "asperities", "W", { dash: [6, 4] }) : []),
    ]);
  }

  private addCoefficients(line: Line): void {
    const of = line.label ? `; ${line.label}` : "";
    const pairs = ["xx", "xy", "yx", "yy"];
    const curves = (symbol: string): Curve[] =>
      pairs.flatMap((pair, hue) => {
        const y = this.sweep.along(line, `${symbol}_${pair}`);
        const only = (sign: number) => y.map((v) => (v !== null && sign * v > 0 ? sign * v : null));
        const name = `${symbol}${pair}`;
        return [
          { label: name, unit: "", y: only(1), points: true, hue, ...(hue === 1 || hue === 2 ? { dash: [6, 4] } : {}) },
          { label: `−${name}`, unit: "", y: only(-1), points: true, hue, dash: [2, 3] },
        ];
      });
    const axes = "x along the load, y a quarter turn on in the sense of rotation";
    const signs = (symbol: string) => `Dotted, as −${symbol}: where a coefficient is negative.`;
    const over = `over ${this.sweep.abscissa}`;
    this.add("stiffness", `Stiffness coefficients K = k c/W ${over}, ${axes}${of}. ${signs("K")}`, { label: "stiffness ±K", unit: "", log: true }, curves("K"), undefined, line);
    this.add("damping", `Damping coefficients C = b c ω/W ${over}, ${axes}${of}. ${signs("C")}`, { label: "damping ±C", unit: "", log: true }, curves("C"), undefined, line);
  }

  private table(): HTMLElement {
    const columns = ["load", "eccentricity_ratio", "attitude", "h_min", "p_max", "friction_journal", "asperity_share", "side_flow", "critical_mass", "sommerfeld_S"];
    const names: Record<string, string> = { load: "load", eccentricity_ratio: "ε", attitude: "attitude", h_min: "h min", p_max: "p max", friction_journal: "friction", asperity_share: "contact", side_flow: "side flow", critical_mass: "critical mass", sommerfeld_S: "S" };
    const { solutions } = this.bearing;
    const sample = solutions.find((s) => !s.error);
    const unit = (key: string) => shownUnit((sample ? figureOf(sample, key)?.unit : "") ?? "");
    const header = [
      ...this.sweep.parameters.map((p) => h("th", { scope: "col" }, p.replaceAll("_", " "))),
      ...columns.map((key) => h("th", { scope: "col", class: "number" }, `${names[key]} ${unit(key)}`.trim())),
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
          ...columns.map((key) => h("td", { class: "number" }, valueText(figureOf(s, key)))),
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
    private readonly bearing: BearingText,
    sweep: Sweep,
    index: number,
  ) {
    this.solution = bearing.solutions[index]!;
    const figures = h("div", { class: "figures" });
    const locus = new Locus({ lines: lines(sweep, bearing.solutions).map((line) => ({ ...line, points: line.points.filter((p) => p.index === index) })), load: () => this.solution.load, clearance: () => this.solution.clearance }, index, () => undefined);
    figures.append(figure("locus", "The journal’s centre in the clearance circle, bearing axes, and the direction of the load (arrow).", null, locus.element));
    this.addFilm(figures);
    this.element.append(this.headline(), figures, this.coefficients(), this.tables());
  }

  private value(key: string): number | null {
    return figureOf(this.solution, key)?.value ?? null;
  }

  private headline(): HTMLElement {
    return h(
      "div",
      { class: "tiles" },
      ...tiles.flatMap(([key, label]) => {
        const f = figureOf(this.solution, key);
        return f ? [tile(label, f, placeOf(this.solution, key))] : [];
      }),
    );
  }

  private addFilm(figures: HTMLElement): void {
    const fields = FilmFields.of(fieldsOnly(this.solution.datasets), this.bearing.name);
    if (!fields) return;
    const kinds = fields.kinds();
    const map = new FieldMap(fields, kinds[0]!, "run", this.solution.features);
    const radian = (key: string) => ((this.value(key) ?? 0) * Math.PI) / 180;
    map.show(0, [
      { phi: radian("p_max_angle"), z: 1e-3 * (this.value("p_max_z") ?? 0), symbol: "cross" },
      { phi: radian("h_min_angle"), z: 1e-3 * (this.value("h_min_z") ?? 0), symbol: "ring" },
    ]);
    const choices = kinds.map(({ key, label }) => ({ value: key, label: capital(label.replace("Film ", "")) }));
    const controls = h("div", { class: "controls" }, segmented("Field shown", choices, kinds[0]!.key, (key) => map.choose(kinds.find((k: FieldKind) => k.key === key)!)));
    const drawn = this.solution.features.length > 0 ? " White outlines: where oil is fed." : "";
    figures.append(figure("map", `The film on the unwrapped bearing.${drawn} Thin white line: edge of the full film; cross: peak pressure; ring: smallest film thickness.`, tableButton(`${this.bearing.name}-film`, () => map.numbers()), controls, map.element));
    figures.append(this.midplane(fields));
  }

  private midplane(fields: FilmFields): HTMLElement {
    const closed = (values: ArrayLike<number>, factor: number) => [...Array.from(values, (v) => v * factor), values[0]! * factor];
    const plot = new LinePlot({
      name: `${this.bearing.name}-midplane`,
      x: { label: "bearing angle φ", unit: "°", values: [...Array.from(fields.phi, (v) => (v * 180) / Math.PI), 360 + (fields.phi[0]! * 180) / Math.PI] },
      left: { label: "pressure at z = 0", unit: "MPa", fromZero: true },
      right: { label: "film thickness", unit: "µm", fromZero: true },
      curves: [
        { label: "pressure", y: closed(fields.midplane("pressure", 0)!, megapascal.factor), unit: "MPa", fill: true },
        { label: "film thickness", y: closed(fields.midplane("thickness", 0)!, micrometre.factor), unit: "µm", axis: "right" },
      ],
      height: 260,
    });
    return figure("midplane", "Pressure and film thickness along the middle of the bearing.", plot.tools, plot.element);
  }

  private coefficients(): HTMLElement {
    const axes = ["x", "y"];
    const cell = (key: string) => h("td", { class: "number", "data-quantity": key }, format(this.value(key)));
    // One error for all entries of a matrix.
    const error = (key: string) => this.solution.figures.find((f) => f.key === `${key}_xx` && f.grid_error);
    const foot = (f: FigureText) => h("tfoot", {}, h("tr", {}, h("td", { class: "number", colspan: "3" }, h("span", { class: "where" }, errorText(f)))));
    const matrix = (title: string, key: string) => {
      const known = error(key);
      return h(
        "table",
        { class: "matrix" },
        h("caption", {}, title),
        h("thead", {}, h("tr", {}, h("td", {}), ...axes.map((axis) => h("th", { scope: "col", class: "number" }, axis)))),
        h("tbody", {}, ...axes.map((row) => h("tr", {}, h("th", { scope: "row" }, row), ...axes.map((column) => cell(`${key}_${row}${column}`))))),
        known ? foot(known) : null,
      );
    };
    return h(
      "section",
      { class: "summary matrices", "aria-label": "Stiffness and damping" },
      matrix("K = k c/W, axes of the load", "K"),
      matrix("C = b c ω/W, axes of the load", "C"),
      matrix("Stiffness k [N/m], bearing axes", "stiffness"),
      matrix("Damping b [N·s/m], bearing axes", "damping"),
      h("p", { class: "note" }, "Row: force of the film on the shell; column: displacement or velocity of the journal. Axes of the load: x along the load, y a quarter turn on in the sense of rotation."),
    );
  }

  private tables(): HTMLElement {
    const tables = groups.flatMap(([group, title]) => {
      const rows = this.solution.figures.filter((f) => f.group === group && !isNothing(f));
      return rows.length === 0 ? [] : h("table", {}, h("caption", {}, title), h("tbody", {}, ...rows.map((f) => row(f))));
    });
    return h("section", { class: "summary", "aria-label": "Figures" }, ...tables, this.solution.remark ? h("p", { class: "note" }, capital(this.solution.remark) + ".") : null);
  }
}

/** A moment that symmetry makes zero but for round-off. */
function isNothing(f: FigureText): boolean {
  return f.key.startsWith("moment_") && Math.abs(f.value ?? 0) < 1e-9;
}

/** Greek letters and powers in names of figures: "S = µ N (R/c)² L D/W". */
function symbols(name: string): string {
  return name.trim().replace(/\bmu\b/g, "µ").replace(/\bomega\b/g, "ω").replace("^2", "²").replace("sqrt(c/g)", "√(c/g)").replace("h_min/sigma", "h/σ");
}

function heading(name: string): string {
  const text = symbols(name);
  return /^[a-z]/.test(text) ? capital(text) : text;
}

/** With as many digits as its error leaves: 5.618. */
function valueText(f: FigureText | undefined): string {
  if (f?.words) return f.words;
  if (!f || f.value === null) return "–";
  if (!f.grid_error || f.grid_error > Math.abs(f.value)) return format(f.value);
  const decimals = Math.min(12, Math.max(0, 1 - Math.floor(Math.log10(f.grid_error))));
  return f.value.toFixed(decimals).replace("-", "−");
}

function errorText(f: FigureText): string {
  return f.grid_error ? `± ${format(f.grid_error, 2)} (grid)` : "";
}

function unitText(f: FigureText): HTMLElement | null {
  if (f.words) return null;
  const unit = shownUnit(f.unit);
  return unit ? h("span", { class: "unit" }, unit === "°" ? "°" : ` ${unit}`) : null;
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
