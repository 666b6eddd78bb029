// Values that a run takes in place of the text's, as `--set` of the command line.

import type { Api, Fault } from "./api";
import { dialog } from "./dialogs";
import { h } from "../src/dom";
import type { OpenDocument } from "./editor";
import { sentence } from "./problems";
import { texts } from "./texts";

/** A field of lines NAME=VALUE. */
export class OverridesField {
  readonly element: HTMLElement;
  private readonly field: HTMLTextAreaElement;
  private readonly words = h("ul", { class: "override-faults", role: "status" });

  constructor(changed: () => void, rows = 1) {
    this.field = h("textarea", { rows, class: "overrides", spellcheck: "false", autocomplete: "off", placeholder: rows === 1 ? `${texts.overrides.label}: NAME=VALUE` : "NAME=VALUE", title: texts.overrides.help, "aria-label": texts.overrides.label });
    this.field.addEventListener("input", changed);
    this.element = h("span", { class: "override-field" }, this.field, this.words);
  }

  get values(): string[] {
    return this.field.value.split("\n").map((line) => line.trim().replace(/^([^=]*?)\s*=\s*/, "$1=")).filter((line) => line !== "");
  }

  say(lines: string[], kind: "bad" | "good" = "bad"): void {
    this.words.replaceChildren(...lines.map((line) => h("li", { class: kind }, line)));
  }

  focus(): void {
    this.field.focus();
  }
}

/** Pause of typing before values are checked [ms]. */
const pause = 150;

/** Asks for other values of a model, which are checked as they are written; null where nothing is to be run. */
export function askOverrides(api: Api, document: OpenDocument): Promise<string[] | null> {
  return new Promise((resolve) => {
    let answer: string[] | null = null;
    let count = 0;
    let timer = 0;
    const start = h("button", { type: "submit", class: "main-button" }, texts.overrides.start);
    const check = async () => {
      const now = ++count;
      const set = field.values;
      const odd = set.filter((line) => !/^[^=\s]+\s*=\s*\S/.test(line));
      let faults = odd.map((line) => texts.overrides.noEquals(line));
      try {
        if (faults.length === 0) {
          const found = await api.post<{ faults: Fault[]; missing: string[] }>("/api/check", { path: document.path, text: document.state.doc.toString(), set, depth: "start", scene: false });
          faults = [...found.faults.map(sentence), ...found.missing];
        }
      } catch (error) {
        faults = [error instanceof Error ? error.message : String(error)];
      }
      if (now !== count) return;
      start.disabled = faults.length > 0;
      if (faults.length > 0) field.say(faults);
      else field.say(set.length > 0 ? [texts.overrides.checked] : [], "good");
    };
    const field = new OverridesField(() => {
      start.disabled = true;
      clearTimeout(timer);
      timer = window.setTimeout(() => void check(), pause);
    }, 5);
    const form = h("form", { method: "dialog" }, h("p", { class: "note" }, texts.overrides.help), field.element, h("div", { class: "window-tools" }, start));
    form.addEventListener("submit", () => (answer = field.values));
    // Enter begins a new line; with Ctrl it starts.
    form.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" || !(event.ctrlKey || event.metaKey)) return;
      event.preventDefault();
      // The page starts a run by the same keys, of the text as it is.
      event.stopPropagation();
      if (!start.disabled) form.requestSubmit();
    });
    const window_ = dialog(texts.overrides.title(document.name), "overrides", form);
    window_.addEventListener("close", () => (clearTimeout(timer), resolve(answer)));
    void check();
    field.focus();
  });
}
