// A canvas that keeps the screen's resolution, follows its container's width, and redraws with the theme.

import { h, placeTooltip } from "./dom";
import { onThemeChange } from "./theme";

const drawings = new Set<Drawing>();
onThemeChange(() => drawings.forEach((drawing) => drawing.draw()));

/** Forgets all drawings whose elements have left the page. */
export function sweepDrawings(): void {
  for (const drawing of drawings) if (drawing.wasShown && !drawing.element.isConnected) drawing.destroy();
}

export abstract class Drawing {
  readonly element = h("div", { class: "plot-area" });
  protected readonly tooltip = h("div", { class: "tooltip", hidden: true });
  protected readonly canvas = h("canvas", { role: "img" });
  protected width = 0;
  protected height = 0;
  private readonly observer: ResizeObserver;

  constructor(label: string) {
    this.canvas.setAttribute("aria-label", label);
    this.element.append(this.canvas, this.tooltip);
    this.canvas.addEventListener("pointermove", (event) => this.hover(event.offsetX, event.offsetY));
    this.canvas.addEventListener("pointerleave", () => (this.tooltip.hidden = true));
    this.observer = new ResizeObserver(() => this.draw());
    this.observer.observe(this.element);
    drawings.add(this);
  }

  /** False for a drawing that has not been on the page yet. */
  get wasShown(): boolean {
    return this.height > 0;
  }

  draw(): void {
    this.width = this.element.clientWidth;
    if (this.width < 40) return;
    this.height = this.heightFor(this.width);
    const ratio = devicePixelRatio || 1;
    const [w, hgt] = [Math.round(this.width * ratio), Math.round(this.height * ratio)];
    if (this.canvas.width !== w || this.canvas.height !== hgt) {
      this.canvas.width = w;
      this.canvas.height = hgt;
      this.canvas.style.width = `${this.width}px`;
      this.canvas.style.height = `${this.height}px`;
    }
    const context = this.canvas.getContext("2d")!;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    context.font = "12px system-ui, sans-serif";
    this.paint(context, ratio);
  }

  destroy(): void {
    this.observer.disconnect();
    drawings.delete(this);
  }

  protected abstract heightFor(width: number): number;
  protected abstract paint(context: CanvasRenderingContext2D, ratio: number): void;
  /** What the tooltip says at a point of the canvas, if anything. */
  protected abstract describe(x: number, y: number): string[] | null;

  private hover(x: number, y: number): void {
    const lines = this.describe(x, y);
    this.tooltip.hidden = lines === null;
    if (lines === null) return;
    this.tooltip.replaceChildren(...lines.map((line) => h("div", { class: "tooltip-line" }, line)));
    placeTooltip(this.tooltip, this.element, x, y);
  }
}

/** Round values, about `count` of them, that cover low to high. */
export function ticks(low: number, high: number, count: number): number[] {
  const raw = (high - low) / Math.max(1, count);
  if (!(raw > 0) || !Number.isFinite(raw)) return [low];
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999)!;
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}
