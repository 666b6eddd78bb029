// How the model stands, in a few words: the button in the bar, and the same for screen readers.

import { h } from "../src/dom";
import { isAlone, type Findings } from "./problems";
import { texts } from "./texts";

export class CheckState {
  readonly button: HTMLElement;
  readonly announcer = h("div", { class: "visually-hidden", role: "status" });
  /** Whether the model can run. */
  isReady = false;
  /** Whether it is a bearing by itself, which is solved rather than run. */
  isAlone = false;

  constructor(clicked: () => void) {
    this.button = h("button", { type: "button", class: "check-state", click: clicked });
  }

  atWork(is: boolean): void {
    this.button.classList.toggle("at-work", is);
  }

  /** @param hasModel  whether there is a model at all */
  show(findings: Findings | null, runs: number, hasModel: boolean): void {
    const { faults, warnings, missing } = findings ?? { faults: [], warnings: [], missing: [] };
    const isReady = faults.length === 0 && missing.length === 0;
    this.isAlone = findings !== null && isAlone(findings);
    const ready = this.isAlone ? texts.state.alone : isReady ? texts.state.good(runs) : texts.state.missing(missing.length);
    const words = !findings ? (hasModel ? texts.state.checking : texts.state.none) : faults.length > 0 ? texts.state.faults(faults.length) : [ready, ...(warnings.length > 0 ? [texts.state.warnings(warnings.length)] : [])].join(", ");
    const kind = !findings ? "none" : faults.length > 0 ? "bad" : warnings.length > 0 || !(isReady || this.isAlone) ? "warn" : "good";
    if (this.button.textContent !== words) this.announcer.textContent = words;
    this.button.textContent = words;
    this.button.dataset["kind"] = kind;
    this.isReady = findings !== null && isReady;
  }
}
