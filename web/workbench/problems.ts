// What is wrong with the model and what it lacks, as a list one can walk through.

import type { Diagnostic } from "@codemirror/lint";
import type { Text } from "@codemirror/state";
import type { Edit, Fault } from "./api";
import { h } from "../src/dom";
import { offset } from "./editor";
import { texts } from "./texts";

export interface Findings {
  faults: Fault[];
  warnings: Fault[];
  missing: string[];
}

/** Whether a text without faults is complete as bearings by themselves: only a machine around them is missing. */
export function isAlone({ faults, missing }: Findings): boolean {
  return faults.length === 0 && missing.length > 0 && missing.every((text) => /^(bodies|simulation):/.test(text));
}

export function sentence(fault: Fault): string {
  const parts = [fault.message || fault.found];
  if (!fault.message && fault.expected) parts.push(texts.expected(fault.expected));
  if (!fault.message && fault.suggestion) parts.push(fault.suggestion);
  return parts.filter((part) => part).join("; ");
}

/** As the editor marks them; those of other files are left to the list. */
export function diagnostics(doc: Text, path: string, { faults, warnings }: Findings, repair: (edits: Edit[]) => void): Diagnostic[] {
  const isHere = (fault: Fault) => !fault.file || fault.file === path || fault.file.endsWith(`/${path}`);
  const mark = (severity: "error" | "warning") => (fault: Fault): Diagnostic => {
    const from = offset(doc, fault.line, fault.column);
    const line = doc.lineAt(from);
    const word = /^[\w.$-]+/.exec(line.text.slice(from - line.from))?.[0].length ?? Math.max(1, line.to - from);
    const to = fault.endColumn && fault.endColumn > fault.column ? offset(doc, fault.line, fault.endColumn) : Math.min(line.to, from + word);
    return {
      from,
      to: Math.max(from, to),
      severity,
      message: sentence(fault),
      actions: (fault.repairs ?? []).map(({ label, edits }) => ({ name: label, apply: () => repair(edits) })),
    };
  };
  return [...faults.filter(isHere).map(mark("error")), ...warnings.filter(isHere).map(mark("warning"))].sort((a, b) => a.from - b.from);
}

export class ProblemList {
  readonly element = h("div", { class: "problems" });

  constructor(
    private readonly goTo: (fault: Fault) => void,
    private readonly repair: (edits: Edit[]) => void,
  ) {}

  /** @param instead  said where nothing is known yet */
  show(findings: Findings | null, instead: string = texts.noModel): void {
    if (!findings) {
      this.element.replaceChildren(h("p", { class: "note" }, instead));
      return;
    }
    const { faults, warnings, missing } = findings;
    const rows = [...faults.map((f) => this.row(f, "fault")), ...warnings.map((f) => this.row(f, "warning"))];
    this.element.replaceChildren(
      ...(rows.length > 0 ? [h("ul", { class: "problem-list" }, ...rows)] : [h("p", { class: "good-news" }, texts.noProblems)]),
      ...(missing.length > 0 ? [h("h3", {}, isAlone(findings) ? texts.missingInMachine : texts.missing), h("ul", { class: "missing" }, ...missing.map((text) => h("li", {}, text)))] : []),
    );
  }

  private row(fault: Fault, kind: "fault" | "warning"): HTMLElement {
    const where = h("span", { class: "problem-place" }, fault.line > 0 ? texts.line(fault.line) : fault.path);
    const go = h("button", { type: "button", class: "problem", click: () => this.goTo(fault) }, h("span", { class: `problem-kind ${kind}` }, texts[kind]), where, h("span", { class: "problem-text" }, sentence(fault)));
    const repairs = (fault.repairs ?? []).map(({ label, edits }) => h("button", { type: "button", class: "quiet repair", click: () => this.repair(edits) }, label));
    return h("li", {}, go, ...repairs);
  }
}
