// What the program says of the model's text, asked as the text changes: faults, warnings, what is missing, and the machine.

import type { Diagnostic } from "@codemirror/lint";
import type { Text } from "@codemirror/state";
import type { Api, Edit, Fault } from "./api";
import type { Editor, OpenDocument } from "./editor";
import type { SceneText } from "./machine_pane";
import { diagnostics, type Findings } from "./problems";
import { texts } from "./texts";

export interface Checked extends Findings {
  runs: number;
  parameters: Record<string, unknown>;
  scene: SceneText | null;
}

export interface CheckerHooks {
  api: Api;
  editor: Editor;
  model: () => OpenDocument | null;
  /** The machine as the text says; null where faults prevent it. */
  scene: (scene: SceneText | null, document: OpenDocument) => void;
  found: (findings: Findings | null, runs?: number) => void;
  atWork: (is: boolean) => void;
  /** Shows the model's text. */
  showModel: () => void;
  say: (words: string) => void;
  fail: (error: unknown) => void;
}

/** Faults that only the start of a run shows, not its text. */
const startFaults = new WeakSet<Fault>();
const isOfStart = (fault: Fault) => startFaults.has(fault);

/** The text that a repair's edits were made for: their lines and columns hold in no other one. */
const textOfEdits = new WeakMap<Edit[], Text>();

function noteText({ faults, warnings }: Findings, doc: Text): void {
  for (const fault of [...faults, ...warnings]) for (const { edits } of fault.repairs ?? []) textOfEdits.set(edits, doc);
}

/** Pause of typing before a text is checked [ms]: a share of what the last answer took, so that those who type fast do
 *  not wait behind answers that nobody wants any longer. */
const leastPause = 8;
const mostPause = 150;
const pauseShare = 0.3;
/** Further pause before the start of its run is tried [ms]. */
const restPause = 200;

export class Checker {
  findings: Findings | null = null;
  private checks = 0;
  private timer = 0;
  /** How long the last answer took [ms]. */
  private took = 0;

  constructor(private readonly hooks: CheckerHooks) {}

  /** Another model: nothing that was found of the last one is said of it. */
  forget(): void {
    this.checks++;
    this.findings = null;
    this.hooks.found(null);
    this.hooks.atWork(false);
  }

  soon(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.now(), Math.min(mostPause, Math.max(leastPause, pauseShare * this.took)));
  }

  now(): void {
    clearTimeout(this.timer);
    void this.check();
  }

  private async check(): Promise<void> {
    const { api, model, scene, atWork, fail } = this.hooks;
    const document = model();
    if (!document) return;
    const count = ++this.checks;
    const { doc } = document.state;
    atWork(true);
    const ask = (depth: "text" | "start", withScene: boolean) => api.post<Checked>("/api/check", { path: document.path, text: doc.toString(), depth, scene: withScene });
    // An older text's answer is of no use once a newer one is asked about.
    const isOld = () => count !== this.checks || document !== model() || document.state.doc !== doc;
    try {
      const asked = performance.now();
      const read = await ask("text", true);
      this.took = performance.now() - asked;
      if (isOld()) return;
      noteText(read, doc);
      const isReadable = read.faults.length === 0;
      // What the start of the run was found to be last stays until it is known of this text.
      const shown = isReadable && this.findings ? { ...read, faults: this.findings.faults.filter(isOfStart), warnings: this.findings.warnings } : read;
      this.show(document, shown);
      scene(read.scene, document);
      performance.mark("hersey-checked");
      if (!isReadable) return;
      // It takes longer: it waits until the hands rest.
      await new Promise((resolve) => setTimeout(resolve, restPause));
      if (isOld()) return;
      const started = await ask("start", false);
      if (isOld()) return;
      noteText(started, doc);
      for (const fault of started.faults) startFaults.add(fault);
      this.show(document, started);
    } catch (error) {
      if (count === this.checks) fail(error);
    } finally {
      if (count === this.checks) atWork(false);
    }
  }

  private show(document: OpenDocument, answer: Checked): void {
    this.findings = { faults: answer.faults, warnings: answer.warnings, missing: answer.missing ?? [] };
    this.hooks.editor.setFaults(document, diagnostics(document.state.doc, document.path, this.findings, (edits) => this.repair(edits)) as Diagnostic[]);
    this.hooks.found(this.findings, answer.runs);
  }

  repair(edits: Edit[]): void {
    const { editor, model, showModel, say } = this.hooks;
    const document = model();
    if (!document) return;
    if (!textOfEdits.get(edits)?.eq(document.state.doc)) {
      say(texts.repairOld);
      this.now();
      return;
    }
    showModel();
    editor.edit(document, edits);
    this.now();
    editor.view.focus();
  }

  repairHere(): boolean {
    const { editor } = this.hooks;
    const found = editor.faultAtCursor();
    const action = found?.diagnostic.actions?.[0];
    if (!found || !action) return false;
    action.apply(editor.view, found.from, found.to);
    return true;
  }

  /** The next fault or warning after the cursor, or the one before it; null: there is none. */
  next(step: number): Fault | null {
    const all = [...(this.findings?.faults ?? []), ...(this.findings?.warnings ?? [])].filter(({ line }) => line > 0).sort((a, b) => a.line - b.line || a.column - b.column);
    if (all.length === 0) return null;
    const { state } = this.hooks.editor.view;
    const here = state.doc.lineAt(state.selection.main.head);
    const column = state.selection.main.head - here.from + 1;
    const after = (f: Fault) => f.line > here.number || (f.line === here.number && f.column > column);
    const before = (f: Fault) => f.line < here.number || (f.line === here.number && f.column < column);
    return step > 0 ? (all.find(after) ?? all[0]!) : ([...all].reverse().find(before) ?? all[all.length - 1]!);
  }
}
