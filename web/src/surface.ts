// The surfaces that films lie on: the coordinates of their nodes, whether they close, where they are in space, and what
// their parts are called. A further kind of bearing is a further object here and in bearing_kinds.ts.

import { ticks } from "./canvas";
import type { BearingText, Numbers, Run } from "./data";
import { axisLabel, degree, format, millimetre, withUnit, type Display } from "./units";

export interface Coordinate {
  /** In names of datasets: fields/phi, h_min_phi. */
  key: string;
  /** In keys of the figures of a bearing by itself: h_min_angle. */
  figure: string;
  symbol: string;
  /** Before the symbol on axes. */
  name?: string;
  display: Display;
  /** Significant digits of a place. */
  digits: number;
  /** What it closes after, in SI; nothing where the film has ends. */
  period?: number;
  /** Distance of ticks on an axis so long [px], in the unit displayed; round values where it is not given. */
  step?: (length: number) => number;
}

/** What is known of a bearing's size [m]; 0 where it does not apply. */
export interface Size {
  radius: number;
  length: number;
  width: number;
}

export interface Surface {
  /** In the direction of motion. */
  along: Coordinate;
  across: Coordinate;
  /** A place of the film in the bearing's frame, x, y, z, a little off the surface where bodies would hide it. */
  point: (along: number, across: number, size: Size) => [number, number, number];
  /** The part that the film's force is reported on, and the one that moves against it. */
  held: string;
  moving: string;
  /** The thing as a whole, and its map. */
  whole: string;
  map: string;
  /** Where the middle of its rows lies: behind "pressure at ". */
  middle: string;
  /** Behind "Extremes over the width, ". */
  way: string;
  axes: string;
  /** Captions of figures. */
  thickness: string;
  flow: string;
  /** A series and figure that only films on it have, where its coordinates are those of another surface. */
  mark?: string;
}

const z: Coordinate = { key: "z", figure: "z", symbol: "z", display: millimetre, digits: 3 };

const bore: Surface = {
  along: { key: "phi", figure: "angle", symbol: "φ", name: "bearing angle", display: degree, digits: 4, period: 2 * Math.PI, step: (length) => (length < 360 ? 90 : 45) },
  across: z,
  // Drawn a little wider than the bore, so that the journal does not touch it.
  point: (phi, height, { radius }) => [1.04 * radius * Math.cos(phi), 1.04 * radius * Math.sin(phi), height],
  held: "shell",
  moving: "journal",
  whole: "the bearing",
  map: "the unwrapped bearing",
  middle: "z = 0",
  way: "around the bore",
  axes: "in the bearing’s axes",
  thickness: "Smallest film thickness, edges included, and along the middle of the bearing.",
  flow: "Oil leaving over the two edges, and entering at the supply and through its holes and grooves.",
};

const plane: Surface = {
  along: { key: "y", figure: "y", symbol: "y", display: millimetre, digits: 3 },
  across: z,
  point: (y, height) => [0, y, height],
  held: "pad",
  moving: "runner",
  whole: "the pad",
  map: "the pad",
  middle: "z = 0",
  way: "along the pad",
  axes: "in its axes: x normal to its face, y along the sliding direction",
  thickness: "Smallest film thickness, edges included, along the middle of the pad, and at its middle.",
  flow: "Oil leaving over the two sides and over the leading and the trailing end (negative: it comes in), and entering through holes and pockets.",
};

const annulus: Surface = {
  along: { ...bore.along, name: "angle" },
  across: { key: "r", figure: "r", symbol: "r", display: millimetre, digits: 3 },
  point: (phi, radius) => [radius * Math.cos(phi), radius * Math.sin(phi), 0],
  held: "stator",
  moving: "runner",
  whole: "the bearing",
  map: "the unwrapped pads",
  middle: "the mean radius",
  way: "around the axis",
  axes: "in the stator’s axes: z along the axis, towards the runner",
  thickness: "Smallest film thickness, edges included, along the mean radius, and on the axis.",
  flow: "Oil leaving over the inner and the outer edges and over leading and trailing edges of pads (negative: it comes in), and entering through holes and pockets.",
};

const skirt: Surface = {
  ...bore,
  along: { ...bore.along, name: "angle" },
  // Drawn a little wider than the skirt, so that the piston does not hide it.
  point: (phi, height, { radius }) => [1.02 * radius * Math.cos(phi), 1.02 * radius * Math.sin(phi), height],
  held: "skirt",
  moving: "liner",
  whole: "the skirt",
  map: "both sides of the unwrapped skirt",
  way: "around the skirt",
  axes: "in its axes: x towards the thrust side, z towards the crown",
  thickness: "Smallest film thickness of both sides, edges included, and at half of the skirt’s length.",
  flow: "Oil leaving over the bottom (left) and the top edge (right) of the skirt (negative: it comes in).",
  mark: "skirt_speed",
};

/** Those with a mark come before those whose coordinates they have; a bore is taken where a file tells nothing. */
export const surfaces = { skirt, bore, plane, annulus };

function has(mark: string | undefined, names: Set<string>): boolean {
  return mark === undefined || names.has(mark);
}

function first(test: (surface: Surface) => boolean): Surface {
  return Object.values(surfaces).find(test) ?? bore;
}

/** By the coordinates that its places are given in. */
export function surfaceOf(run: Run, bearing: string): Surface {
  const names = new Set(run.namesAfter(`/bearings/${bearing}/`));
  return first((surface) => has(surface.mark, names) && [surface.along, surface.across].every(({ key }) => names.has(`fields/${key}`) || names.has(`h_min_${key}`)));
}

/** Likewise of a bearing by itself. */
export function surfaceOfPage(bearing: Pick<BearingText, "solutions">): Surface {
  const known = new Set(bearing.solutions.flatMap(({ figures }) => figures.map(({ key }) => key)));
  return first((surface) => has(surface.mark, known) && [surface.along, surface.across].every(({ figure }) => known.has(`h_min_${figure}`)));
}

/** "bearing angle φ". */
export function axisName({ name, symbol }: Coordinate): string {
  return name === undefined ? symbol : `${name} ${symbol}`;
}

/** "φ 194.2°". */
export function textOf({ symbol, display, digits }: Coordinate, value: number): string {
  return `${symbol} ${withUnit(value * display.factor, display.unit, digits)}`;
}

/** The nodes of a film along one of its coordinates; they ascend, and may be graded. Between the arcs of a bore there is no film. */
export class FilmAxis {
  /** What a map shows: a whole turn, of arcs from the first on or them alone, or from the first node to the last. */
  readonly low: number;
  readonly high: number;
  /** Between neighbours; as many as nodes where the film closes. */
  readonly cells: number;

  constructor(
    readonly coordinate: Coordinate,
    readonly nodes: Numbers,
    /** Number of the arc on which each node lies; nothing where the film is whole. */
    private readonly arcs?: Numbers,
  ) {
    const { period } = coordinate;
    const last = nodes.length - 1;
    this.low = period === undefined || arcs ? nodes[0]! : 0;
    // Arcs that leave more than half of the turn free are shown alone.
    const isShort = arcs && period !== undefined && nodes[last]! - nodes[0]! < period / 2;
    this.high = period === undefined || isShort ? nodes[last]! : this.low + period;
    this.cells = period === undefined ? last : nodes.length;
  }

  /** True of a cell that holds film: it does not lie between two arcs. */
  isFilm(cell: number): boolean {
    return !this.arcs || (cell + 1 < this.nodes.length && this.arcs[cell] === this.arcs[cell + 1]);
  }

  /** The node with an index, which may go on beyond the last one where the film closes. */
  node(index: number): number {
    return index % this.nodes.length;
  }

  /** Where the node with an index is, likewise. */
  place(index: number): number {
    const n = this.nodes.length;
    return index < n ? this.nodes[index]! : this.nodes[index - n]! + (this.coordinate.period ?? 0);
  }

  valueAt(share: number): number {
    return this.low + share * (this.high - this.low);
  }

  /** A value as a share of what is shown. */
  share(value: number): number {
    const { period } = this.coordinate;
    const within = period === undefined ? value : value - period * Math.floor((value - this.low) / period);
    return (within - this.low) / (this.high - this.low || 1);
  }

  /** The places where a value is seen: on a film that closes a turn to the left and right, too, for what crosses the seam. */
  repeated(value: number): number[] {
    const { period } = this.coordinate;
    if (period === undefined) return [value];
    const middle = value - period * Math.floor(value / period);
    return [middle - period, middle, middle + period];
  }

  /** Index of the node at or before a share of what is shown, with the share of the way to the next. */
  index(share: number): number {
    const { nodes } = this;
    const value = this.valueAt(share);
    const { period } = this.coordinate;
    const at = period === undefined ? value : value - period * Math.floor((value - nodes[0]!) / period);
    const i = Math.max(0, Math.min(this.cells - 1, lastNotAbove(nodes, at)));
    const [from, to] = [this.place(i), this.place(i + 1)];
    return to > from ? i + Math.min(1, Math.max(0, (at - from) / (to - from))) : i;
  }

  /** The share of what is shown at a fractional index. */
  shareOf(index: number): number {
    const i = Math.min(this.cells - 1, Math.floor(index));
    const [from, to] = [this.place(i), this.place(i + 1)];
    return (from + (index - i) * (to - from) - this.low) / (this.high - this.low || 1);
  }

  /** "bearing angle φ [°]". */
  label(): string {
    return axisLabel(axisName(this.coordinate), this.coordinate.display.unit);
  }

  /** "bearing angle [°]": of a column of a table. */
  heading(): string {
    const { name, symbol, display } = this.coordinate;
    return axisLabel(name ?? symbol, display.unit);
  }

  /** Numbers of the nodes times a factor, the first once more at the end where the film closes; NaN between arcs. */
  closed(values: ArrayLike<number>, factor = 1): number[] {
    if (!this.arcs) return Array.from({ length: this.cells + 1 }, (_, i) => values[this.node(i)]! * factor);
    return Array.from(this.nodes).flatMap((_, i) => (this.isFilm(i) ? [values[i]! * factor] : [values[i]! * factor, NaN]));
  }

  /** Places of the nodes in the unit displayed, likewise. */
  shown(): number[] {
    const { factor } = this.coordinate.display;
    if (!this.arcs) return Array.from({ length: this.cells + 1 }, (_, i) => this.place(i) * factor);
    return Array.from(this.nodes).flatMap((x, i) => (this.isFilm(i) ? [x * factor] : [x * factor, x * factor]));
  }

  /** Ticks of an axis so long [px] with their places, as shares of it. */
  ticks(length: number, most: number): { share: number; text: string }[] {
    const { display, step } = this.coordinate;
    const [low, high] = [this.low * display.factor, this.high * display.factor];
    // Steps of the angle suit a whole turn.
    const isWhole = this.high - this.low > 0.99 * (this.coordinate.period ?? Infinity);
    const width = isWhole ? step?.(length) : undefined;
    const first = width === undefined ? low : width * Math.ceil(low / width - 1e-6);
    const values = width === undefined ? ticks(low, high, most) : Array.from({ length: Math.floor((high - first) / width + 1.000001) }, (_, i) => first + i * width);
    return values.map((value) => ({ share: (value - low) / (high - low || 1), text: format(value, 3) }));
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
