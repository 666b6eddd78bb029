// A field on the unwrapped bearing: angle to the right, axial position upwards, one colour scale for the whole run.

import { Drawing, ticks } from "./canvas";
import { colourTable } from "./colormap";
import { line, paintColourBar, verticalText, type Box } from "./colour_bar";
import type { FieldKind, FilmFields } from "./film_fields";
import { extent } from "./film_fields";
import { palette } from "./theme";
import { axisLabel, format, withUnit } from "./units";

/** A place on the film worth marking. */
export interface Mark {
  phi: number;
  z: number;
  symbol: "cross" | "ring";
}

/** A hole or groove in the film, drawn as its outline; one without extent is a line. */
export interface Outline {
  name: string;
  round: boolean;
  phi: number;
  z: number;
  arc: number;
  length: number;
}

const margin = { left: 52, right: 92, top: 10, bottom: 40 };

export class FieldMap extends Drawing {
  private instant = 0;
  private marks: Mark[] = [];
  private readonly image = document.createElement("canvas");

  constructor(
    private readonly fields: FilmFields,
    private kind: FieldKind,
    private scale: "run" | "instant" = "run",
    private readonly outlines: Outline[] = [],
  ) {
    super("Field on the unwrapped bearing");
    this.element.classList.add("field-map");
  }

  show(instant: number, marks: Mark[]): void {
    this.instant = instant;
    this.marks = marks;
    this.draw();
  }

  choose(kind: FieldKind): void {
    this.kind = kind;
    this.draw();
  }

  rescale(scale: "run" | "instant"): void {
    this.scale = scale;
    this.draw();
  }

  /** The field shown as a table, a row for each node. */
  numbers(): (string | number)[][] {
    const { phi, z } = this.fields;
    const { label, display } = this.kind;
    const field = this.fields.at(this.kind.key, this.instant) ?? [];
    const rows = Array.from(phi, (angle, i) => Array.from(z, (height, j) => [(180 / Math.PI) * angle, 1e3 * height, field[i * z.length + j]! * display.factor]));
    return [["bearing angle [°]", "z [mm]", axisLabel(label, display.unit)], ...rows.flat()];
  }

  protected heightFor(width: number): number {
    return Math.round(Math.min(340, Math.max(190, 0.44 * width)));
  }

  protected paint(context: CanvasRenderingContext2D, ratio: number): void {
    const field = this.fields.at(this.kind.key, this.instant);
    if (!field) return;
    const range = this.range();
    const box = this.box();
    this.paintImage(field, range, Math.round(box.width * ratio), Math.round(box.height * ratio));
    context.drawImage(this.image, box.left, box.top, box.width, box.height);
    this.paintRupture(context);
    this.paintOutlines(context);
    this.paintMarks(context);
    this.paintFrame(context);
    paintColourBar(context, box, this.width, range, this.kind.label, this.kind.display);
  }

  protected describe(x: number, y: number): string[] | null {
    const box = this.box();
    const [u, v] = [(x - box.left) / box.width, 1 - (y - box.top) / box.height];
    const field = this.fields.at(this.kind.key, this.instant);
    if (u < 0 || u > 1 || v < 0 || v > 1 || !field) return null;
    const z = this.fields.z;
    const height = z[0]! + v * (z[z.length - 1]! - z[0]!);
    const { label, display } = this.kind;
    return [
      `${label} ${withUnit(this.sample(field, this.fields.indexAround(u), this.fields.indexAlong(v)) * display.factor, display.unit)}`,
      `φ ${format(360 * u, 4)}°, z ${withUnit(1e3 * height, "mm", 3)}`,
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

  private range(): [number, number] {
    const [low, high] =
      this.scale === "run"
        ? this.fields.range(this.kind.key)
        : extent(this.fields.at(this.kind.key, this.instant) ?? []);
    if (this.kind.key === "fill") return [Math.min(low, 0.999), 1];
    const bottom = this.kind.key === "thickness" ? 0 : Math.min(0, low);
    return high > bottom ? [bottom, high] : [bottom, bottom + 1];
  }

  /** Bilinear between the nodes; x and y are fractional indices around and along the bearing. */
  private sample(field: ArrayLike<number>, x: number, y: number): number {
    const [n, nz] = [this.fields.phi.length, this.fields.z.length];
    const i = Math.floor(x);
    const j = Math.min(nz - 2, Math.floor(y));
    const [s, t] = [x - i, y - j];
    const low = (i % n) * nz + j;
    const high = ((i + 1) % n) * nz + j;
    const left = field[low]! * (1 - t) + field[low + 1]! * t;
    const right = field[high]! * (1 - t) + field[high + 1]! * t;
    return left * (1 - s) + right * s;
  }

  private paintImage(field: ArrayLike<number>, [low, high]: [number, number], width: number, height: number): void {
    this.image.width = width;
    this.image.height = height;
    const context = this.image.getContext("2d")!;
    const pixels = context.createImageData(width, height);
    const words = new Uint32Array(pixels.data.buffer);
    const factor = 255 / (high - low);
    const around = Array.from({ length: width }, (_, column) => this.fields.indexAround((column + 0.5) / width));
    for (let row = 0; row < height; row++) {
      const along = this.fields.indexAlong(1 - (row + 0.5) / height);
      for (let column = 0; column < width; column++) {
        const value = (this.sample(field, around[column]!, along) - low) * factor;
        words[row * width + column] = colourTable[value <= 0 ? 0 : value >= 255 ? 255 : Math.round(value)]!;
      }
    }
    context.putImageData(pixels, 0, 0);
  }

  /** The edge of the full film, where the fill fraction leaves one. */
  private paintRupture(context: CanvasRenderingContext2D): void {
    const fill = this.fields.at("fill", this.instant);
    if (!fill) return;
    const [n, nz] = [this.fields.phi.length, this.fields.z.length];
    const box = this.box();
    const level = 0.995;
    context.save();
    context.strokeStyle = "rgb(255 255 255 / 0.7)";
    context.lineWidth = 1.2;
    context.beginPath();
    for (let i = 0; i < n; i++)
      for (let j = 0; j < nz - 1; j++) {
        const corners: [number, number][] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
        const crossings: [number, number][] = [];
        corners.forEach(([ia, ja], k) => {
          const [ib, jb] = corners[(k + 1) % 4]!;
          const a = fill[(ia % n) * nz + ja]! - level;
          const b = fill[(ib % n) * nz + jb]! - level;
          if (a < 0 === b < 0) return;
          const t = a / (a - b);
          crossings.push([ia + t * (ib - ia), ja + t * (jb - ja)]);
        });
        for (let k = 0; k + 1 < crossings.length; k += 2)
          [crossings[k]!, crossings[k + 1]!].forEach(([x, y], end) => {
            const px = box.left + this.fields.shareAround(x) * box.width;
            const py = box.top + (1 - this.fields.shareAlong(y)) * box.height;
            if (end === 0) context.moveTo(px, py);
            else context.lineTo(px, py);
          });
      }
    context.stroke();
    context.restore();
  }

  private paintOutlines(context: CanvasRenderingContext2D): void {
    const box = this.box();
    const z = this.fields.z;
    const [low, high] = [z[0]!, z[z.length - 1]!];
    const x = (phi: number) => box.left + (phi / (2 * Math.PI)) * box.width;
    const y = (height: number) => box.top + (1 - (height - low) / (high - low)) * box.height;
    context.save();
    context.beginPath();
    context.rect(box.left, box.top, box.width, box.height);
    context.clip();
    for (const o of this.outlines) {
      const middle = o.phi - 2 * Math.PI * Math.floor(o.phi / (2 * Math.PI));
      // Once more a turn to the left and right: an outline may cross the seam of the map.
      for (const phi of [middle - 2 * Math.PI, middle, middle + 2 * Math.PI]) {
        const [w, hgt] = [(o.arc / (2 * Math.PI)) * box.width, (o.length / (high - low)) * box.height];
        for (const [colour, width] of [["rgb(0 0 0 / 0.6)", 3.5], ["#ffffff", 1.6]] as const) {
          context.strokeStyle = colour;
          context.lineWidth = width;
          context.setLineDash(o.arc === 0 ? [6, 4] : []);
          context.beginPath();
          if (o.round) context.ellipse(x(phi), y(o.z), w / 2, hgt / 2, 0, 0, 2 * Math.PI);
          else context.rect(x(phi) - w / 2, y(o.z) - hgt / 2, w, hgt);
          context.stroke();
        }
      }
    }
    context.restore();
  }

  private paintMarks(context: CanvasRenderingContext2D): void {
    const box = this.box();
    const z = this.fields.z;
    const [low, high] = [z[0]!, z[z.length - 1]!];
    for (const mark of this.marks) {
      const turn = mark.phi / (2 * Math.PI);
      const x = box.left + (turn - Math.floor(turn)) * box.width;
      const y = box.top + (1 - (mark.z - low) / (high - low)) * box.height;
      // Dark under white: visible on every colour of the map.
      for (const [colour, width] of [["rgb(0 0 0 / 0.7)", 4], ["#ffffff", 2]] as const) {
        context.strokeStyle = colour;
        context.lineWidth = width;
        context.beginPath();
        if (mark.symbol === "ring") context.arc(x, y, 5, 0, 2 * Math.PI);
        else for (const [dx, dy] of [[5, 0], [0, 5]] as const) {
          context.moveTo(x - dx, y - dy);
          context.lineTo(x + dx, y + dy);
        }
        context.stroke();
      }
    }
  }

  private paintFrame(context: CanvasRenderingContext2D): void {
    const box = this.box();
    const { ink, faint } = palette();
    context.strokeStyle = faint;
    context.fillStyle = ink;
    context.lineWidth = 1;
    context.strokeRect(box.left + 0.5, box.top + 0.5, box.width - 1, box.height - 1);
    context.textAlign = "center";
    context.textBaseline = "top";
    const step = box.width < 360 ? 90 : 45;
    for (let angle = 0; angle <= 360; angle += step) {
      const x = box.left + (angle / 360) * box.width;
      line(context, x, box.top + box.height, x, box.top + box.height + 4);
      context.fillText(String(angle), x, box.top + box.height + 6);
    }
    context.fillText("bearing angle φ [°]", box.left + box.width / 2, box.top + box.height + 23);
    const z = this.fields.z;
    const [bottom, top] = [1e3 * z[0]!, 1e3 * z[z.length - 1]!];
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const value of ticks(bottom, top, 4)) {
      const y = box.top + (1 - (value - bottom) / (top - bottom)) * box.height;
      line(context, box.left - 4, y, box.left, y);
      context.fillText(format(value, 3), box.left - 7, y);
    }
    verticalText(context, "z [mm]", 12, box.top + box.height / 2);
  }
}
