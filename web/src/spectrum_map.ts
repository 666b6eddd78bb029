// Spectra over the speed as a map of colours, in decibels below the largest amplitude: small orders and whirls show beside large ones.

import { Drawing, ticks } from "./canvas";
import { colourTable } from "./colormap";
import { line, paintColourBar, verticalText, type Box } from "./colour_bar";
import { palette } from "./theme";
import { format, withUnit } from "./units";
import { largestOf, orders, type Ridge, type WaterfallAxes } from "./waterfall";

const margin = { left: 62, right: 92, top: 10, bottom: 44 };
/** Amplitudes below this have the colour of none [dB]. */
const least = -60;
const decibel = { factor: 1, unit: "dB" };

export class SpectrumMap extends Drawing {
  private readonly rows: Ridge[];
  private readonly largest: number;
  private readonly image = document.createElement("canvas");

  /** @param ridges  spectra of the same frequencies, from zero in equal steps */
  constructor(
    ridges: Ridge[],
    private readonly names: WaterfallAxes,
  ) {
    super(`Map of ${ridges.length} spectra over ${names.y}`);
    this.rows = [...ridges].sort((a, b) => a.at - b.at);
    this.largest = largestOf(ridges).amplitude || 1;
  }

  protected heightFor(width: number): number {
    return Math.round(Math.min(440, Math.max(240, 0.6 * width)));
  }

  protected paint(context: CanvasRenderingContext2D, ratio: number): void {
    const box = this.box();
    this.paintImage(Math.round(box.width * ratio), Math.round(box.height * ratio));
    context.drawImage(this.image, box.left, box.top, box.width, box.height);
    this.paintFrame(context, box);
    if (this.names.turns) for (const order of orders) this.paintOrder(context, box, order, order * this.names.turns);
    paintColourBar(context, box, this.width, [least, 0], "below the largest", decibel);
  }

  protected describe(px: number, py: number): string[] | null {
    const box = this.box();
    const [u, v] = [(px - box.left) / box.width, 1 - (py - box.top) / box.height];
    if (u < 0 || u > 1 || v < 0 || v > 1) return null;
    const row = this.rows[this.rowAt(this.speedAt(v))]!;
    const i = this.lineAt(row, u);
    return [
      `${withUnit(row.amplitude[i]!, this.names.amplitude)}, ${format(this.decibels(row.amplitude[i]!), 3)} dB`,
      `${format(row.frequency[i]!)} Hz, ${withUnit(row.at, this.names.unit)}`,
    ];
  }

  private box(): Box {
    return {
      left: margin.left,
      top: margin.top,
      width: Math.max(10, this.width - margin.left - margin.right),
      height: this.height - margin.top - margin.bottom,
    };
  }

  private get highest(): number {
    const { frequency } = this.rows[0]!;
    return frequency[frequency.length - 1]! || 1;
  }

  private speedAt(share: number): number {
    const [low, high] = [this.rows[0]!.at, this.rows[this.rows.length - 1]!.at];
    return low + share * (high - low);
  }

  /** The spectrum whose speed is nearest. */
  private rowAt(speed: number): number {
    let best = 0;
    this.rows.forEach((row, i) => {
      if (Math.abs(row.at - speed) < Math.abs(this.rows[best]!.at - speed)) best = i;
    });
    return best;
  }

  private lineAt(row: Ridge, share: number): number {
    const last = row.frequency.length - 1;
    return Math.min(last, Math.round(share * last));
  }

  private decibels(amplitude: number): number {
    return amplitude > 0 ? Math.max(-200, 20 * Math.log10(amplitude / this.largest)) : -200;
  }

  private paintImage(width: number, height: number): void {
    this.image.width = width;
    this.image.height = height;
    const context = this.image.getContext("2d")!;
    const pixels = context.createImageData(width, height);
    const words = new Uint32Array(pixels.data.buffer);
    for (let y = 0; y < height; y++) {
      const row = this.rows[this.rowAt(this.speedAt(1 - (y + 0.5) / height))]!;
      for (let x = 0; x < width; x++) {
        const share = 1 - this.decibels(row.amplitude[this.lineAt(row, (x + 0.5) / width)]!) / least;
        words[y * width + x] = colourTable[Math.round(255 * Math.min(1, Math.max(0, share)))]!;
      }
    }
    context.putImageData(pixels, 0, 0);
  }

  private paintFrame(context: CanvasRenderingContext2D, box: Box): void {
    const { ink, faint } = palette();
    context.strokeStyle = faint;
    context.fillStyle = ink;
    context.lineWidth = 1;
    context.strokeRect(box.left + 0.5, box.top + 0.5, box.width - 1, box.height - 1);
    const bottom = box.top + box.height;
    context.textAlign = "center";
    context.textBaseline = "top";
    for (const value of ticks(0, this.highest, Math.max(3, box.width / 90))) {
      const x = box.left + (value / this.highest) * box.width;
      line(context, x, bottom, x, bottom + 4);
      context.fillText(format(value, 5), x, bottom + 6);
    }
    context.fillText(this.names.x, box.left + box.width / 2, bottom + 24);
    context.textAlign = "right";
    context.textBaseline = "middle";
    const [low, high] = [this.speedAt(0), this.speedAt(1)];
    for (const value of ticks(low, high, 5)) {
      const y = bottom - ((value - low) / (high - low || 1)) * box.height;
      line(context, box.left - 4, y, box.left, y);
      context.fillText(format(value, 5), box.left - 7, y);
    }
    verticalText(context, this.names.y, 12, box.top + box.height / 2);
  }

  private paintOrder(context: CanvasRenderingContext2D, box: Box, order: number, slope: number): void {
    const [low, high] = [this.speedAt(0), Math.min(this.speedAt(1), this.highest / slope)];
    if (high <= low) return;
    const span = this.speedAt(1) - low || 1;
    const at = (speed: number): [number, number] => [box.left + ((slope * speed) / this.highest) * box.width, box.top + (1 - (speed - low) / span) * box.height];
    const [[x0, y0], [x1, y1]] = [at(low), at(high)];
    context.save();
    context.setLineDash([5, 4]);
    // White on dark: visible on every colour of the map.
    for (const [colour, width] of [["rgb(0 0 0 / 0.5)", 2.4], ["rgb(255 255 255 / 0.85)", 1]] as const) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      line(context, x0, y0, x1, y1);
    }
    context.restore();
    context.textAlign = "right";
    context.textBaseline = "top";
    context.lineWidth = 3;
    context.strokeStyle = "rgb(0 0 0 / 0.6)";
    context.fillStyle = "#ffffff";
    context.strokeText(`${order}×`, x1 - 5, y1 + 4);
    context.fillText(`${order}×`, x1 - 5, y1 + 4);
  }
}
