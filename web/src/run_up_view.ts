// A run-up or coast-down: spectra over the speed, and what goes with the shaft's revolutions, by amplitude and phase.

import { numbersOf, type DisplacementText, type Numbers, type Run, type RunUpText } from "./data";
import { figure, h, tableButton } from "./dom";
import { spaced } from "./key_figures";
import { LinePlot, type Curve, type LineFigure } from "./line_plot";
import { scaled } from "./series";
import { isSorted } from "./shafts";
import { summaryTables } from "./summary_table";
import { axisLabel, degree, micrometre, millimetre, type Display } from "./units";
import { SpectrumMap } from "./spectrum_map";
import { waterfall, type WaterfallAxes } from "./waterfall";

/** An order with less than this share of the whole motion has no phase worth showing: beside a whirl it is what the window leaves of that. */
const negligible = 0.05;
/** Half peak to peak above this is shown in millimetres [m]. */
const large = 1e-3;

/** Amplitude and phase together are as high as the waterfall beside them [px]. */
const height = 165;

const settings = { displacement: "" };

/** Windows in the order in which they are drawn, and where: over the speed where it goes one way, else over time. */
interface Windows {
  x: LineFigure["x"];
  order: number[];
}

export class RunUpView {
  readonly element = h("div", { class: "spectra run-up" });
  readonly title: string;

  /** Null of any other run. */
  static of(run: Run): RunUpView | null {
    return run.runUp ? new RunUpView(run, run.runUp) : null;
  }

  private constructor(
    private readonly run: Run,
    private readonly runUp: RunUpText,
  ) {
    const speed = numbersOf(runUp.displacements[0]!.speed);
    this.title = speed[speed.length - 1]! < speed[0]! ? "Coast-down" : "Run-up";
  }

  render(): void {
    const { displacement } = this;
    const display = displayOf(displacement);
    const [lines, map] = this.cascade(displacement, display);
    this.element.replaceChildren(
      ...[this.picker(), h("div", { class: "figures" }, lines, h("div", { class: "bode" }, ...this.bode(displacement, display)), map)].filter((part) => part !== null),
      h("section", { class: "summary", "aria-label": "Largest amplitudes once a revolution" }, ...summaryTables(this.run, "run-up", "Once a revolution")),
    );
  }

  private get displacement(): DisplacementText {
    return this.runUp.displacements.find((d) => keyOf(d) === settings.displacement) ?? this.runUp.displacements[0]!;
  }

  private picker(): HTMLElement | null {
    if (this.runUp.displacements.length < 2) return null;
    const picker = h("select", {
      "aria-label": "Displacement whose orders are shown",
      change: () => {
        settings.displacement = picker.value;
        this.render();
        this.element.querySelector("select")?.focus();
      },
    });
    for (const d of this.runUp.displacements) picker.append(h("option", { value: keyOf(d), selected: d === this.displacement }, nameOf(d)));
    return h("div", { class: "controls" }, picker);
  }

  private cascade(displacement: DisplacementText, display: Display): [HTMLElement, HTMLElement] {
    const { cascade } = displacement;
    const [speed, frequency, amplitude] = [numbersOf(cascade.speed), numbersOf(cascade.frequency), numbersOf(cascade.amplitude)];
    const lines = frequency.length;
    const ridges = Array.from(speed, (v, i) => ({
      at: rpm(v),
      frequency,
      amplitude: scaled(amplitude.slice(i * lines, (i + 1) * lines), display.factor),
    }));
    const shaft = spaced(displacement.shaft);
    const axes: WaterfallAxes = { x: "frequency [Hz]", y: `speed of ${shaft} [rpm]`, unit: "rpm", amplitude: display.unit, turns: 1 / 60 };
    const table = () => [
      ["speed [rpm]", "frequency [Hz]", axisLabel("amplitude", display.unit)],
      ...ridges.flatMap((ridge) => Array.from(ridge.frequency, (f, i) => [ridge.at, f, ridge.amplitude[i]!])),
    ];
    const caption = `Waterfall: spectra of ${nameOf(displacement)}, piece by piece of the run, each at its mean speed; dashed: orders of ${shaft}.`;
    return [
      figure("run-up-waterfall", caption, tableButton("run-up-waterfall", table), waterfall(ridges, axes)),
      figure("run-up-map", `The same spectra of ${nameOf(displacement)} as a map, in decibels below the largest amplitude; dashed: orders of ${shaft}.`, tableButton("run-up-map", table), new SpectrumMap(ridges, axes).element),
    ];
  }

  private bode(displacement: DisplacementText, display: Display): HTMLElement[] {
    const windows = this.windows(displacement);
    const { orders } = this.runUp;
    const { revolutions } = displacement;
    const amplitude = numbersOf(displacement.amplitude);
    const column = (values: Numbers, k: number) => windows.order.map((i) => values[i * orders.length + k]!);
    const curves: Curve[] = orders.map((order, k) => ({ label: `${order}×`, unit: display.unit, hue: k, y: column(amplitude, k).map((a) => a * display.factor) }));
    const whole = numbersOf(displacement.peak_to_peak);
    curves.push({ label: "peak to peak", unit: display.unit, dash: [5, 4], y: windows.order.map((i) => whole[i]! * display.factor) });
    const first = orders.indexOf(1);
    const sizes = new LinePlot({ name: "run-up-amplitude", x: windows.x, left: { label: "amplitude", unit: display.unit, fromZero: true }, curves, height });
    const share = column(amplitude, first).map((a, i) => (2 * a) / whole[windows.order[i]!]!);
    const lag = unwrapped(column(numbersOf(displacement.lag), first), share);
    const phases = new LinePlot({
      name: "run-up-phase",
      x: windows.x,
      left: { label: "phase lag", unit: degree.unit },
      height,
      curves: [{ label: "1×", unit: degree.unit, hue: first, y: lag.map((v) => v && v * degree.factor) }],
    });
    const [name, shaft] = [nameOf(displacement), spaced(displacement.shaft)];
    const amplitudes = figure("run-up-amplitude", `Amplitudes of ${name} at orders of ${shaft}, in windows of ${revolutions} revolutions; and all of the motion from peak to peak.`, sizes.tools, sizes.element);
    if (lag.every((v) => v === null)) return [amplitudes];
    return [
      amplitudes,
      figure("run-up-phase", `Phase of order 1 of ${name}: how far it lags behind the angle of ${shaft}.`, phases.tools, phases.element),
    ];
  }

  private windows(displacement: DisplacementText): Windows {
    const [time, speed] = [displacement.time, displacement.speed].map((text) => Float64Array.from(numbersOf(text))) as [Float64Array, Float64Array];
    const overSpeed = isSorted(speed, 1) || isSorted(speed, -1);
    const along = overSpeed ? speed : time;
    const order = Array.from(along, (_, i) => i).sort((a, b) => along[a]! - along[b]!);
    const values = order.map((i) => (overSpeed ? rpm(along[i]!) : along[i]!));
    return { order, x: overSpeed ? { label: `speed of ${spaced(displacement.shaft)}`, unit: "rpm", values } : { label: "time", unit: "s", values } };
  }
}

function rpm(speed: number): number {
  return (30 / Math.PI) * speed;
}

function keyOf({ path, column }: DisplacementText): string {
  return `${path}#${column}`;
}

/** "journal in left, x" or "rotor, x". */
function nameOf({ path, column }: DisplacementText): string {
  const [, group, ...rest] = path.split("/");
  const thing = spaced(rest.slice(0, -1).join(" "));
  return `${group === "bearings" ? `journal in ${thing}` : thing}, ${"xyz"[column]}`;
}

function displayOf({ peak_to_peak }: DisplacementText): Display {
  return Float64Array.from(numbersOf(peak_to_peak)).reduce((a, b) => Math.max(a, b), 0) > 2 * large ? millimetre : micrometre;
}

/** Phases without jumps by a turn [rad], none where the share of the motion is negligible; the first lies within half a turn of a sixth of one. */
function unwrapped(lag: number[], share: number[]): (number | null)[] {
  let last = Math.PI / 3;
  return lag.map((value, i) => {
    if (!(share[i]! > negligible)) return null;
    last = value + 2 * Math.PI * Math.round((last - value) / (2 * Math.PI));
    return last;
  });
}
