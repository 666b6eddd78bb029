// The journal centre's path inside its clearance circle, to scale.

import { ClearanceCircle } from "./clearance_circle";
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

export class Orbit extends ClearanceCircle {
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

  protected clearance(): number {
    return this.data.clearance;
  }

  protected reach(): number {
    let reach = 0;
    for (let i = 0; i < this.data.x.length; i++) reach = Math.max(reach, Math.hypot(...this.point(i)));
    return reach;
  }

  /** Position in row i over the clearance. */
  private point(i: number): [number, number] {
    const { x, y, clearance } = this.data;
    return [x[i]! / clearance, y[i]! / clearance];
  }

  protected paint(context: CanvasRenderingContext2D): void {
    const at = this.mapped();
    this.paintCircles(context);
    context.strokeStyle = palette().series[0]!;
    context.lineWidth = 1.4;
    context.lineJoin = "round";
    context.beginPath();
    for (let i = 0; i < this.data.x.length; i++) {
      const [px, py] = at(...this.point(i));
      if (i === 0) context.moveTo(px, py);
      else context.lineTo(px, py);
    }
    context.stroke();
    const force = this.data.force;
    if (force) this.paintLoad(context, force.x[this.row]!, force.y[this.row]!);
    this.paintCentre(context, ...this.point(this.row));
  }

  protected describe(px: number, py: number): string[] | null {
    const { x, y, time } = this.data;
    const i = this.nearestTo(px, py, x.length, (row) => this.point(row));
    if (i < 0) return null;
    return [
      `t = ${format(1e3 * time[i]!, 5)} ms`,
      `x ${format(1e6 * x[i]!)} µm, y ${format(1e6 * y[i]!)} µm`,
      `ε = ${format(Math.hypot(...this.point(i)))}`,
    ];
  }
}
