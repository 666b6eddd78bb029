// The oil circuit as the text has it: the report's drawing without flows. What is clicked is found in the text.

import type { Run } from "../src/data";
import { network, type CircuitElement } from "../src/circuit_drawing";
import { h } from "../src/dom";
import { texts } from "./texts";

/** See scene_parts.h. */
export interface CircuitScene {
  nodes: { name: string; given: boolean; pressure?: number }[];
  elements: string[];
  feeds: { node: string; bearing: string; feature: string }[];
}

export class CircuitPlan {
  readonly element = h("details", { class: "circuit-plan", open: true }, h("summary", {}, texts.circuit.title));
  private readonly holder = h("div", { class: "circuit-holder" });

  constructor(private readonly pick: (part: string) => void) {
    this.element.append(this.holder);
    this.element.hidden = true;
    this.holder.addEventListener("click", (event) => {
      const part = (event.target as Element).closest<SVGElement>("[data-element], [data-node]");
      if (part) this.pick(partOf(part));
    });
  }

  show(circuit: CircuitScene | null, run: Run | null): void {
    this.element.hidden = !circuit || circuit.nodes.length === 0 || circuit.elements.length === 0;
    if (this.element.hidden || !circuit || !run) return this.holder.replaceChildren();
    const feeds = (node: string) => [...new Set(circuit.feeds.filter((feed) => feed.node === node).map(({ bearing }) => bearing.replaceAll("_", " ")))];
    const nodes = circuit.nodes.map(({ name, pressure }) => ({ name, pressure: pressure === undefined ? null : 1e-5 * pressure, drawn: feeds(name).length > 0 ? 1 : 0, feeds: feeds(name).join(", ") }));
    const elements = circuit.elements.flatMap((name): CircuitElement[] => {
      const [type, from, to] = run.list("/circuit", `element_${name}`);
      return type && from && to ? [{ name, type, from, to, flow: null }] : [];
    });
    const drawing = network(nodes, elements);
    // A thin line is hard to meet.
    for (const line of drawing.querySelectorAll<SVGElement>("path[data-element]")) {
      const wide = line.cloneNode() as SVGElement;
      wide.setAttribute("class", "circuit-touch");
      wide.removeAttribute("style");
      line.before(wide);
    }
    this.holder.replaceChildren(drawing);
  }

  choose(part: string | null): void {
    for (const drawn of this.holder.querySelectorAll("[data-element], [data-node]")) drawn.classList.toggle("chosen", partOf(drawn) === part);
  }
}

function partOf(drawn: Element): string {
  const node = drawn.getAttribute("data-node");
  return node !== null ? `/circuit/nodes/${node}` : `/circuit/elements/${drawn.getAttribute("data-element")}`;
}
