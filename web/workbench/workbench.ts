// The page as a whole: what joins its panes, the texts that are open, and what the program says.

import { Unreachable, Refused, sentences, type Api, type Hello } from "./api";
import { h } from "../src/dom";
import { CheckState } from "./check_state";
import { Checker } from "./checker";
import { DocumentFiles } from "./document_files";
import { Documents } from "./documents";
import type { Editor, OpenDocument } from "./editor";
import { FileList } from "./file_list";
import { bar, frame, nextPane } from "./frame";
import { listenToKeys } from "./keys";
import type { SceneText } from "./machine_pane";
import type { MeshTarget } from "./mesh_window";
import { modelEditor } from "./model_editor";
import { ModelPanes } from "./model_panes";
import { Memory, type OpenReport, type Remembered } from "./memory";
import { ModelSchema, type Schema } from "./model_schema";
import { News } from "./news";
import { Notices } from "./notices";
import { Outline } from "./outline";
import { Places } from "./places";
import { ProblemList, type Findings } from "./problems";
import { RunPanes } from "./run_panes";
import { texts } from "./texts";
import { ValueEdits } from "./value_edits";

export class Workbench {
  readonly element: HTMLElement;
  private readonly notices = new Notices();
  private readonly memory = new Memory();
  private readonly editor: Editor;
  private readonly documentFiles: DocumentFiles;
  private readonly documents: Documents;
  private readonly fileList: FileList;
  private readonly checker: Checker;
  private readonly values: ValueEdits;
  private readonly checkState: CheckState;
  private readonly places: Places;
  private readonly panes: ModelPanes;
  private readonly runs: RunPanes;
  private readonly problems: ProblemList;
  private readonly outline: Outline;
  private readonly news: News;
  private readonly saveButton = h("button", { type: "button", class: "quiet", click: () => this.save() }, texts.save);
  private readonly old: Remembered | null;
  private readonly sizes: Record<string, number>;
  private schema: ModelSchema | null = null;
  private isLeaving = false;
  private isRecalled = false;

  constructor(
    private readonly api: Api,
    private readonly hello: Hello,
  ) {
    this.old = this.memory.recall(hello.folder);
    this.sizes = this.old?.sizes ?? {};
    const { notices } = this;
    const say = (words: string) => notices.say(words);
    const fail = (error: unknown) => this.fail(error);
    const model = () => this.documents.model;
    const changed = () => this.rememberSoon();
    const editor = (this.editor = modelEditor({ api, schema: () => this.schema, changed: (document) => this.textChanged(document), moved: (document) => this.cursorMoved(document), repair: () => this.checker.repairHere(), run: () => void this.runs.starter.run(), say }));
    const documentFiles = (this.documentFiles = new DocumentFiles({ api, editor, notices, fail, changed: () => this.documents.show() }));
    const openReport = (report: OpenReport) => this.documents.openReport(report);
    const begin = () => void this.fileList.begin();
    this.documents = new Documents({ editor, documentFiles, modelTaken: (document) => this.modelTaken(document), shown: () => this.documentShown(), begin });
    const opened = (path: string) => (this.documents.activate(path), editor.view.focus());
    this.fileList = new FileList({ api, editor, runs: () => this.runs.list.runs, active: () => this.documents.active, openReport, opened, say, fail, meshTarget: () => this.meshTarget() });
    this.checker = new Checker({ api, editor, model, scene: (scene, document) => this.showScene(scene, document), found: (findings, runs) => this.found(findings, runs), atWork: (is) => this.checkState.atWork(is), showModel: () => this.documents.showModel(), say, fail });
    const values = (this.values = new ValueEdits({ api, editor, model, changed: () => this.checker.now(), say, fail }));
    this.panes = new ModelPanes({ api, openReport, model, schema: () => this.schema, set: (key, value) => values.set(key, value), goToKey: (key) => this.places.goToKey(key), goToPart: (part) => this.places.goToPart(part), say, changed });
    this.places = new Places({ editor, documents: this.documents, fileList: this.fileList, panes: this.panes });
    this.problems = new ProblemList((fault) => this.places.goToFault(fault), (edits) => this.checker.repair(edits));
    this.checkState = new CheckState(() => this.showProblems());
    const clearance = (bearing: string) => this.panes.machine.run?.number(`/bearings/${bearing}`, "radial_clearance");
    this.runs = new RunPanes({ api, hello, model, isReady: () => this.checkState.isReady, isAlone: () => this.checkState.isAlone, showPoint: () => this.panes.tabs.show("point"), save: (document) => documentFiles.save(document), openReport, clearance, showPlace: (run) => void this.places.goToPlace(run.at?.file || run.model, run.at ?? null), listed: () => this.fileList.draw(), changed, say, fail }, this.problems.element);
    this.outline = new Outline((at) => this.places.goToOffset(at));
    const files = () => (void this.fileList.load(), void documentFiles.refresh());
    this.news = new News({ notices, files, runs: () => void this.runs.load(), run: (event) => this.runs.hear(event), model: () => model()?.path, modelFiles: () => this.checker.soon(), back: () => this.back() });
    const { starter } = this.runs;
    const beginButton = h("button", { type: "button", class: "quiet", click: begin }, texts.begin);
    this.element = frame({
      bar: bar(hello.folder, [beginButton, this.saveButton, this.checkState.button], [starter.runButton, starter.runWithButton, starter.stopButton]),
      left: [[texts.files, this.fileList.element], [texts.runs, this.runs.list.element], [texts.outline, this.outline.element]],
      middle: [this.documents.bar, this.documents.area],
      right: this.panes.tabs.element,
      below: this.runs.tabs.element,
      further: [notices.element, this.checkState.announcer],
    }, this.sizes, changed);
    this.listen();
  }

  private listen(): void {
    const { starter } = this.runs;
    const focusText = () => !this.editor.element.hidden && (this.editor.view.focus(), true);
    listenToKeys({
      save: () => this.save(),
      run: () => void starter.run(),
      stop: () => void starter.stop(),
      nextPane: (step) => nextPane(this.element, step, focusText),
      nextProblem: (step) => this.nextProblem(step),
      showMachine: () => this.panes.tabs.show("machine"),
    });
    addEventListener("pagehide", () => this.memory.write(this.present()));
    addEventListener("beforeunload", (event) => {
      this.memory.write(this.present());
      // The texts come back with the tab; without its memory, or without a program to come back to, they would be lost.
      const isAtRisk = !this.memory.isWritten || (!this.news.isReachable && !this.isLeaving);
      if (isAtRisk && [...this.editor.documents.values()].some((d) => d.isDirty)) event.preventDefault();
    });
  }

  /** The page is about to be loaded anew, with another token. */
  leave(): void {
    this.isLeaving = true;
  }

  /** Loads the folder and what was open before. */
  async begin(): Promise<void> {
    const { old, documents, fileList } = this;
    document.title = `${this.hello.folder.split("/").pop()} · ${texts.name}`;
    this.found(null);
    this.api.answered = (is) => this.news.connected(is);
    void this.loadSchema();
    const files = fileList.load();
    const runs = this.runs.load();
    await documents.recall(old?.documents ?? [], old?.reports ?? [], this.api, (error) => this.fail(error));
    this.isRecalled = true;
    if (old) this.recall(old);
    await files;
    const models = fileList.files.filter(({ kind }) => kind === "model");
    const wanted = this.hello.open ?? (models.length === 1 ? models[0]!.path : null);
    if (!old && wanted) await fileList.open(wanted);
    if (!documents.active) documents.show();
    if (!old && models.length === 0) void fileList.begin();
    this.news.follow(this.api, this.hello.event);
    await runs;
    await this.runs.showLast(old?.run);
  }

  private recall(old: Remembered): void {
    this.documents.model = this.editor.documents.get(old.model) ?? null;
    this.documents.activate(old.active);
    this.panes.tabs.show(old.tabs["right"] ?? "machine");
    this.runs.tabs.show(old.tabs["below"] ?? "problems");
    if (this.documents.model) this.checker.now();
    void this.documentFiles.refresh();
  }

  private async loadSchema(): Promise<void> {
    try {
      this.schema = new ModelSchema(await this.api.get<Schema>("/api/schema"));
      this.panes.showParts(null);
    } catch {
      // Asked for again once the program answers.
    }
  }

  private back(): void {
    if (!this.schema) void this.loadSchema();
    this.checker.soon();
  }

  // ---- the texts

  private modelTaken(document: OpenDocument | null): void {
    this.checker.forget();
    this.panes.clear();
    if (!document) return;
    this.panes.showFirst(document.tree);
    this.checker.now();
  }

  private documentShown(): void {
    const { shown, model } = this.documents;
    this.fileList.draw();
    this.outline.show((shown ?? model)?.isModel ? (shown ?? model)!.tree : null);
    this.saveButton.disabled = !shown?.isDirty;
    this.rememberSoon();
  }

  private textChanged(document: OpenDocument): void {
    this.rememberSoon();
    this.drawDirty(document);
    this.documents.textChanged(document);
    if (document === this.documents.model) this.checker.soon();
  }

  /** Redrawn only where something becomes unsaved or saved: typing costs nothing. */
  private drawDirty(document: OpenDocument): void {
    const marked = this.saveButton.disabled === false;
    if (document.path === this.documents.active && marked === document.isDirty) return;
    this.documents.drawBar();
    this.fileList.draw();
    this.saveButton.disabled = !document.isDirty;
  }

  private meshTarget(): MeshTarget | null {
    const { model } = this.documents;
    return model && { name: model.name, path: model.path, tree: model.tree, text: model.state.doc.toString(), set: (key, value) => this.values.set(key, value) };
  }

  private cursorMoved(document: OpenDocument): void {
    this.rememberSoon();
    if (document === this.documents.model) this.places.cursorMoved(document);
  }

  private save(): void {
    const { shown } = this.documents;
    if (shown) void this.documentFiles.save(shown);
  }

  // ---- what is found of the model

  private showScene(scene: SceneText | null, document: OpenDocument): void {
    this.panes.show(scene, () => this.places.partAtCursor(document));
    if (this.documents.active === document.path) this.outline.show(document.tree);
    this.runs.study.refresh();
  }

  private found(findings: Findings | null, runs = 1): void {
    const { model } = this.documents;
    this.problems.show(findings, model ? texts.state.checking : texts.noModel);
    this.checkState.show(findings, runs, model !== null);
    this.panes.mark(findings?.faults ?? []);
    this.runs.starter.showButtons();
    const count = (findings?.faults.length ?? 0) + (findings?.warnings.length ?? 0);
    this.runs.tabs.label("problems", count > 0 ? `${texts.problems} (${count})` : texts.problems);
  }

  private showProblems(): void {
    this.runs.tabs.show("problems");
    this.element.querySelector<HTMLElement>(".problems button")?.focus();
  }

  private nextProblem(step: number): void {
    const fault = this.checker.next(step);
    if (fault) this.places.goToFault(fault);
    else this.notices.say(texts.noProblems);
  }

  // ---- words, memory

  private fail(error: unknown): void {
    if (error instanceof Unreachable) return this.news.connected(false);
    this.notices.say(error instanceof Refused ? sentences(error) : error instanceof Error ? error.message : String(error));
  }

  private rememberSoon(): void {
    this.memory.writeSoon(() => this.present());
  }

  /** What is open, to be found again; null until what was open before is. */
  private present(): Remembered | null {
    if (!this.isRecalled) return null;
    const { openReports: reports, active, model } = this.documents;
    const tabs = { right: this.panes.tabs.current, below: this.runs.tabs.current };
    return { folder: this.hello.folder, documents: this.editor.remembered(), active, model: model?.path ?? "", reports, sizes: this.sizes, tabs, run: this.runs.live.shownRun };
  }
}
