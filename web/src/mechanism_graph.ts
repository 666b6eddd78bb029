// Bodies as boxes, joints, bearings and forces as lines between them; layers by distance from ground.

import type { Run } from "./data";
import { figure } from "./dom";
import { MachineGeometry, type Link } from "./machine_geometry";

const box = { width: 132, height: 34, across: 190, down: 96 };

interface Place {
  x: number;
  y: number;
}

export function mechanismGraph(run: Run): HTMLElement | null {
  const geometry = MachineGeometry.of(run);
  if (!geometry) return null;
  // The frames of a flexible body, "rod.tip", are parts of it.
  const names = geometry.bodies.map((body) => body.name);
  const owner = (name: string) => (names.includes(name.split(".")[0]!) ? name.split(".")[0]! : name);
  const links = [...geometry.joints, ...geometry.bearings, ...geometry.forces]
    .map((link) => ({ ...link, inboard: owner(link.inboard), outboard: owner(link.outboard) }))
    .filter((link) => link.inboard !== link.outboard);
  const layers = layersFromGround(["ground", ...names.filter((name) => owner(name) === name)], links);
  const widest = Math.max(...layers.map((layer) => layer.length));
  const places = new Map<string, Place>();
  layers.forEach((layer, depth) =>
    layer.forEach((name, i) => places.set(name, { x: box.across * (i + 0.5 + 0.5 * (widest - layer.length)), y: box.down * (depth + 0.5) })),
  );
  const svg = element("svg", { viewBox: `0 0 ${box.across * widest} ${box.down * layers.length}`, role: "img", class: "graph-drawing", "aria-label": "Bodies and what connects them" });
  svg.style.maxWidth = `${box.across * widest}px`;
  svg.append(...edges(links, places), ...[...places].map(([name, place]) => node(name, place)));
  return figure("graph", "Bodies and what connects them: joints as lines, bearings thick, forces dashed.", null, svg);
}

/** Breadth first along all links; what nothing connects comes last. */
function layersFromGround(names: string[], links: Link[]): string[][] {
  const depth = new Map<string, number>([["ground", 0]]);
  const waiting = ["ground"];
  for (let name = waiting.shift(); name !== undefined; name = waiting.shift())
    for (const link of links)
      for (const [near, far] of [[link.inboard, link.outboard], [link.outboard, link.inboard]] as const)
        if (near === name && !depth.has(far)) {
          depth.set(far, depth.get(name)! + 1);
          waiting.push(far);
        }
  const deepest = Math.max(...depth.values());
  const layers: string[][] = Array.from({ length: deepest + 1 }, () => []);
  for (const name of names) {
    const at = depth.get(name) ?? deepest + 1;
    (layers[at] ??= []).push(name);
  }
  return layers;
}

function edges(links: Link[], places: Map<string, Place>): SVGElement[] {
  const drawn = new Map<string, number>();
  return links.flatMap((link) => {
    const [a, b] = [places.get(link.inboard), places.get(link.outboard)];
    if (!a || !b) return [];
    const pair = [link.inboard, link.outboard].sort().join("|");
    const nth = drawn.get(pair) ?? 0;
    drawn.set(pair, nth + 1);
    // Lines between the same two bodies, and within one layer, are bent apart.
    const bend = (nth === 0 ? (a.y === b.y ? 44 : 0) : 56 * Math.ceil(nth / 2) * (nth % 2 === 1 ? 1 : -1)) || 0;
    const [dx, dy] = [b.x - a.x, b.y - a.y];
    const length = Math.hypot(dx, dy) || 1;
    const middle = { x: (a.x + b.x) / 2 - (dy / length) * bend, y: (a.y + b.y) / 2 + (dx / length) * bend };
    const label = { x: (a.x + b.x) / 4 + middle.x / 2, y: (a.y + b.y) / 4 + middle.y / 2 };
    const path = element("path", { d: `M${a.x} ${a.y} Q${middle.x} ${middle.y} ${b.x} ${b.y}`, class: `graph-link ${link.kind === "bearing" || link.kind === "force" ? link.kind : "joint"}` });
    return [path, text(`${link.name.replaceAll("_", " ")}`, label.x, label.y - 2, "graph-label"), text(link.kind, label.x, label.y + 10, "graph-kind")];
  });
}

function node(name: string, { x, y }: Place): SVGElement {
  const group = element("g", { class: name === "ground" ? "graph-body ground" : "graph-body" });
  group.append(
    element("rect", { x: x - box.width / 2, y: y - box.height / 2, width: box.width, height: box.height, rx: 5 }),
    text(name.replaceAll("_", " "), x, y + 4, "graph-name"),
  );
  return group;
}

function text(content: string, x: number, y: number, kind: string): SVGElement {
  const label = element("text", { x, y, class: kind, "text-anchor": "middle" });
  label.textContent = content;
  return label;
}

function element(name: string, attributes: Record<string, string | number>): SVGElement {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, String(value));
  return made;
}
