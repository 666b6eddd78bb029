// One run in detail: key figures, table, and all figures, tied together by the timeline.

import { BearingView } from "./bearing_view";
import { sweepDrawings } from "./canvas";
import type { Run, SummaryRow } from "./data";
import { h, segmented } from "./dom";
import { nearest } from "./film_fields";
import { sweepPlots } from "./line_plot";
import { MachineView, sweepMachineViews } from "./machine_view";
import { ModePlayer } from "./mode_player";
import type { Abscissa } from "./series";
import { place, summaryTables } from "./summary_table";
import { SystemView } from "./system_view";
import { Timeline } from "./timeline";
import { format } from "./units";

/** The rows of the summary that stand large above the figures. */
const keyFigures: [string, string][] = [
  ["minimum film thickness (MOFT)", "Minimum film thickness"],
  ["peak film pressure (POFP)", "Peak film pressure"],
  ["largest load", "Largest load"],
  ["mean power loss in the film", "Mean film power loss"],
  ["worst mass-balance error of the film", "Worst mass-balance error"],
];

export class RunView {
  readonly element = h("div", { class: "run" });
  private bearing: string;
  private abscissa: Abscissa;
  private timeline: Timeline | null = null;
  private time: number | null = null;

  constructor(private readonly run: Run) {
    this.bearing = run.children("/bearings")[0] ?? "";
    this.abscissa = run.column("/crank_angle") ? "angle" : "time";
    this.render();
  }

  private render(): void {
    this.timeline?.stop();
    const { run, bearing, abscissa } = this;
    const view = bearing ? new BearingView(run, bearing, abscissa, (time) => this.timeline?.show(nearest(instants, time))) : null;
    const machine = MachineView.of(run);
    const modes = machine ? ModePlayer.of(run, machine) : null;
    const system = new SystemView(run, abscissa);
    const instants = view?.fields?.time ?? run.column("/time") ?? new Float64Array();
    const timeline = new Timeline(instants, this.anglesAt(instants), (index) => {
      const time = instants[index]!;
      this.time = time;
      view?.show(time, index);
      machine?.show(time);
      system.show(time);
    });
    this.timeline = timeline;
    this.element.replaceChildren(
      ...[this.controls(), this.headline(), this.table(), view?.element ?? null, modes?.element ?? null, machine ? h("div", { class: "figures" }, machine.element) : null, this.notes(), system.element, timeline.element].filter((e) => e !== null),
    );
    sweepPlots();
    sweepDrawings();
    sweepMachineViews();
    if (instants.length > 0) timeline.show(nearest(instants, this.time ?? this.firstShown(instants)));
    if (instants.length < 2) timeline.element.remove();
  }

  /** The last time within the last cycle at which the pressure is at its peak: of a settled run, the end. */
  private firstShown(instants: ArrayLike<number>): number {
    const last = instants[instants.length - 1]!;
    const time = this.run.column("/time");
    const angle = this.run.column("/crank_angle");
    const pressure = this.run.column(`/bearings/${this.bearing}/p_max`);
    if (!time || !angle || !pressure) return last;
    const cycle = 4 * Math.PI;
    const end = angle.length - 1;
    let best = end;
    for (let i = end; i >= 0 && Math.abs(angle[end]! - angle[i]!) <= cycle; i--)
      if (pressure[i]! > 1.001 * pressure[best]!) best = i;
    return best === end ? last : time[best]!;
  }

  private anglesAt(instants: ArrayLike<number>): ArrayLike<number> | null {
    const angle = this.run.column("/crank_angle");
    const time = this.run.column("/time");
    return angle && time ? Float64Array.from(instants, (t) => angle[nearest(time, t)]!) : null;
  }

  private controls(): HTMLElement | null {
    const bearings = this.run.children("/bearings");
    const parts: HTMLElement[] = [];
    if (bearings.length > 1)
      parts.push(segmented("Bearing", bearings.map((b) => ({ value: b, label: b.replaceAll("_", " ") })), this.bearing, (b) => this.change(() => (this.bearing = b))));
    if (this.run.column("/crank_angle"))
      parts.push(segmented("Abscissa", [{ value: "angle", label: "Crank angle" }, { value: "time", label: "Time" }], this.abscissa, (a) => this.change(() => (this.abscissa = a as Abscissa))));
    return parts.length > 0 ? h("div", { class: "controls view-controls" }, ...parts) : null;
  }

  private change(set: () => void): void {
    set();
    const scroll = scrollY;
    this.render();
    scrollTo(0, scroll);
  }

  private headline(): HTMLElement | null {
    const rows = this.run.summary.filter((row) => row.group === this.bearing);
    const tiles = keyFigures.flatMap(([name, label]) => {
      const row = rows.find((r) => r.name === name);
      return row ? [tile(label, row)] : [];
    });
    return tiles.length > 0 ? h("div", { class: "tiles" }, ...tiles) : null;
  }

  private notes(): HTMLElement | null {
    const parts = [
      this.run.seriesStride > 1 ? `Curves show every ${ordinal(this.run.seriesStride)} stored instant; the summary uses all of them.` : "",
      this.run.fieldStride > 1 ? `Maps show every ${ordinal(this.run.fieldStride)} stored field.` : "",
    ].filter((text) => text);
    return parts.length > 0 ? h("p", { class: "note" }, parts.join(" ")) : null;
  }

  private table(): HTMLElement {
    const tables = [
      ...summaryTables(this.run, this.bearing, `Bearing ${this.bearing.replaceAll("_", " ")}`),
      ...summaryTables(this.run, "modes", "Small motions"),
      h("div", { class: "stack" }, ...summaryTables(this.run, "run", "Whole run"), ...summaryTables(this.run, "cycles", "Cycles")),
    ];
    return h("section", { class: "summary", "aria-label": "Summary" }, ...tables);
  }
}

function tile(label: string, row: SummaryRow): HTMLElement {
  return h(
    "div",
    { class: "tile" },
    h("div", { class: "tile-label" }, label),
    h("div", { class: "tile-value" }, format(row.value), row.unit ? h("span", { class: "unit" }, ` ${row.unit}`) : null),
    h("div", { class: "tile-where" }, place(row.where) || "\u00a0"),
  );
}

function ordinal(n: number): string {
  const suffix = n % 10 === 1 && n % 100 !== 11 ? "st" : n % 10 === 2 && n % 100 !== 12 ? "nd" : n % 10 === 3 && n % 100 !== 13 ? "rd" : "th";
  return `${n}${suffix}`;
}
