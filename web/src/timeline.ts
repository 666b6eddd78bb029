// The bar at the bottom: one slider for all figures that show an instant, and a play button.

import { h } from "./dom";
import { format } from "./units";

export class Timeline {
  readonly element: HTMLElement;
  private readonly slider = h("input", { type: "range", class: "timeline-slider", step: 1, min: 0, "aria-label": "Instant shown" });
  private readonly button = h("button", { type: "button", class: "play" });
  private readonly text = h("output", { class: "timeline-text" });
  private timer = 0;

  constructor(
    private readonly time: ArrayLike<number>,
    private readonly angle: ArrayLike<number> | null,
    private readonly changed: (index: number) => void,
  ) {
    this.slider.max = String(Math.max(0, time.length - 1));
    this.slider.addEventListener("input", () => this.show(Number(this.slider.value)));
    this.button.addEventListener("click", () => this.toggle());
    this.element = h("div", { class: "timeline", role: "group", "aria-label": "Instant shown" }, this.button, this.slider, this.text);
    this.setPlaying(false);
  }

  get index(): number {
    return Number(this.slider.value);
  }

  show(index: number): void {
    this.slider.value = String(index);
    this.text.textContent = instantText(this.time[index]!, this.angle?.[index] ?? null);
    this.slider.setAttribute("aria-valuetext", this.text.textContent);
    this.changed(index);
  }

  get isPlaying(): boolean {
    return this.timer !== 0;
  }

  /** Tells an instant that a cursor is at; the slider stays where it was. */
  tell(time: number, angle: number | null): void {
    this.text.textContent = instantText(time, angle);
  }

  stop(): void {
    clearInterval(this.timer);
    this.timer = 0;
    this.setPlaying(false);
  }

  private toggle(): void {
    if (this.timer !== 0) return this.stop();
    const count = this.time.length;
    if (this.index >= count - 1) this.show(0);
    // The whole run in about eight seconds, at most thirty pictures a second.
    const period = Math.max(33, Math.min(400, 8000 / count));
    this.timer = window.setInterval(() => {
      if (!this.element.isConnected || this.index >= count - 1) this.stop();
      else this.show(this.index + 1);
    }, period);
    this.setPlaying(true);
  }

  private setPlaying(playing: boolean): void {
    this.button.textContent = playing ? "❚❚" : "▶";
    this.button.setAttribute("aria-label", playing ? "Pause" : "Play");
  }
}

function instantText(time: number, angle: number | null): string {
  return `t = ${format(1e3 * time, 5)} ms` + (angle === null ? "" : `   crank ${format((180 / Math.PI) * angle, 4)}°`);
}
