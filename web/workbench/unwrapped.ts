// The surface of a bearing unwrapped: grid, holes, grooves and pads; what has a place in the text can be moved.

import type { BearingScene, Feature } from "./api";
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
  /** A feature was moved by so much [rad or m; m]. */
  moved: (feature: Feature, phi: number, z: number) => void;
  chosen: (feature: Feature) => void;
}

const box = { left: 44, top: 10, width: 540, height: 190 };

export class Unwrapped {
  readonly element = h("div", { class: "unwrapped" });

  constructor(private readonly hooks: UnwrappedHooks) {}

  show(name: string, bearing: BearingScene | null): void {
    const width = bearing?.width ?? 0;
    if (!bearing || !(width > 0)) {
      this.element.replaceChildren();
      return;
    }
    const focused = (document.activeElement as Element | null)?.getAttribute?.("data-feature");
    const isPlane = (bearing.length as number | undefined ?? 0) > 0 && !(bearing.radius && bearing.radius > 0);
    const along = isPlane ? (bearing["length"] as number) : 2 * Math.PI;
    const low = isPlane ? -along / 2 : 0;
    const x = (phi: number) => box.left + ((phi - low) / along) * box.width;
    const y = (z: number) => box.top + (0.5 - z / width) * box.height;
    const drawing = svg("svg", { viewBox: `0 0 ${box.left + box.width + 14} ${box.top + box.height + 40}`, role: "group", "aria-label": texts.unwrapped(name) });
    drawing.append(svg("rect", { class: "paper", x: box.left, y: box.top, width: box.width, height: box.height }));
    this.drawGrid(drawing, bearing);
    for (let k = 0; k <= 4; k++) {
      const value = low + (k / 4) * along;
      drawing.append(svg("text", { class: "tick", x: x(value), y: box.top + box.height + 15, "text-anchor": "middle" }, isPlane ? format(1e3 * value, 3) : `${90 * k}°`));
    }
    for (const share of [-0.5, 0, 0.5]) drawing.append(svg("text", { class: "tick", x: box.left - 6, y: y(share * width) + 4, "text-anchor": "end" }, format(1e3 * share * width, 3)));
    drawing.append(svg("text", { class: "axis", x: box.left + box.width / 2, y: box.top + box.height + 33, "text-anchor": "middle" }, isPlane ? "x [mm]" : "bearing angle φ; z upwards [mm]"));
    const clip = svg("clipPath", { id: "unwrapped-clip" }, svg("rect", { x: box.left, y: box.top, width: box.width, height: box.height }));
    drawing.append(svg("defs", {}, clip));
    for (const feature of bearing.features) drawing.append(this.draw(feature, along, width, x, y, isPlane));
    this.element.replaceChildren(drawing);
    if (focused) this.element.querySelector<SVGElement>(`[data-feature="${CSS.escape(focused)}"]`)?.focus();
  }

  private drawGrid(drawing: SVGElement, { grid }: BearingScene): void {
    if (!grid) return;
    const lines: string[] = [];
    const [n, m] = [grid.circumferential, grid.axial];
    for (let i = 1; i < n && n <= 400; i++) lines.push(`M${box.left + (i / n) * box.width} ${box.top}v${box.height}`);
    const cells = Math.max(1, m - 1);
    for (let j = 1; j < cells && m <= 200; j++) lines.push(`M${box.left} ${box.top + (j / cells) * box.height}h${box.width}`);
    drawing.append(svg("path", { class: "grid", d: lines.join("") }));
  }

  private draw(feature: Feature, along: number, width: number, x: (phi: number) => number, y: (z: number) => number, isPlane: boolean): SVGElement {
    const [w, t] = [(feature.arc / along) * box.width, ((feature.length || width) / width) * box.height];
    const key = feature.key ?? "";
    const round = /hole|pocket|round|circle/.test(feature.kind) && feature.kind !== "groove";
    const place = isPlane ? `${format(1e3 * feature.phi, 3)} mm` : `${format((feature.phi * 180) / Math.PI, 4)}°`;
    const group = svg("g", { class: `feature ${feature.kind}`, "clip-path": "url(#unwrapped-clip)" });
    const handle = svg("g", { class: key ? "handle" : "", "data-feature": feature.name, ...(key ? { tabindex: 0, role: "button", "aria-label": `${feature.name}, ${feature.kind}, at ${place}, z ${format(1e3 * feature.z, 3)} mm` } : {}) });
    const turn = isPlane ? [0] : [-along, 0, along];
    for (const shift of turn) {
      const [cx, cy] = [x(feature.phi + shift), y(feature.z)];
      if (feature.arc === 0) handle.append(svg("path", { class: "line", d: `M${cx} ${cy - t / 2}v${t}` }), svg("path", { class: "touch", d: `M${cx} ${cy - t / 2}v${t}` }));
      else if (round) handle.append(svg("ellipse", { cx, cy, rx: Math.max(3, w / 2), ry: Math.max(3, t / 2) }));
      else handle.append(svg("rect", { x: cx - Math.max(2, w / 2), y: cy - t / 2, width: Math.max(4, w), height: t, rx: 1.5 }));
      if (shift === 0) handle.append(svg("text", { class: "feature-name", x: Math.min(box.left + box.width - 4, Math.max(box.left + 4, cx)), y: Math.max(box.top + 12, cy - t / 2 - 4), "text-anchor": cx > box.left + box.width - 60 ? "end" : cx < box.left + 60 ? "start" : "middle" }, feature.name));
    }
    group.append(handle);
    if (key) this.followHand(handle, feature, along, width);
    return group;
  }

  private followHand(handle: SVGElement, feature: Feature, along: number, width: number): void {
    const round = (value: number, step: number) => Math.round(value / step) * step;
    const steps: [number, number] = along > 6.28 && along < 6.3 ? [Math.PI / 180, 1e-4] : [1e-4, 1e-4];
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
      if (Math.abs((phi / along) * box.width) < 1 && Math.abs((z / width) * box.height) < 1) return;
      this.hooks.moved(feature, round(feature.phi + phi, steps[0]), round(feature.z + z, steps[1]));
    });
    handle.addEventListener("keydown", (event) => {
      const way: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
      const step = way[event.key];
      if (!step) return;
      event.preventDefault();
      const size = event.shiftKey ? 10 : 1;
      this.hooks.moved(feature, round(feature.phi + size * step[0] * steps[0], steps[0]), round(feature.z + size * step[1] * steps[1], steps[1]));
    });
  }
}
