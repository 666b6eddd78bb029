// The journal centre's path inside its clearance circle, to scale.

import { Drawing } from "./canvas";
import type { Numbers } from "./data";
import { nearest } from "./film_fields";
import { palette } from "./theme";
import { format } from "./units";

export interface OrbitData {
  time: Numbers;
  x: Numbers;
  y: Numbers;
  /** Force on the shell: it points where the journal is pressed to. */
  force: { x: Numbers; y: Numbers } | null;
  clearance: number;
}

export class Orbit extends Drawing {
  private row = 0;

  constructor(private readonly data: OrbitData) {
    super("Journal orbit inside the clearance circle");
  }

  show(time: number): void {
    this.row = nearest(this.data.time, time);
    this.draw();
  }

  /** The path as a table. */
  numbers(): (string | number)[][] {
    const { time, x, y } = this.data;
    return [["time [s]", "x [m]", "y [m]"], ...Array.from(time, (t, i) => [t, x[i]!, y[i]!])];
  }

  protected heightFor(width: number): number {
    return Math.min(width, 380);
  }

  /** The larger of the clearance and the path: surfaces that yield let the journal leave the circle. */
  private reach(): number {
    const { x, y, clearance } = this.data;
    let reach = clearance;
    for (let i = 0; i < x.length; i++) {
      const size = Math.hypot(x[i]!, y[i]!);
      if (size > reach) reach = size;
    }
    return reach;
  }

  private place(): { cx: number; cy: number; scale: number } {
    const half = Math.min(this.width, this.height) / 2;
    return { cx: this.width / 2, cy: this.height / 2, scale: (half - 26) / this.reach() };
  }

  protected paint(context: CanvasRenderingContext2D): void {
    const { cx, cy, scale } = this.place();
    const { ink, faint, line, accent, series } = palette();
    const { x, y, clearance } = this.data;
    this.paintCircles(context, ink, faint, line);
    context.strokeStyle = series[0]!;
    context.lineWidth = 1.4;
    context.lineJoin = "round";
    context.beginPath();
    for (let i = 0; i < x.length; i++) {
      const [px, py] = [cx + scale * x[i]!, cy - scale * y[i]!];
      if (i === 0) context.moveTo(px, py);
      else context.lineTo(px, py);
    }
    context.stroke();
    this.paintLoad(context, series[1]!);
    const [px, py] = [cx + scale * x[this.row]!, cy - scale * y[this.row]!];
    context.strokeStyle = accent;
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(cx, cy);
    context.lineTo(px, py);
    context.stroke();
    context.fillStyle = accent;
    context.strokeStyle = palette().paper;
    context.lineWidth = 2;
    context.beginPath();
    context.arc(px, py, 5.5, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
    const epsilon = Math.hypot(x[this.row]!, y[this.row]!) / clearance;
    context.fillStyle = ink;
    context.textAlign = "left";
    context.textBaseline = "top";
    context.fillText(`ε = ${format(epsilon, 4)}`, 2, 2);
  }

  private paintCircles(context: CanvasRenderingContext2D, ink: string, faint: string, line: string): void {
    const { cx, cy, scale } = this.place();
    const radius = scale * this.data.clearance;
    context.lineWidth = 1;
    context.strokeStyle = line;
    for (const share of [0.25, 0.5, 0.75]) circle(context, cx, cy, share * radius);
    context.beginPath();
    context.moveTo(cx - radius, cy);
    context.lineTo(cx + radius, cy);
    context.moveTo(cx, cy - radius);
    context.lineTo(cx, cy + radius);
    context.stroke();
    context.strokeStyle = faint;
    context.lineWidth = 1.6;
    circle(context, cx, cy, radius);
    context.fillStyle = ink;
    context.textBaseline = "middle";
    context.textAlign = "left";
    context.fillText("x", cx + radius + 6, cy);
    context.textAlign = "center";
    context.textBaseline = "bottom";
    context.fillText("y", cx, cy - radius - 4);
    context.textBaseline = "top";
    context.fillText(`clearance circle, radius ${format(1e6 * this.data.clearance, 4)} µm`, cx, cy + radius + 8);
  }

  /** The load's direction, an arrow of fixed length outside the path's centre. */
  private paintLoad(context: CanvasRenderingContext2D, colour: string): void {
    const { force, clearance } = this.data;
    if (!force) return;
    const [fx, fy] = [force.x[this.row]!, force.y[this.row]!];
    const size = Math.hypot(fx, fy);
    if (!(size > 0)) return;
    const { cx, cy, scale } = this.place();
    const [ux, uy] = [fx / size, -fy / size];
    const length = 0.32 * scale * clearance;
    const [x1, y1] = [cx + ux * length, cy + uy * length];
    context.strokeStyle = colour;
    context.fillStyle = colour;
    context.lineWidth = 2;
    context.beginPath();
    context.moveTo(cx, cy);
    context.lineTo(x1, y1);
    context.stroke();
    context.beginPath();
    context.moveTo(x1 + 7 * ux, y1 + 7 * uy);
    context.lineTo(x1 - 4 * uy, y1 + 4 * ux);
    context.lineTo(x1 + 4 * uy, y1 - 4 * ux);
    context.fill();
  }

  protected describe(px: number, py: number): string[] | null {
    const { cx, cy, scale } = this.place();
    const { x, y, time, clearance } = this.data;
    let best = -1;
    let distance = 18;
    for (let i = 0; i < x.length; i++) {
      const d = Math.hypot(cx + scale * x[i]! - px, cy - scale * y[i]! - py);
      if (d < distance) [best, distance] = [i, d];
    }
    if (best < 0) return null;
    return [
      `t = ${format(1e3 * time[best]!, 5)} ms`,
      `x ${format(1e6 * x[best]!)} µm, y ${format(1e6 * y[best]!)} µm`,
      `ε = ${format(Math.hypot(x[best]!, y[best]!) / clearance)}`,
    ];
  }
}

function circle(context: CanvasRenderingContext2D, x: number, y: number, radius: number): void {
  context.beginPath();
  context.arc(x, y, Math.max(0, radius), 0, 2 * Math.PI);
  context.stroke();
}
