// Figures of a run while it goes on that are called by names, such as pressures of nodes: their courses, and plots of them.

import type { RunEvent } from "./api";
import { h } from "../src/dom";
import { LinePlot } from "../src/line_plot";
import { texts } from "./texts";

/** A plot, with a curve for each name. */
export interface PlotKind {
  key: string;
  label: string;
  unit: string;
  fromZero: boolean;
  shown: (value: number) => number;
  /** Leaves out what is nothing all the time. */
  hidesZeros?: boolean;
}

/** A figure of an event: of which plot, called how. */
export type Figure = [plot: string, name: string, value: number | null | undefined];

/** Events of a run as columns, by plot and name. */
export class NamedCourse {
  readonly time: number[] = [];
  readonly columns = new Map<string, Map<string, number[]>>();

  /** @param figures  of an event; empty where it has none of these */
  constructor(
    readonly kinds: PlotKind[],
    private readonly figures: (event: RunEvent) => Figure[],
  ) {
    for (const { key } of kinds) this.columns.set(key, new Map());
  }

  take(event: RunEvent): void {
    const { t } = event;
    const figures = this.figures(event);
    if (t === undefined || figures.length === 0 || (this.time.length > 0 && t <= this.time[this.time.length - 1]!)) return;
    for (const [plot, name, value] of figures) {
      if (value === undefined) continue;
      const columns = this.columns.get(plot)!;
      // What was not told before is not known there.
      const column = columns.get(name) ?? this.time.map(() => NaN);
      column.push(this.kinds.find(({ key }) => key === plot)!.shown(value ?? NaN));
      columns.set(name, column);
    }
    this.time.push(t);
    for (const columns of this.columns.values()) for (const column of columns.values()) while (column.length < this.time.length) column.push(NaN);
    if (this.time.length > 4000) this.thin();
  }

  /** Names of a plot that are drawn. */
  names({ key, hidesZeros }: PlotKind): string[] {
    const isDrawn = (column: number[]) => !hidesZeros || column.some((value) => value !== 0 && !Number.isNaN(value));
    return [...this.columns.get(key)!].filter(([, column]) => isDrawn(column)).map(([name]) => name);
  }

  /** Every second instant of the first half goes. */
  private thin(): void {
    const half = this.time.length >> 1;
    const keep = (values: number[]) => values.splice(0, half, ...values.slice(0, half).filter((_, i) => i % 2 === 0));
    keep(this.time);
    for (const columns of this.columns.values()) for (const column of columns.values()) keep(column);
  }
}

/** The plots of one course. */
export class NamedPlots {
  readonly elements: HTMLElement[];
  private readonly x: number[] = [];
  private readonly plots: { key: string; plot: LinePlot; names: string[] }[];

  /** @param prefix  of the plots' names */
  constructor(
    readonly course: NamedCourse,
    prefix: string,
    height: number,
  ) {
    const wanted = course.kinds.map((kind) => ({ kind, names: course.names(kind) })).filter(({ names }) => names.length > 0);
    this.plots = wanted.map(({ kind: { key, label, unit, fromZero }, names }) => {
      const curves = names.map((name) => ({ label: name, unit, y: [] }));
      const plot = new LinePlot({ name: `${prefix}_${key}`, x: { label: texts.time, unit: "ms", values: this.x }, left: { label, unit, fromZero }, curves, height });
      return { key, plot, names };
    });
    this.elements = this.plots.map(({ key, plot }) => h("div", { class: "live-plot live-named", "data-plot": `${prefix}_${key}` }, plot.element));
    this.redraw();
  }

  /** Whether there are curves by now that are not drawn. */
  get isOutdated(): boolean {
    const drawn = this.plots.reduce((sum, { names }) => sum + names.length, 0);
    return drawn !== this.course.kinds.reduce((sum, kind) => sum + this.course.names(kind).length, 0);
  }

  redraw(): void {
    this.x.splice(0, this.x.length, ...this.course.time.map((t) => 1e3 * t));
    for (const { key, plot, names } of this.plots) plot.update(names.map((name) => this.course.columns.get(key)!.get(name)!));
  }

  destroy(): void {
    this.plots.forEach(({ plot }) => plot.destroy());
  }
}
