// Position of the journal's centre in the clearance circle: one equilibrium, or the locus of a sweep.

import { ClearanceCircle, dot } from "./clearance_circle";
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

export class Locus extends ClearanceCircle {
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

  protected clearance(): number {
    return this.data.clearance(this.chosen);
  }

  protected reach(): number {
    return Math.max(0, ...this.points().map((p) => Math.hypot(p.x, p.y)));
  }

  private points(): LocusPoint[] {
    return this.data.lines.flatMap((line) => line.points);
  }

  protected paint(context: CanvasRenderingContext2D): void {
    const at = this.mapped();
    const { series } = palette();
    this.paintCircles(context);
    for (const line of this.data.lines) {
      context.strokeStyle = context.fillStyle = series[line.colour % series.length]!;
      context.lineWidth = 1.4;
      context.beginPath();
      line.points.forEach((p, i) => (i === 0 ? context.moveTo(...at(p.x, p.y)) : context.lineTo(...at(p.x, p.y))));
      context.stroke();
      for (const p of line.points) dot(context, ...at(p.x, p.y), 3);
    }
    const chosen = this.points().find((p) => p.index === this.chosen);
    if (!chosen) return;
    this.paintLoad(context, ...this.data.load(this.chosen));
    this.paintCentre(context, chosen.x, chosen.y);
  }

  private near(px: number, py: number): LocusPoint | null {
    const points = this.points();
    const i = this.nearestTo(px, py, points.length, (k) => [points[k]!.x, points[k]!.y]);
    return i < 0 ? null : points[i]!;
  }

  protected describe(px: number, py: number): string[] | null {
    const p = this.near(px, py);
    if (!p) return null;
    const c = 1e6 * this.data.clearance(p.index);
    return [...(p.label ? [p.label] : []), `x ${format(c * p.x)} µm, y ${format(c * p.y)} µm`, `ε = ${format(Math.hypot(p.x, p.y))}`];
  }
}
