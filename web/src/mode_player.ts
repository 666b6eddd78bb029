// Small motions about the state shown: one mode of the analysis, played on the machine, much enlarged.

import { Vector3 } from "three";
import type { Run } from "./data";
import { h } from "./dom";
import type { Increment, MachineView } from "./machine_view";
import { format } from "./units";

const shareOfSize = 0.15;
const period = 1.6;

/** A body's share in a mode: increments at phase 0 and a quarter of a period later. */
interface BodyShape {
  body: string;
  real: Increment;
  imaginary: Increment;
}

export class ModePlayer {
  readonly element: HTMLElement;
  private readonly bodies: string[];
  private readonly play = h("button", { type: "button", class: "quiet", "aria-pressed": "false" }, "Play mode");
  private shapes: BodyShape[] = [];
  private enlargement = 0;
  private phase = 0;
  private last: number | null = null;
  private playing = false;

  static of(run: Run, machine: MachineView): ModePlayer | null {
    return run.dataset("/modes/fields/body_real") ? new ModePlayer(run, machine) : null;
  }

  private constructor(
    private readonly run: Run,
    private readonly machine: MachineView,
  ) {
    this.bodies = run.list("/modes", "bodies");
    const frequency = run.column("/modes/fields/damped_frequency")!;
    const damping = run.column("/modes/fields/damping_ratio")!;
    const picker = h("select", { "aria-label": "Mode", change: () => this.choose(Number(picker.value)) });
    Array.from(frequency).forEach((f, i) => {
      const damped = Math.abs(damping[i]!) < 1e-9 ? "" : `, damping ratio ${format(damping[i]!)}`;
      picker.append(h("option", { value: i }, `Mode ${i + 1}: ${format(f)} Hz${damped}`));
    });
    this.play.addEventListener("click", () => this.toggle());
    this.element = h("div", { class: "controls mode-player" }, picker, this.play);
    this.choose(0);
  }

  private choose(mode: number): void {
    const part = (dataset: string, k: number): Increment => {
      const values = this.run.dataset(`/modes/fields/${dataset}`)!.values;
      const at = 6 * (mode * this.bodies.length + k);
      return { rotation: new Vector3().fromArray(values, at), displacement: new Vector3().fromArray(values, at + 3) };
    };
    this.shapes = this.bodies.map((body, k) => ({ body, real: part("body_real", k), imaginary: part("body_imaginary", k) }));
    const largest = Math.max(...this.shapes.flatMap(({ body, real, imaginary }) => [real, imaginary].map((s) => s.displacement.length() + s.rotation.length() * this.machine.reach(body))));
    this.enlargement = largest > 0 ? (shareOfSize * this.machine.size) / largest : 0;
    this.phase = 0;
    this.draw();
  }

  private toggle(): void {
    this.playing = !this.playing;
    this.play.setAttribute("aria-pressed", String(this.playing));
    this.last = null;
    if (this.playing) requestAnimationFrame((now) => this.advance(now));
    else this.machine.displace(null);
  }

  private advance(now: number): void {
    if (!this.playing || !this.element.isConnected) return;
    this.phase += this.last === null ? 0 : (2 * Math.PI * (now - this.last)) / (1000 * period);
    this.last = now;
    this.draw();
    requestAnimationFrame((next) => this.advance(next));
  }

  private draw(): void {
    if (!this.playing) return;
    const [c, s] = [this.enlargement * Math.cos(this.phase), -this.enlargement * Math.sin(this.phase)];
    const mix = (a: Vector3, b: Vector3) => a.clone().multiplyScalar(c).addScaledVector(b, s);
    this.machine.displace(
      new Map(this.shapes.map(({ body, real, imaginary }) => [body, { rotation: mix(real.rotation, imaginary.rotation), displacement: mix(real.displacement, imaginary.displacement) }])),
    );
  }
}
