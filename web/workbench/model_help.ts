// Completion, hover help and conversion of units in a model's text.

import { snippetCompletion, type Completion, type CompletionContext, type CompletionResult } from "@codemirror/autocomplete";
import { StateEffect, StateField, type Extension } from "@codemirror/state";
import { hoverTooltip, showTooltip, type EditorView, type Tooltip } from "@codemirror/view";
import { yamlLanguage } from "@codemirror/lang-yaml";
import { h } from "../src/dom";
import type { ModelSchema } from "./model_schema";
import { texts } from "./texts";
import { familyOf, quantityPattern, unitsLike } from "./units_of";
import { child, find, nodeAt, pathOf, placeAt, readTree, type TextNode } from "./yaml_tree";

export interface ModelHelpers {
  schema: () => ModelSchema | null;
  convert: (value: string, unit: string) => Promise<string>;
  say: (text: string) => void;
}

/** Names that parts of a model have, by what a schema calls them. */
function namesOf(kind: string, root: TextNode): string[] {
  const names = (group: string) => (find(root, [group])?.children ?? []).filter((c) => c.kind !== "loose" && c.key !== "use").map((c) => c.key);
  const groups: [RegExp, string][] = [
    [/lubricant|oil/i, "lubricants"],
    [/joint/i, "joints"],
    [/bearing/i, "bearings"],
    [/template/i, "templates"],
    [/force/i, "forces"],
    [/drive/i, "drives"],
  ];
  if (/body/i.test(kind) || /frame/i.test(kind)) {
    const bodies = ["ground", ...names("bodies").filter((b) => b !== "ground")];
    return bodies.flatMap((body) => [body, ...(find(root, ["bodies", body, "frames"])?.children ?? []).filter((f) => f.kind !== "loose").map((f) => `${body}.${f.key}`)]);
  }
  return groups.flatMap(([pattern, group]) => (pattern.test(kind) ? names(group) : []));
}

function keyCompletions(schema: ModelSchema, map: TextNode, text: string): Completion[] {
  const flow = map.kind === "map" || map.flow;
  return schema.keys(map, text).map(({ key, description, default: fallback, required, isMap }) => {
    const detail = required ? "required" : fallback ? `default ${fallback}` : "";
    const option: Completion = { label: key, type: "property", ...(detail ? { detail } : {}), info: description, boost: required ? 10 : 0 };
    return isMap ? snippetCompletion(flow ? `${key}: {\${}}` : `${key}:\n\t\${}`, option) : { ...option, apply: `${key}: ` };
  });
}

function valueCompletions(schema: ModelSchema, node: TextNode, root: TextNode, text: string, written: string): Completion[] {
  const quantity = /^((?:[-+]?[\d.]+(?:[eE][-+]?\d+)?\s+)*[-+]?[\d.]+(?:[eE][-+]?\d+)?)\s+(\S*)$/.exec(written) ?? /^([-+]?[\d.]+)\s*$/.exec(written);
  const values = schema.values(node, text);
  if (quantity) {
    const units = values.flatMap(({ value }) => quantityPattern.exec(value)?.[2] ?? []).flatMap(familyOf);
    return [...new Set(units)].map((unit, i) => ({ label: `${quantity[1]!.trim()} ${unit}`, type: "unit", boost: -i }));
  }
  const words: Completion[] = values.map(({ value, description, kind }) => ({ label: value, type: kind === "word" ? "enum" : "text", info: description, detail: kind === "example" ? "such as" : "", boost: kind === "word" ? 5 : 0 }));
  const names = schema.kindsOfName(node, text).flatMap((kind) => namesOf(kind, root));
  const parameters = (child(root, "parameters")?.children ?? []).filter((c) => c.kind === "scalar").map((c) => ({ label: `\${${c.key}}`, apply: node.flow ? `"\${${c.key}}"` : `\${${c.key}}`, type: "variable", detail: text.slice(c.valueFrom, c.valueTo), boost: -20 }));
  return [...[...new Set(names)].map((name) => ({ label: name, type: "class", boost: 8 })), ...words, ...parameters];
}

function complete(context: CompletionContext, helpers: ModelHelpers): CompletionResult | null {
  const schema = helpers.schema();
  if (!schema) return null;
  const text = context.state.doc.toString();
  const root = readTree(text);
  const place = placeAt(root, text, context.pos);
  if (!place || (!context.explicit && place.written === "" && place.what === "key")) return null;
  // In the midst of a value nothing is offered unasked.
  const line = context.state.doc.lineAt(context.pos);
  if (!context.explicit && /^\s*[^\s,}\]#]/.test(text.slice(context.pos, line.to))) return null;
  const options = place.what === "key" ? keyCompletions(schema, place.map, text) : valueCompletions(schema, place.node, root, text, place.written);
  if (options.length === 0) return null;
  return { from: place.from, options, validFor: place.what === "key" ? /^\w*$/ : /^[-\w. ]*$/ };
}

function explanation(schema: ModelSchema, node: TextNode, text: string): HTMLElement | null {
  const help = schema.help(node, text);
  if (!help || (!help.description && help.kinds.length === 0)) return null;
  return h(
    "div",
    { class: "key-help" },
    h("p", { class: "key-help-title" }, pathOf(node).join(".")),
    help.description ? h("p", {}, help.description) : null,
    help.kinds.length > 0 ? h("p", {}, `${texts.help.allowed} `, ...help.kinds.flatMap((kind, i) => (i > 0 ? ["; ", kind] : [kind]))) : null,
    help.default ? h("p", {}, `${texts.help.default} `, h("code", {}, help.default)) : null,
  );
}

/** A value with a unit at a position. */
export function quantityAt(text: string, position: number): { from: number; to: number; value: string; unit: string } | null {
  const node = nodeAt(readTree(text), position);
  if (node.kind !== "scalar" || position < node.valueFrom || position > node.valueTo) return null;
  let [from, to] = [node.valueFrom, node.valueTo];
  if (/["']/.test(text[from]!)) [from, to] = [from + 1, to - 1];
  const match = quantityPattern.exec(text.slice(from, to));
  return match ? { from, to, value: match[0], unit: match[2]! } : null;
}

const showUnits = StateEffect.define<number | null>();

function unitsTooltip(helpers: ModelHelpers, at: { from: number; to: number; value: string; unit: string }): Tooltip {
  return {
    pos: at.from,
    above: false,
    create: (view: EditorView) => {
      const buttons = unitsLike(at.unit).map((unit) => {
        const button = h("button", { type: "button", class: "quiet" }, unit);
        button.addEventListener("click", () => {
          void helpers.convert(at.value, unit).then(
            (insert) => {
              if (view.state.sliceDoc(at.from, at.to) !== at.value) return;
              view.dispatch({ changes: { from: at.from, to: at.to, insert }, selection: { anchor: at.from }, effects: showUnits.of(null), userEvent: "input" });
              view.focus();
            },
            (error: Error) => helpers.say(error.message),
          );
        });
        return button;
      });
      const dom = h("div", { class: "unit-choice", role: "group", "aria-label": texts.convert }, h("span", {}, texts.convert), ...buttons);
      dom.addEventListener("keydown", (event) => {
        if (event.key !== "Escape") return;
        view.dispatch({ effects: showUnits.of(null) });
        view.focus();
      });
      return { dom };
    },
  };
}

function unitField(helpers: ModelHelpers): StateField<Tooltip | null> {
  return StateField.define<Tooltip | null>({
    create: () => null,
    update(value, transaction) {
      if (transaction.docChanged) return null;
      let place: number | null | undefined;
      for (const effect of transaction.effects) if (effect.is(showUnits)) place = effect.value;
      if (place === undefined && transaction.selection) {
        const { main } = transaction.state.selection;
        place = transaction.isUserEvent("select.pointer") && main.empty ? main.head : null;
      }
      if (place === undefined) return value;
      if (place === null) return null;
      const at = quantityAt(transaction.state.doc.toString(), place);
      return at && unitsLike(at.unit).length > 0 ? unitsTooltip(helpers, at) : null;
    },
    provide: (field) => showTooltip.from(field),
  });
}

const showHelp = StateEffect.define<number | null>();

function helpField(helpers: ModelHelpers): StateField<Tooltip | null> {
  return StateField.define<Tooltip | null>({
    create: () => null,
    update(value, transaction) {
      if (transaction.docChanged || transaction.selection) return null;
      for (const effect of transaction.effects)
        if (effect.is(showHelp)) {
          if (effect.value === null) return null;
          return tooltipAt(helpers, transaction.state.doc.toString(), effect.value);
        }
      return value;
    },
    provide: (field) => showTooltip.from(field),
  });
}

function tooltipAt(helpers: ModelHelpers, text: string, position: number): (Tooltip & { end: number }) | null {
  const schema = helpers.schema();
  const node = nodeAt(readTree(text), position);
  const dom = schema && node.parent && node.kind !== "loose" ? explanation(schema, node, text) : null;
  if (!dom) return null;
  const inKey = position <= node.keyTo;
  return { pos: inKey ? node.from : node.valueFrom, end: inKey ? node.keyTo : node.valueTo, above: true, create: () => ({ dom }) };
}

/** Opens the units of the value under the cursor and goes there; says whether there is one. */
export function offerUnits(view: EditorView): boolean {
  const { head } = view.state.selection.main;
  const at = quantityAt(view.state.doc.toString(), head);
  if (!at || unitsLike(at.unit).length === 0) return false;
  view.dispatch({ effects: showUnits.of(head) });
  requestAnimationFrame(() => view.dom.querySelector<HTMLElement>(".unit-choice button")?.focus());
  return true;
}

export function explainHere(view: EditorView, helpers: ModelHelpers): boolean {
  const { head } = view.state.selection.main;
  if (!tooltipAt(helpers, view.state.doc.toString(), head)) return false;
  view.dispatch({ effects: showHelp.of(head) });
  return true;
}

export function modelHelp(helpers: ModelHelpers): Extension {
  return [
    yamlLanguage.data.of({ autocomplete: (context: CompletionContext) => complete(context, helpers) }),
    hoverTooltip((view, position) => tooltipAt(helpers, view.state.doc.toString(), position), { hoverTime: 350 }),
    unitField(helpers),
    helpField(helpers),
  ];
}
