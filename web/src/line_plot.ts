// Line figures on uPlot: axes with units, a legend that switches curves, a tooltip, a marker at the shown instant.

import uPlot from "uplot";
import { h, placeTooltip, saveText } from "./dom";
import { lineSvg } from "./line_svg";
import { onThemeChange, palette } from "./theme";
import { axisLabel, format, superscript, withUnit } from "./units";

export interface Curve {
  label: string;
  y: ArrayLike<number | null>;
  unit: string;
  axis?: "right";
  colour?: string;
  /** Place in the palette; else that of the curve among the others. */
  hue?: number;
  dash?: number[];
  points?: boolean;
  stepped?: boolean;
  fill?: boolean;
  /** Dots without a line between them, for values that jump from row to row. */
  dots?: boolean;
}

export interface LineFigure {
  name: string;
  x: { label: string; unit: string; values: ArrayLike<number>; categories?: string[]; log?: boolean };
  left: { label: string; unit: string; log?: boolean; fromZero?: boolean; highest?: number };
  right?: { label: string; unit: string; fromZero?: boolean };
  curves: Curve[];
  /** Called with the index of the point that was clicked. */
  pick?: (index: number) => void;
  /** Called with the index of the point under this figure's cursor, and with null when the cursor leaves it. */
  hover?: (index: number | null) => void;
  height?: number;
}

/** Steps between the ticks of an angle: parts and multiples of a turn, in degrees. */
const angleSteps = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 45, 90, 180, 360, 720, 1440, 3600, 7200, 18000, 36000, 72000, 180000];

/** Powers of ten across a logarithmic axis, at most about six. */
function decades(_plot: uPlot, _axis: number, low: number, high: number): number[] {
  const first = Math.ceil(Math.log10(low) - 1e-9);
  const last = Math.floor(Math.log10(high) + 1e-9);
  const step = Math.max(1, Math.ceil((last - first) / 6));
  return Array.from({ length: Math.max(0, Math.floor((last - first) / step)) + 1 }, (_, i) => 10 ** (first + i * step));
}

function powers(_plot: uPlot, splits: number[]): string[] {
  return splits.map((v) => `10${superscript(Math.round(Math.log10(v)))}`);
}

const plots = new Set<LinePlot>();
onThemeChange(() => plots.forEach((plot) => plot.redraw()));

/** Forgets all plots whose elements have left the page. */
export function sweepPlots(): void {
  for (const plot of plots) if (plot.wasShown && !plot.element.isConnected) plot.destroy();
}

/** Drops what cannot be drawn: gaps for NaN, and for zero or less on a logarithmic axis. */
function drawable(values: ArrayLike<number | null>, log: boolean): (number | null)[] {
  return Array.from(values, (v) => (v === null || !Number.isFinite(v) || (log && v <= 0) ? null : v));
}

function padded(fromZero: boolean, highest = -Infinity): uPlot.Range.Function {
  return (_plot, low, high) => {
    if (low === null || high === null || !Number.isFinite(low) || !Number.isFinite(high)) return [0, 1];
    const bottom = fromZero ? Math.min(0, low) : low;
    const top = Math.max(highest, fromZero ? Math.max(0, high) : high);
    // A constant is drawn in the middle, not as noise filling the axis.
    const least = 1e-6 * Math.max(Math.abs(bottom), Math.abs(top)) || 1;
    const span = Math.max(top - bottom, least);
    const slack = top - bottom < least ? 0.5 * span : 0.06 * span;
    return [bottom === 0 && fromZero ? 0 : bottom - slack, top === 0 && fromZero ? 0 : top + slack];
  };
}

/** Puts a figure's cursor somewhere (px; below zero: nowhere), and that of the figures over the same abscissa. */
function placeCursor(plot: uPlot, left: number, top: number): void {
  // The third argument, which passes the place on to the others, is missing from uPlot's types.
  const place = plot.setCursor as (to: { left: number; top: number }, fireHook: boolean, publish: boolean) => void;
  place({ left, top }, true, true);
}

export class LinePlot {
  readonly element: HTMLElement;
  readonly tools: HTMLElement;
  private readonly canvasHolder = h("div", { class: "plot-area" });
  private readonly tooltip = h("div", { class: "tooltip", hidden: true });
  private readonly hiddenCurves = new Set<number>();
  private readonly observer: ResizeObserver;
  private plot: uPlot | null = null;
  private hovered: number | null = null;

  /** False for a plot that has not been on the page yet. */
  get wasShown(): boolean {
    return this.plot !== null;
  }
  private marker: number | null = null;

  constructor(private spec: LineFigure) {
    this.element = h("div", { class: "line-plot" }, this.legend(), this.canvasHolder);
    this.canvasHolder.append(this.tooltip);
    this.tools = h(
      "span",
      { class: "tools" },
      h("button", { type: "button", class: "quiet", "aria-label": "Save the drawing of this figure as SVG", click: () => this.saveDrawing() }, "SVG"),
      h("button", { type: "button", class: "quiet", "aria-label": "Save the numbers of this figure as CSV", click: () => this.save() }, "CSV"),
    );
    this.observer = new ResizeObserver(() => this.fit());
    this.observer.observe(this.canvasHolder);
    plots.add(this);
  }

  /** Moves the vertical line; null takes it away. */
  mark(x: number | null): void {
    this.marker = x;
    this.plot?.redraw(false, false);
  }

  /** Replaces the curves' numbers, keeping axes and legend. */
  update(y: ArrayLike<number | null>[]): void {
    y.forEach((values, i) => (this.spec.curves[i]!.y = values));
    this.plot?.setData(this.data());
  }

  redraw(): void {
    this.forgetPlot();
    this.element.replaceChild(this.legend(), this.element.firstChild!);
    this.fit();
  }

  destroy(): void {
    this.observer.disconnect();
    this.forgetPlot();
    plots.delete(this);
  }

  private forgetPlot(): void {
    const { plot } = this;
    this.plot = null;
    plot?.destroy();
  }

  private colour(index: number): string {
    const colours = palette().series;
    const { colour, hue } = this.spec.curves[index]!;
    return colour ?? colours[(hue ?? index) % colours.length]!;
  }

  private legend(): HTMLElement {
    const curves = this.spec.curves;
    const entries = curves.map((curve, i) => {
      const swatch = h("span", { class: curve.dash ? "swatch dashed" : "swatch", style: `--colour: ${this.colour(i)}` });
      return h(
        "button",
        {
          type: "button",
          class: "legend-entry",
          "aria-pressed": !this.hiddenCurves.has(i) ? "true" : "false",
          title: "Show or hide this curve",
          click: (event: Event) => this.toggle(i, event.currentTarget as HTMLElement),
        },
        swatch,
        curve.label,
      );
    });
    return h("div", { class: "legend" }, ...entries);
  }

  private toggle(index: number, button: HTMLElement): void {
    const show = this.hiddenCurves.has(index);
    if (show) this.hiddenCurves.delete(index);
    else this.hiddenCurves.add(index);
    button.setAttribute("aria-pressed", show ? "true" : "false");
    this.plot?.setSeries(index + 1, { show });
  }

  private data(): uPlot.AlignedData {
    const { x, curves, left } = this.spec;
    const log = (curve: Curve) => left.log === true && curve.axis !== "right";
    return [Array.from(x.values), ...curves.map((curve) => drawable(curve.y, log(curve)))];
  }

  private fit(): void {
    const width = Math.floor(this.canvasHolder.clientWidth);
    if (width < 40) return;
    const height = this.spec.height ?? 230;
    if (this.plot === null) this.plot = this.create(width, height);
    else if (this.plot.width !== width) this.plot.setSize({ width, height });
  }

  private create(width: number, height: number): uPlot {
    const plot = new uPlot(this.options(width, height), this.data(), this.canvasHolder);
    const canvas = plot.root.querySelector("canvas");
    canvas?.setAttribute("role", "img");
    canvas?.setAttribute("aria-label", `${this.spec.left.label} against ${this.spec.x.label}`);
    this.followPointer(plot);
    this.followKeys(plot);
    return plot;
  }

  private followPointer(plot: uPlot): void {
    plot.over.addEventListener("click", () => this.pickAt(plot));
    plot.over.addEventListener("mouseleave", () => this.hoverAt(null));
  }

  /** The cursor by keys: arrows step along the rows, Home and End go to the ends shown, Enter picks, Escape leaves. */
  private followKeys(plot: uPlot): void {
    const { over } = plot;
    const { left, x } = this.spec;
    const attributes = { tabindex: "0", role: "slider", "aria-label": `Cursor of ${left.label} against ${x.label}`, "aria-valuemin": "0", "aria-valuemax": String(x.values.length - 1), "aria-valuenow": "0" };
    for (const [name, value] of Object.entries(attributes)) over.setAttribute(name, value);
    over.addEventListener("keydown", (event) => {
      if (event.key === "Escape") return this.dropCursor(plot);
      if (event.key === "Enter") return this.pickAt(plot);
      const index = this.steppedTo(plot, event);
      if (index === null) return;
      event.preventDefault();
      placeCursor(plot, plot.valToPos(plot.data[0][index]!, "x"), over.clientHeight / 2);
    });
    over.addEventListener("blur", () => this.dropCursor(plot));
  }

  /** The row a key leads to, within what is shown; null for keys that do not move the cursor. */
  private steppedTo(plot: uPlot, event: KeyboardEvent): number | null {
    const [first, last] = plot.series[0]!.idxs ?? [0, plot.data[0].length - 1];
    const stride = event.shiftKey ? 10 : 1;
    const from = plot.cursor.idx ?? null;
    const goals: Record<string, number> = {
      ArrowRight: from === null ? first : from + stride,
      ArrowLeft: from === null ? last : from - stride,
      Home: first,
      End: last,
    };
    const goal = goals[event.key];
    return goal === undefined ? null : Math.min(last, Math.max(first, goal));
  }

  private dropCursor(plot: uPlot): void {
    // A figure that leaves the page loses the focus, too.
    if (this.plot !== plot) return;
    placeCursor(plot, -10, -10);
    this.hoverAt(null);
  }

  private pickAt(plot: uPlot): void {
    const index = plot.cursor.idx;
    if (index !== null && index !== undefined) this.spec.pick?.(index);
  }

  private hoverAt(index: number | null): void {
    if (index === this.hovered) return;
    this.hovered = index;
    this.spec.hover?.(index);
  }

  /** Whether the cursor is this figure's own, by pointer or keys, and not that of another figure over the same abscissa. */
  private owns(plot: uPlot): boolean {
    return plot.over.matches(":hover, :focus-visible");
  }

  private options(width: number, height: number): uPlot.Options {
    const { x, left, right, curves } = this.spec;
    const font = "12px system-ui, sans-serif";
    const { ink, faint, line } = palette();
    const axis = (label: string, unit: string, extra: Partial<uPlot.Axis>): uPlot.Axis => ({
      label: axisLabel(label, unit),
      labelFont: font,
      font,
      stroke: ink,
      labelSize: 22,
      labelGap: 2,
      grid: { stroke: line, width: 1 },
      ticks: { stroke: faint, width: 1, size: 4 },
      values: (_plot, splits) => splits.map((v) => (v === null ? "" : format(v, 5))),
      ...extra,
    });
    const axes: uPlot.Axis[] = [
      axis(x.label, x.unit, {
        size: 26,
        ...(x.log ? { splits: decades, values: (_p: uPlot, splits: number[]) => splits.map((v) => format(v, 3)), filter: (_p: uPlot, splits: number[]) => splits } : {}),
        ...(x.unit === "°" ? { incrs: angleSteps } : {}),
        ...(x.categories
          ? { splits: () => Array.from(x.values), values: (_p: uPlot, s: number[]) => s.map((v) => x.categories![v] ?? "") }
          : {}),
      }),
      axis(left.label, left.unit, { scale: "y", size: 52, ...(left.log ? { splits: decades, values: powers, filter: (_p: uPlot, splits: number[]) => splits } : {}) }),
    ];
    if (right) axes.push(axis(right.label, right.unit, { scale: "right", side: 1, size: 48, grid: { show: false } }));
    return {
      width,
      height,
      padding: [8, right ? 0 : 20, 0, 0],
      legend: { show: false },
      // Figures over one abscissa share their cursor; the tooltip stays with the pointer.
      cursor: { drag: { x: true, y: false }, points: { size: 7 }, y: false, sync: { key: axisLabel(x.label, x.unit), setSeries: false } },
      scales: {
        x: x.log ? { time: false, distr: 3 } : { time: false, range: (_p, low, high) => (low === high || x.categories ? [low - 0.5, high + 0.5] : [low, high]) },
        y: left.log ? { distr: 3 } : { range: padded(left.fromZero === true, left.highest) },
        right: { range: padded(right?.fromZero === true) },
      },
      axes,
      series: [{}, ...curves.map((curve, i) => this.series(curve, i))],
      hooks: { setCursor: [(plot) => this.showTooltip(plot)], draw: [(plot) => this.drawMarker(plot)] },
    };
  }

  private series(curve: Curve, index: number): uPlot.Series {
    const stroke = this.colour(index);
    return {
      label: curve.label,
      show: !this.hiddenCurves.has(index),
      scale: curve.axis ?? "y",
      stroke,
      width: 1.6,
      points: curve.points || curve.dots ? { show: true, size: curve.dots ? (curve.y.length < 300 ? 5 : 2.5) : 6, fill: stroke } : { show: false },
      ...(curve.dots ? { paths: () => null } : {}),
      ...(curve.dash ? { dash: curve.dash } : {}),
      ...(curve.fill ? { fill: `color-mix(in srgb, ${stroke} 14%, transparent)` } : {}),
      ...(curve.stepped ? { paths: uPlot.paths.stepped!({ align: 1 }) } : {}),
    };
  }

  private drawMarker(plot: uPlot): void {
    if (this.marker === null) return;
    const x = Math.round(plot.valToPos(this.marker, "x", true));
    const { left, top, width, height } = plot.bbox;
    if (x < left || x > left + width) return;
    const context = plot.ctx;
    context.save();
    context.setLineDash([]);
    context.strokeStyle = palette().accent;
    context.lineWidth = Math.max(1, devicePixelRatio);
    context.beginPath();
    context.moveTo(x, top);
    context.lineTo(x, top + height);
    context.stroke();
    context.restore();
  }

  private showTooltip(plot: uPlot): void {
    const index = plot.cursor.idx;
    const { left, top } = plot.cursor;
    if (index === null || index === undefined || left === undefined || left < 0 || !this.owns(plot)) {
      this.tooltip.hidden = true;
      return;
    }
    this.hoverAt(index);
    const { x, curves } = this.spec;
    const data = plot.data;
    const at = x.categories?.[index] ?? withUnit(x.values[index], x.unit, 6);
    const rows = curves.flatMap((curve, i) => {
      const value = data[i + 1]?.[index];
      if (value === null || value === undefined || this.hiddenCurves.has(i)) return [];
      return [
        h("span", { class: "swatch", style: `--colour: ${this.colour(i)}` }),
        h("span", {}, curve.label),
        h("span", { class: "value" }, withUnit(value, curve.unit)),
      ];
    });
    this.tooltip.replaceChildren(h("div", { class: "tooltip-head" }, `${x.label} ${at}`), ...rows);
    plot.over.setAttribute("aria-valuenow", String(index));
    plot.over.setAttribute("aria-valuetext", [`${x.label} ${at}`, ...rows.filter((_, i) => i % 3 > 0).map((part) => part.textContent)].join(" "));
    this.tooltip.hidden = rows.length === 0;
    placeTooltip(this.tooltip, this.canvasHolder, left + plot.over.offsetLeft, (top ?? 0) + plot.over.offsetTop);
  }

  private saveDrawing(): void {
    const { plot, spec } = this;
    if (!plot) return;
    const curves = spec.curves.flatMap((curve, i) =>
      this.hiddenCurves.has(i)
        ? []
        : [{ label: curve.label, colour: this.colour(i), scale: curve.axis ?? ("y" as const), dash: curve.dash ?? [], dots: curve.dots === true, points: curve.points === true, stepped: curve.stepped === true, values: plot.data[i + 1]! }],
    );
    saveText(`${spec.name}.svg`, lineSvg(plot, { x: spec.x, left: spec.left, right: spec.right ?? null }, curves, palette()), "image/svg+xml");
  }

  private save(): void {
    const { x, curves, name } = this.spec;
    const quote = (text: string) => `"${text.replace(/"/g, '""')}"`;
    const head = [axisLabel(x.label, x.unit), ...curves.map((c) => axisLabel(c.label, c.unit))].map(quote).join(",");
    const rows = Array.from(x.values, (value, i) =>
      [x.categories ? quote(x.categories[i] ?? "") : value, ...curves.map((c) => c.y[i] ?? "")].join(","),
    );
    saveText(`${name}.csv`, [head, ...rows].join("\n"));
  }
}
