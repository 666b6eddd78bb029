// The clearance circle of a journal bearing, to scale: what the orbit of a run and the locus of a sweep are drawn into.

import { Drawing } from "./canvas";
import { palette } from "./theme";
import { format } from "./units";

/** Positions are over the clearance: on the circle, at 1, rigid surfaces touch. */
export abstract class ClearanceCircle extends Drawing {
  /** Radial clearance [m] that the circle is labelled with. */
  protected abstract clearance(): number;
  /** Largest distance from the centre that is drawn: surfaces that yield let the journal leave the circle. */
  protected abstract reach(): number;

  protected heightFor(width: number): number {
    return Math.min(width, 380);
  }

  private frame(): { cx: number; cy: number; scale: number } {
    const half = Math.min(this.width, this.height) / 2;
    return { cx: this.width / 2, cy: this.height / 2, scale: (half - 26) / Math.max(1, this.reach()) };
  }

  /** Maps a position over the clearance to the canvas. */
  protected mapped(): (x: number, y: number) => [number, number] {
    const { cx, cy, scale } = this.frame();
    return (x, y) => [cx + scale * x, cy - scale * y];
  }

  protected paintCircles(context: CanvasRenderingContext2D): void {
    const { cx, cy, scale } = this.frame();
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
    context.fillText(`clearance circle, radius ${format(1e6 * this.clearance(), 4)} µm`, cx, cy + scale + 8);
  }

  /** An arrow of fixed length in the direction of the load. */
  protected paintLoad(context: CanvasRenderingContext2D, fx: number, fy: number): void {
    const size = Math.hypot(fx, fy);
    if (!(size > 0)) return;
    const { cx, cy, scale } = this.frame();
    const [ux, uy] = [fx / size, -fy / size];
    const [x, y] = [cx + 0.32 * scale * ux, cy + 0.32 * scale * uy];
    context.strokeStyle = context.fillStyle = palette().series[1]!;
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

  /** The journal's centre at (x, y), with its eccentricity ratio. */
  protected paintCentre(context: CanvasRenderingContext2D, x: number, y: number): void {
    const at = this.mapped();
    const { accent, paper, ink } = palette();
    context.strokeStyle = accent;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(...at(0, 0));
    context.lineTo(...at(x, y));
    context.stroke();
    context.fillStyle = accent;
    context.strokeStyle = paper;
    context.lineWidth = 2;
    dot(context, ...at(x, y), 5.5);
    context.stroke();
    context.fillStyle = ink;
    context.textAlign = "left";
    context.textBaseline = "top";
    context.fillText(`ε = ${format(Math.hypot(x, y), 4)}`, 2, 2);
  }

  /** Index of the point nearest to the pointer, within reach of a finger; -1: none. */
  protected nearestTo(px: number, py: number, count: number, point: (i: number) => [number, number]): number {
    const at = this.mapped();
    let best = -1;
    let distance = 18;
    for (let i = 0; i < count; i++) {
      const [x, y] = at(...point(i));
      const d = Math.hypot(x - px, y - py);
      if (d < distance) [best, distance] = [i, d];
    }
    return best;
  }
}

function ring(context: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  context.beginPath();
  context.arc(x, y, Math.max(0, radius), 0, 2 * Math.PI);
  context.stroke();
}

export function dot(context: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fill();
}
