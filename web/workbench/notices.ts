// Words of the page to who works with it: passing ones, and ones that stay until their matter is settled.

import { h } from "../src/dom";
import { texts } from "./texts";

/** How long a passing word stays [ms]. */
const passing = 4500;

export class Notices {
  readonly element = h("div", { class: "notices", "aria-live": "polite" });

  /** A word that goes by itself; empty: away with the last one. */
  say(words: string): void {
    this.element.querySelector(".passing")?.remove();
    if (!words) return;
    const line = h("p", { class: "notice passing" }, words, h("button", { type: "button", class: "quiet", "aria-label": texts.dismiss, click: () => line.remove() }, "✕"));
    this.element.append(line);
    setTimeout(() => line.remove(), passing);
  }

  /** A word that stays until its matter, `key`, is settled. */
  keep(key: string, words: string, actions: { label: string; act: () => void }[] = []): void {
    this.drop(key);
    const line = h("p", { class: "notice", "data-notice": key }, words, ...actions.map(({ label, act }) => h("button", { type: "button", class: "quiet", click: act }, label)), h("button", { type: "button", class: "quiet", "aria-label": texts.dismiss, click: () => line.remove() }, "✕"));
    this.element.append(line);
  }

  drop(key: string): void {
    this.element.querySelector(`[data-notice="${CSS.escape(key)}"]`)?.remove();
  }
}
