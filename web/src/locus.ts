// Where the journal's centre stands in the clearance circle: one equilibrium, or the locus of a sweep.

import { Drawing } from "./canvas";
import { palette } from "./theme";
import { format } from "./units";

export interface LocusPoint {
  label: string;
  /** Position over the clearance. */
  x: number;
  y: number;
  /** Index of the solution. */
  index: number;
}

export interface LocusData {
  /** Each a line. */
  lines: { colour: number; points: LocusPoint[] }[];
  load: (index: number) => [number, number];
  clearance: (index: number) => number;
}

export class Locus extends Drawing {
  constructor(
    private readonly data: LocusData,
    private chosen: number,
    private readonly pick: (index: number) => void,
  ) {
    super("Journal centre in the clearance circle");
    this.canvas.addEventListener("click", (event) => {
      const point = this.near(event.offsetX, event.offsetY);
      if (point) this.pick(point.index);
    });
  }

  show(index: number): void {
    this.chosen = index;
    this.draw();
  }

  protected heightFor(width: number): number {
    return Math.min(width, 380);
  }

  private points(): LocusPoint[] {
    return this.data.lines.flatMap((line) => line.points);
  }

  private place(): { cx: number; cy: number; scale: number } {
    const half = Math.min(this.width, this.height) / 2;
    const reach = Math.max(1, ...this.points().map((p) => Math.hypot(p.x, p.y)));
    return { cx: this.width / 2, cy: this.height / 2, scale: (half - 26) / reach };
  }

  private at(p: LocusPoint): [number, number] {
    const { cx, cy, scale } = this.place();
    return [cx + scale * p.x, cy - scale * p.y];
  }

  protected paint(context: CanvasRenderingContext2D): void {
    const { series, accent, paper, ink } = palette();
    this.paintCircles(context);
    for (const line of this.data.lines) {
      const colour = series[line.colour % series.length]!;
      context.strokeStyle = context.fillStyle = colour;
      context.lineWidth = 1.4;
      context.beginPath();
      line.points.forEach((p, i) => (i === 0 ? context.moveTo(...this.at(p)) : context.lineTo(...this.at(p))));
      context.stroke();
      for (const p of line.points) dot(context, ...this.at(p), 3);
    }
    const chosen = this.points().find((p) => p.index === this.chosen);
    if (!chosen) return;
    this.paintLoad(context, series[1]!);
    const { cx, cy } = this.place();
    const [x, y] = this.at(chosen);
    context.strokeStyle = accent;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(cx, cy);
    context.lineTo(x, y);
    context.stroke();
    context.fillStyle = accent;
    context.strokeStyle = paper;
    context.lineWidth = 2;
    dot(context, x, y, 5.5);
    context.stroke();
    context.fillStyle = ink;
    context.textAlign = "left";
    context.textBaseline = "top";
    context.fillText(`ε = ${format(Math.hypot(chosen.x, chosen.y), 4)}`, 2, 2);
  }

  private paintCircles(context: CanvasRenderingContext2D): void {
    const { cx, cy, scale } = this.place();
    const { ink, faint, line } = palette();
    context.lineWidth = 1;
    context.strokeStyle = line;
    for (const share of [0.25, 0.5, 0.75]) ring(context, cx, cy, share * scale);
    context.beginPath();
    context.moveTo(cx - scale, cy);
    context.lineTo(cx + scale, cy);
    context.moveTo(cx, cy - scale);
    context.lineTo(cx, cy + scale);
    context.stroke();
    context.strokeStyle = faint;
    context.lineWidth = 1.6;
    ring(context, cx, cy, scale);
    context.fillStyle = ink;
    context.textBaseline = "middle";
    context.textAlign = "left";
    context.fillText("x", cx + scale + 6, cy);
    context.textAlign = "center";
    context.textBaseline = "bottom";
    context.fillText("y", cx, cy - scale - 4);
    context.textBaseline = "top";
    const clearance = format(1e6 * this.data.clearance(this.chosen), 4);
    context.fillText(`clearance circle, radius ${clearance} µm`, cx, cy + scale + 8);
  }

  private paintLoad(context: CanvasRenderingContext2D, colour: string): void {
    const [fx, fy] = this.data.load(this.chosen);
    const size = Math.hypot(fx, fy);
    if (!(size > 0)) return;
    const { cx, cy, scale } = this.place();
    const [ux, uy] = [fx / size, -fy / size];
    const [x, y] = [cx + 0.32 * scale * ux, cy + 0.32 * scale * uy];
    context.strokeStyle = context.fillStyle = colour;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(cx, cy);
    context.lineTo(x, y);
    context.stroke();
    context.beginPath();
    context.moveTo(x + 7 * ux, y + 7 * uy);
    context.lineTo(x - 4 * uy, y + 4 * ux);
    context.lineTo(x + 4 * uy, y - 4 * ux);
    context.fill();
  }

  private near(px: number, py: number): LocusPoint | null {
    let best: LocusPoint | null = null;
    let distance = 18;
    for (const p of this.points()) {
      const [x, y] = this.at(p);
      const d = Math.hypot(x - px, y - py);
      if (d < distance) [best, distance] = [p, d];
    }
    return best;
  }

  protected describe(px: number, py: number): string[] | null {
    const p = this.near(px, py);
    if (!p) return null;
    const c = 1e6 * this.data.clearance(p.index);
    return [...(p.label ? [p.label] : []), `x ${format(c * p.x)} µm, y ${format(c * p.y)} µm`, `ε = ${format(Math.hypot(p.x, p.y))}`];
  }
}

function ring(context: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  context.beginPath();
  context.arc(x, y, Math.max(0, radius), 0, 2 * Math.PI);
  context.stroke();
}

function dot(context: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fill();
}
