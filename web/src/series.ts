// Time series of a run as curves: the abscissa, and columns scaled to display units.

import type { Numbers, Run } from "./data";
import type { Curve, LineFigure } from "./line_plot";
import { risingSpeed, shafts } from "./shafts";
import { degree, displayOf, type Display } from "./units";

export type Abscissa = "time" | "angle" | "speed";

/** Numbers times a factor. */
export function scaled(values: ArrayLike<number>, factor: number): Float64Array {
  return Float64Array.from(values, (v) => v * factor);
}

export function timeDisplay(run: Run): Display {
  const time = run.column("/time");
  const longest = time ? time[time.length - 1]! : 0;
  return longest >= 2 ? { factor: 1, unit: "s" } : { factor: 1e3, unit: "ms" };
}

/** The speed of what turns [rpm], where a run takes it up: null elsewhere. */
export function speedAbscissa(run: Run): Float64Array | null {
  const shaft = shafts(run)[0];
  return shaft ? risingSpeed(shaft) : null;
}

/** The abscissa of a run's time series, and how an instant is placed on it. */
export class Axis {
  readonly x: LineFigure["x"];
  private readonly time: Numbers;

  constructor(run: Run, kind: Abscissa) {
    this.time = run.column("/time") ?? new Float64Array();
    const speed = kind === "speed" ? speedAbscissa(run) : null;
    if (speed) {
      this.x = { label: "speed", unit: "rpm", values: speed };
      return;
    }
    const angle = run.column("/crank_angle");
    const display = kind === "angle" && angle ? degree : timeDisplay(run);
    const values = kind === "angle" && angle ? angle : this.time;
    this.x = { label: kind === "angle" && angle ? "crank angle" : "time", unit: display.unit, values: scaled(values, display.factor) };
  }

  /** Whether the run is one state, of which there are no curves. */
  get isOneInstant(): boolean {
    return this.time.length === 1;
  }

  /** Where a time lies on the abscissa, linear between rows. */
  at(time: number): number | null {
    const n = this.time.length;
    if (n === 0) return null;
    let k = 1;
    while (k < n - 1 && this.time[k]! < time) k++;
    if (n === 1) return this.x.values[0]!;
    const [t0, t1] = [this.time[k - 1]!, this.time[k]!];
    const share = t1 > t0 ? Math.min(1, Math.max(0, (time - t0) / (t1 - t0))) : 0;
    return (1 - share) * this.x.values[k - 1]! + share * this.x.values[k]!;
  }
}

/** A column as a curve, or nothing where the file lacks it. */
export function curve(
  run: Run,
  path: string,
  label: string,
  display: Display,
  extra: Partial<Curve> & { column?: number } = {},
): Curve[] {
  const { column, ...rest } = extra;
  const values = run.column(path, column ?? 0);
  return values ? [{ label, y: scaled(values, display.factor), unit: display.unit, ...rest }] : [];
}

/** All columns of a dataset as curves. */
export function columns(run: Run, path: string, labels: string[]): Curve[] {
  const dataset = run.dataset(path);
  if (!dataset) return [];
  const display = displayOf(dataset.unit);
  return Array.from({ length: dataset.width }, (_, i) => i).flatMap((i) =>
    curve(run, path, labels[i] ?? `${i + 1}`, display, { column: i }),
  );
}

/** Length of the vectors in a dataset of three columns. */
export function magnitude(run: Run, path: string): Float64Array | null {
  const dataset = run.dataset(path);
  if (!dataset || dataset.width < 2) return null;
  return Float64Array.from({ length: dataset.shape[0]! }, (_, i) => {
    let sum = 0;
    for (let k = 0; k < dataset.width; k++) sum += dataset.values[i * dataset.width + k]! ** 2;
    return Math.sqrt(sum);
  });
}
