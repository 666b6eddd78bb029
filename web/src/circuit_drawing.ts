// The oil circuit: nodes in layers behind the sump, elements as lines as wide as their flow, and who takes how much.

import type { Run } from "./data";
import { figure } from "./dom";
import { format } from "./units";

const box = { width: 118, height: 38, across: 212, down: 84, margin: 26 };
const bar = { height: 24, label: 150, width: 520 };
const litrePerMinute = 6e-5; // of mm³/s
const widestLine = 9;

/** Of a run, with means of the run or of its last cycle; or of a plan, before one. */
export interface CircuitNode {
  name: string;
  /** [bar]; null where nobody knows it yet. */
  pressure: number | null;
  /** By films [l/min]; of a plan 1 where there are some. */
  drawn: number;
  /** [degC]; undefined where the oil has one temperature. */
  temperature?: number | undefined;
  /** Of a plan: the films that it feeds. */
  feeds?: string;
}

export interface CircuitElement {
  name: string;
  type: string;
  from: string;
  to: string;
  /** [l/min]; null in a plan. */
  flow: number | null;
}

type Node = CircuitNode;
type Element = CircuitElement;

interface Place {
  x: number;
  y: number;
}

/** Drawings of a run's circuit; none where it has no circuit. */
export function circuitDrawings(run: Run): HTMLElement[] {
  const nodes = run.namesAfter("/circuit/pressure_").map((name) => ({
    name,
    pressure: 10 * mean(run, `mean pressure of ${name}`),
    drawn: litrePerMinute * mean(run, `mean flow from ${name} into films`),
    temperature: run.summary.find((row) => row.group === "circuit" && row.name === `mean temperature of ${name}`)?.value ?? undefined,
  }));
  const elements = run.namesAfter("/circuit/flow_").flatMap((name) => {
    const [type, from, to] = run.list("/circuit", `element_${name}`);
    return type && from && to ? [{ name, type, from, to, flow: litrePerMinute * mean(run, `mean flow through ${name}`) }] : [];
  });
  if (nodes.length === 0 || elements.length === 0) return [];
  return [
    figure("circuit", "The oil circuit with its means: nodes the darker the higher their pressure, lines as wide as the root of their flow, arrows into films.", null, network(nodes, elements)),
    figure("circuit-takers", "Who takes how much: mean flows into films, and of elements that lead oil back.", null, takers(nodes, elements)),
  ];
}

function mean(run: Run, name: string): number {
  return run.summary.find((row) => row.group === "circuit" && row.name === name)?.value ?? 0;
}

/** A node comes a layer behind the first from which oil flows to it; what flows back draws no node along. */
function layersOf(nodes: Node[], elements: Element[]): string[][] {
  const down = elements.map(({ from, to, flow }) => ((flow ?? 0) >= 0 ? [from, to] : [to, from]) as [string, string]);
  const height = ({ pressure }: Node) => pressure ?? Infinity;
  const lowest = nodes.reduce((a, b) => (height(b) < height(a) ? b : a)).name;
  const depth = new Map([[lowest, 0]]);
  const waiting = [lowest];
  for (let name = waiting.shift(); name !== undefined; name = waiting.shift())
    for (const [from, to] of down)
      if (from === name && !depth.has(to)) {
        depth.set(to, depth.get(name)! + 1);
        waiting.push(to);
      }
  const layers: string[][] = [];
  for (const { name } of nodes) (layers[depth.get(name) ?? 0] ??= []).push(name);
  return layers;
}

/** The circuit as a drawing: flows and pressures of a run, or what a plan has of them. */
export function network(nodes: Node[], elements: Element[]): SVGElement {
  const layers = layersOf(nodes, elements);
  const widest = Math.max(...layers.map((layer) => layer.length));
  const places = new Map<string, Place>();
  layers.forEach((layer, depth) => {
    // Below one another in the order of the nodes that feed them.
    const height = (name: string) => {
      const feeds = elements.filter((element) => element.to === name).flatMap((element) => places.get(element.from)?.y ?? []);
      return feeds.length > 0 ? feeds.reduce((a, b) => a + b, 0) / feeds.length : 0;
    };
    const sorted = layer.map((name, i) => ({ name, i, y: height(name) })).sort((a, b) => a.y - b.y || a.i - b.i);
    sorted.forEach(({ name }, i) =>
      places.set(name, { x: box.margin + box.across * depth + box.width / 2, y: box.down * (i + 0.5 + 0.5 * (widest - layer.length)) }),
    );
  });
  const back = elements.some((element) => (places.get(element.from)?.x ?? 0) >= (places.get(element.to)?.x ?? 0)) ? 70 : 0;
  const [width, height] = [box.across * layers.length + 40, box.down * widest + back];
  const svg = draw("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", class: "graph-drawing", "aria-label": "The oil circuit" });
  svg.style.maxWidth = `${width}px`;
  const largest = Math.max(...elements.map(({ flow }) => Math.abs(flow ?? 0)), ...nodes.map(({ drawn }) => Math.abs(drawn)), 1e-12);
  const isPlan = elements.every(({ flow }) => flow === null);
  const line = (flow: number | null) => (isPlan ? 2 : Math.max(1, widestLine * Math.sqrt(Math.abs(flow ?? 0) / largest)));
  const highest = Math.max(...nodes.map(({ pressure }) => pressure ?? 0), 1e-12);
  const drawn = new Map<string, number>();
  svg.append(
    ...elements.flatMap((element) => link(element, places, line(element.flow), height, drawn)),
    ...nodes.filter(({ drawn: flow }) => flow !== 0).flatMap((node) => {
      const place = places.get(node.name)!;
      const isFreeAbove = !elements.some(({ from, to }) => from === node.name && places.get(to)!.y < place.y);
      return intoFilms(node, place, line(node.drawn), isFreeAbove);
    }),
    ...nodes.map((node) => nodeBox(node, places.get(node.name)!, Math.max(0, (node.pressure ?? 0) / highest))),
  );
  return svg;
}

function link(element: Element, places: Map<string, Place>, width: number, height: number, drawn: Map<string, number>): SVGElement[] {
  const [a, b] = [places.get(element.from)!, places.get(element.to)!];
  const pair = [element.from, element.to].sort().join("|");
  const nth = drawn.get(pair) ?? 0;
  drawn.set(pair, nth + 1);
  const forwards = a.x < b.x;
  // What leads back goes round below; elements beside one another are bent apart.
  const [start, end] = forwards ? [a.x + box.width / 2, b.x - box.width / 2] : [a.x, b.x];
  const low = height - 34;
  const middle = { x: (start + end) / 2, y: forwards ? (a.y + b.y) / 2 + 40 * nth : low };
  const d = forwards
    ? `M${start} ${a.y} Q${middle.x} ${middle.y} ${end} ${b.y}`
    : `M${a.x} ${a.y + box.height / 2} C${a.x} ${low} ${a.x} ${low} ${middle.x} ${low} S${b.x} ${low} ${b.x} ${b.y + box.height / 2}`;
  // Nearer to its later end, where lines from one node have come apart.
  const label = forwards ? { x: 0.4 * start + 0.6 * end, y: 0.4 * a.y + 0.6 * b.y + 20 * nth } : { x: a.x + 40 * nth, y: (a.y + box.height / 2 + low) / 2 };
  return [
    drawLine(d, width, { class: `graph-link circuit ${element.type}`, "data-element": element.name }),
    text(`${plain(element.name)}${(element.flow ?? 0) < 0 ? " ◂" : ""}`, label.x, label.y - 5, "graph-label"),
    text(element.flow === null ? plain(element.type) : `${format(Math.abs(element.flow), 3)} l/min`, label.x, label.y + 8, "graph-kind"),
  ];
}

function intoFilms({ drawn, feeds }: Node, { x, y }: Place, width: number, isFreeAbove: boolean): SVGElement[] {
  const [start, end] = [x + box.width / 2, x + box.width / 2 + 22];
  const tip = drawn > 0 ? `M${end} ${y - 6} L${end + 9} ${y} L${end} ${y + 6} Z` : `M${end + 9} ${y - 6} L${end} ${y} L${end + 9} ${y + 6} Z`;
  return [
    drawLine(`M${start} ${y} L${end} ${y}`, width, { class: "graph-link circuit" }),
    draw("path", { d: tip, class: "circuit-tip" }),
    text(feeds ?? `${format(drawn, 3)} l/min`, start + 5, isFreeAbove ? y - 9 : y + 17, "graph-kind", "start"),
  ];
}

function nodeBox(node: Node, { x, y }: Place, share: number): SVGElement {
  const group = draw("g", { class: "graph-body circuit", "data-node": node.name });
  const place = { x: x - box.width / 2, y: y - box.height / 2, width: box.width, height: box.height, rx: 6 };
  group.append(
    draw("rect", place),
    draw("rect", { ...place, class: "circuit-pressure", "fill-opacity": (0.35 * share).toFixed(3) }),
    text(plain(node.name), x, y - 3, "graph-name"),
    text(node.pressure === null ? "" : `${format(node.pressure, 3)} bar${node.temperature === undefined ? "" : `, ${format(node.temperature, 3)} °C`}`, x, y + 12, "circuit-figure"),
  );
  return group;
}

/** Films by the nodes that feed them, and elements other than those that only pass the oil on to a film's node. */
function takers(nodes: Node[], elements: Element[]): SVGElement {
  const places = new Map(layersOf(nodes, elements).flatMap((layer, depth) => layer.map((name) => [name, depth] as const)));
  const rows = [
    ...nodes.filter(({ drawn }) => drawn !== 0).map(({ name, drawn }) => ({ name: `films at ${plain(name)}`, flow: drawn })),
    ...elements.filter(({ from, to }) => places.get(to) === 0 && places.get(from)! > 0).map(({ name, flow }) => ({ name: plain(name), flow: flow ?? 0 })),
  ].sort((a, b) => b.flow - a.flow);
  const all = rows.reduce((sum, { flow }) => sum + Math.max(0, flow), 0) || 1;
  const most = Math.max(...rows.map(({ flow }) => Math.abs(flow)), 1e-12);
  const [width, height] = [bar.label + bar.width + 150, bar.height * rows.length + 8];
  const svg = draw("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", class: "graph-drawing", "aria-label": "Who takes how much oil" });
  svg.style.maxWidth = `${width}px`;
  rows.forEach(({ name, flow }, i) => {
    const y = bar.height * (i + 0.5) + 4;
    const length = (bar.width * Math.abs(flow)) / most;
    svg.append(
      text(name, bar.label - 8, y + 4, "graph-name", "end"),
      draw("rect", { x: bar.label, y: y - 8, width: Math.max(1, length), height: 16, class: flow < 0 ? "circuit-bar back" : "circuit-bar" }),
      text(flow < 0 ? `${format(flow, 3)} l/min` : `${format(flow, 3)} l/min, ${format((100 * flow) / all, 2)} %`, bar.label + length + 8, y + 4, "circuit-figure", "start"),
    );
  });
  return svg;
}

function plain(name: string): string {
  return name.replaceAll("_", " ");
}

function text(content: string, x: number, y: number, kind: string, anchor = "middle"): SVGElement {
  const label = draw("text", { x, y, class: kind, "text-anchor": anchor });
  label.textContent = content;
  return label;
}

/** A line of a width of its own, which the style sheet does not know. */
function drawLine(d: string, width: number, attributes: Record<string, string>): SVGElement {
  const made = draw("path", { d, ...attributes });
  made.style.strokeWidth = String(width);
  return made;
}

function draw(name: string, attributes: Record<string, string | number>): SVGElement {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  return made;
}
