// Windows that ask something: which template to begin with, which of two texts, what keys there are.

import { MergeView } from "@codemirror/merge";
import { EditorState } from "@codemirror/state";
import { EditorView, lineNumbers } from "@codemirror/view";
import { yaml } from "@codemirror/lang-yaml";
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
  dialog(texts.keys.title, "keys", h("table", { class: "keys-table" }, h("tbody", {}, ...texts.keys.list.map(([keys, words]) => h("tr", {}, h("th", { scope: "row" }, h("kbd", {}, keys)), h("td", {}, words))))), h("p", { class: "note" }, h("a", { href: "/licences.txt", target: "_blank", rel: "noreferrer" }, texts.licences)));
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
