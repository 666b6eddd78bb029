// Spectra of any series of a run: over frequency or over the orders of a shaft; of a run-up, over its speed as well.

import type { Run } from "./data";
import { figure, h, segmented, tableButton } from "./dom";
import { spaced } from "./key_figures";
import { LinePlot, type Curve } from "./line_plot";
import { lastCycle } from "./overview";
import { scaled } from "./series";
import { isRunUp, isSorted, shafts, type Shaft } from "./shafts";
import { ascending, orderLines, orderTrack, pieces, spectrum, type Spectrum } from "./spectrum";
import { SpectrumMap } from "./spectrum_map";
import { capital } from "./summary_table";
import { axisLabel, displayOf, format, micrometre, type Display } from "./units";
import { waterfall, type WaterfallAxes } from "./waterfall";

interface Choice {
  path: string;
  column: number;
  group: string;
  label: string;
  display: Display;
}

/** Lines that are smaller than this share of the largest, and above all others, are not shown. */
const negligible = 2e-3;
const mostPieces = 30;
const mostTracks = 150;
const tracked = [0.5, 1, 2, 3];

const settings = { series: "", over: "frequency", stretch: "settled", scale: "linear", shaft: "" };

export class SpectraView {
  readonly element = h("div", { class: "spectra" });
  private readonly choices: Choice[];
  private readonly shafts: Shaft[];
  private readonly time: Float64Array;

  /** Null where there are too few instants, or where nothing is recorded of them. */
  static of(run: Run): SpectraView | null {
    const time = run.column("/time");
    if (!time || time.length < 32) return null;
    const view = new SpectraView(run, Float64Array.from(time));
    return view.choices.length > 0 ? view : null;
  }

  /** Whether the run goes through a range of speeds: spectra are what it is made for. */
  static isRunUp(run: Run): boolean {
    const shaft = shafts(run)[0];
    return shaft !== undefined && isRunUp(shaft);
  }

  private constructor(
    private readonly run: Run,
    time: Float64Array,
  ) {
    this.time = time;
    this.shafts = shafts(run);
    this.choices = choicesOf(run);
  }

  render(): void {
    const { choice, shaft } = this;
    const picker = h("select", { "aria-label": "Series whose spectrum is shown", change: () => this.set("series", picker.value) });
    for (const group of [...new Set(this.choices.map((c) => c.group))])
      picker.append(
        h("optgroup", { label: group }, ...this.choices.filter((c) => c.group === group).map((c) => h("option", { value: keyOf(c), selected: c === choice }, c.label))),
      );
    const parts: (HTMLElement | null)[] = [
      picker,
      shaft ? segmented("Abscissa of the spectrum", [{ value: "frequency", label: "Frequency" }, { value: "order", label: `Orders of ${spaced(shaft.name)}` }], settings.over, (v) => this.set("over", v)) : null,
      segmented("Stretch of the run", [{ value: "settled", label: this.stretchName() }, { value: "run", label: "Whole run" }], settings.stretch, (v) => this.set("stretch", v)),
      segmented("Scale of the amplitudes", [{ value: "linear", label: "Linear" }, { value: "log", label: "Logarithmic" }], settings.scale, (v) => this.set("scale", v)),
      this.shaftPicker(),
    ];
    const figures = h("div", { class: "figures" }, this.spectrumFigure(choice), ...this.runUpFigures(choice));
    const thinned = this.run.seriesStride > 1 ? h("p", { class: "note" }, `From every ${this.run.seriesStride}th stored instant: what is faster than ${format(this.highest())} Hz appears at lower frequencies.`) : null;
    this.element.replaceChildren(...[h("div", { class: "controls" }, ...parts.filter((p) => p !== null)), figures, thinned].filter((p) => p !== null));
  }

  private set(name: keyof typeof settings, value: string): void {
    const focused = document.activeElement;
    const [label, group] = [focused?.getAttribute("aria-label"), focused?.closest("fieldset")?.querySelector("legend")?.textContent];
    settings[name] = value;
    this.render();
    // A control that was drawn anew keeps the keyboard.
    if (label) this.element.querySelector<HTMLElement>(`select[aria-label="${label}"]`)?.focus();
    for (const legend of this.element.querySelectorAll("legend"))
      if (group && legend.textContent === group) legend.parentElement!.querySelector<HTMLElement>("input:checked")?.focus();
  }

  private get choice(): Choice {
    return this.choices.find((c) => keyOf(c) === settings.series) ?? firstChoice(this.run, this.choices);
  }

  private get shaft(): Shaft | null {
    return this.shafts.find((s) => s.name === settings.shaft) ?? this.shafts[0] ?? null;
  }

  private shaftPicker(): HTMLElement | null {
    if (this.shafts.length < 2) return null;
    const picker = h("select", { "aria-label": "Shaft whose orders are counted", change: () => this.set("shaft", picker.value) });
    for (const s of this.shafts) picker.append(h("option", { value: s.name, selected: s === this.shaft }, `Shaft: ${spaced(s.name)}`));
    return picker;
  }

  private highest(): number {
    const { time } = this;
    return (0.5 * (time.length - 1)) / (time[time.length - 1]! - time[0]!);
  }

  private hasCycle(): boolean {
    const { from, to } = lastCycle(this.run);
    return to - from >= 16 && from > 0;
  }

  private stretchName(): string {
    return this.hasCycle() ? "Last cycle" : "Second half";
  }

  /** Where the stretch that is analysed begins. */
  private begin(): number {
    if (settings.stretch === "run") return 0;
    return this.hasCycle() ? lastCycle(this.run).from : Math.floor(0.5 * this.time.length);
  }

  private values({ path, column, display }: Choice): Float64Array {
    return scaled(this.run.column(path, column)!, display.factor);
  }

  private spectrumFigure(choice: Choice): HTMLElement {
    const { shaft } = this;
    const byOrder = settings.over === "order" && shaft !== null;
    const found = byOrder ? this.byOrder(choice, shaft) : this.byFrequency(choice);
    if (!found) return h("p", { class: "note" }, byOrder ? "The stretch holds no whole turn." : "The stretch has too few instants.");
    const shown = cut(found.spectrum);
    const log = settings.scale === "log";
    const plot = new LinePlot({
      name: `spectrum-${keyOf(choice).replace(/[^\w]+/g, "-")}`,
      x: byOrder ? { label: `order of ${spaced(shaft.name)}`, unit: "", values: shown.frequency } : { label: "frequency", unit: "Hz", values: shown.frequency },
      left: { label: "amplitude", unit: choice.display.unit, fromZero: !log, log },
      curves: [{ label: "amplitude", y: shown.amplitude, unit: choice.display.unit, points: byOrder && shown.frequency.length < 200 }],
    });
    return figure("spectrum", `${capital(choice.label)} (${choice.group}): amplitudes over the ${byOrder ? "orders" : "frequency"}, ${found.of}.`, plot.tools, plot.element);
  }

  private byFrequency(choice: Choice): { spectrum: Spectrum; of: string } | null {
    const begin = this.begin();
    const { x, y } = ascending(this.time.slice(begin), this.values(choice).slice(begin));
    const found = x.length >= 8 ? spectrum(x, y) : null;
    const length = x.length > 0 ? 1e3 * (x[x.length - 1]! - x[0]!) : 0;
    return found && { spectrum: found, of: `${this.stretchText()} of ${format(length)} ms under Hann’s window, without its mean` };
  }

  private byOrder(choice: Choice, shaft: Shaft): { spectrum: Spectrum; of: string } | null {
    const begin = this.begin();
    const { x, y } = ascending(shaft.turns.slice(begin), this.values(choice).slice(begin));
    // A cycle is known by its number of turns; its last row closes it.
    const turns = Math.floor((x.length > 0 ? x[x.length - 1]! - x[0]! : 0) + 0.02);
    const whole = turns >= 1 && x[x.length - 1]! - x[0]! < turns ? { x: Float64Array.from(x, (v) => x[x.length - 1]! - ((x[x.length - 1]! - v) * turns) / (x[x.length - 1]! - x[0]!)), y } : { x, y };
    const found = turns >= 1 ? orderLines(whole.x, whole.y, turns) : null;
    return found && { spectrum: found, of: `of ${turns} whole turn${turns > 1 ? "s" : ""} (${this.stretchText()})` };
  }

  private stretchText(): string {
    if (settings.stretch === "run") return "the whole run";
    return this.hasCycle() ? "the last cycle" : "the second half of the run";
  }

  private runUpFigures(choice: Choice): HTMLElement[] {
    const { shaft } = this;
    if (!shaft || !isRunUp(shaft)) return [];
    return [...this.waterfallFigure(choice, shaft), ...this.trackFigure(choice, shaft)];
  }

  private waterfallFigure(choice: Choice, shaft: Shaft): HTMLElement[] {
    const { x, y } = ascending(this.time, this.values(choice));
    const rows = pieces(x, y, Math.min(mostPieces, Math.max(4, Math.floor(x.length / 64))));
    if (rows.length < 3) return [];
    const largest = rows.reduce((most, row) => row.amplitude.reduce((a, b) => Math.max(a, b), most), 0);
    const most = rows.reduce((count, row) => Math.max(count, cut(row, largest).frequency.length), 0);
    const ridges = rows.map(({ at, frequency, amplitude }) => ({ at: 60 * shaft.speed[rowAt(this.time, at)]!, frequency: frequency.slice(0, most), amplitude: amplitude.slice(0, most) }));
    const { label, display } = choice;
    const axes: WaterfallAxes = { x: "frequency [Hz]", y: `speed of ${spaced(shaft.name)} [rpm]`, unit: "rpm", amplitude: display.unit, turns: 1 / 60 };
    const table = () => [
      ["speed [rpm]", "frequency [Hz]", axisLabel(`amplitude of ${label}`, display.unit)],
      ...ridges.flatMap(({ at, frequency, amplitude }) => Array.from(frequency, (f, i) => [at, f, amplitude[i]!])),
    ];
    const caption = `Waterfall: spectra of ${label} (${choice.group}), piece by piece of the run, each at its mean speed; dashed: orders of ${spaced(shaft.name)}.`;
    return [
      figure("waterfall", caption, tableButton("waterfall", table), waterfall(ridges, axes)),
      figure("waterfall-map", `The same spectra of ${label} as a map, in decibels below the largest amplitude; dashed: orders of ${spaced(shaft.name)}.`, tableButton("waterfall-map", table), new SpectrumMap(ridges, axes).element),
    ];
  }

  private trackFigure(choice: Choice, shaft: Shaft): HTMLElement[] {
    const { x: turns, y } = ascending(shaft.turns, this.values(choice));
    const [first, last] = [turns[0]!, turns[turns.length - 1]!];
    const width = Math.min(8, Math.floor((last - first) / 4));
    if (width < 2) return [];
    const count = Math.min(mostTracks, 1 + Math.floor(2 * (last - first - width)));
    const middles = Float64Array.from({ length: count }, (_, i) => first + 0.5 * width + ((last - first - width) * i) / (count - 1));
    const speeds = middles.map((at) => 60 * shaft.speed[rowAt(shaft.turns, at)]!);
    // A run-down is drawn from its slow end; what goes up and down is drawn over time.
    const [up, down] = [isSorted(speeds, 1), isSorted(speeds, -1)];
    const order = Array.from(middles, (_, i) => i).sort((a, b) => (up || down ? speeds[a]! - speeds[b]! : a - b));
    const overSpeed = up || down;
    const values = order.map((i) => (overSpeed ? speeds[i]! : this.time[rowAt(shaft.turns, middles[i]!)]!));
    const at = Float64Array.from(order, (i) => middles[i]!);
    // Two lines of the window apart, orders do not see each other.
    const curves: Curve[] = tracked.filter((o) => o * width >= 2).map((o) => ({ label: `order ${o}`, unit: choice.display.unit, y: orderTrack(turns, y, o, width, at) }));
    const plot = new LinePlot({
      name: "order-tracks",
      x: overSpeed ? { label: `speed of ${spaced(shaft.name)}`, unit: "rpm", values } : { label: "time", unit: "s", values },
      left: { label: "amplitude", unit: choice.display.unit, fromZero: true },
      curves,
      height: 300,
    });
    return [figure("order-tracks", `Order tracks: amplitudes of ${choice.label} (${choice.group}) that turn with ${spaced(shaft.name)}, over windows of ${width} turns.`, plot.tools, plot.element)];
  }
}

function keyOf({ path, column }: Choice): string {
  return `${path}#${column}`;
}

function rowAt(ascendingValues: ArrayLike<number>, value: number): number {
  let [low, high] = [0, ascendingValues.length - 1];
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (ascendingValues[middle]! <= value) low = middle;
    else high = middle;
  }
  return value - ascendingValues[low]! < ascendingValues[high]! - value ? low : high;
}

/** A spectrum up to where it is nothing any more. */
function cut({ frequency, amplitude }: Spectrum, largest = amplitude.reduce((a, b) => Math.max(a, b), 0)): Spectrum {
  let last = amplitude.length - 1;
  while (last > 16 && amplitude[last]! < negligible * largest) last--;
  const end = Math.min(amplitude.length, Math.ceil(1.15 * last) + 1);
  return { frequency: frequency.slice(0, end), amplitude: amplitude.slice(0, end) };
}

/** Every series that changes, by what it belongs to. */
function choicesOf(run: Run): Choice[] {
  return run.seriesPaths().flatMap(({ path, unit, description, width, columns }) => {
    if (/^\/(solver|time$|crank_angle$)|\/(fields|cycles)\/|_around$/.test(path)) return [];
    const parts = path.split("/").slice(1);
    const name = parts.pop()!;
    const group = parts.map((part) => spaced(part.replace(/^(bearing|bodie|joint|contact|drive|coupling)s$/, (_, one: string) => (one === "bodie" ? "body" : one)))).join(" ");
    const about = description && description.length < 50 && !path.startsWith("/bodies/") ? description : spaced(name);
    const display = unit === "m" && path.startsWith("/bearings/") ? micrometre : displayOf(unit);
    return Array.from({ length: width }, (_, column) => column).flatMap((column): Choice[] => {
      const values = run.column(path, column)!;
      if (values.every((v) => v === values[0] || !Number.isFinite(v))) return [];
      const component = width === 1 ? "" : `, ${columns[column] ?? (width === 4 ? "wxyz"[column] : width <= 3 ? "xyz"[column] : column + 1)}`;
      return [{ path, column, group, label: `${about}${component}`, display }];
    });
  });
}

/** What shakes: a journal in its bearing, a runner on its pad, else the body that moves most. */
function firstChoice(run: Run, choices: Choice[]): Choice {
  for (const name of ["/eccentricity", "/film_thickness_middle"]) {
    const moving = choices.find(({ path }) => path.endsWith(name));
    if (moving) return moving;
  }
  const range = ({ path, column }: Choice) => {
    const values = Float64Array.from(run.column(path, column)!);
    return values.reduce((a, b) => Math.max(a, b), -Infinity) - values.reduce((a, b) => Math.min(a, b), Infinity);
  };
  const moving = choices.filter(({ path }) => /^\/bodies\/.*\/position$/.test(path));
  return moving.length > 0 ? moving.reduce((a, b) => (range(b) > range(a) ? b : a)) : choices[0]!;
}

