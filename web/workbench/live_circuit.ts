// The oil circuit of a run while it goes on: pressures and temperatures of its nodes, flows through its elements.

import type { RunEvent } from "./api";
import { h } from "../src/dom";
import { LinePlot } from "../src/line_plot";
import { texts } from "./texts";

type Kind = "pressure" | "flow" | "temperature";

const kinds: { key: Kind; unit: string; shown: (value: number) => number }[] = [
  { key: "pressure", unit: "bar", shown: (x) => 1e-5 * x },
  { key: "flow", unit: "l/min", shown: (x) => 6e4 * x },
  { key: "temperature", unit: "°C", shown: (x) => x - 273.15 },
];

/** Events of a run as columns, by what they are of. */
export class CircuitCourse {
  readonly time: number[] = [];
  readonly columns: Record<Kind, Map<string, number[]>> = { pressure: new Map(), flow: new Map(), temperature: new Map() };

  take({ t, circuit }: RunEvent): void {
    if (t === undefined || !circuit || (this.time.length > 0 && t <= this.time[this.time.length - 1]!)) return;
    this.time.push(t);
    const add = (kind: Kind, name: string, value: number | null | undefined) => {
      if (value === undefined) return;
      const column = this.columns[kind].get(name) ?? [];
      column.push(kinds.find(({ key }) => key === kind)!.shown(value ?? NaN));
      this.columns[kind].set(name, column);
    };
    for (const [name, { pressure, temperature }] of Object.entries(circuit.nodes)) {
      add("pressure", name, pressure);
      add("temperature", name, temperature);
    }
    for (const [name, flow] of Object.entries(circuit.flows)) add("flow", name, flow);
    if (this.time.length > 4000) this.thin();
  }

  /** Every second instant of the first half goes. */
  private thin(): void {
    const half = this.time.length >> 1;
    const keep = (values: number[]) => values.splice(0, half, ...values.slice(0, half).filter((_, i) => i % 2 === 0));
    keep(this.time);
    for (const columns of Object.values(this.columns)) for (const column of columns.values()) keep(column);
  }
}

/** The plots of one course. */
export class CircuitPlots {
  readonly elements: HTMLElement[];
  private readonly x: number[] = [];
  private readonly plots: { plot: LinePlot; columns: Map<string, number[]> }[];

  constructor(
    private readonly course: CircuitCourse,
    height: number,
  ) {
    const wanted = kinds.filter(({ key }) => course.columns[key].size > 0);
    this.plots = wanted.map(({ key, unit }) => {
      const columns = course.columns[key];
      const curves = [...columns.keys()].map((label) => ({ label, unit, y: [] }));
      const plot = new LinePlot({ name: `circuit_${key}`, x: { label: texts.time, unit: "ms", values: this.x }, left: { label: texts.circuit[key], unit, fromZero: key !== "temperature" }, curves, height });
      return { plot, columns };
    });
    this.elements = wanted.map(({ key }, i) => h("div", { class: "live-plot live-circuit", "data-plot": `circuit_${key}` }, this.plots[i]!.plot.element));
    this.redraw();
  }

  redraw(): void {
    this.x.splice(0, this.x.length, ...this.course.time.map((t) => 1e3 * t));
    for (const { plot, columns } of this.plots) plot.update([...columns.values()]);
  }

  destroy(): void {
    this.plots.forEach(({ plot }) => plot.destroy());
  }
}
