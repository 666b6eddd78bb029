// Plots of a run while it goes on: least film thickness, largest pressure, the journal's path.

import type { Api, RunEntry, RunEvent } from "./api";
import { h } from "../src/dom";
import { dot } from "../src/clearance_circle";
import { LinePlot } from "../src/line_plot";
import { Orbit, type OrbitData } from "../src/orbit";
import { palette } from "../src/theme";
import { circuitCourse } from "./live_circuit";
import { NamedPlots, type NamedCourse } from "./live_columns";
import { powerCourse } from "./live_powers";
import { LiveMap } from "./live_map";
import { path } from "./runs_pane";
import { texts } from "./texts";

type Further = "power" | "flow" | "T_max";

interface Columns {
  h_min: number[];
  p_max: number[];
  x: number[];
  y: number[];
  power: number[];
  flow: number[];
  T_max: number[];
}

const further: { key: Further; unit: string; shown: (value: number) => number }[] = [
  { key: "power", unit: "W", shown: (x) => x },
  { key: "flow", unit: "mm³/s", shown: (x) => 1e9 * x },
  { key: "T_max", unit: "°C", shown: (x) => x - 273.15 },
];

/** Events of a run as columns, per bearing. */
class Course {
  readonly time: number[] = [];
  readonly bearings = new Map<string, Columns>();

  take({ kind, t, bearings }: RunEvent): void {
    if (kind !== "stepped" || t === undefined || !bearings || (this.time.length > 0 && t <= this.time[this.time.length - 1]!)) return;
    this.time.push(t);
    for (const [name, b] of Object.entries(bearings)) {
      let own = this.bearings.get(name);
      if (!own) this.bearings.set(name, (own = { h_min: [], p_max: [], x: [], y: [], power: [], flow: [], T_max: [] }));
      own.h_min.push(1e6 * (b.h_min ?? NaN));
      own.p_max.push(1e-6 * (b.p_max ?? NaN));
      own.x.push(b.e_x ?? NaN);
      own.y.push(b.e_y ?? NaN);
      for (const { key, shown } of further) own[key].push(shown(b[key] ?? NaN));
    }
    if (this.time.length > 4000) this.thin();
  }

  /** Every second instant of the first half goes. */
  private thin(): void {
    const keep = (values: number[]) => {
      const half = values.length >> 1;
      values.splice(0, half, ...values.slice(0, half).filter((_, i) => i % 2 === 0));
    };
    keep(this.time);
    for (const b of this.bearings.values()) Object.values(b).forEach(keep);
  }
}

/** As high as the plots beside it; without a circle where nobody knows its radius. */
class LowOrbit extends Orbit {
  isKnown = false;

  constructor(
    data: OrbitData,
    private readonly low: number,
  ) {
    super(data);
  }

  protected override paintCircles(context: CanvasRenderingContext2D): void {
    if (this.isKnown) super.paintCircles(context);
  }

  protected override paintCentre(context: CanvasRenderingContext2D, x: number, y: number): void {
    if (this.isKnown) return super.paintCentre(context, x, y);
    context.fillStyle = palette().accent;
    dot(context, ...this.mapped()(x, y), 5.5);
  }

  protected override describe(px: number, py: number): string[] | null {
    const lines = super.describe(px, py);
    return this.isKnown ? lines : (lines?.filter((line) => !line.startsWith("ε")) ?? null);
  }

  protected override heightFor(): number {
    return this.low ?? 150;
  }
}

/** In place of a bearing; no name has such letters. */
const circuitChoice = "<circuit>";
const powersChoice = "<powers>";

/** Between two readings of a log that grows [ms]. */
const logPause = 2000;
/** Between two readings of a study's run [ms]. */
const partPause = 1000;

export class LivePane {
  readonly element: HTMLElement;
  readonly log = h("pre", { class: "log", tabindex: 0, "aria-label": texts.log }, texts.noLog);
  private readonly choice = h("select", { "aria-label": texts.liveBearing });
  private readonly title = h("span", { class: "live-title" });
  private readonly plots = h("div", { class: "live-plots" });
  /** Of the shown run; a study has one for each of its runs. */
  private courses = new Map<number, Course>();
  /** Radial clearances of its bearings, as it says when it starts [m]. */
  private clearances: Record<string, number> = {};
  private circuits = new Map<number, NamedCourse>();
  private powers = new Map<number, NamedCourse>();
  private namedPlots: NamedPlots | null = null;
  private readonly map: LiveMap;
  /** Which one of a study has said something last. */
  private newest = 0;
  /** Events that came while the older ones were asked for. */
  private early: RunEvent[] | null = null;
  private run: RunEntry | null = null;
  /** Of a study, the run that is shown. */
  private part: { id: string; label: string } | null = null;
  private shownBearing = "";
  private drawn: { x: number[]; thickness: LinePlot; pressure: LinePlot; others: { key: Further; plot: LinePlot }[]; orbit: LowOrbit; path: { time: Float64Array; x: Float64Array; y: Float64Array; force: null; clearance: number } } | null = null;
  private mapHeight = 150;
  private awaited = false;
  private lastDrawn = 0;

  constructor(
    private readonly api: Api,
    private readonly clearance: (run: RunEntry, bearing: string) => number | undefined,
  ) {
    this.map = new LiveMap(api);
    setInterval(() => {
      if (this.run?.state === "running" && this.log.checkVisibility()) void this.readLog();
    }, logPause);
    // Runs of a study send no events by themselves.
    setInterval(() => {
      if (this.run?.state === "running" && this.part && this.element.checkVisibility()) void this.recall(this.run).then(() => this.redrawSoon());
    }, partPause);
    this.choice.addEventListener("change", () => this.build());
    this.element = h("div", { class: "live-pane" }, h("div", { class: "pane-tools" }, this.title, this.choice), this.plots);
    this.plots.append(h("p", { class: "note" }, texts.noLive));
    this.choice.hidden = true;
  }

  get shownRun(): string {
    return this.run?.id ?? "";
  }

  /** @param part  of a study, the run of it */
  async show(run: RunEntry, part: { id: string; label: string } | null = null): Promise<void> {
    const isOther = run.id !== this.run?.id || part?.id !== this.part?.id;
    this.run = run;
    this.part = part;
    this.title.textContent = part ? `${run.id}, ${part.label}` : run.id;
    if (isOther) {
      this.courses = new Map();
      this.clearances = {};
      this.circuits = new Map();
      this.powers = new Map();
      this.newest = 0;
      this.log.textContent = "";
      this.build();
    }
    await this.recall(run);
    if (this.run.id !== run.id) return;
    this.build();
    await this.readLog();
  }

  /** How far the runs are now. */
  update(runs: RunEntry[]): void {
    this.run = runs.find(({ id }) => id === this.run?.id) ?? this.run;
    this.showMap();
  }

  async readLog(): Promise<void> {
    if (!this.run) return;
    const { id } = this.run;
    let text: string;
    try {
      text = await (await this.api.request("GET", `/api/runs/${path(id)}/log`)).text();
    } catch (error) {
      text = error instanceof Error ? error.message : String(error);
    }
    // Meanwhile another run may be shown.
    text ||= "–";
    if (this.run.id !== id || this.log.textContent === text) return;
    const atEnd = this.log.scrollTop + this.log.clientHeight > this.log.scrollHeight - 30;
    this.log.textContent = text;
    if (atEnd) this.log.scrollTop = this.log.scrollHeight;
  }

  /** What the run has written before this page was there. */
  private async recall(run: RunEntry): Promise<void> {
    const { part } = this;
    this.early = [];
    let text = "";
    try {
      text = await (await this.api.request("GET", `/api/runs/${path(run.id)}/events${part ? `?run=${path(part.id)}` : ""}`)).text();
    } catch {
      // A run made elsewhere has none.
    }
    if (this.run?.id !== run.id || this.part?.id !== part?.id) return;
    const early = this.early ?? [];
    this.early = null;
    if (text) [this.courses, this.circuits, this.powers] = [new Map(), new Map(), new Map()];
    for (const line of text.split("\n")) {
      if (!/"(stepped|started)"/.test(line)) continue;
      try {
        this.take(JSON.parse(line) as RunEvent);
      } catch {
        // The last line may be half written.
      }
    }
    early.forEach((event) => this.take(event));
  }

  private take(event: RunEvent): void {
    if (event.kind === "started") for (const [name, { clearance }] of Object.entries(event.bearings ?? {})) if (typeof clearance === "number") this.clearances[name] = clearance;
    if (event.kind !== "stepped") return;
    const number = event.run ?? 0;
    const course = this.courses.get(number) ?? new Course();
    course.take(event);
    this.courses.set(number, course);
    const note = (courses: Map<number, NamedCourse>, make: () => NamedCourse) => {
      const own = courses.get(number) ?? make();
      own.take(event);
      courses.set(number, own);
    };
    if (event.circuit) note(this.circuits, circuitCourse);
    if (event.powers) note(this.powers, powerCourse);
    this.newest = number;
  }

  hear(event: RunEvent): void {
    if (event.id !== this.run?.id) return;
    if (this.early) this.early.push(event);
    else this.take(event);
    this.redrawSoon();
  }

  /** At most ten pictures a second. */
  private redrawSoon(): void {
    if (this.awaited) return;
    this.awaited = true;
    setTimeout(() => requestAnimationFrame(() => {
      this.awaited = false;
      this.lastDrawn = performance.now();
      this.redraw();
    }), Math.max(0, 100 - (performance.now() - this.lastDrawn)));
  }

  private get course(): Course | undefined {
    return this.courses.get(this.newest);
  }

  /** As high as the pane leaves room: title, legend and scroll bar stand beside. */
  private get height(): number {
    return Math.max(110, this.element.clientHeight - 48);
  }

  private showMap(): void {
    const isOfBearing = this.drawn !== null && this.shownBearing !== "";
    this.map.show(isOfBearing && !this.part ? this.run : null, this.shownBearing, this.drawn ? this.mapHeight : this.height);
  }

  private names(): string[] {
    return [...(this.course?.bearings.keys() ?? [])];
  }

  /** What is shown of the whole machine in place of a bearing. */
  private systems(): { value: string; title: string; name: string; course: NamedCourse }[] {
    const [powers, circuit] = [this.powers.get(this.newest), this.circuits.get(this.newest)];
    return [
      ...(powers ? [{ value: powersChoice, title: texts.powers.title, name: "powers", course: powers }] : []),
      ...(circuit ? [{ value: circuitChoice, title: texts.circuit.title, name: "circuit", course: circuit }] : []),
    ];
  }

  private build(): void {
    const names = this.names();
    const before = this.choice.value;
    this.choice.replaceChildren(...names.map((name) => h("option", { value: name }, name)), ...this.systems().map(({ value, title }) => h("option", { value }, title)));
    if ([...this.choice.options].some(({ value }) => value === before)) this.choice.value = before;
    this.choice.hidden = this.choice.options.length < 2;
    this.namedPlots?.destroy();
    this.namedPlots = null;
    this.drawn?.thickness.destroy();
    this.drawn?.pressure.destroy();
    this.drawn?.orbit.destroy();
    this.drawn?.others.forEach(({ plot }) => plot.destroy());
    this.drawn = null;
    const system = this.systems().find(({ value }) => value === this.choice.value);
    if (system) {
      this.shownBearing = "";
      this.showMap();
      this.namedPlots = new NamedPlots(system.course, system.name, this.height);
      this.plots.replaceChildren(...this.namedPlots.elements);
      return;
    }
    const bearing = this.choice.value;
    this.shownBearing = bearing;
    const { course } = this;
    const own = course?.bearings.get(bearing);
    if (!course || !own) {
      this.plots.replaceChildren(h("p", { class: "note" }, texts.noLive));
      this.showMap();
      return;
    }
    const x: number[] = [];
    const { height } = this;
    this.mapHeight = height;
    const line = (name: string, label: string, unit: string) => new LinePlot({ name, x: { label: texts.time, unit: "ms", values: x }, left: { label: texts.short[name as "h_min" | "p_max"], unit, fromZero: true }, curves: [{ label, unit, y: [] }], height });
    // What this run tells besides, such as no temperatures where they are not solved for.
    const others = further
      .filter(({ key }) => own[key].some((value) => Number.isFinite(value)))
      .map(({ key, unit }) => ({ key, plot: new LinePlot({ name: key, x: { label: texts.time, unit: "ms", values: x }, left: { label: key === "T_max" ? "T" : texts.further[key].toLowerCase(), unit, fromZero: key !== "T_max" }, curves: [{ label: texts.further[key], unit, y: [] }], height }) }));
    const orbit = { time: new Float64Array(), x: new Float64Array(), y: new Float64Array(), force: null, clearance: 1 };
    this.drawn = { x, thickness: line("h_min", texts.hMin, "µm"), pressure: line("p_max", texts.pMax, "MPa"), others, orbit: new LowOrbit(orbit, height + 6), path: orbit };
    this.plots.replaceChildren(
      h("div", { class: "live-plot", "data-plot": "h_min" }, this.drawn.thickness.element),
      h("div", { class: "live-plot", "data-plot": "p_max" }, this.drawn.pressure.element),
      h("div", { class: "live-plot live-orbit", "data-plot": "orbit" }, this.drawn.orbit.element),
      this.map.element,
      ...others.map(({ key, plot }) => h("div", { class: "live-plot", "data-plot": key }, plot.element)),
    );
    this.showMap();
    this.redraw();
  }

  private redraw(): void {
    const { course } = this;
    if (!course) return;
    const isOther = this.names().length + this.systems().length !== this.choice.options.length;
    const system = this.systems().find(({ value }) => value === this.choice.value);
    if (this.namedPlots && !isOther && !this.namedPlots.isOutdated && system?.course === this.namedPlots.course) return this.namedPlots.redraw();
    if (this.namedPlots || !this.drawn || isOther) {
      if (this.names().length + this.systems().length > 0) this.build();
      return;
    }
    const own = course.bearings.get(this.shownBearing);
    if (!own || course.time.length === 0) return;
    const { x, thickness, pressure, orbit, path: shown } = this.drawn;
    x.splice(0, x.length, ...course.time.map((t) => 1e3 * t));
    thickness.update([own.h_min]);
    pressure.update([own.p_max]);
    for (const { key, plot } of this.drawn.others) plot.update([own[key]]);
    // The journal's last turns are enough of its path.
    const from = Math.max(0, own.x.length - 600);
    shown.time = Float64Array.from(course.time.slice(from));
    shown.x = Float64Array.from(own.x.slice(from));
    shown.y = Float64Array.from(own.y.slice(from));
    const clearance = this.clearances[this.shownBearing] ?? (this.run ? this.clearance(this.run, this.shownBearing) : undefined);
    orbit.isKnown = clearance !== undefined;
    const reach = own.x.reduce((most, e, i) => Math.max(most, Math.hypot(e, own.y[i]!) || 0), 0);
    shown.clearance = clearance ?? 1.1 * Math.max(1e-9, reach);
    orbit.show(course.time[course.time.length - 1]!);
  }
}
