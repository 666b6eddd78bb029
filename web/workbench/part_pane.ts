// The keys of the part that was chosen, in the machine or by the cursor, as a form.

import type { Fault } from "./api";
import { h } from "../src/dom";
import { PartForm, type SetValue } from "./form";
import type { ModelSchema } from "./model_schema";
import { texts } from "./texts";
import { find, type TextNode } from "./yaml_tree";

export class PartPane {
  readonly element: HTMLElement;
  private readonly title = h("h3", {}, texts.noPart);
  private readonly form: PartForm;
  private part: string | null = null;
  private last: { schema: ModelSchema | null; tree: TextNode; text: string } | null = null;

  constructor(set: SetValue) {
    this.form = new PartForm(set);
    this.element = h("div", { class: "part-pane" }, this.title, this.form.element);
  }

  /** @param part  such as /bodies/rod */
  choose(part: string | null): void {
    if (part === this.part) return;
    this.part = part;
    this.draw();
  }

  show(schema: ModelSchema | null, tree: TextNode, text: string): void {
    this.last = { schema, tree, text };
    this.draw();
  }

  /** What is wrong with the text. */
  mark(faults: Fault[]): void {
    this.form.mark(faults);
  }

  /** Once it comes into sight. */
  draw(): void {
    if (this.element.hidden) return;
    const path = this.part?.slice(1).split("/") ?? [];
    const node = this.last && path.length === 2 ? find(this.last.tree, path) : undefined;
    this.title.textContent = node ? path.join(".") : texts.noPart;
    if (node && this.last?.schema) this.form.show(this.last.schema, node, this.last.text, path.join("."));
    else this.form.clear();
  }
}
