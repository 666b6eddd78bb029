// Windows that ask something: which template to begin with, which of two texts, what keys there are.

import { MergeView } from "@codemirror/merge";
import { EditorState } from "@codemirror/state";
import { EditorView, lineNumbers } from "@codemirror/view";
import { yaml } from "@codemirror/lang-yaml";
import type { Template } from "./api";
import { h } from "../src/dom";
import { isDark } from "../src/theme";
import { texts } from "./texts";

/** A window over the page, closed by Escape. */
export function dialog(title: string, kind: string, ...content: (HTMLElement | null)[]): HTMLDialogElement {
  const id = `dialog-${kind}`;
  const close = h("button", { type: "button", class: "quiet", "aria-label": texts.close, click: () => element.close() }, "✕");
  const element = h("dialog", { class: `window ${kind}`, "aria-labelledby": id }, h("div", { class: "window-head" }, h("h2", { id }, title), close), ...content);
  element.addEventListener("close", () => element.remove());
  document.body.append(element);
  element.showModal();
  return element;
}

export function showKeys(): void {
  dialog(texts.keys.title, "keys", h("table", { class: "keys-table" }, h("tbody", {}, ...texts.keys.list.map(([keys, words]) => h("tr", {}, h("th", { scope: "row" }, h("kbd", {}, keys)), h("td", {}, words))))));
}

/** A question with a few answers; null where the window is closed. */
export function ask(title: string, answers: { value: string; label: string }[]): Promise<string | null> {
  return new Promise((resolve) => {
    let answer: string | null = null;
    const buttons = answers.map(({ value, label }, i) => h("button", { type: "button", class: i === 0 ? "main-button" : "quiet", autofocus: i === 0, click: () => ((answer = value), window.close()) }, label));
    const window = dialog(title, "question", h("div", { class: "window-tools" }, ...buttons));
    window.addEventListener("close", () => resolve(answer));
  });
}

/** Which text a file shall have; null: not decided. */
export function askTexts(name: string, mine: string, theirs: string): Promise<string | null> {
  return new Promise((resolve) => {
    let answer: string | null = null;
    const holder = h("div", { class: "merge" });
    const take = (text: () => string) => () => ((answer = text()), window.close());
    const window = dialog(
      texts.conflict.title(name),
      "conflict",
      h("p", { class: "note" }, texts.conflict.words),
      holder,
      h(
        "div",
        { class: "window-tools" },
        h("button", { type: "button", class: "main-button", click: take(() => view.a.state.doc.toString()) }, texts.conflict.mine),
        h("button", { type: "button", class: "quiet", click: take(() => theirs) }, texts.conflict.theirs),
        h("button", { type: "button", class: "quiet", click: () => window.close() }, texts.conflict.later),
      ),
    );
    const common = (label: string) => [lineNumbers(), yaml(), EditorView.theme({}, { dark: isDark() }), EditorView.contentAttributes.of({ "aria-label": label, tabindex: "0" })];
    const view = new MergeView({
      parent: holder,
      a: { doc: mine, extensions: common(texts.conflict.mine) },
      b: { doc: theirs, extensions: [...common(texts.conflict.theirs), EditorState.readOnly.of(true)] },
      revertControls: "b-to-a",
      collapseUnchanged: { margin: 3, minSize: 6 },
    });
    window.addEventListener("close", () => {
      view.destroy();
      resolve(answer);
    });
  });
}

/** Which template, and what the file is called; null where nothing is begun. */
export function askTemplate(templates: Template[]): Promise<{ template: string; path: string } | null> {
  return new Promise((resolve) => {
    let answer: { template: string; path: string } | null = null;
    const preview = h("pre", { class: "template-text", tabindex: 0, "aria-label": texts.templates.preview });
    const path = h("input", { type: "text", required: true, spellcheck: "false", autocomplete: "off", id: "template-path" });
    const list = h("select", { size: 14, "aria-label": texts.templates.choose, class: "template-list" }, ...templates.map(({ name, title }) => h("option", { value: name }, title ? `${title} (${name})` : name)));
    const choose = () => {
      const template = templates.find(({ name }) => name === list.value);
      if (!template) return;
      preview.textContent = template.text;
      preview.scrollTop = 0;
      path.value = `${template.name.split("/").pop()}.yaml`;
    };
    list.addEventListener("change", choose);
    const form = h(
      "form",
      { method: "dialog" },
      h("p", { class: "note" }, texts.templates.words),
      h("div", { class: "template-choice" }, list, preview),
      h("div", { class: "window-tools" }, h("label", { for: "template-path" }, texts.templates.path), path, h("button", { type: "submit", class: "main-button" }, texts.templates.create)),
    );
    form.addEventListener("submit", () => (answer = { template: list.value, path: path.value.trim() }));
    const window = dialog(texts.templates.title, "templates", form);
    if (templates[0]) list.value = templates[0].name;
    choose();
    list.focus();
    window.addEventListener("close", () => resolve(answer));
  });
}
