// A field on the unwrapped surface of a film: along the motion to the right, across it upwards, one colour scale for the whole run.

import { Drawing } from "./canvas";
import { colourTable } from "./colormap";
import { line, paintColourBar, verticalText, type Box } from "./colour_bar";
import type { FeatureText } from "./data";
import type { FieldKind, FilmFields } from "./film_fields";
import { extent } from "./film_fields";
import { textOf } from "./surface";
import { palette } from "./theme";
import { axisLabel, withUnit } from "./units";

/** A place on the film worth marking. */
export interface Mark {
  along: number;
  across: number;
  symbol: "cross" | "ring";
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
    private readonly outlines: FeatureText[] = [],
  ) {
    super(`Field on ${fields.surface.map}`);
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
    const { along, across } = this.fields;
    const { label, display } = this.kind;
    const field = this.fields.at(this.kind.key, this.instant) ?? [];
    const n = across.nodes.length;
    const [u, v] = [along.coordinate.display.factor, across.coordinate.display.factor];
    const rows = Array.from(along.nodes, (x, i) => Array.from(across.nodes, (y, j) => [u * x, v * y, field[i * n + j]! * display.factor]));
    return [[along.heading(), across.heading(), axisLabel(label, display.unit)], ...rows.flat()];
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
    const { along, across } = this.fields;
    const { label, display } = this.kind;
    const value = this.sample(field, along.index(u), across.index(v)) * display.factor;
    return [
      Number.isNaN(value) ? "between arcs" : `${label} ${withUnit(value, display.unit)}`,
      `${textOf(along.coordinate, along.valueAt(u))}, ${textOf(across.coordinate, across.valueAt(v))}`,
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

  /** Where a place is drawn. */
  private mapped(box: Box, along: number, across: number): [number, number] {
    const { low, high } = this.fields.along;
    return [box.left + ((along - low) / (high - low || 1)) * box.width, box.top + (1 - this.fields.across.share(across)) * box.height];
  }

  /** Bilinear between the nodes, NaN between arcs; x and y are fractional indices along and across the motion. */
  private sample(field: ArrayLike<number>, x: number, y: number): number {
    const { along, across } = this.fields;
    const nz = across.nodes.length;
    const i = Math.min(along.cells - 1, Math.floor(x));
    if (!along.isFilm(i)) return NaN;
    const j = Math.min(nz - 2, Math.floor(y));
    const [s, t] = [x - i, y - j];
    const low = along.node(i) * nz + j;
    const high = along.node(i + 1) * nz + j;
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
    const places = Array.from({ length: width }, (_, column) => this.fields.along.index((column + 0.5) / width));
    for (let row = 0; row < height; row++) {
      const across = this.fields.across.index(1 - (row + 0.5) / height);
      for (let column = 0; column < width; column++) {
        const value = (this.sample(field, places[column]!, across) - low) * factor;
        if (!Number.isNaN(value)) words[row * width + column] = colourTable[value <= 0 ? 0 : value >= 255 ? 255 : Math.round(value)]!;
      }
    }
    context.putImageData(pixels, 0, 0);
  }

  /** The edge of the full film, where the fill fraction leaves one. */
  private paintRupture(context: CanvasRenderingContext2D): void {
    const fill = this.fields.at("fill", this.instant);
    if (!fill) return;
    const { along, across } = this.fields;
    const nz = across.nodes.length;
    const box = this.box();
    const level = 0.995;
    context.save();
    context.strokeStyle = "rgb(255 255 255 / 0.7)";
    context.lineWidth = 1.2;
    context.beginPath();
    for (let i = 0; i < along.cells; i++)
      for (let j = 0; along.isFilm(i) && j < nz - 1; j++) {
        const corners: [number, number][] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
        const crossings: [number, number][] = [];
        corners.forEach(([ia, ja], k) => {
          const [ib, jb] = corners[(k + 1) % 4]!;
          const a = fill[along.node(ia) * nz + ja]! - level;
          const b = fill[along.node(ib) * nz + jb]! - level;
          if (a < 0 === b < 0) return;
          const t = a / (a - b);
          crossings.push([ia + t * (ib - ia), ja + t * (jb - ja)]);
        });
        for (let k = 0; k + 1 < crossings.length; k += 2)
          [crossings[k]!, crossings[k + 1]!].forEach(([x, y], end) => {
            const px = box.left + along.shareOf(x) * box.width;
            const py = box.top + (1 - across.shareOf(y)) * box.height;
            if (end === 0) context.moveTo(px, py);
            else context.lineTo(px, py);
          });
      }
    context.stroke();
    context.restore();
  }

  private paintOutlines(context: CanvasRenderingContext2D): void {
    const box = this.box();
    const { along, across } = this.fields;
    context.save();
    context.beginPath();
    context.rect(box.left, box.top, box.width, box.height);
    context.clip();
    for (const o of this.outlines) {
      for (const middle of along.repeated(o.phi)) {
        const [x, y] = this.mapped(box, middle, o.z);
        const [w, hgt] = [(o.arc / (along.high - along.low)) * box.width, (o.length / (across.high - across.low)) * box.height];
        for (const [colour, width] of [["rgb(0 0 0 / 0.6)", 3.5], ["#ffffff", 1.6]] as const) {
          context.strokeStyle = colour;
          context.lineWidth = width;
          context.setLineDash(o.arc === 0 ? [6, 4] : []);
          context.beginPath();
          if (o.round) context.ellipse(x, y, w / 2, hgt / 2, 0, 0, 2 * Math.PI);
          else context.rect(x - w / 2, y - hgt / 2, w, hgt);
          context.stroke();
        }
      }
    }
    context.restore();
  }

  private paintMarks(context: CanvasRenderingContext2D): void {
    const box = this.box();
    const { along, across } = this.fields;
    for (const mark of this.marks) {
      if (!Number.isFinite(mark.along) || !Number.isFinite(mark.across)) continue;
      const x = box.left + along.share(mark.along) * box.width;
      const y = box.top + (1 - across.share(mark.across)) * box.height;
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
    const { along, across } = this.fields;
    for (const { share, text } of along.ticks(box.width, Math.max(3, box.width / 90))) {
      const x = box.left + share * box.width;
      line(context, x, box.top + box.height, x, box.top + box.height + 4);
      context.fillText(text, x, box.top + box.height + 6);
    }
    context.fillText(along.label(), box.left + box.width / 2, box.top + box.height + 23);
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const { share, text } of across.ticks(box.height, 4)) {
      const y = box.top + (1 - share) * box.height;
      line(context, box.left - 4, y, box.left, y);
      context.fillText(text, box.left - 7, y);
    }
    verticalText(context, across.label(), 12, box.top + box.height / 2);
  }
}
