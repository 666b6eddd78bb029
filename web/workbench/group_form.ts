// A group of keys that a part does not have yet, such as the asperities of a bearing: its fields, of which those that it
// needs have to be filled before it is written into the text as a whole.

import { h } from "../src/dom";
import type { Group, ModelSchema } from "./model_schema";
import { texts } from "./texts";

export class GroupForm {
  readonly element: HTMLFormElement;
  private readonly rows = h("div", {});
  private readonly kind: HTMLSelectElement | null = null;

  /** @param add  writes the value of the whole group, `{model: film, supply_temperature: 50 degC}` */
  constructor(
    private readonly schema: ModelSchema,
    private readonly group: Group,
    name: string,
    private readonly add: (value: string) => void,
  ) {
    const id = `group-${name}`;
    const { decides, kinds } = group;
    if (decides) {
      this.kind = h("select", { id: `${id}-kind`, "data-group-key": decides, change: () => this.draw() }, ...kinds.map(({ word }) => h("option", { value: word }, word)));
      // The first that says more than its word: `none` is what the part is without the group.
      this.kind.value = (kinds.find(({ keys }) => keys.some(({ required }) => required)) ?? kinds.find(({ keys }) => keys.length > 0) ?? kinds[0]!).word;
    }
    this.element = h("form", { class: "group-form", "aria-label": `${texts.add}: ${name}` }, this.kind && h("div", { class: "field" }, h("label", { for: this.kind.id }, decides.replaceAll("_", " ")), this.kind), this.rows, h("div", { class: "field" }, h("button", { type: "submit", class: "quiet" }, `${texts.add} ${name.split(".").pop()!}`)));
    this.element.addEventListener("submit", (event) => {
      event.preventDefault();
      this.add(this.value());
    });
    this.draw();
  }

  focus(): void {
    this.element.querySelector<HTMLElement>("select, input")?.focus();
  }

  /** Needed keys first. */
  private draw(): void {
    const { keys } = this.group.kinds.find(({ word }) => !this.kind || word === this.kind.value) ?? this.group.kinds[0]!;
    const rows = keys.filter(({ key }) => key !== "use").sort((a, b) => Number(b.required) - Number(a.required)).map((field) => {
      const id = `${this.element.getAttribute("aria-label")}-${field.key}`.replace(/[^\w-]+/g, "-");
      const help = this.schema.wordsOf(field.schema);
      const words = help.filter(({ kind }) => kind === "word").map(({ value }) => value);
      const example = field.default || (help.find(({ kind }) => kind === "example")?.value ?? "");
      const input = h("input", { id, type: "text", "data-group-key": field.key, required: field.required, placeholder: example, spellcheck: "false", autocomplete: "off", ...(words.length > 0 ? { list: `${id}-words` } : {}) });
      const label = h("label", { for: id, title: field.description }, field.key.replaceAll("_", " "), field.required ? h("span", { class: "needed" }, ` (${texts.needed})`) : null);
      return h("div", { class: "field" }, label, input, words.length > 0 ? h("datalist", { id: `${id}-words` }, ...words.map((word) => h("option", { value: word }))) : null);
    });
    this.rows.replaceChildren(...rows);
  }

  private value(): string {
    const fields = [...this.element.querySelectorAll<HTMLInputElement | HTMLSelectElement>("[data-group-key]")];
    const said = fields.filter((field) => field.value.trim()).map((field) => `${field.dataset["groupKey"]}: ${field.value.trim()}`);
    return `{${said.join(", ")}}`;
  }
}
