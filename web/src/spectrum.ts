// What vibrates in a series, and how fast: spectra over frequency or over orders of a turning shaft, whole or piece by piece.

export interface Spectrum {
  /** Cycles per unit of the abscissa: Hz over time, orders over turns. */
  frequency: Float64Array;
  /** A sine of amplitude 1 has a peak of 1. */
  amplitude: Float64Array;
}

/** A spectrum of a piece of a series. */
export interface Piece extends Spectrum {
  /** The abscissa in its middle. */
  at: number;
}

/** Fourier's transform in place; the length is a power of two. */
export function transform(re: Float64Array, im: Float64Array): void {
  const n = re.length;
  for (let i = 1, j = 0; i < n; i++) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i >= j) continue;
    [re[i], re[j]] = [re[j]!, re[i]!];
    [im[i], im[j]] = [im[j]!, im[i]!];
  }
  for (let length = 2; length <= n; length <<= 1) {
    const half = length >> 1;
    for (let k = 0; k < half; k++) {
      // Each factor by itself: products of one with the next would lose digits.
      const [c, s] = [Math.cos((-2 * Math.PI * k) / length), Math.sin((-2 * Math.PI * k) / length)];
      for (let i = k; i < n; i += length) {
        const j = i + half;
        const [a, b] = [re[j]! * c - im[j]! * s, re[j]! * s + im[j]! * c];
        re[j] = re[i]! - a;
        im[j] = im[i]! - b;
        re[i]! += a;
        im[i]! += b;
      }
    }
  }
}

/**
 * A series at `count` even places from `from` in steps of `step`: cubic between its rows, with slopes of the parabola through a row
 * and its neighbours. Even rows keep their values.
 */
export function evenly(x: ArrayLike<number>, y: ArrayLike<number>, from: number, step: number, count: number): Float64Array {
  const n = x.length;
  const slope = (i: number): number => {
    if (n < 3) return (y[1]! - y[0]!) / (x[1]! - x[0]!);
    const m = Math.min(n - 2, Math.max(1, i));
    const [a, b] = [x[m]! - x[m - 1]!, x[m + 1]! - x[m]!];
    const [u, v] = [(y[m]! - y[m - 1]!) / a, (y[m + 1]! - y[m]!) / b];
    const curvature = (v - u) / (a + b);
    return u + curvature * (x[i]! - x[m]! + (x[i]! - x[m - 1]!));
  };
  let k = 1;
  return Float64Array.from({ length: count }, (_, i) => {
    const place = from + i * step;
    while (k < n - 1 && x[k]! < place) k++;
    const length = x[k]! - x[k - 1]!;
    const t = (place - x[k - 1]!) / length;
    const [p, q] = [length * slope(k - 1), length * slope(k)];
    const rise = y[k]! - y[k - 1]!;
    return y[k - 1]! + t * (p + t * (3 * rise - 2 * p - q + t * (p + q - 2 * rise)));
  });
}

/** Rows whose abscissa does not come after that of the row before, or that are no numbers, are left out. */
export function ascending(x: ArrayLike<number>, y: ArrayLike<number>): { x: Float64Array; y: Float64Array } {
  const keep: number[] = [];
  for (let i = 0; i < Math.min(x.length, y.length); i++)
    if (Number.isFinite(y[i]!) && (keep.length === 0 || x[i]! > x[keep[keep.length - 1]!]!)) keep.push(i);
  return { x: Float64Array.from(keep, (i) => x[i]!), y: Float64Array.from(keep, (i) => y[i]!) };
}

function powerOfTwo(least: number): number {
  return 2 ** Math.ceil(Math.log2(Math.max(2, least)));
}

/** Hann's, over `count` places of which the ends are not both within the period. */
function hann(count: number): Float64Array {
  return Float64Array.from({ length: count }, (_, i) => 0.5 - 0.5 * Math.cos((2 * Math.PI * (i + 0.5)) / count));
}

/** Of even values without their mean under Hann's window, between the transform's lines by padding with zeros. */
function windowed(values: Float64Array, step: number): Spectrum {
  const count = values.length;
  const window = hann(count);
  const weight = window.reduce((a, b) => a + b, 0);
  const mean = values.reduce((sum, v, i) => sum + v * window[i]!, 0) / weight;
  const n = powerOfTwo(4 * count);
  const [re, im] = [new Float64Array(n), new Float64Array(n)];
  values.forEach((v, i) => (re[i] = (v - mean) * window[i]!));
  transform(re, im);
  const lines = n / 2;
  return {
    frequency: Float64Array.from({ length: lines }, (_, k) => k / (n * step)),
    amplitude: Float64Array.from({ length: lines }, (_, k) => (2 * Math.hypot(re[k]!, im[k]!)) / weight),
  };
}

/** The spectrum of a series from one place to another, up to half its mean rate of rows. */
export function spectrum(x: Float64Array, y: Float64Array, from = x[0]!, to = x[x.length - 1]!): Spectrum | null {
  const count = x.filter((v) => v >= from && v <= to).length;
  if (count < 8) return null;
  const step = (to - from) / (count - 1);
  return windowed(evenly(x, y, from, step, count), step);
}

/**
 * Amplitudes of the orders of a shaft over its last `turns` turns, which are whole and taken as a period: the lines are exact for what
 * repeats with it. Order 1/turns is the lowest.
 */
export function orderLines(angle: Float64Array, y: Float64Array, turns: number): Spectrum | null {
  const end = angle[angle.length - 1]!;
  const rows = angle.filter((v) => v >= end - turns).length;
  if (rows < 8 || end - angle[0]! < turns * (1 - 1e-9)) return null;
  const n = powerOfTwo(2 * rows);
  const re = evenly(angle, y, end - turns, turns / n, n);
  const im = new Float64Array(n);
  transform(re, im);
  const lines = Math.floor(rows / 2);
  return {
    frequency: Float64Array.from({ length: lines }, (_, k) => (k + 1) / turns),
    amplitude: Float64Array.from({ length: lines }, (_, k) => (2 * Math.hypot(re[k + 1]!, im[k + 1]!)) / n),
  };
}

/** Spectra of `count` pieces of a series that overlap by half, Hann's window on each. */
export function pieces(x: Float64Array, y: Float64Array, count: number): Piece[] {
  const n = x.length;
  const length = Math.max(16, Math.floor((2 * n) / (count + 1)));
  if (n < 2 * length) return [];
  const [from, step] = [x[0]!, (x[n - 1]! - x[0]!) / (n - 1)];
  const values = evenly(x, y, from, step, n);
  const begins: number[] = [];
  for (let begin = 0; begin + length <= n; begin += Math.max(1, Math.floor((n - length) / Math.max(1, count - 1)))) begins.push(begin);
  return begins.map((begin) => ({ at: from + (begin + 0.5 * (length - 1)) * step, ...windowed(values.slice(begin, begin + length), step) }));
}

/** How the amplitude of one order goes on over a run: at the middles `at` of windows of `width` turns, Hann's. */
export function orderTrack(angle: Float64Array, y: Float64Array, order: number, width: number, at: Float64Array): Float64Array {
  // Of each order the window lets eight rows a period through, and every row of the run.
  const rows = Math.ceil((width * angle.length) / (angle[angle.length - 1]! - angle[0]!));
  const count = Math.max(rows, Math.ceil(8 * Math.max(order, 1) * width), 64);
  const window = hann(count);
  const weight = window.reduce((a, b) => a + b, 0);
  return at.map((middle) => {
    const step = width / count;
    const first = middle - 0.5 * width + 0.5 * step;
    const values = evenly(angle, y, first, step, count);
    const mean = values.reduce((sum, v, i) => sum + v * window[i]!, 0) / weight;
    let [re, im] = [0, 0];
    values.forEach((v, i) => {
      const phase = 2 * Math.PI * order * (first + i * step);
      re += window[i]! * (v - mean) * Math.cos(phase);
      im -= window[i]! * (v - mean) * Math.sin(phase);
    });
    return (2 * Math.hypot(re, im)) / weight;
  });
}
