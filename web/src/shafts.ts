// What turns in a run: its angle over the rows, and its speed as a mean over one turn.

import type { Numbers, Run } from "./data";

export interface Shaft {
  name: string;
  /** In turns, counted on, rising; whichever way it turns. */
  turns: Float64Array;
  /** Mean over the turn around each row [turns/s]. */
  speed: Float64Array;
}

/** Fewer turns than these have no speed worth plotting over; what tumbles is no shaft. */
const fewestTurns = 2;
const fewestOfBodies = 10;

/** The crank first, else hinges, else bodies, those with the most turns first. */
export function shafts(run: Run): Shaft[] {
  const time = run.column("/time");
  if (!time || time.length < 8) return [];
  const crank = run.column("/crank_angle");
  if (crank) return shaftsOf([["crank", crank]], time);
  const hinges = run.children("/joints").flatMap((joint): [string, Numbers][] => {
    const dataset = run.dataset(`/joints/${joint}/coordinates`);
    const names = dataset?.columns.length ? dataset.columns : run.list(`/joints/${joint}`, "coordinate_names");
    const place = names.indexOf("rotation");
    const angle = dataset && place >= 0 ? run.column(`/joints/${joint}/coordinates`, place) : null;
    return angle ? [[joint, angle]] : [];
  });
  const found = shaftsOf(hinges, time);
  return found.length > 0 ? found : shaftsOf(run.children("/bodies").flatMap((body) => turned(run, body, time)), time, fewestOfBodies);
}

/** The way a body has turned about the axis that it turns about most. */
function turned(run: Run, body: string, time: Numbers): [string, Numbers][] {
  const columns = [0, 1, 2].flatMap((k) => run.column(`/bodies/${body}/angular_velocity`, k) ?? []);
  if (columns.length < 3) return [];
  const ways = columns.map((omega) => {
    const angle = new Float64Array(time.length);
    for (let i = 1; i < time.length; i++) angle[i] = angle[i - 1]! + 0.5 * (omega[i]! + omega[i - 1]!) * (time[i]! - time[i - 1]!);
    return angle;
  });
  const way = (angle: Float64Array) => Math.abs(angle[angle.length - 1]!);
  return [[body, ways.reduce((a, b) => (way(b) > way(a) ? b : a))]];
}

function shaftsOf(angles: [string, Numbers][], time: Numbers, fewest = fewestTurns): Shaft[] {
  return angles
    .flatMap(([name, angle]) => {
      const last = angle.length - 1;
      const sign = angle[last]! < angle[0]! ? -1 : 1;
      const turns = Float64Array.from(angle, (a) => (sign * a) / (2 * Math.PI));
      return turns[last]! - turns[0]! >= fewest ? [{ name, turns, speed: speedOf(turns, time) }] : [];
    })
    .sort((a, b) => travelled(b) - travelled(a));
}

function travelled({ turns }: Shaft): number {
  return turns[turns.length - 1]! - turns[0]!;
}

/** Over one turn around each row: what a shaft's speed does within a turn does not show. */
function speedOf(turns: Float64Array, time: Numbers): Float64Array {
  const n = turns.length;
  const at = (place: number, from: number): number => {
    let k = from;
    while (k < n - 1 && turns[k]! < place) k++;
    while (k > 1 && turns[k - 1]! > place) k--;
    const way = turns[k]! - turns[k - 1]!;
    return time[k - 1]! + (way > 0 ? (place - turns[k - 1]!) / way : 0) * (time[k]! - time[k - 1]!);
  };
  const [first, last] = [turns[0]!, turns[n - 1]!];
  return Float64Array.from(turns, (place, i) => {
    const half = Math.min(0.5, place - first, last - place);
    const [a, b] = [Math.max(1, i), Math.min(n - 1, i + 1)];
    // At the very ends there is no turn around the row.
    if (!(half > 1e-6)) return Math.max(0, (turns[b]! - turns[a - 1]!) / (time[b]! - time[a - 1]!));
    return (2 * half) / (at(place + half, a) - at(place - half, a));
  });
}

/** Whether a run is a run-up or a run-down: the speed changes by more than a fifth from its smallest to its largest value. */
export function isRunUp({ speed }: Shaft): boolean {
  const inner = speed.slice(Math.floor(0.02 * speed.length), Math.ceil(0.98 * speed.length));
  return inner.reduce((a, b) => Math.max(a, b), 0) > 1.2 * inner.reduce((a, b) => Math.min(a, b), Infinity);
}

/** The speed [rpm] as an abscissa, which has to rise from row to row: null where it falls by more than noise. */
export function risingSpeed(shaft: Shaft): Float64Array | null {
  if (!isRunUp(shaft)) return null;
  const rpm = shaft.speed.map((v) => 60 * v);
  const highest = rpm.reduce((a, b) => Math.max(a, b), 0);
  for (let i = 1; i < rpm.length; i++) {
    if (rpm[i]! < rpm[i - 1]! - 0.01 * highest) return null;
    rpm[i] = Math.max(rpm[i]!, rpm[i - 1]!);
  }
  return rpm;
}

/** Whether speeds go one way, up (sign 1) or down (sign -1), but for what is negligible beside the highest. */
export function isSorted(values: Float64Array, sign: number): boolean {
  const highest = values.reduce((a, b) => Math.max(a, b), 0);
  let farthest = -Infinity;
  return values.every((v) => {
    farthest = Math.max(farthest, sign * v);
    return sign * v >= farthest - 0.005 * highest;
  });
}
