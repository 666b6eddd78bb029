// A form for one part of the model, its fields made from the schema. Every change is an edit of the text.

import { h } from "../src/dom";
import type { Fault } from "./api";
import { GroupForm } from "./group_form";
import type { KeyHelp, ModelSchema, Schema } from "./model_schema";
import { sentence } from "./problems";
import { texts } from "./texts";
import { child, type TextNode } from "./yaml_tree";

export type SetValue = (key: string, value: string | null) => Promise<void>;

type MissingField = KeyHelp & { schema: Schema };

const deepest = 3;

export class PartForm {
  readonly element = h("div", { class: "part-form" });
  private shape = "";
  private faults: Fault[] = [];
  /** The field in which a hand types, or whose value is on its way into the text. */
  private typed: Element | null = null;
  private refill = () => {};

  constructor(private readonly set: SetValue) {}

  /** @param path  of the part, such as bearings.main */
  show(schema: ModelSchema, node: TextNode, text: string, path: string): void {
    const shape = this.shapeOf(schema, node, text, path);
    if (shape !== this.shape || !this.element.firstChild) {
      this.shape = shape;
      this.element.replaceChildren(...this.fields(schema, node, text, path, 0));
    }
    this.refill = () => this.fill(node, text, path);
    this.refill();
    this.drawFaults();
  }

  /** What is wrong with the text: said below the fields that it is about. */
  mark(faults: Fault[]): void {
    this.faults = faults;
    this.drawFaults();
  }

  private drawFaults(): void {
    for (const field of this.element.querySelectorAll<HTMLElement>("[data-key]")) {
      const own = this.faults.filter(({ path }) => path === field.dataset["key"]);
      const words = own.map(sentence).join("\n");
      const id = `${field.id}-fault`;
      const row = field.closest(".field")!;
      const before = row.querySelector(".field-fault");
      if ((before?.textContent ?? "") === words) continue;
      before?.remove();
      if (words) row.append(h("p", { class: "field-fault", id }, words));
      field.toggleAttribute("aria-invalid", false);
      if (words) field.setAttribute("aria-invalid", "true");
      if (words) field.setAttribute("aria-describedby", id);
      else field.removeAttribute("aria-describedby");
    }
  }

  clear(): void {
    this.shape = "";
    this.element.replaceChildren();
  }

  /** What is written decides which fields there are; typing a value keeps them. */
  private shapeOf(schema: ModelSchema, node: TextNode, text: string, path: string): string {
    const written = (n: TextNode): string => n.children.filter((c) => c.kind !== "loose").map((c) => `${c.key}(${written(c)})`).join();
    return `${path}:${written(node)}:${schema.fields(node, text).map(({ key }) => key).join()}`;
  }

  private fields(schema: ModelSchema, node: TextNode, text: string, path: string, depth: number): HTMLElement[] {
    const rows: HTMLElement[] = [];
    const missing: MissingField[] = [];
    for (const field of schema.fields(node, text)) {
      if (field.key === "use") continue;
      const own = child(node, field.key);
      const key = `${path}.${field.key}`;
      if (!own) {
        missing.push(field);
        continue;
      }
      if (own.kind === "map" || (own.kind === "block" && own.children.length > 0)) {
        if (depth < deepest) rows.push(h("fieldset", {}, h("legend", { title: field.description }, field.key), ...this.fields(schema, own, text, key, depth + 1)));
        continue;
      }
      rows.push(this.row(field.key, field.description, key, schema.wordsOf(field.schema).filter(({ kind }) => kind === "word").map(({ value }) => value), schema.isOfWords(field.schema)));
    }
    // Of a group, such as the holes of a bearing: names that the schema does not know.
    for (const own of node.children) {
      if (own.kind === "loose" || schema.fields(node, text).some(({ key }) => key === own.key)) continue;
      const key = `${path}.${own.key}`;
      if (own.kind === "map" || own.kind === "block") {
        if (depth < deepest) rows.push(h("fieldset", {}, h("legend", {}, own.key), ...this.fields(schema, own, text, key, depth + 1)));
      } else rows.push(this.row(own.key, "", key, [], false));
    }
    if (missing.length > 0) rows.push(this.adder(schema, missing, path));
    return rows;
  }

  private row(name: string, description: string, key: string, words: string[], isClosed: boolean): HTMLElement {
    const id = `field-${key}`;
    const label = h("label", { for: id, title: description }, name.replaceAll("_", " "));
    const options = words.map((word) => h("option", { value: word }, word));
    const isChoice = isClosed && words.length > 0;
    const field = isChoice ? h("select", { id, "data-key": key }, ...options) : h("input", { id, type: "text", "data-key": key, spellcheck: "false", autocomplete: "off", ...(words.length > 0 ? { list: `${id}-words` } : {}) });
    field.addEventListener("input", () => (this.typed = field));
    field.addEventListener("change", () => {
      this.typed = field;
      void this.set(key, field.value).finally(() => {
        if (this.typed === field) this.typed = null;
      });
    });
    // As the text says, which may have changed meanwhile.
    field.addEventListener("blur", () => {
      if (this.typed !== field) this.refill();
    });
    return h("div", { class: "field" }, label, field, !isChoice && words.length > 0 ? h("datalist", { id: `${id}-words` }, ...options) : null);
  }

  private adder(schema: ModelSchema, missing: MissingField[], path: string): HTMLElement {
    const choice = h("select", { "aria-label": `${texts.add}: ${path}` }, h("option", { value: "" }, `${texts.add} …`), ...missing.map(({ key, description }) => h("option", { value: key, title: description }, key)));
    const value = h("input", { type: "text", "aria-label": `${path}: value`, hidden: true, spellcheck: "false" });
    const further = h("div", {});
    choice.addEventListener("change", () => {
      const field = missing.find(({ key }) => key === choice.value);
      const group = field ? schema.group(field.schema) : null;
      value.hidden = !field || group !== null;
      further.replaceChildren();
      if (!field) return;
      if (!group) return value.focus();
      const name = `${path}.${field.key}`;
      const form = new GroupForm(schema, group, name, (text) => void this.set(name, text));
      further.append(form.element);
      form.focus();
    });
    value.addEventListener("change", () => choice.value && value.value && void this.set(`${path}.${choice.value}`, value.value));
    return h("div", {}, h("div", { class: "field adder" }, choice, value), further);
  }

  private fill(node: TextNode, text: string, path: string): void {
    const visit = (n: TextNode, key: string) => {
      for (const c of n.children) {
        if (c.kind === "loose") continue;
        const own = `${key}.${c.key}`;
        const field = this.element.querySelector<HTMLInputElement | HTMLSelectElement>(`[data-key="${CSS.escape(own)}"]`);
        if (field && (document.activeElement !== field || this.typed !== field)) {
          const value = text.slice(c.valueFrom, c.valueTo).replace(/^(["'])(.*)\1$/, "$2");
          if (field instanceof HTMLSelectElement && ![...field.options].some((o) => o.value === value)) field.append(h("option", { value }, value));
          field.value = value;
        }
        visit(c, own);
      }
    };
    visit(node, path);
  }
}
