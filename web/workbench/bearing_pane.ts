// The pane of one bearing: its unwrapped surface, and its keys as a form.

import type { BearingScene, BoreArc, Fault, Feature } from "./api";
import { h } from "../src/dom";
import { PartForm, type SetValue } from "./form";
import type { ModelSchema } from "./model_schema";
import { texts } from "./texts";
import { Unwrapped } from "./unwrapped";
import { find, type TextNode } from "./yaml_tree";

export interface BearingHooks {
  set: SetValue;
  goToKey: (key: string) => void;
  chosen: (bearing: string) => void;
}

export class BearingPane {
  readonly element: HTMLElement;
  private readonly choice = h("select", { "aria-label": texts.bearingOf });
  private readonly note = h("p", { class: "note empty" }, texts.noBearing);
  private readonly body: HTMLElement;
  private readonly unwrapped: Unwrapped;
  private readonly form: PartForm;
  private bearings: Record<string, BearingScene> = {};
  private last: { schema: ModelSchema | null; tree: TextNode; text: string } | null = null;

  constructor(private readonly hooks: BearingHooks) {
    this.unwrapped = new Unwrapped({ moved: (feature, phi, z) => void this.move(feature, phi, z), arcMoved: (arc, end, phi) => void this.moveArc(arc, end, phi), chosen: ({ key }) => key && hooks.goToKey(key) });
    this.form = new PartForm(hooks.set);
    this.choice.addEventListener("change", () => {
      hooks.chosen(this.choice.value);
      this.draw();
    });
    this.body = h("div", { class: "bearing-body", hidden: true }, h("div", { class: "pane-tools" }, this.choice), this.unwrapped.element, h("p", { class: "note" }, texts.unwrappedHelp), this.form.element);
    this.element = h("div", { class: "bearing-pane" }, this.note, this.body);
  }

  get name(): string {
    return this.choice.value;
  }

  choose(name: string): void {
    if (!(name in this.names()) || this.choice.value === name) return;
    this.choice.value = name;
    this.draw();
  }

  private names(): Record<string, true> {
    return Object.fromEntries([...this.choice.options].map((o) => [o.value, true]));
  }

  /** @param bearings  of the last text that could be read; null: as before */
  show(bearings: Record<string, BearingScene> | null, schema: ModelSchema | null, tree: TextNode, text: string): void {
    if (bearings) this.bearings = bearings;
    this.last = { schema, tree, text };
    const written = (find(tree, ["bearings"])?.children ?? []).filter((c) => c.kind !== "loose" && c.key !== "use").map((c) => c.key);
    const names = [...new Set([...written, ...Object.keys(this.bearings)])];
    if (names.join() !== [...this.choice.options].map((o) => o.value).join()) {
      const before = this.choice.value;
      this.choice.replaceChildren(...names.map((name) => h("option", { value: name }, name)));
      if (names.includes(before)) this.choice.value = before;
    }
    this.body.hidden = names.length === 0;
    this.note.hidden = names.length > 0;
    this.draw();
  }

  clear(): void {
    this.bearings = {};
    this.last = null;
    this.choice.replaceChildren();
    this.form.clear();
    this.body.hidden = true;
    this.note.hidden = false;
  }

  /** What is wrong with the text. */
  mark(faults: Fault[]): void {
    this.form.mark(faults);
  }

  /** Once it comes into sight: what nobody sees takes no time. */
  draw(): void {
    if (this.element.hidden) return;
    const name = this.choice.value;
    this.unwrapped.show(name, this.bearings[name] ?? null);
    const { schema, tree, text } = this.last ?? {};
    const node = tree ? find(tree, ["bearings", name]) : undefined;
    if (schema && node && text !== undefined) this.form.show(schema, node, text, `bearings.${name}`);
    else this.form.clear();
  }

  private async move(feature: Feature, phi: number | null, z: number | null): Promise<void> {
    const { key } = feature;
    const { tree } = this.last ?? {};
    if (!key || !tree) return;
    const node = find(tree, key.split("."));
    const degrees = (x: number) => `${Number(((((x % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI)) * 180 / Math.PI).toFixed(3))} deg`;
    const millimetres = (x: number) => `${Number((1e3 * x).toFixed(4))} mm`;
    if (feature.kind === "line" || node?.kind === "scalar") return phi === null ? undefined : this.hooks.set(key, degrees(phi));
    const { along, across } = this.bearings[this.name]!;
    if (phi !== null) await this.hooks.set(`${key}.${along === "phi" ? "angle" : along}`, along === "phi" ? degrees(phi) : millimetres(phi));
    if (z !== null) await this.hooks.set(`${key}.${across}`, millimetres(z));
  }

  /** An arc by itself has a middle and an angle; those of a bore leave a groove between them, and are all alike. */
  private async moveArc({ key, isOfBore, from, to }: BoreArc, end: "from" | "to", phi: number): Promise<void> {
    if (!key) return;
    const degrees = (x: number) => `${Number(((x * 180) / Math.PI).toFixed(3))} deg`;
    const [begin, finish] = end === "from" ? [phi, to] : [from, phi];
    if (isOfBore) {
      const count = this.bearings[this.name]!.arcs!.length;
      const growth = finish - begin - (to - from);
      const groove = (2 * Math.PI) / count - (to - from) - 2 * growth;
      return this.hooks.set(`${key}.groove`, degrees(Math.max(0, groove)));
    }
    await this.hooks.set(`${key}.middle`, degrees(0.5 * (begin + finish)));
    await this.hooks.set(`${key}.arc`, degrees(finish - begin));
  }
}
