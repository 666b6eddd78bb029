// One run in detail: key figures, table, and all figures, tied together by the timeline.

import { BearingView } from "./bearing_view";
import { sweepDrawings } from "./canvas";
import type { FieldsFile, Run } from "./data";
import { h, segmented } from "./dom";
import { loadFields } from "./fields_file";
import { nearest } from "./film_fields";
import { filmLoss, hottestOil, keyRow, largestLoad, moft, pofp, spaced, tileOf, worstFirst } from "./key_figures";
import { sweepPlots } from "./line_plot";
import { MachineView, sweepMachineViews } from "./machine_view";
import { ModePlayer } from "./mode_player";
import { Overview } from "./overview";
import { speedAbscissa, type Abscissa } from "./series";
import { summaryTables } from "./summary_table";
import { SystemView } from "./system_view";
import { Timeline } from "./timeline";
import { format } from "./units";
import { verdict } from "./verdict";

/** The rows of the summary that stand large above the figures of one of several bearings. */
const keyFigures: [string, string][] = [
  [moft, "Minimum film thickness"],
  [pofp, "Peak film pressure"],
  [hottestOil, "Hottest oil"],
  [largestLoad, "Largest load"],
  [filmLoss, "Mean film power loss"],
  ["worst mass-balance error of the film", "Worst mass-balance error"],
];

export class RunView {
  readonly element = h("div", { class: "run" });
  private bearing: string;
  private abscissa: Abscissa;
  private timeline: Timeline | null = null;
  private time: number | null = null;
  private showTime: (time: number) => void = () => {};
  /** The row under a figure's cursor, drawn with the next picture; undefined while none waits. */
  private waiting: number | null | undefined;
  private readonly overview: Overview | null;
  private readonly changing = h("div", { class: "changing" });

  constructor(
    private readonly run: Run,
    notes: HTMLElement | null,
  ) {
    this.bearing = worstFirst(run)[0] ?? "";
    this.abscissa = run.column("/crank_angle") ? "angle" : "time";
    this.overview = this.bearing ? new Overview(run, (bearing) => this.change(() => (this.bearing = bearing))) : null;
    this.element.append(...[verdict(run), this.overview?.element ?? null, notes, this.changing].filter((e) => e !== null));
    this.render();
  }

  private render(): void {
    this.timeline?.stop();
    const { run, bearing, abscissa } = this;
    const pick = (time: number) => this.timeline?.show(nearest(instants, time));
    const hover = (row: number | null) => this.hover(row);
    const view = bearing ? new BearingView(run, bearing, abscissa, pick, hover) : null;
    const machine = MachineView.of(run);
    const modes = machine ? ModePlayer.of(run, machine) : null;
    const system = new SystemView(run, abscissa, pick, hover);
    const instants = view?.fields?.time ?? run.column("/time") ?? new Float64Array();
    this.showTime = (time) => {
      view?.show(time, nearest(instants, time));
      machine?.show(time);
      system.show(time);
      this.overview?.show(time);
    };
    const timeline = new Timeline(instants, this.anglesAt(instants), (index) => {
      this.time = instants[index]!;
      this.showTime(this.time);
    });
    this.timeline = timeline;
    this.overview?.highlight(bearing);
    this.changing.replaceChildren(
      ...[this.controls(), this.headline(), this.notes(), view?.element ?? null, modes?.element ?? null, machine ? h("div", { class: "figures" }, machine.element) : null, this.table(), view?.further ?? null, system.element, timeline.element].filter((e) => e !== null),
    );
    sweepPlots();
    sweepDrawings();
    sweepMachineViews();
    if (instants.length > 0) timeline.show(nearest(instants, this.time ?? this.firstShown(instants)));
    if (instants.length < 2) timeline.element.remove();
  }

  /** All figures follow the cursor of one of them, and go back to the instant shown when it leaves. */
  private hover(row: number | null): void {
    if (this.waiting === undefined) requestAnimationFrame(() => this.follow());
    this.waiting = row;
  }

  private follow(): void {
    const row = this.waiting ?? null;
    this.waiting = undefined;
    const { timeline } = this;
    // A film that plays is not held up by a pointer that lies on a figure.
    if (!timeline || timeline.isPlaying) return;
    if (row === null) return timeline.show(timeline.index);
    const time = this.run.column("/time")?.[row];
    if (time === undefined) return;
    timeline.tell(time, this.run.column("/crank_angle")?.[row] ?? null);
    this.showTime(time);
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
    if (bearings.length > 1) {
      const picker = h("select", { "aria-label": "Bearing shown in detail", change: () => this.change(() => (this.bearing = picker.value)) });
      for (const b of worstFirst(this.run)) picker.append(h("option", { value: b, selected: b === this.bearing }, spaced(b)));
      parts.push(h("h2", {}, `Bearing ${spaced(this.bearing)}`), picker);
    }
    const choices = [
      ...(this.run.column("/crank_angle") ? [{ value: "angle", label: "Crank angle" }] : []),
      { value: "time", label: "Time" },
      ...(speedAbscissa(this.run) ? [{ value: "speed", label: "Speed" }] : []),
    ];
    if (choices.length > 1)
      parts.push(segmented("Abscissa", choices, this.abscissa, (a) => this.change(() => (this.abscissa = a as Abscissa))));
    return parts.length > 0 ? h("div", { class: "controls view-controls" }, ...parts) : null;
  }

  private change(set: () => void): void {
    const focused = document.activeElement?.getAttribute("aria-label");
    set();
    const scroll = scrollY;
    this.render();
    scrollTo(0, scroll);
    // A control that was drawn anew keeps the keyboard.
    if (focused) this.changing.querySelector<HTMLElement>(`select[aria-label="${focused}"]`)?.focus();
  }

  private headline(): HTMLElement | null {
    // The verdict has shown those of an only bearing.
    if (this.run.children("/bearings").length < 2) return null;
    const tiles = keyFigures.flatMap(([name, label]) => {
      const row = keyRow(this.run, this.bearing, name);
      return row ? [tileOf(label, row)] : [];
    });
    return tiles.length > 0 ? h("div", { class: "tiles bearing-tiles" }, ...tiles) : null;
  }

  private notes(): HTMLElement | null {
    const { run, bearing } = this;
    const beside = run.fieldsBeside(bearing);
    const shown = run.dataset(`/bearings/${bearing}/fields/time`)?.values.length ?? 0;
    const parts = [
      run.seriesStride > 1 ? `Curves show every ${ordinal(run.seriesStride)} stored instant; the summary uses all of them.` : "",
      beside ? `Maps show ${shown} of ${beside.instants} stored fields.` : "",
    ].filter((text) => text);
    return parts.length > 0 ? h("p", { class: "note" }, parts.join(" "), beside ? " " : null, beside ? this.loader(beside) : null) : null;
  }

  /** Loads what the page has not of the fields of the bearing shown, and shows it. */
  private loader({ bearing, instants, bytes }: FieldsFile): HTMLElement {
    const button = h("button", { type: "button", class: "quiet" }, `Load all ${instants} (${format(bytes / 1e6, 2)} MB)`);
    button.addEventListener("click", () => {
      button.disabled = true;
      loadFields(this.run, bearing).then(
        () => this.change(() => undefined),
        (error: Error) => button.replaceWith(h("span", { class: "fault", role: "status" }, error.message)),
      );
    });
    return button;
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

function ordinal(n: number): string {
  const suffix = n % 10 === 1 && n % 100 !== 11 ? "st" : n % 10 === 2 && n % 100 !== 12 ? "nd" : n % 10 === 3 && n % 100 !== 13 ? "rd" : "th";
  return `${n}${suffix}`;
}
