// The fields of one bearing's film at its stored instants, on the unwrapped bearing.

import type { Dataset, Numbers, Run } from "./data";
import { displayOf, megapascal, micrometre, percent, type Display } from "./units";

export interface FieldKind {
  key: string;
  label: string;
  display: Display;
}

/** Fields with units of their own, in the order in which they are shown; others follow as their file describes them. */
const fieldKinds: FieldKind[] = [
  { key: "pressure", label: "Film pressure", display: megapascal },
  { key: "thickness", label: "Film thickness", display: micrometre },
  { key: "fill", label: "Fill fraction", display: percent },
  { key: "asperity_pressure", label: "Asperity pressure", display: megapascal },
  { key: "shell_displacement", label: "Shell displacement", display: micrometre },
  { key: "journal_displacement", label: "Journal displacement", display: micrometre },
];

export class FilmFields {
  private constructor(
    readonly time: Numbers,
    readonly phi: Numbers,
    readonly z: Numbers,
    private readonly fields: Map<string, Dataset>,
  ) {}

  static of(run: Run, bearing: string): FilmFields | null {
    const path = (name: string) => `/bearings/${bearing}/fields/${name}`;
    const time = run.dataset(path("time"))?.values;
    const phi = run.dataset(path("phi"))?.values;
    const z = run.dataset(path("z"))?.values;
    if (!time || !phi || !z) return null;
    const fields = new Map<string, Dataset>();
    for (const key of run.namesAfter(path(""))) {
      const dataset = run.dataset(path(key));
      if (dataset && dataset.width === phi.length * z.length) fields.set(key, dataset);
    }
    return fields.size > 0 ? new FilmFields(time, phi, z, fields) : null;
  }

  /** Other fields of one instant on the nodes of a bearing's film. */
  static with(run: Run, bearing: string, fields: Map<string, Dataset>): FilmFields | null {
    const phi = run.dataset(`/bearings/${bearing}/fields/phi`)?.values;
    const z = run.dataset(`/bearings/${bearing}/fields/z`)?.values;
    const fit = phi && z && [...fields.values()].every(({ width }) => width === phi.length * z.length);
    return fit ? new FilmFields(Float64Array.of(0), phi, z, fields) : null;
  }

  /** The kinds of field stored, without an asperity pressure that is zero throughout. */
  kinds(): FieldKind[] {
    const known = fieldKinds.filter(({ key }) => {
      const dataset = this.fields.get(key);
      return dataset !== undefined && (key !== "asperity_pressure" || dataset.values.some((v) => v > 0));
    });
    const others = [...this.fields].filter(([key]) => !fieldKinds.some((kind) => kind.key === key));
    return [...known, ...others.map(([key, { description, unit }]) => ({ key, label: description, display: displayOf(unit) }))];
  }

  get instants(): number {
    return this.time.length;
  }

  /** The field at one instant, index i z.length + j for angle i and axial position j. */
  at(key: string, instant: number): Numbers | null {
    const dataset = this.fields.get(key);
    if (!dataset) return null;
    return dataset.values.subarray(instant * dataset.width, (instant + 1) * dataset.width);
  }

  range(key: string): [number, number] {
    return extent(this.fields.get(key)?.values ?? []);
  }

  /** Angles of the nodes in degrees, closed at 360. */
  degrees(): number[] {
    return [...Array.from(this.phi, (phi) => (180 / Math.PI) * phi), 360 + (180 / Math.PI) * this.phi[0]!];
  }

  /** Index of the node at or before the share u of a turn, with the share of the way to the next. Grids may be graded. */
  indexAround(u: number): number {
    const turn = 2 * Math.PI;
    const n = this.phi.length;
    const angle = u * turn < this.phi[0]! ? (u + 1) * turn : u * turn;
    const i = lastNotAbove(this.phi, angle);
    const next = i + 1 < n ? this.phi[i + 1]! : this.phi[0]! + turn;
    return i + (angle - this.phi[i]!) / (next - this.phi[i]!);
  }

  /** Likewise for the share v of the width. */
  indexAlong(v: number): number {
    const last = this.z.length - 1;
    const height = this.z[0]! + v * (this.z[last]! - this.z[0]!);
    const j = Math.min(last - 1, lastNotAbove(this.z, height));
    return j + (height - this.z[j]!) / (this.z[j + 1]! - this.z[j]!);
  }

  /** Shares of a turn and of the width at a fractional index. */
  shareAround(index: number): number {
    const i = Math.floor(index);
    const at = (k: number) => (k < this.phi.length ? this.phi[k]! : this.phi[0]! + 2 * Math.PI);
    return (at(i) + (index - i) * (at(i + 1) - at(i))) / (2 * Math.PI);
  }

  shareAlong(index: number): number {
    const last = this.z.length - 1;
    const j = Math.min(last - 1, Math.floor(index));
    return (this.z[j]! + (index - j) * (this.z[j + 1]! - this.z[j]!) - this.z[0]!) / (this.z[last]! - this.z[0]!);
  }

  /** The field along the angle at z = 0, between two rows if none lies there. */
  midplane(key: string, instant: number): Float64Array | null {
    const field = this.at(key, instant);
    if (!field) return null;
    const nz = this.z.length;
    let below = 0;
    while (below < nz - 2 && this.z[below + 1]! <= 1e-12) below++;
    const [low, high] = [this.z[below]!, this.z[below + 1] ?? this.z[below]!];
    const t = high > low ? Math.min(1, Math.max(0, -low / (high - low))) : 0;
    return Float64Array.from(this.phi, (_, i) => {
      const at = i * nz + below;
      return t === 0 ? field[at]! : (1 - t) * field[at]! + t * field[at + 1]!;
    });
  }
}

function lastNotAbove(ascending: Numbers, value: number): number {
  let low = 0;
  let high = ascending.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (ascending[middle]! <= value) low = middle;
    else high = middle;
  }
  return low;
}

export function extent(values: ArrayLike<number>): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (let i = 0; i < values.length; i++) {
    const v = values[i]!;
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return low <= high ? [low, high] : [0, 1];
}

/** The index of the value nearest to x; values ascend. */
export function nearest(values: ArrayLike<number>, x: number): number {
  let low = 0;
  let high = values.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (values[middle]! <= x) low = middle;
    else high = middle;
  }
  return Math.abs(values[high]! - x) < Math.abs(values[low]! - x) ? high : low;
}
