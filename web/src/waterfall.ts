// Spectra one behind the other, the slowest in front: of the runs of a study over a parameter, or of the pieces of one run over its speed.

import { axes, canvasOf, path, scaleOf, svg, usual, withTitle, type Frame } from "./svg_plot";
import { format, withUnit } from "./units";

export interface Ridge {
  /** Its place on the axis upwards. */
  at: number;
  frequency: ArrayLike<number>;
  amplitude: ArrayLike<number>;
}

export interface WaterfallAxes {
  x: string;
  y: string;
  /** Of the axis upwards, and of the amplitudes. */
  unit: string;
  amplitude: string;
  /** Of the axis upwards, turns per second of one of its units: orders are drawn. */
  turns?: number;
}

const frame: Frame = { ...usual, width: 640, height: 440 };
const tallest = 70;
export const orders = [0.5, 1, 2, 3];

export function waterfall(ridges: Ridge[], { x: xLabel, y: yLabel, unit, amplitude, turns }: WaterfallAxes): SVGElement {
  const rows = [...ridges].sort((a, b) => b.at - a.at);
  const top = largestOf(rows);
  const plot = canvasOf(frame, `Waterfall of spectra: ${rows.length} spectra, ${yLabel} from ${format(rows[rows.length - 1]!.at)} to ${format(rows[0]!.at)}; ${textOf(top, unit, amplitude)}`);
  const x = scaleOf([0, Math.max(...rows.map((row) => row.frequency[row.frequency.length - 1] ?? 0))], frame.left, frame.width - frame.right, 0);
  const places = rows.map((row) => row.at);
  const y = scaleOf([Math.min(...places), Math.max(...places)], frame.height - frame.bottom, frame.top + tallest, 0.02);
  axes(plot, frame, x, y, xLabel, yLabel);
  for (const row of rows) {
    const base = y.at(row.at);
    const points = Array.from(row.frequency, (f, i): [number, number] => [x.at(f), base - (tallest * row.amplitude[i]!) / (top.amplitude || 1)]);
    plot.append(withTitle(svg("path", { d: path(points), class: "ridge" }), withUnit(row.at, unit)));
  }
  if (turns) for (const order of orders) orderLine(plot, order, order * turns, places, x, y);
  plot.append(svg("text", { x: frame.width - frame.right, y: frame.top + 8, "text-anchor": "end" }, textOf(top, unit, amplitude)));
  return plot;
}

export interface Peak {
  amplitude: number;
  frequency: number;
  at: number;
}

export function largestOf(rows: Ridge[]): Peak {
  let best: Peak = { amplitude: 0, frequency: 0, at: 0 };
  for (const row of rows)
    for (let i = 0; i < row.amplitude.length; i++) if (row.amplitude[i]! > best.amplitude) best = { amplitude: row.amplitude[i]!, frequency: row.frequency[i]!, at: row.at };
  return best;
}

function textOf({ amplitude, frequency, at }: Peak, unit: string, ofAmplitude: string): string {
  return `largest amplitude ${withUnit(amplitude, ofAmplitude)} at ${format(frequency)} Hz, ${withUnit(at, unit)}`;
}

function orderLine(plot: SVGElement, order: number, slope: number, places: number[], x: ReturnType<typeof scaleOf>, y: ReturnType<typeof scaleOf>): void {
  const low = Math.min(...places);
  const high = Math.min(Math.max(...places), x.high / slope);
  if (high <= low) return;
  plot.append(
    svg("line", { x1: x.at(slope * low), y1: y.at(low), x2: x.at(slope * high), y2: y.at(high), class: "order" }),
    svg("text", { x: x.at(slope * high) - 4, y: y.at(high) - 5, "text-anchor": "end", class: "halo" }, `${order}×`),
  );
}
