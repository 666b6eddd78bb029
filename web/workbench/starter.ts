// Starting the model that is open as a run or a study, with values of its text or other ones, and stopping the run that is shown.

import type { Api, RunEntry } from "./api";
import { h } from "../src/dom";
import { ask } from "./dialogs";
import type { OpenDocument } from "./editor";
import { askOverrides } from "./overrides";
import type { RunsPane } from "./runs_pane";
import { texts } from "./texts";

export interface StarterHooks {
  api: Api;
  runs: RunsPane;
  model: () => OpenDocument | null;
  /** Whether the model can run. */
  isReady: () => boolean;
  /** Whether it is a bearing by itself, whose operating point is shown instead. */
  isAlone: () => boolean;
  showPoint: () => void;
  shownRun: () => string;
  save: (document: OpenDocument) => Promise<boolean>;
  started: (run: RunEntry) => Promise<void>;
  /** Whether the model plans a study, which is shown before it is started. */
  hasStudy: () => boolean;
  /** Whether `hersey run` does its runs as well: all combinations of lists. */
  isWrittenOut: () => boolean;
  planStudy: () => void;
  say: (words: string) => void;
  fail: (error: unknown) => void;
}

/** What a run takes besides the model. */
export interface StartRequest {
  set: string[];
  study?: true;
  on?: string;
  jobs?: number;
}

export class Starter {
  readonly runButton = h("button", { type: "button", class: "main-button", click: () => void this.run() }, texts.run);
  readonly runWithButton = h("button", { type: "button", class: "quiet", title: texts.overrides.help, click: () => void this.runWith() }, texts.overrides.runWith);
  readonly stopButton = h("button", { type: "button", class: "quiet stop", disabled: true, click: () => void this.stop() }, texts.stop);
  private isStarting = false;

  constructor(private readonly hooks: StarterHooks) {}

  /** A second start has to wait until the first one is known. */
  showButtons(): void {
    const hasStudy = this.hooks.hasStudy();
    const isReady = this.hooks.isReady() && !this.isStarting;
    this.runButton.textContent = hasStudy ? texts.studies.open : texts.run;
    const isAlone = this.hooks.isAlone() && !hasStudy;
    this.runButton.title = isAlone ? texts.runAlone : "";
    this.runButton.disabled = !isReady && !hasStudy && !isAlone;
    this.runWithButton.disabled = !isReady || (hasStudy && !this.hooks.isWrittenOut());
    this.stopButton.disabled = this.hooks.runs.running.length === 0;
  }

  /** A study is planned first. */
  async run(): Promise<void> {
    if (this.runButton.disabled) return;
    if (this.hooks.hasStudy()) this.hooks.planStudy();
    else if (this.hooks.isAlone()) this.hooks.showPoint();
    else await this.begin({ set: [] });
  }

  /** Asks for other values first. */
  async runWith(): Promise<void> {
    const document = this.hooks.model();
    if (!document || this.runWithButton.disabled) return;
    const set = await askOverrides(this.hooks.api, document);
    if (set) await this.begin({ set });
  }

  async begin(request: StartRequest): Promise<void> {
    const document = this.hooks.model();
    if (!document || this.isStarting) return;
    this.isStarting = true;
    this.showButtons();
    try {
      await this.start(document, request);
    } catch (error) {
      this.hooks.fail(error);
    } finally {
      this.isStarting = false;
      this.showButtons();
    }
  }

  private async start(document: OpenDocument, request: StartRequest): Promise<void> {
    const { api, runs, save, say, started } = this.hooks;
    if (document.isDirty) {
      const answer = await ask(texts.saveFirst(document.name), [
        { value: "save", label: texts.saveAndRun },
        { value: "cancel", label: texts.cancel },
      ]);
      if (answer !== "save" || !(await save(document))) return;
    }
    const { id } = await api.post<{ id: string }>("/api/runs", { path: document.path, etag: document.etag, ...request });
    say(texts.started(id));
    await runs.load();
    const run = runs.runs.find((r) => r.id === id);
    if (run) await started(run);
  }

  async stop(): Promise<void> {
    const { api, runs, shownRun, fail } = this.hooks;
    const run = runs.running.find(({ id }) => id === shownRun()) ?? runs.running[0];
    if (!run) return;
    try {
      await api.post(`/api/runs/${encodeURIComponent(run.id)}/stop`);
      await runs.load();
    } catch (error) {
      fail(error);
    }
  }
}
