// The surface of a bearing unwrapped: grid, holes, grooves and pads; what has a place in the text can be moved.

import type { BearingScene, BoreArc, Feature } from "./api";
import { h } from "../src/dom";
import { format } from "../src/units";
import { texts } from "./texts";

const ns = "http://www.w3.org/2000/svg";

function svg(tag: string, properties: Record<string, string | number>, ...children: (Node | string)[]): SVGElement {
  const element = document.createElementNS(ns, tag);
  for (const [name, value] of Object.entries(properties)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

export interface UnwrappedHooks {
  /** A feature was moved there [rad or m; m]; null: that coordinate stays as it is written. */
  moved: (feature: Feature, phi: number | null, z: number | null) => void;
  /** An end of an arc was moved to an angle [rad]. */
  arcMoved: (arc: BoreArc, end: "from" | "to", phi: number) => void;
  chosen: (part: { key?: string }) => void;
}

const turn = 2 * Math.PI;
const wrapped = (phi: number) => ((phi % turn) + turn) % turn;
const degree = Math.PI / 180;

const box = { left: 44, top: 10, width: 540, height: 190 };

export class Unwrapped {
  readonly element = h("div", { class: "unwrapped" });

  constructor(private readonly hooks: UnwrappedHooks) {}

  show(name: string, bearing: BearingScene | null): void {
    if (!bearing || bearing.grid.along.length < 2 || bearing.grid.across.length < 2) {
      this.element.replaceChildren();
      return;
    }
    const { along: nodes, across: rows, closes } = bearing.grid;
    const isPlane = bearing.along !== "phi";
    const arcs = bearing.arcs ?? [];
    // Around arcs there is the whole turn: their ends can be moved into the grooves.
    const isRound = closes || arcs.length > 0;
    const low = isRound ? 0 : nodes[0]!;
    const along = isRound ? turn : nodes[nodes.length - 1]! - low;
    const bottom = rows[0]!;
    const width = rows[rows.length - 1]! - bottom;
    // The line that supplies it is a feature without extent around it.
    const line: Feature[] = bearing.supply?.at === "angle" ? [{ name: texts.supply, kind: "line", phi: bearing.supply.phi, z: 0, arc: 0, length: 0, key: `bearings.${name}.supply.line` }] : [];
    const all = [...bearing.features, ...line];
    const focused = (document.activeElement as Element | null)?.getAttribute?.("data-feature");
    const x = (phi: number) => box.left + ((phi - low) / along) * box.width;
    const lineAt = (phi: number) => x(arcs.length > 0 ? wrapped(phi) : phi);
    const y = (z: number) => box.top + (1 - (z - bottom) / width) * box.height;
    const drawing = svg("svg", { viewBox: `0 0 ${box.left + box.width + 14} ${box.top + box.height + 40}`, role: "group", "aria-label": texts.unwrapped(name) });
    drawing.append(svg("rect", { class: arcs.length > 0 ? "paper between-arcs" : "paper", x: box.left, y: box.top, width: box.width, height: box.height }));
    for (const { from, to } of arcs)
      for (const shift of [-turn, 0, turn]) {
        const [left, right] = [Math.max(0, wrapped(from) + shift), Math.min(turn, wrapped(from) + to - from + shift)];
        if (right > left) drawing.append(svg("rect", { class: "paper", x: x(left), y: box.top, width: x(right) - x(left), height: box.height }));
      }
    const lines = [...nodes.map((node) => `M${lineAt(node)} ${box.top}v${box.height}`), ...rows.map((row) => `M${box.left} ${y(row)}h${box.width}`)];
    drawing.append(svg("path", { class: "grid", d: lines.join("") }));
    for (let k = 0; k <= 4; k++) {
      const value = low + (k / 4) * along;
      drawing.append(svg("text", { class: "tick", x: x(value), y: box.top + box.height + 15, "text-anchor": "middle" }, isPlane ? format(1e3 * value, 3) : `${format((180 / Math.PI) * value, 3)}°`));
    }
    for (const share of [0, 0.5, 1]) drawing.append(svg("text", { class: "tick", x: box.left - 6, y: y(bottom + share * width) + 4, "text-anchor": "end" }, format(1e3 * (bottom + share * width), 3)));
    drawing.append(svg("text", { class: "axis", x: box.left + box.width / 2, y: box.top + box.height + 33, "text-anchor": "middle" }, isPlane ? texts.axesOfPad(bearing.along, bearing.across) : texts.axesOfBore));
    const clip = svg("clipPath", { id: "unwrapped-clip" }, svg("rect", { x: box.left, y: box.top, width: box.width, height: box.height }));
    drawing.append(svg("defs", {}, clip));
    for (const feature of all) drawing.append(this.draw(feature, along, width, x, y, isPlane));
    for (const arc of arcs) drawing.append(...(["from", "to"] as const).map((end) => this.drawEnd(arc, end, arcs, lineAt)));
    this.element.replaceChildren(drawing);
    if (focused) this.element.querySelector<SVGElement>(`[data-feature="${CSS.escape(focused)}"]`)?.focus();
  }

  private draw(feature: Feature, along: number, width: number, x: (phi: number) => number, y: (z: number) => number, isPlane: boolean): SVGElement {
    const [w, t] = [(feature.arc / along) * box.width, ((feature.length || 4 * width) / width) * box.height];
    const key = feature.key ?? "";
    const round = feature.kind === "hole";
    const place = isPlane ? `${format(1e3 * feature.phi, 3)} mm` : `${format((feature.phi * 180) / Math.PI, 4)}°`;
    const group = svg("g", { class: `feature ${feature.kind} ${feature.surface ?? "fixed"}`, "clip-path": "url(#unwrapped-clip)" });
    const handle = svg("g", { class: key ? "handle" : "", "data-feature": feature.name, ...(key ? { tabindex: 0, role: "button", "aria-label": `${feature.name}, ${feature.kind}, at ${place}, z ${format(1e3 * feature.z, 3)} mm` } : {}) });
    for (const shift of isPlane ? [0] : [-along, 0, along]) {
      const copy = shift === 0 ? {} : { class: "copy" };
      const [cx, cy] = [x(feature.phi + shift), y(feature.z)];
      if (feature.arc === 0) handle.append(svg("path", { class: shift === 0 ? "line" : "line copy", d: `M${cx} ${cy - t / 2}v${t}` }), svg("path", { class: "touch", d: `M${cx} ${cy - t / 2}v${t}` }));
      else if (round) handle.append(svg("ellipse", { cx, cy, rx: Math.max(3, w / 2), ry: Math.max(3, t / 2), ...copy }));
      else handle.append(svg("rect", { x: cx - Math.max(2, w / 2), y: cy - t / 2, width: Math.max(4, w), height: t, rx: 1.5, ...copy }));
      if (shift === 0) handle.append(svg("text", { class: "feature-name", x: Math.min(box.left + box.width - 4, Math.max(box.left + 4, cx)), y: Math.max(box.top + 13, cy - t / 2 - 4), "text-anchor": cx > box.left + box.width - 60 ? "end" : cx < box.left + 60 ? "start" : "middle" }, feature.name));
    }
    group.append(handle);
    if (key) this.followHand(handle, feature, along, width);
    return group;
  }

  /** An end of an arc, as a line across the bearing with a grip. */
  private drawEnd(arc: BoreArc, end: "from" | "to", arcs: BoreArc[], lineAt: (phi: number) => number): SVGElement {
    const at = lineAt(arc[end]);
    const words = `${texts.arcEnd[end](arc.name)}, ${format(arc[end] / degree, 4)}°`;
    const handle = svg("g", { class: "handle arc-end", "data-feature": `arc ${arc.name} ${end}`, tabindex: 0, role: "button", "aria-label": words });
    const middle = box.top + box.height / 2;
    const out = end === "from" ? 1 : -1; // into the arc
    handle.append(svg("title", {}, words), svg("path", { class: "line", d: `M${at} ${box.top}v${box.height}` }), svg("path", { class: "grip", d: `M${at} ${middle - 9}l${7 * out} 9l${-7 * out} 9z` }), svg("path", { class: "touch", d: `M${at} ${box.top}v${box.height}` }));
    // Neighbours, the arc's other end and whole degrees limit it; where keys have brought it, before the text's answer.
    let place = arc[end];
    const limited = (phi: number) => {
      const grid = Math.round(phi / degree) * degree;
      const own = end === "from" ? Math.min(grid, arc.to - degree) : Math.max(grid, arc.from + degree);
      const room = arcs.length > 1 || arc.isOfBore ? Infinity : turn;
      return end === "from" ? Math.max(own, arc.to - room) : Math.min(own, arc.from + room);
    };
    let start: { x: number; scale: number } | null = null;
    const moved = (event: PointerEvent) => ((event.clientX - start!.x) * start!.scale * turn) / box.width;
    handle.addEventListener("pointerdown", (event) => {
      const drawing = handle.ownerSVGElement!;
      start = { x: event.clientX, scale: drawing.viewBox.baseVal.width / drawing.getBoundingClientRect().width };
      handle.setPointerCapture(event.pointerId);
      this.hooks.chosen(arc);
    });
    handle.addEventListener("pointermove", (event) => {
      if (start) handle.setAttribute("transform", `translate(${((limited(arc[end] + moved(event)) - arc[end]) / turn) * box.width} 0)`);
    });
    handle.addEventListener("pointerup", (event) => {
      if (!start) return;
      const phi = limited(arc[end] + moved(event));
      const isMoved = Math.abs(moved(event)) > 0.5 * degree;
      start = null;
      if (!isMoved) return handle.removeAttribute("transform");
      this.hooks.arcMoved(arc, end, phi);
    });
    handle.addEventListener("keydown", (event) => {
      const way = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
      if (!way) return;
      event.preventDefault();
      place = limited(place + way * (event.shiftKey ? 10 : 1) * degree);
      this.hooks.arcMoved(arc, end, place);
    });
    return handle;
  }

  private followHand(handle: SVGElement, feature: Feature, along: number, width: number): void {
    const round = (value: number, step: number) => Math.round(value / step) * step;
    const steps: [number, number] = along > 6.28 && along < 6.3 ? [Math.PI / 180, 1e-4] : [1e-4, 1e-4];
    // Where the keys have brought it, before the text's answer is there.
    const place = { phi: feature.phi, z: feature.z };
    let start: { x: number; y: number; scale: number } | null = null;
    const shift = (event: PointerEvent): [number, number] => {
      const [dx, dy] = [(event.clientX - start!.x) * start!.scale, (event.clientY - start!.y) * start!.scale];
      return [(dx / box.width) * along, (-dy / box.height) * width];
    };
    handle.addEventListener("pointerdown", (event) => {
      const drawing = handle.ownerSVGElement!;
      start = { x: event.clientX, y: event.clientY, scale: drawing.viewBox.baseVal.width / drawing.getBoundingClientRect().width };
      handle.setPointerCapture(event.pointerId);
      this.hooks.chosen(feature);
    });
    handle.addEventListener("pointermove", (event) => {
      if (!start) return;
      const [phi, z] = shift(event);
      handle.setAttribute("transform", `translate(${(phi / along) * box.width} ${feature.arc === 0 ? 0 : (-z / width) * box.height})`);
    });
    handle.addEventListener("pointerup", (event) => {
      if (!start) return;
      const [phi, z] = shift(event);
      start = null;
      const [right, up] = [Math.abs((phi / along) * box.width), Math.abs((z / width) * box.height)];
      if (right < 1 && up < 1) return handle.removeAttribute("transform");
      // A hand that follows one direction leaves it by some pixels.
      const isStill = (own: number, other: number) => own < 1 || (own < 4 && own < 0.2 * other);
      this.hooks.moved(feature, isStill(right, up) ? null : round(feature.phi + phi, steps[0]), isStill(up, right) ? null : round(feature.z + z, steps[1]));
    });
    handle.addEventListener("keydown", (event) => {
      const way: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
      const step = way[event.key];
      if (!step) return;
      event.preventDefault();
      const size = event.shiftKey ? 10 : 1;
      const [right, up] = step;
      if (right) place.phi = round(place.phi + size * right * steps[0], steps[0]);
      if (up) place.z = round(place.z + size * up * steps[1], steps[1]);
      this.hooks.moved(feature, right ? place.phi : null, up ? place.z : null);
    });
  }
}
