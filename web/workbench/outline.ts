// The parts of a text as a list: groups and the names in them.

import { h } from "../src/dom";
import type { TextNode } from "./yaml_tree";

const named = new Set(["bodies", "joints", "fmus", "drives", "couplings", "forces", "contacts", "lubricants", "bearings", "circuit", "templates", "parameters"]);

export class Outline {
  readonly element = h("ul", { class: "outline" });
  private shape = "";

  constructor(private readonly goTo: (offset: number) => void) {}

  show(root: TextNode | null): void {
    const groups = (root?.children ?? []).filter((c) => c.kind !== "loose");
    const entries = groups.flatMap((group) => [{ node: group, depth: 0 }, ...(named.has(group.key) && group.kind === "block" ? group.children.filter((c) => c.kind !== "loose").map((node) => ({ node, depth: 1 })) : [])]);
    const shape = entries.map(({ node, depth }) => `${depth}${node.key}`).join();
    if (shape !== this.shape) {
      this.shape = shape;
      this.element.replaceChildren(...entries.map(({ node, depth }) => h("li", { class: `depth-${depth}` }, h("button", { type: "button", class: "outline-entry" }, node.key))));
    }
    entries.forEach(({ node }, i) => (this.element.children[i]!.firstElementChild as HTMLButtonElement).onclick = () => this.goTo(node.from));
  }
}
