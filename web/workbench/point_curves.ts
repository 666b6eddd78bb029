// Curves of a bearing by itself over one of its sliders, the others as they stand: the Stribeck curve and its like. Points
// are asked for one after another, each from its neighbour's solution, so that the sliders stay quick.

import { h } from "../src/dom";
import type { FigureText } from "../src/data";
import { LinePlot, type Curve } from "../src/line_plot";
import { format, shownUnit } from "../src/units";
import { texts } from "./texts";

/** What a bearing can be varied by. */
export interface Abscissa {
  key: string;
  label: string;
  unit: string;
  /** Where the slider stands. */
  value: number;
}

/** A point of a curve as the program answers. */
export interface CurvePoint {
  id: string | null;
  solved: boolean;
  figures: FigureText[];
}

export interface PointCurvesHooks {
  abscissae: () => Abscissa[];
  /** Solves the bearing with one slider elsewhere, from a solution near by. */
  solve: (key: string, value: number, previous: string | null) => Promise<CurvePoint>;
  /** The last solution of the sliders' own point. */
  present: () => string | null;
}

/** How far a curve goes from the slider's value, down and up. */
const reach: Record<string, [number, number]> = { speed: [1 / 300, 8], viscosity: [1 / 100, 10], load: [1 / 10, 10], clearance: [1 / 2.5, 2.5] };
/** Points to either side, most of them where it goes farthest. */
const points = 30;
/** Pause of the sliders before a curve is computed anew [ms]. */
const pause = 350;

interface Shown {
  name: string;
  label: string;
  /** The first of these figures that there is, or the sum of those joined by +. */
  keys: string[];
  log?: boolean;
}

const shown: Shown[] = [
  { name: "friction", label: texts.curves.friction, keys: ["friction_journal", "friction_runner"], log: true },
  { name: "h_min", label: texts.hMin, keys: ["h_min"] },
  { name: "p_max", label: texts.pMax, keys: ["p_max"] },
  { name: "loss", label: texts.further.power, keys: ["power_film+power_asperity"] },
  { name: "flow", label: texts.further.flow, keys: ["side_flow"] },
];

function valueOf(figures: FigureText[], keys: string[]): { value: number; unit: string } | null {
  for (const key of keys) {
    const parts = key.split("+").map((part) => figures.find((f) => f.key === part && f.value !== null)).filter((f) => f !== undefined);
    if (parts.length > 0) return { value: parts.reduce((sum, f) => sum + f.value!, 0), unit: shownUnit(parts[0]!.unit) };
  }
  return null;
}

/** The first of some values in their order, and how many there are besides. */
function listed(values: number[]): string {
  const most = 4;
  const first = [...values].sort((a, b) => a - b).slice(0, most).map((value) => format(value, 3));
  return values.length > most ? `${first.join(", ")} … (${values.length})` : first.join(", ");
}

/** Geometric, from one end to the other through `value`. */
function placesAround({ key, value }: Abscissa): number[] {
  const [down, up] = reach[key]!;
  const all = Math.log(up / down);
  const below = Math.max(2, Math.round((-Math.log(down) / all) * points));
  const above = Math.max(2, points - below);
  return [...Array.from({ length: below }, (_, i) => value * down ** ((below - i) / below)), value, ...Array.from({ length: above }, (_, i) => value * up ** ((i + 1) / above))];
}

export class PointCurves {
  readonly element: HTMLDetailsElement;
  private readonly choice = h("select", { "aria-label": texts.curves.over });
  private readonly status = h("span", { class: "note", role: "status" });
  private readonly plots = h("div", { class: "point-curves" });
  private drawn: { name: string; plot: LinePlot; keys: string[] }[] = [];
  private x: number[] = [];
  private answers: (FigureText[] | null)[] = [];
  private sweeps = 0;
  private timer = 0;
  /** What the curves that are shown were computed of. */
  private of = "";

  constructor(private readonly hooks: PointCurvesHooks) {
    this.choice.addEventListener("change", () => this.again());
    this.element = h("details", { class: "curves" }, h("summary", {}, texts.curves.title), h("div", { class: "pane-tools" }, h("label", {}, `${texts.curves.over} `, this.choice), this.status), this.plots) as HTMLDetailsElement;
    this.element.addEventListener("toggle", () => this.again());
  }

  /** The sliders' point is solved: `state` tells one from another but for the abscissa's own slider. */
  solved(state: (without: string) => string): void {
    const all = this.hooks.abscissae();
    const before = this.choice.value || "speed";
    const names = all.map(({ key }) => key);
    if (names.join() !== [...this.choice.options].map(({ value }) => value).join()) {
      this.choice.replaceChildren(...all.map(({ key, label }) => h("option", { value: key }, label)));
      this.choice.value = names.includes(before) ? before : (names[0] ?? "");
    }
    const at = all.find(({ key }) => key === this.choice.value);
    if (!at || !this.element.open) return;
    const of = `${at.key} ${state(at.key)}`;
    const isWithin = this.x.length > 0 && at.value >= this.x[0]! && at.value <= this.x[this.x.length - 1]!;
    // Along the curve only its mark moves.
    if (of === this.of && isWithin) return this.mark(at.value);
    this.of = of;
    clearTimeout(this.timer);
    this.sweeps++;
    this.timer = window.setTimeout(() => void this.sweep(at), pause);
  }

  /** Another bearing, or none. */
  clear(): void {
    this.sweeps++;
    clearTimeout(this.timer);
    this.of = "";
    this.forget();
    this.status.textContent = "";
  }

  /** While the text is faulty nothing is solved; then what is shown is of an older one. */
  faulty(is: boolean): void {
    this.choice.disabled = is;
    this.element.classList.toggle("old", is);
    if (!is) {
      if (this.status.textContent === texts.faultyText) this.status.textContent = "";
      return;
    }
    this.sweeps++;
    clearTimeout(this.timer);
    this.of = "";
    this.status.textContent = texts.faultyText;
  }

  private again(): void {
    if (this.choice.disabled) return;
    this.of = "";
    this.sweeps++;
    const at = this.element.open ? this.hooks.abscissae().find(({ key }) => key === this.choice.value) : undefined;
    if (at) void this.sweep(at);
  }

  private forget(): void {
    this.drawn.forEach(({ plot }) => plot.destroy());
    this.drawn = [];
    this.plots.replaceChildren();
  }

  private mark(value: number): void {
    for (const { plot } of this.drawn) plot.mark(value);
  }

  /** From the sliders' point upwards, then downwards. */
  private async sweep(at: Abscissa): Promise<void> {
    const count = ++this.sweeps;
    const places = placesAround(at);
    const middle = places.indexOf(at.value);
    const order = [...places.slice(middle).map((_, i) => middle + i), ...places.slice(0, middle).map((_, i) => middle - 1 - i)];
    const answers: (FigureText[] | null)[] = places.map(() => null);
    let previous = this.hooks.present();
    let first: string | null = null;
    let done = 0;
    const failed: number[] = [];
    for (const i of order) {
      if (i === middle - 1) previous = first ?? this.hooks.present();
      done++;
      try {
        let answer = await this.hooks.solve(at.key, places[i]!, previous);
        // A neighbour may lie on another branch, or too far away: the point is tried by itself, as the command line does.
        if (!answer.solved && previous !== null && count === this.sweeps) answer = await this.hooks.solve(at.key, places[i]!, null);
        if (count !== this.sweeps) return;
        if (answer.solved) {
          answers[i] = answer.figures;
          previous = answer.id ?? previous;
          if (i === middle) first = answer.id;
        } else failed.push(places[i]!);
      } catch (error) {
        if (count !== this.sweeps) return;
        this.status.textContent = error instanceof Error ? error.message : String(error);
        return;
      }
      this.status.textContent = texts.curves.progress(done, places.length);
      if (done === 1) this.build(at, places, answers);
      else this.draw(answers);
    }
    this.status.textContent = failed.length > 0 ? texts.curves.notFound(listed(failed), at.unit) : "";
    this.build(at, places, answers);
    performance.mark("hersey-curves");
  }

  private draw(answers: (FigureText[] | null)[]): void {
    this.answers = answers;
    for (const { plot, keys } of this.drawn) plot.update(keys.map((key) => this.along(key)));
  }

  private along(key: string): (number | null)[] {
    return this.answers.map((figures) => (figures ? (valueOf(figures, [key])?.value ?? null) : null));
  }

  private build(at: Abscissa, places: number[], answers: (FigureText[] | null)[]): void {
    this.forget();
    this.x = places;
    this.answers = answers;
    const known = answers.find((figures) => figures !== null);
    if (!known) return;
    const isRough = answers.some((figures) => figures?.some(({ key, value }) => (key === "asperity_share" || key === "film_ratio") && (value ?? 0) > 0));
    const isLog = at.key !== "clearance";
    for (const { name, label, keys, log } of shown) {
      const key = keys.find((one) => valueOf(known, [one]));
      if (!key) continue;
      const unit = valueOf(known, [key])!.unit;
      const withAsperities = name === "friction" && isRough;
      const curves: Curve[] = [{ label, unit, y: this.along(key) }];
      if (withAsperities) curves.push({ label: texts.curves.asperities, unit: "", y: this.along("asperity_share"), axis: "right", dash: [6, 4] });
      const plot = new LinePlot({
        name,
        x: { label: at.label.toLowerCase(), unit: at.unit, values: places, log: isLog },
        left: { label: name === "h_min" || name === "p_max" ? texts.short[name] : label.toLowerCase(), unit, ...(log ? { log } : { fromZero: true }) },
        ...(withAsperities ? { right: { label: texts.curves.share, unit: "", fromZero: true } } : {}),
        curves,
        height: 190,
      });
      plot.mark(this.hooks.abscissae().find((one) => one.key === at.key)?.value ?? at.value);
      this.drawn.push({ name, plot, keys: withAsperities ? [key, "asperity_share"] : [key] });
    }
    this.plots.replaceChildren(...this.drawn.map(({ name, plot }) => h("div", { class: "point-curve", "data-curve": name }, plot.element)));
  }
}
