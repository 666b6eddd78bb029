// The oil circuit of a run while it goes on: pressures and temperatures of its nodes, flows through its elements.

import type { RunEvent } from "./api";
import { NamedCourse, type Figure, type PlotKind } from "./live_columns";
import { texts } from "./texts";

const kinds: PlotKind[] = [
  { key: "pressure", label: texts.circuit.pressure, unit: "bar", fromZero: true, shown: (x) => 1e-5 * x },
  { key: "flow", label: texts.circuit.flow, unit: "l/min", fromZero: true, shown: (x) => 6e4 * x },
  { key: "temperature", label: texts.circuit.temperature, unit: "°C", fromZero: false, shown: (x) => x - 273.15 },
];

function figures({ circuit }: RunEvent): Figure[] {
  if (!circuit) return [];
  const nodes = Object.entries(circuit.nodes);
  return [
    ...nodes.map(([name, { pressure }]): Figure => ["pressure", name, pressure]),
    ...nodes.map(([name, { temperature }]): Figure => ["temperature", name, temperature]),
    ...Object.entries(circuit.flows).map(([name, flow]): Figure => ["flow", name, flow]),
  ];
}

export const circuitCourse = () => new NamedCourse(kinds, figures);
