// The runs of the folder and what is shown of one of them: the list, its plots, its log; starting and stopping.

import type { Api, Hello, RunEntry, RunEvent } from "./api";
import type { OpenDocument } from "./editor";
import { Tabs } from "./layout";
import { LivePane } from "./live_pane";
import type { OpenReport } from "./memory";
import { RunsPane } from "./runs_pane";
import { Starter } from "./starter";
import { StudyPane } from "./study_pane";
import { texts } from "./texts";

export interface RunPanesHooks {
  api: Api;
  hello: Hello;
  model: () => OpenDocument | null;
  isReady: () => boolean;
  isAlone: () => boolean;
  /** Shows the operating point of a bearing by itself. */
  showPoint: () => void;
  save: (document: OpenDocument) => Promise<boolean>;
  openReport: (report: OpenReport) => void;
  /** Radial clearance of a bearing of the model as it is drawn [m]. */
  clearance: (bearing: string) => number | undefined;
  /** Shows the part of its model that a failed run is about. */
  showPlace: (run: RunEntry) => void;
  /** The list of runs is another one. */
  listed: () => void;
  /** Another run or tab is shown. */
  changed: () => void;
  say: (words: string) => void;
  fail: (error: unknown) => void;
}

export class RunPanes {
  readonly list: RunsPane;
  readonly live: LivePane;
  readonly starter: Starter;
  readonly study: StudyPane;
  readonly tabs: Tabs;

  /** @param problems  what stands first below: the list of faults */
  constructor(
    private readonly hooks: RunPanesHooks,
    problems: HTMLElement,
  ) {
    const { api, hello, model, isReady, isAlone, showPoint, save, openReport, showPlace, changed, say, fail } = hooks;
    this.live = new LivePane(api, (run, bearing) => this.clearanceOf(run, bearing));
    this.list = new RunsPane({ api, say, chosen: (run) => void this.show(run), openReport, showPlace, changed: () => this.listed() });
    const started = (run: RunEntry) => (this.tabs.show(run.study ? "study" : "live"), this.show(run));
    const hasStudy = () => this.study.hasStudy;
    const planStudy = () => (this.tabs.show("study"), this.study.focusStart());
    this.starter = new Starter({ api, runs: this.list, model, isReady, isAlone, showPoint, shownRun: () => this.live.shownRun, save, started, hasStudy, isWrittenOut: () => this.study.isWrittenOut, planStudy, say, fail });
    const studies = () => this.list.runs.filter(({ study }) => study);
    const counted = (runs: number) => this.tabs?.label("study", texts.studyTab(runs));
    this.study = new StudyPane({ api, machine: hello, model, studies, start: (request) => this.starter.begin(request), act: (run, what) => this.list.act(run, what), showLive: (id, part, label) => void this.showPart(id, part, label), counted });
    const contents = [
      { key: "problems", label: texts.problems, content: problems },
      { key: "live", label: texts.live, content: this.live.element },
      { key: "study", label: texts.study, content: this.study.element },
      { key: "log", label: texts.log, content: this.live.log },
    ];
    this.tabs = new Tabs(texts.panes.below, contents, (key) => {
      if (key === "log") void this.live.readLog();
      if (key === "study") setTimeout(() => this.study.refresh());
      changed();
    });
  }

  load(): Promise<void> {
    return this.list.load().catch(() => undefined);
  }

  hear(event: RunEvent): void {
    this.live.hear(event);
    if (event.share !== undefined) this.list.progress(event.id, event.share);
    if (event.kind === "finished" || event.kind === "started") void this.load();
    if ((event.kind === "finished" || event.kind === "warning") && event.id === this.live.shownRun) this.readShownLog();
  }

  /** The run that was shown before, or one that goes on. */
  async showLast(id: string | undefined): Promise<void> {
    const last = this.list.runs.find((run) => run.id === id) ?? this.list.running[0];
    if (last) await this.show(last, false);
  }

  private async show(run: RunEntry, open = true): Promise<void> {
    this.list.select(run.id);
    if (run.study) this.study.show(run.id);
    if (open && (run.study ? this.tabs.current !== "log" : ["problems", "study"].includes(this.tabs.current))) this.tabs.show(run.study ? "study" : "live");
    await this.live.show(run);
    this.hooks.changed();
  }

  /** One run of a study that goes on. */
  private async showPart(id: string, part: string, label: string): Promise<void> {
    const run = this.list.runs.find((r) => r.id === id);
    if (!run) return;
    this.tabs.show("live");
    await this.live.show(run, { id: part, label });
  }

  private listed(): void {
    this.live.update(this.list.runs);
    this.starter.showButtons();
    this.study.listed();
    this.hooks.listed();
    const shown = this.list.runs.find(({ id }) => id === this.live.shownRun);
    if (shown && shown.state !== "running") this.readShownLog();
  }

  private readShownLog(): void {
    if (this.tabs.current === "log") void this.live.readLog();
  }

  /** Of a run whose model is the open one, unchanged since; else nobody knows it here. */
  private clearanceOf(run: RunEntry, bearing: string): number | undefined {
    const model = this.hooks.model();
    const isOpen = model && run.set.length === 0 && run.model === model.path && this.list.textOf(run.id) === model.state.doc.toString();
    return isOpen ? this.hooks.clearance(bearing) : undefined;
  }
}
