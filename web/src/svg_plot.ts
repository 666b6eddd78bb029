// Small figures as SVG: scales, axes, shapes. Colours are the style sheet's, so that both themes and print follow.

import { ticks } from "./canvas";
import { format } from "./units";

type Attributes = Record<string, string | number>;

export function svg(tag: string, attributes: Attributes = {}, ...children: (Node | string)[]): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

export interface Scale {
  low: number;
  high: number;
  at(value: number): number;
}

/** From the range of `values` to [from, to]; a constant stands in the middle. */
export function scaleOf(values: (number | null)[], from: number, to: number, slack = 0.04): Scale {
  const numbers = values.filter((v): v is number => v !== null && Number.isFinite(v));
  let low = Math.min(...numbers);
  let high = Math.max(...numbers);
  if (!(low <= high)) [low, high] = [0, 1];
  const span = high - low || Math.abs(high) || 1;
  low -= slack * span;
  high += slack * span;
  return { low, high, at: (value) => from + ((value - low) / (high - low)) * (to - from) };
}

export interface Frame {
  width: number;
  height: number;
  left: number;
  right: number;
  top: number;
  bottom: number;
}

export const usual: Frame = { width: 420, height: 280, left: 62, right: 14, top: 12, bottom: 44 };

export function canvasOf(frame: Frame, label: string): SVGElement {
  return svg("svg", { viewBox: `0 0 ${frame.width} ${frame.height}`, class: "svg-plot", role: "img", "aria-label": label });
}

export function axes(plot: SVGElement, frame: Frame, x: Scale, y: Scale, xLabel: string, yLabel: string): void {
  const bottom = frame.height - frame.bottom;
  for (const value of ticks(x.low, x.high, 5)) {
    plot.append(
      svg("line", { x1: x.at(value), x2: x.at(value), y1: frame.top, y2: bottom, class: "grid" }),
      svg("text", { x: x.at(value), y: bottom + 15, "text-anchor": "middle" }, format(value)),
    );
  }
  for (const value of ticks(y.low, y.high, 5)) {
    plot.append(
      svg("line", { x1: frame.left, x2: frame.width - frame.right, y1: y.at(value), y2: y.at(value), class: "grid" }),
      svg("text", { x: frame.left - 6, y: y.at(value) + 4, "text-anchor": "end" }, format(value)),
    );
  }
  plot.append(
    svg("text", { x: 0.5 * (frame.left + frame.width - frame.right), y: frame.height - 8, "text-anchor": "middle", class: "axis" }, xLabel),
    svg("text", { transform: `translate(13 ${0.5 * (frame.top + bottom)}) rotate(-90)`, "text-anchor": "middle", class: "axis" }, yLabel),
  );
}

export function withTitle(element: SVGElement, title: string): SVGElement {
  element.append(svg("title", {}, title));
  return element;
}

export function path(points: [number, number][]): string {
  return points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");
}
