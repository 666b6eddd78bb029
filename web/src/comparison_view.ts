// Runs laid over each other over the last cycle: curves, what they differ by, and a table of changes.

import { course, interpolated, sharedAbscissa, sharedPlaces, type Course } from "./cycle_course";
import type { Run } from "./data";
import { figure, h } from "./dom";
import { isOfCycle, keyRow, moft, spaced } from "./key_figures";
import { LinePlot, type Curve } from "./line_plot";
import { capital } from "./summary_table";
import { displayOf, format, megapascal, micrometre, type Display } from "./units";

/** More curves than this are a tangle. */
export const mostOverlaid = 8;

interface Quantity {
  name: string;
  label: string;
  display: Display;
}

/** What every film is asked for first; the rest can be chosen. */
const first: Quantity[] = [
  { name: "h_min", label: "smallest film thickness", display: micrometre },
  { name: "p_max", label: "peak film pressure", display: megapascal },
  { name: "force", label: "size of the film force", display: { factor: 1, unit: "N" } },
  { name: "power_film", label: "power loss in the film", display: { factor: 1, unit: "W" } },
];

export class ComparisonView {
  readonly element = h("section", { class: "overlay", "aria-label": "Runs laid over each other" });
  private readonly courses: { run: Run; label: string; course: Course }[];
  private reference = 0;
  private chosen: string;

  constructor(
    runs: Run[],
    label: (run: Run) => string,
    private readonly bearing: string,
  ) {
    const abscissa = sharedAbscissa(runs);
    this.courses = runs.flatMap((run) => {
      const one = course(run, abscissa);
      return one ? [{ run, label: label(run), course: one }] : [];
    });
    const given = this.others().map(({ name }) => name);
    this.chosen = ["eccentricity_ratio", "film_thickness_middle", "film_thickness_axis"].find((name) => given.includes(name)) ?? given[0] ?? "";
    this.render();
  }

  private path(name: string): string {
    return `/bearings/${this.bearing}/${name}`;
  }

  private render(): void {
    const { courses } = this;
    if (courses.length < 2) return;
    const reference = h("select", { "aria-label": "Run the others are compared with", change: () => this.change(() => (this.reference = Number(reference.value))) });
    courses.forEach(({ label }, i) => reference.append(h("option", { value: i, selected: i === this.reference }, label)));
    const figures = h("div", { class: "figures" }, ...first.flatMap((quantity) => this.pair(quantity)), ...this.chosenPair());
    this.element.replaceChildren(
      h("div", { class: "controls view-controls" }, h("h2", {}, `${this.courses.some(({ run }) => isOfCycle(keyRow(run, this.bearing, moft))) ? "Over the last cycle" : "Over time"}${this.bearing ? `: ${spaced(this.bearing)}` : ""}`), h("label", { class: "choice" }, "Differences from ", reference)),
      figures,
      this.changes(),
    );
  }

  private change(set: () => void): void {
    const focused = document.activeElement?.getAttribute("aria-label");
    set();
    const scroll = scrollY;
    this.render();
    scrollTo(0, scroll);
    if (focused) this.element.querySelector<HTMLElement>(`select[aria-label="${focused}"]`)?.focus();
  }

  /** Quantities of the film that all runs have, as their files describe them. */
  private others(): Quantity[] {
    const [run, ...rest] = this.courses.map((c) => c.run);
    if (!run) return [];
    return run
      .seriesIn(`/bearings/${this.bearing}`)
      .filter(({ name }) => !first.some((q) => q.name === name) && rest.every((other) => other.dataset(this.path(name))))
      .map(({ name, unit, description }) => ({ name, label: description || spaced(name), display: unit === "m" ? micrometre : displayOf(unit) }));
  }

  private chosenPair(): HTMLElement[] {
    const others = this.others();
    const quantity = others.find(({ name }) => name === this.chosen);
    if (!quantity) return [];
    const picker = h("select", { "aria-label": "Further quantity laid over each other", change: () => this.change(() => (this.chosen = picker.value)) });
    for (const { name, label } of others) picker.append(h("option", { value: name, selected: name === this.chosen }, capital(label)));
    return this.pair(quantity, h("div", { class: "controls" }, picker));
  }

  /** The curves, and beside them their differences from the reference. */
  private pair(quantity: Quantity, controls: HTMLElement | null = null): HTMLElement[] {
    const { label, display } = quantity;
    const found = this.courses.map((c) => ({ ...c, y: c.course.of(this.path(quantity.name)) }));
    if (found.some(({ y }) => y === null)) return [];
    const abscissa = sharedAbscissa(this.courses.map((c) => c.run));
    const places = sharedPlaces(this.courses.map((c) => c.course));
    const values = found.map(({ course: { x }, y }) => interpolated(x, y!, places).map((v) => (v === null ? null : v * display.factor)));
    const base = values[this.reference]!;
    const x = { label: abscissa.label, unit: abscissa.unit, values: places };
    const curves: Curve[] = found.map(({ label: name }, hue) => ({ label: name, unit: display.unit, y: values[hue]!, hue }));
    const overlay = new LinePlot({ name: `overlay-${quantity.name}`, x, left: { label, unit: display.unit }, curves });
    const differences: Curve[] = found.flatMap(({ label: name }, hue) =>
      hue === this.reference ? [] : [{ label: `${name} − ${found[this.reference]!.label}`, unit: display.unit, hue, y: values[hue]!.map((v, i) => (v === null || base[i] === null ? null : v - base[i]!)) }],
    );
    const difference = new LinePlot({ name: `difference-${quantity.name}`, x, left: { label: "difference", unit: display.unit, fromZero: true }, curves: differences });
    const over = `over ${abscissa.unit === "°" ? "the crank’s angle" : "time"}`;
    return [
      figure("overlay", `${capital(label)} ${over}, run over run.`, overlay.tools, controls, overlay.element),
      figure("difference", `The same, less that of ${found[this.reference]!.label}.`, difference.tools, difference.element),
    ];
  }

  /** Rows of the closing table that all runs have, with what they change by. */
  private changes(): HTMLElement {
    const runs = this.courses.map((c) => c.run);
    const base = runs[this.reference]!;
    const rows = base.summary.filter((row) => row.group === this.bearing || row.group === "run");
    const value = (run: Run, group: string, name: string) => run.summary.find((r) => r.group === group && r.name === name)?.value ?? null;
    const body = rows.flatMap((row) => {
      const values = runs.map((run) => value(run, row.group, row.name));
      const own = row.value;
      if (own === null || values.some((v) => v === null) || values.every((v) => v === own)) return [];
      const unit = row.unit ? (row.unit === "°" ? " [°]" : ` [${row.unit}]`) : "";
      const cells = values.flatMap((v, i) => [
        h("td", { class: "number" }, format(v)),
        ...(i === this.reference ? [] : [h("td", { class: "number change" }, changeText(v! - own, own))]),
      ]);
      return [h("tr", { "data-quantity": row.name }, h("th", { scope: "row" }, capital(row.name) + unit), ...cells)];
    });
    const head = this.courses.flatMap(({ label }, i) => [h("th", { scope: "col", class: "number" }, label), ...(i === this.reference ? [] : [h("th", { scope: "col", class: "number" }, "change")])]);
    const title = h("caption", {}, "Changes", h("span", { class: "where" }, `${spaced(this.bearing)} and the whole run; from ${this.courses[this.reference]!.label}; what is the same is left out`));
    return h(
      "div",
      { class: "wide-table changes", tabindex: 0, role: "region", "aria-label": "Table of changes" },
      h("table", { class: "change-table" }, title, h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "Quantity"), ...head)), h("tbody", {}, ...body)),
    );
  }
}

/** "+1.2 (+3.4 %)". */
function changeText(change: number, from: number): string {
  const sign = (v: number) => (v > 0 ? "+" : "");
  const share = from !== 0 ? ` (${sign((100 * change) / Math.abs(from))}${format((100 * change) / Math.abs(from), 3)} %)` : "";
  return `${sign(change)}${format(change)}${share}`;
}
