// A curve as large as a word: its course over the cycle, its extreme, and the instant shown.

import { h } from "./dom";

const svgNamespace = "http://www.w3.org/2000/svg";
const [width, height, rim] = [92, 26, 3];

function svg(tag: string, properties: Record<string, string | number>): SVGElement {
  const element = document.createElementNS(svgNamespace, tag);
  for (const [name, value] of Object.entries(properties)) element.setAttribute(name, String(value));
  return element;
}

export interface SparkSpec {
  /** Said to who cannot see it. */
  label: string;
  x: ArrayLike<number>;
  y: ArrayLike<number>;
  /** Which extreme is marked. */
  extreme: "low" | "high";
}

export class SparkLine {
  readonly element: HTMLElement;
  private readonly cursor = svg("line", { class: "spark-cursor", y1: 0, y2: height, visibility: "hidden" });
  private readonly first: number;
  private readonly last: number;

  constructor(spec: SparkSpec) {
    const { x, y } = spec;
    this.first = x[0] ?? 0;
    this.last = x[x.length - 1] ?? 1;
    const kept = thinned(y, Math.floor(1.5 * width));
    const values = kept.map((i) => y[i]!);
    const [low, high] = [Math.min(0, ...values), Math.max(0, ...values)];
    const down = (v: number) => height - rim - ((v - low) / (high - low || 1)) * (height - 2 * rim);
    const points = kept.map((i) => `${this.across(x[i]!).toFixed(1)},${down(y[i]!).toFixed(1)}`);
    const drawing = svg("svg", { class: "spark", viewBox: `0 0 ${width} ${height}`, width, height, role: "img", "aria-label": spec.label });
    const marked = kept.reduce((best, i) => ((spec.extreme === "low" ? y[i]! < y[best]! : y[i]! > y[best]!) ? i : best), kept[0] ?? 0);
    drawing.append(svg("polyline", { class: "spark-curve", points: points.join(" ") }), this.cursor);
    if (kept.length > 0) drawing.append(svg("circle", { class: "spark-extreme", cx: this.across(x[marked]!), cy: down(y[marked]!), r: 2.4 }));
    this.element = h("span", { class: "spark-holder" });
    this.element.append(drawing);
  }

  /** Moves the line of the instant shown; outside the curve there is none. */
  show(x: number): void {
    const within = x >= this.first && x <= this.last;
    this.cursor.setAttribute("visibility", within ? "visible" : "hidden");
    if (!within) return;
    this.cursor.setAttribute("x1", this.across(x).toFixed(1));
    this.cursor.setAttribute("x2", this.across(x).toFixed(1));
  }

  private across(x: number): number {
    return rim + ((x - this.first) / (this.last - this.first || 1)) * (width - 2 * rim);
  }
}

/** Indices of at most about `most` values, the lowest and the highest of each stretch among them. */
function thinned(y: ArrayLike<number>, most: number): number[] {
  const finite = Array.from({ length: y.length }, (_, i) => i).filter((i) => Number.isFinite(y[i]!));
  const stretch = Math.max(1, Math.ceil((2 * finite.length) / most));
  if (stretch === 1) return finite;
  const kept: number[] = [];
  for (let from = 0; from < finite.length; from += stretch) {
    const part = finite.slice(from, from + stretch);
    const low = part.reduce((best, i) => (y[i]! < y[best]! ? i : best));
    const high = part.reduce((best, i) => (y[i]! > y[best]! ? i : best));
    kept.push(...(low === high ? [low] : [Math.min(low, high), Math.max(low, high)]));
  }
  return kept;
}
