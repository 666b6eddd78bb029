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
  private mode = 0;
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
    this.mode = mode;
    const part = (dataset: "real" | "imaginary", k: number): Increment => {
      const values = this.run.dataset(`/modes/fields/body_${dataset}`)!.values;
      const at = 6 * (mode * this.bodies.length + k);
      const amplitudes = this.run.dataset(`/modes/fields/${this.bodies[k]}_amplitudes_${dataset}`);
      return {
        rotation: new Vector3().fromArray(values, at),
        displacement: new Vector3().fromArray(values, at + 3),
        ...(amplitudes ? { amplitudes: Float64Array.from(amplitudes.values.slice(mode * amplitudes.width, (mode + 1) * amplitudes.width)) } : {}),
      };
    };
    this.shapes = this.bodies.map((body, k) => ({ body, real: part("real", k), imaginary: part("imaginary", k) }));
    const largest = Math.max(...this.shapes.flatMap(({ body, real, imaginary }) => [real, imaginary].map((s) => this.farthest(body, s))));
    this.enlargement = largest > 0 ? (shareOfSize * this.machine.size) / largest : 0;
    this.phase = 0;
    this.draw();
  }

  private farthest(body: string, { displacement, rotation, amplitudes }: Increment): number {
    return displacement.length() + rotation.length() * this.machine.reach(body) + (amplitudes ? this.machine.deformationBy(body, amplitudes) : 0);
  }

  private toggle(): void {
    this.playing = !this.playing;
    this.choose(this.mode);
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
      new Map(
        this.shapes.map(({ body, real, imaginary }) => {
          const increment = { rotation: mix(real.rotation, imaginary.rotation), displacement: mix(real.displacement, imaginary.displacement) };
          const amplitudes = real.amplitudes?.map((a, k) => c * a + s * imaginary.amplitudes![k]!);
          return [body, amplitudes ? { ...increment, amplitudes } : increment];
        }),
      ),
    );
  }
}
