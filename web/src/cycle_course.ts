// A quantity's course over the last cycle of a run, on an abscissa that runs of one machine share.

import type { Run } from "./data";
import { lastCycle } from "./overview";
import { degree } from "./units";

export interface Course {
  x: Float64Array;
  /** By name of the dataset, in SI. */
  of: (path: string) => Float64Array | null;
}

export interface Abscissa {
  label: string;
  unit: string;
}

/** The crank's angle where every run has one, else the time since the cycle's beginning. */
export function sharedAbscissa(runs: Run[]): Abscissa {
  return runs.every((run) => run.column("/crank_angle")) ? { label: "crank angle", unit: "°" } : { label: "time", unit: "ms" };
}

export function course(run: Run, abscissa: Abscissa): Course | null {
  const time = run.column("/time");
  const { from, to } = lastCycle(run);
  if (!time || to - from < 2) return null;
  const angle = abscissa.unit === "°" ? run.column("/crank_angle")! : null;
  const base = angle ?? time;
  const start = base[from]!;
  // Cycles that are turns begin where the crank has its zero, whichever cycle of the run they are.
  const length = Math.abs(base[to - 1]! - start);
  const phase = angle && length > 6 ? start - 2 * Math.PI * Math.round(start / (2 * Math.PI)) : 0;
  const factor = angle ? degree.factor * (base[to - 1]! < start ? -1 : 1) : 1e3;
  const x = Float64Array.from(base.slice(from, to), (v) => factor * (v - start + (angle ? phase : 0)));
  return {
    x,
    of: (path) => {
      const dataset = run.dataset(path);
      if (!dataset || dataset.shape[0] !== time.length || dataset.width > 3) return null;
      const { width, values } = dataset;
      return Float64Array.from({ length: to - from }, (_, i) => {
        if (width === 1) return values[from + i]!;
        return Math.hypot(...values.slice((from + i) * width, (from + i + 1) * width));
      });
    },
  };
}

/** `count` places from the latest beginning to the earliest end of some courses. */
export function sharedPlaces(courses: Course[], count = 721): Float64Array {
  const first = Math.max(...courses.map(({ x }) => x[0]!));
  const last = Math.min(...courses.map(({ x }) => x[x.length - 1]!));
  return Float64Array.from({ length: count }, (_, i) => first + ((last - first) * i) / (count - 1));
}

/** Values at other places, linear between their own; x and places ascend. */
export function interpolated(x: ArrayLike<number>, y: ArrayLike<number>, places: ArrayLike<number>): (number | null)[] {
  let k = 1;
  return Array.from(places, (place) => {
    while (k < x.length - 1 && x[k]! < place) k++;
    const share = (place - x[k - 1]!) / (x[k]! - x[k - 1]! || 1);
    // Places may be beside the ends by what rounding leaves.
    if (share < -1e-6 || share > 1 + 1e-6) return null;
    const value = (1 - share) * y[k - 1]! + share * y[k]!;
    return Number.isFinite(value) ? value : null;
  });
}
