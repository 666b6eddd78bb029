// The scale beside a map of colours.

import { ticks } from "./canvas";
import { colour } from "./colormap";
import { palette } from "./theme";
import { format, type Display } from "./units";

export interface Box {
  left: number;
  top: number;
  width: number;
  height: number;
}

/** Right of the map in `box`, up to `right`: values from low to high in the colours of the map. */
export function paintColourBar(
  context: CanvasRenderingContext2D,
  box: Box,
  right: number,
  [low, high]: [number, number],
  label: string,
  { factor, unit }: Display,
): void {
  const left = box.left + box.width + 16;
  const { ink, faint } = palette();
  const gradient = context.createLinearGradient(0, box.top + box.height, 0, box.top);
  for (let k = 0; k <= 16; k++) gradient.addColorStop(k / 16, `rgb(${colour(k / 16).join(" ")})`);
  context.fillStyle = gradient;
  context.fillRect(left, box.top, 12, box.height);
  context.strokeStyle = faint;
  context.strokeRect(left + 0.5, box.top + 0.5, 11, box.height - 1);
  context.fillStyle = ink;
  context.textAlign = "left";
  context.textBaseline = "middle";
  for (const value of ticks(low * factor, high * factor, 5)) {
    const y = box.top + (1 - (value / factor - low) / (high - low)) * box.height;
    line(context, left + 12, y, left + 16, y);
    context.fillText(format(value, 4), left + 19, y);
  }
  verticalText(context, `${label.toLowerCase()} [${unit}]`, right - 8, box.top + box.height / 2);
}

export function line(context: CanvasRenderingContext2D, x0: number, y0: number, x1: number, y1: number): void {
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

export function verticalText(context: CanvasRenderingContext2D, text: string, x: number, y: number): void {
  context.save();
  context.translate(x, y);
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(text, 0, 0);
  context.restore();
}
