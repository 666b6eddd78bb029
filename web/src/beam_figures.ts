// Section forces along the beams of a machine at the instant of the timeline.

import type { Run } from "./data";
import { figure } from "./dom";
import { nearest } from "./film_fields";
import { LinePlot, type Curve } from "./line_plot";

const kinds = [
  { dataset: "section_force", name: "section-force", label: "force", unit: "N", caption: "normal force and shear", curves: ["normal", "shear y", "shear z"] },
  { dataset: "section_moment", name: "section-moment", label: "moment", unit: "N·m", caption: "torque and bending moments", curves: ["torque", "about y", "about z"] },
] as const;

/** The bodies of a run that are beams. */
export function beamsOf(run: Run): string[] {
  return run.children("/bodies").filter((name) => run.dataset(`/bodies/${name}/section_moment`));
}

export class BeamFigures {
  readonly elements: HTMLElement[] = [];
  private readonly followers: ((row: number) => void)[] = [];
  private readonly time: ArrayLike<number>;

  constructor(private readonly run: Run) {
    this.time = run.column("/time") ?? new Float64Array();
    for (const beam of beamsOf(run)) for (const kind of kinds) this.add(beam, kind);
  }

  show(time: number): void {
    if (this.time.length === 0) return;
    const row = nearest(this.time, time);
    for (const follow of this.followers) follow(row);
  }

  private add(beam: string, kind: (typeof kinds)[number]): void {
    const { values, width } = this.run.dataset(`/bodies/${beam}/${kind.dataset}`)!;
    const columns = (row: number) => kind.curves.map((_, axis) => Float64Array.from({ length: width / 3 }, (_, k) => values[row * width + 3 * k + axis]!));
    const curves: Curve[] = columns(0).map((y, axis) => ({ label: kind.curves[axis]!, y, unit: kind.unit }));
    const plot = new LinePlot({
      name: `${beam}-${kind.name}`,
      x: { label: "along the beam", unit: "mm", values: this.middles(beam) },
      left: { label: kind.label, unit: kind.unit },
      curves,
      height: 200,
    });
    this.followers.push((row) => plot.update(columns(row)));
    const caption = `${beam.replaceAll("_", " ")}: ${kind.caption} in its elements at the instant shown, axes of the section.`;
    this.elements.push(figure(`${beam}-${kind.name}`, caption, plot.tools, plot.element));
  }

  /** Where the middles of the elements lie along the beam [mm]. */
  private middles(beam: string): Float64Array {
    const nodes = this.run.dataset(`/bodies/${beam}/nodes`)!.values;
    const middles = new Float64Array(nodes.length / 3 - 1);
    let start = 0;
    for (let k = 0; k < middles.length; k++) {
      const length = Math.hypot(...[0, 1, 2].map((i) => nodes[3 * (k + 1) + i]! - nodes[3 * k + i]!));
      middles[k] = 1e3 * (start + 0.5 * length);
      start += length;
    }
    return middles;
  }
}
