// A quantity along the motion of one film over the whole run: time or crank angle to the right, the place upwards.

import { Drawing, ticks } from "./canvas";
import { colourTable } from "./colormap";
import { line, paintColourBar, verticalText, type Box } from "./colour_bar";
import type { Numbers, Run } from "./data";
import { extent, type FieldKind } from "./film_fields";
import type { Axis } from "./series";
import { FilmAxis, surfaceOf, textOf } from "./surface";
import { palette } from "./theme";
import { axisLabel, format, megapascal, micrometre, withUnit } from "./units";

/** Extremes over the width that the results keep for every row. */
const kinds: FieldKind[] = [
  { key: "h_min_around", label: "Smallest film thickness", display: micrometre },
  { key: "p_max_around", label: "Peak film pressure", display: megapascal },
];

const margin = { left: 52, right: 92, top: 10, bottom: 40 };

export class AngleTimeMap extends Drawing {
  readonly kinds: FieldKind[];
  private kind: FieldKind;
  private at: number | null = null;
  private readonly image = document.createElement("canvas");

  private constructor(
    private readonly fields: Map<string, Numbers>,
    private readonly along: FilmAxis,
    private readonly x: Float64Array,
    private readonly axis: { label: string; unit: string },
    pick: (row: number) => void,
  ) {
    super("Field around the bearing over time");
    this.element.classList.add("field-map");
    this.kinds = kinds.filter(({ key }) => fields.has(key));
    this.kind = this.kinds[0]!;
    this.canvas.addEventListener("click", (event) => {
      const share = (event.offsetX - margin.left) / this.box().width;
      if (share >= 0 && share <= 1) pick(Math.round(this.rowAt(this.valueAt(share))));
    });
  }

  /** The maps of one bearing, or null where the file has none or but one instant; `pick` is given a row of the maps. */
  static of(run: Run, bearing: string, axis: Axis, pick: (rowOfSeries: number) => void): AngleTimeMap | null {
    const { along } = surfaceOf(run, bearing);
    const nodes = run.dataset(`/bearings/${bearing}/fields/${along.key}`)?.values;
    const fields = new Map<string, Numbers>();
    let rows = 0;
    for (const { key } of kinds) {
      const dataset = run.dataset(`/bearings/${bearing}/${key}`);
      if (!nodes || dataset?.width !== nodes.length) continue;
      fields.set(key, dataset.values);
      rows = dataset.shape[0]!;
    }
    const all = axis.x.values;
    // Rows are thinned more than those of the series, both counted from the last one.
    const row = (k: number) => all.length - 1 - (rows - 1 - k) * run.aroundStride;
    if (!nodes || rows < 2 || row(0) < 0) return null;
    const x = Float64Array.from({ length: rows }, (_, k) => all[row(k)]!);
    return new AngleTimeMap(fields, new FilmAxis(along, nodes, run.dataset(`/bearings/${bearing}/fields/arc`)?.values), x, axis.x, (k) => pick(row(k)));
  }

  choose(kind: FieldKind): void {
    this.kind = kind;
    this.draw();
  }

  /** Marks a place on the abscissa. */
  mark(x: number | null): void {
    this.at = x;
    this.draw();
  }

  /** The map shown as a table: a row for each instant, a column for each place. */
  numbers(): (string | number)[][] {
    const { x, kind, axis } = this;
    const { nodes, coordinate } = this.along;
    const values = this.fields.get(kind.key)!;
    const { factor, unit } = coordinate.display;
    const head = [axisLabel(axis.label, axis.unit), ...Array.from(nodes, (place) => `${kind.label} [${kind.display.unit}] at ${withUnit(place * factor, unit)}`)];
    return [head, ...Array.from(x, (at, k) => [at, ...Array.from(nodes, (_, i) => values[k * nodes.length + i]! * kind.display.factor)])];
  }

  protected heightFor(width: number): number {
    return Math.round(Math.min(360, Math.max(210, 0.5 * width)));
  }

  protected paint(context: CanvasRenderingContext2D, ratio: number): void {
    const box = this.box();
    const range = this.range();
    this.paintImage(range, Math.round(box.width * ratio), Math.round(box.height * ratio));
    context.drawImage(this.image, box.left, box.top, box.width, box.height);
    this.paintFrame(context, box);
    paintColourBar(context, box, this.width, range, this.kind.label, this.kind.display);
  }

  protected describe(px: number, py: number): string[] | null {
    const box = this.box();
    const [u, v] = [(px - box.left) / box.width, 1 - (py - box.top) / box.height];
    if (u < 0 || u > 1 || v < 0 || v > 1) return null;
    const { label, display } = this.kind;
    const value = this.sample(this.rowAt(this.valueAt(u)), this.along.index(v));
    return [
      Number.isNaN(value) ? "between arcs" : `${label} ${withUnit(value * display.factor, display.unit)}`,
      `${textOf(this.along.coordinate, this.along.valueAt(v))}, ${this.axis.label} ${withUnit(this.valueAt(u), this.axis.unit, 5)}`,
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
    const [low, high] = extent(this.fields.get(this.kind.key)!);
    const bottom = Math.min(0, low);
    return high > bottom ? [bottom, high] : [bottom, bottom + 1];
  }

  private valueAt(share: number): number {
    const [first, last] = [this.x[0]!, this.x[this.x.length - 1]!];
    return first + share * (last - first);
  }

  /** Fractional row at a value of the abscissa, which grows; rows may be unevenly spaced. */
  private rowAt(value: number): number {
    const x = this.x;
    const sign = x[x.length - 1]! >= x[0]! ? 1 : -1;
    let [low, high] = [0, x.length - 1];
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (sign * x[middle]! <= sign * value) low = middle;
      else high = middle;
    }
    const span = x[high]! - x[low]!;
    return span === 0 ? high : low + Math.min(1, Math.max(0, (value - x[low]!) / span));
  }

  private sample(row: number, place: number): number {
    const values = this.fields.get(this.kind.key)!;
    const { along } = this;
    const n = along.nodes.length;
    const r = Math.min(this.x.length - 2, Math.floor(row));
    const i = Math.min(along.cells - 1, Math.floor(place));
    if (!along.isFilm(i)) return NaN;
    const [s, t] = [row - r, place - i];
    const at = (k: number) => values[k * n + along.node(i)]! * (1 - t) + values[k * n + along.node(i + 1)]! * t;
    return at(r) * (1 - s) + at(r + 1) * s;
  }

  private paintImage([low, high]: [number, number], width: number, height: number): void {
    this.image.width = width;
    this.image.height = height;
    const context = this.image.getContext("2d")!;
    const pixels = context.createImageData(width, height);
    const words = new Uint32Array(pixels.data.buffer);
    const factor = 255 / (high - low);
    const rows = Array.from({ length: width }, (_, column) => this.rowAt(this.valueAt((column + 0.5) / width)));
    for (let y = 0; y < height; y++) {
      const place = this.along.index(1 - (y + 0.5) / height);
      for (let column = 0; column < width; column++) {
        const value = (this.sample(rows[column]!, place) - low) * factor;
        if (!Number.isNaN(value)) words[y * width + column] = colourTable[value <= 0 ? 0 : value >= 255 ? 255 : Math.round(value)]!;
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
    const [first, last] = [this.x[0]!, this.x[this.x.length - 1]!];
    const place = (value: number) => box.left + ((value - first) / (last - first || 1)) * box.width;
    context.textAlign = "center";
    context.textBaseline = "top";
    for (const value of ticks(Math.min(first, last), Math.max(first, last), Math.max(3, box.width / 90))) {
      line(context, place(value), box.top + box.height, place(value), box.top + box.height + 4);
      context.fillText(format(value, 5), place(value), box.top + box.height + 6);
    }
    context.fillText(`${this.axis.label} [${this.axis.unit}]`, box.left + box.width / 2, box.top + box.height + 23);
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (const { share, text } of this.along.ticks(0, 4)) {
      const y = box.top + (1 - share) * box.height;
      line(context, box.left - 4, y, box.left, y);
      context.fillText(text, box.left - 7, y);
    }
    verticalText(context, this.along.label(), 12, box.top + box.height / 2);
    if (this.at === null) return;
    // Dark under white: visible on every colour of the map.
    for (const [colour, width] of [["rgb(0 0 0 / 0.6)", 3], ["#ffffff", 1.4]] as const) {
      context.strokeStyle = colour;
      context.lineWidth = width;
      line(context, place(this.at), box.top, place(this.at), box.top + box.height);
    }
  }
}
