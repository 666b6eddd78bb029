// The page as a whole: which model is open, what is asked of the program when its text changes, which pane shows what.

import type { Diagnostic } from "@codemirror/lint";
import type { Text } from "@codemirror/state";
import { Unreachable, Refused, type Api, type Edit, type Fault, type FileEntry, type RunEntry, type RunEvent, type Template } from "./api";
import { h } from "../src/dom";
import { isDark, onThemeChange, setTheme } from "../src/theme";
import { BearingPane } from "./bearing_pane";
import { ask, askTemplate, showKeys } from "./dialogs";
import { DocumentFiles } from "./document_files";
import { Editor, type OpenDocument, type SavedDocument } from "./editor";
import { splitter, Tabs, walkable } from "./layout";
import { LivePane } from "./live_pane";
import { MachinePane, type SceneText } from "./machine_pane";
import { explainHere, modelHelp, offerUnits, type ModelHelpers } from "./model_help";
import { Memory, type OpenReport, type Remembered } from "./memory";
import { showMesh } from "./mesh_window";
import { ModelSchema, type Schema } from "./model_schema";
import { Notices } from "./notices";
import { Outline } from "./outline";
import { PartPane } from "./part_pane";
import { PointPane } from "./point_pane";
import { diagnostics, ProblemList, type Findings } from "./problems";
import { RunsPane } from "./runs_pane";
import { texts } from "./texts";
import { find, nodeAt, pathOf } from "./yaml_tree";

export interface Hello {
  version: string;
  folder: string;
  open: string | null;
  /** Number of the last event. */
  event?: number;
}

interface Checked extends Findings {
  runs: number;
  parameters: Record<string, unknown>;
  scene: SceneText | null;
}

/** Faults that only the start of a run shows, not its text. */
const startFaults = new WeakSet<Fault>();
const isOfStart = (fault: Fault) => startFaults.has(fault);

/** The text that a repair's edits were made for: their lines and columns hold in no other one. */
const textOfEdits = new WeakMap<Edit[], Text>();

function noteText({ faults, warnings }: Findings, doc: Text): void {
  for (const fault of [...faults, ...warnings]) for (const { edits } of fault.repairs ?? []) textOfEdits.set(edits, doc);
}

/** Pause of typing before a text is checked [ms]. */
const pause = 45;
/** Further pause before the start of its run is tried [ms]. */
const restPause = 200;
/** So often a change is asked about while the text goes on changing. */
const mostTries = 5;

export class Workbench {
  readonly element: HTMLElement;
  private readonly editor: Editor;
  private readonly documentFiles: DocumentFiles;
  private readonly machine: MachinePane;
  private readonly bearing: BearingPane;
  private readonly point: PointPane;
  private readonly part: PartPane;
  private readonly problems: ProblemList;
  private readonly runs: RunsPane;
  private readonly live: LivePane;
  private readonly outline: Outline;
  private readonly right: Tabs;
  private readonly below: Tabs;
  private readonly fileList = h("ul", { class: "files" });
  private readonly documentBar = h("div", { class: "tabs documents", role: "tablist", "aria-label": texts.panes.middle });
  private readonly documentArea = h("div", { class: "document-area" });
  private readonly notices = new Notices();
  private readonly memory = new Memory();
  private readonly checkState = h("button", { type: "button", class: "check-state", click: () => this.showProblems() });
  private readonly announcer = h("div", { class: "visually-hidden", role: "status" });
  private readonly runButton = h("button", { type: "button", class: "main-button", click: () => void this.runModel() }, texts.run);
  private readonly stopButton = h("button", { type: "button", class: "quiet stop", disabled: true, click: () => void this.stopRun() }, texts.stop);
  private readonly saveButton = h("button", { type: "button", class: "quiet", click: () => void this.save() }, texts.save);
  private schema: ModelSchema | null = null;
  private files: FileEntry[] = [];
  private model: OpenDocument | null = null;
  private findings: Findings | null = null;
  private reports: (OpenReport & { frame: HTMLIFrameElement })[] = [];
  private active = "";
  private checks = 0;
  /** The last change by a form or a drag. */
  private valueSet: Promise<void> = Promise.resolve();
  private listings = 0;
  private checkTimer = 0;
  private isReachable = true;
  private isLeaving = false;
  private isRecalled = false;
  /** Whether the model can run. */
  private isReady = false;
  private isStarting = false;
  private sizes: Record<string, number>;
  private readonly old: Remembered | null;

  constructor(
    private readonly api: Api,
    private readonly hello: Hello,
  ) {
    this.old = this.memory.recall(this.hello.folder);
    this.sizes = this.old?.sizes ?? {};
    const say = (text: string) => this.say(text);
    const helpers: ModelHelpers = {
      schema: () => this.schema,
      convert: async (value, unit) => (await api.post<{ text: string }>("/api/convert", { text: value, unit })).text,
      say,
    };
    this.editor = new Editor({
      changed: (document) => this.textChanged(document),
      moved: (document) => this.cursorMoved(document),
      model: modelHelp(helpers),
      commands: [
        { key: "Alt-Enter", run: () => this.repairHere() },
        { key: "Alt-u", run: () => offerUnits(this.editor.view) || this.nothing(texts.convertNone) },
        { key: "Alt-h", run: () => explainHere(this.editor.view, helpers) || this.nothing(texts.explainNone) },
        { key: "Mod-Enter", run: () => (void this.runModel(), true) },
      ],
    });
    this.documentFiles = new DocumentFiles({
      api,
      editor: this.editor,
      notices: this.notices,
      fail: (error) => this.fail(error),
      changed: () => {
        this.showActive();
        this.rememberSoon();
      },
    });
    const text = () => (this.model ? { path: this.model.path, text: this.model.state.doc.toString() } : null);
    this.machine = new MachinePane({ api, model: text, chosen: (part) => this.goToPart(part), say });
    const set = (key: string, value: string | null) => this.setValue(key, value);
    this.bearing = new BearingPane({ set, goToKey: (key) => this.goToKey(key), chosen: (name) => (this.machine.highlight(`/bearings/${name}`), this.point.refresh()) });
    this.point = new PointPane(api, () => (this.model ? { ...text()!, tree: this.model.tree } : null), () => this.bearing.name);
    this.part = new PartPane(set);
    this.problems = new ProblemList((fault) => this.goToFault(fault), (edits) => this.repair(edits));
    this.live = new LivePane(api, (run, bearing) => this.clearanceOf(run, bearing));
    this.runs = new RunsPane({ api, say, chosen: (run) => void this.showRun(run), openReport: (report) => this.openReport(report), changed: () => this.runsChanged() });
    this.outline = new Outline((at) => this.goToOffset(at));
    this.right = new Tabs(texts.panes.right, [
      { key: "machine", label: texts.machine, content: this.machine.element },
      { key: "bearing", label: texts.bearing, content: this.bearing.element },
      { key: "part", label: texts.part, content: this.part.element },
      { key: "point", label: texts.point, content: this.point.element },
    ], (key) => {
      if (key === "point") setTimeout(() => this.point.refresh());
      if (key === "bearing") this.bearing?.draw();
      if (key === "part") this.part?.draw();
      this.rememberSoon();
    });
    this.below = new Tabs(texts.panes.below, [
      { key: "problems", label: texts.problems, content: this.problems.element },
      { key: "live", label: texts.live, content: this.live.element },
      { key: "log", label: texts.log, content: this.live.log },
    ], (key) => {
      if (key === "log") void this.live?.readLog();
      this.rememberSoon();
    });
    this.element = this.layOut();
    walkable(this.documentBar);
    document.addEventListener("keydown", (event) => this.key(event));
    addEventListener("pagehide", () => this.remember());
    addEventListener("beforeunload", (event) => {
      this.remember();
      // The texts come back with the tab; without its memory, or without a program to come back to, they would be lost.
      const isAtRisk = !this.memory.isWritten || (!this.isReachable && !this.isLeaving);
      if (isAtRisk && [...this.editor.documents.values()].some((d) => d.isDirty)) event.preventDefault();
    });
  }

  /** The page is about to be loaded anew, with another token. */
  leave(): void {
    this.isLeaving = true;
  }

  private layOut(): HTMLElement {
    const theme = h("button", { type: "button", class: "quiet", click: () => this.switchTheme() });
    const label = () => {
      theme.textContent = isDark() ? texts.theme.light : texts.theme.dark;
      theme.setAttribute("aria-label", isDark() ? texts.theme.toLight : texts.theme.toDark);
    };
    onThemeChange(label);
    label();
    const bar = h(
      "header",
      { class: "bar" },
      h("h1", { class: "brand" }, "hersey", h("span", { class: "visually-hidden" }, " workbench")),
      h("span", { class: "folder", title: this.hello.folder }, this.hello.folder.split("/").pop() || this.hello.folder),
      h("button", { type: "button", class: "quiet", click: () => void this.beginModel() }, texts.begin),
      this.saveButton,
      this.checkState,
      h("span", { class: "spacer" }),
      this.runButton,
      this.stopButton,
      h("button", { type: "button", class: "quiet", click: () => showKeys() }, texts.shortcuts),
      theme,
    );
    const group = (title: string, content: HTMLElement) => h("section", { class: "group", "aria-label": title }, h("h2", {}, title), content);
    const root = h("div", { class: "bench" });
    const usual = (): Record<"left" | "right" | "below", number> => ({
      left: Math.min(420, Math.max(200, 0.17 * innerWidth)),
      right: Math.max(380, 0.36 * innerWidth),
      below: Math.max(215, 0.3 * innerHeight),
    });
    const size = (name: "left" | "right" | "below") => this.sizes[name] ?? usual()[name];
    // What nobody has set by hand follows the window.
    addEventListener("resize", () => {
      for (const name of ["left", "right", "below"] as const) if (this.sizes[name] === undefined) root.style.setProperty(`--${name}`, `${usual()[name]}px`);
    });
    const remember = (name: string) => (value: number) => {
      this.sizes[name] = value;
      this.rememberSoon();
    };
    root.append(
      bar,
      h(
        "section",
        { class: "splitters", "aria-label": texts.panes.sizes },
        splitter(root, "--left", texts.splitters.left, "right", size("left"), remember("left")),
        splitter(root, "--right", texts.splitters.right, "left", size("right"), remember("right")),
        splitter(root, "--below", texts.splitters.below, "up", size("below"), remember("below")),
      ),
      h("nav", { class: "pane left", "aria-label": texts.panes.left, tabindex: -1 }, group(texts.files, this.fileList), group(texts.runs, this.runs.element), group(texts.outline, this.outline.element)),
      h("main", { class: "pane middle", "aria-label": texts.panes.middle, tabindex: -1 }, this.documentBar, this.documentArea),
      h("aside", { class: "pane right", "aria-label": texts.panes.right, tabindex: -1 }, this.right.element),
      h("section", { class: "pane below", "aria-label": texts.panes.below, tabindex: -1 }, this.below.element),
      this.notices.element,
      this.announcer,
    );
    return root;
  }

  /** Loads the folder and what was open before. */
  async begin(): Promise<void> {
    document.title = `${this.hello.folder.split("/").pop()} · ${texts.name}`;
    this.problems.show(null);
    this.showCheckState();
    this.api.answered = (is) => this.connected(is);
    void this.loadSchema();
    const files = this.loadFiles();
    const runs = this.runs.load().catch(() => undefined);
    await this.recallDocuments(this.old?.documents ?? []);
    for (const report of this.old?.reports ?? []) this.addReport(report);
    if (this.old) {
      this.model = this.editor.documents.get(this.old.model) ?? null;
      this.activate(this.old.active);
      this.right.show(this.old.tabs["right"] ?? "machine");
      this.below.show(this.old.tabs["below"] ?? "problems");
      if (this.model) this.checkNow();
      void this.documentFiles.refresh();
    }
    await files;
    const wanted = this.hello.open ?? (this.files.filter(({ kind }) => kind === "model").length === 1 ? this.files.find(({ kind }) => kind === "model")!.path : null);
    if (!this.old && wanted) await this.openFile(wanted);
    if (!this.active) this.showActive();
    void this.api.follow(this.hello.event, (event, data) => this.hear(event, data));
    await runs;
    const last = this.runs.runs.find(({ id }) => id === this.old?.run) ?? this.runs.running[0];
    if (last) await this.showRun(last, false);
  }

  /** What was not saved comes from the tab's memory, all else from the file as it is now. */
  private async recallDocuments(documents: SavedDocument[]): Promise<void> {
    const contents = await Promise.all(documents.map(({ path, unsaved }) => (unsaved ? null : this.api.file(path).catch((error: unknown) => this.fail(error)))));
    documents.forEach(({ path, unsaved, cursor }, i) => {
      const content = contents[i];
      if (this.editor.documents.has(path)) return;
      if (unsaved) this.editor.restore(path, unsaved);
      else if (content) this.editor.add(path, content, cursor);
    });
    this.isRecalled = true;
  }

  private async loadSchema(): Promise<void> {
    try {
      this.schema = new ModelSchema(await this.api.get<Schema>("/api/schema"));
      this.showModelParts(null);
    } catch {
      // Asked for again once the program answers.
    }
  }

  // ---- what the program tells

  private hear(event: string, data: unknown): void {
    if (event === "files") this.hearFiles((data as { paths?: string[] } | null)?.paths ?? []);
    else if (event === "runs") void this.runs.load().catch(() => undefined);
    else if (event === "run") this.hearRun(data as RunEvent);
    else if (event === "reload") {
      void this.loadFiles();
      void this.documentFiles.refresh();
      void this.runs.load().catch(() => undefined);
    } else if (event === "refused") {
      this.isReachable = false;
      this.notices.keep("connection", texts.tokenRefused);
    }
  }

  private hearFiles(paths: string[]): void {
    void this.loadFiles();
    void this.documentFiles.refresh();
    const isOfRun = (path: string) => path.startsWith("runs/") || /\.(h5|lock|checkpoint)$/.test(path);
    if (paths.some(isOfRun)) void this.runs.load().catch(() => undefined);
    // A table, a mesh or a part of the model may be another one.
    if (paths.some((path) => !isOfRun(path) && path !== this.model?.path)) this.checkSoon();
  }

  private hearRun(event: RunEvent): void {
    this.live.hear(event);
    if (event.share !== undefined) this.runs.progress(event.id, event.share);
    if (event.kind === "finished" || event.kind === "started") void this.runs.load().catch(() => undefined);
    if ((event.kind === "finished" || event.kind === "warning") && event.id === this.live.shownRun && this.below.current === "log") void this.live.readLog();
  }

  private connected(is: boolean): void {
    if (is === this.isReachable) return;
    this.isReachable = is;
    if (is) {
      this.notices.drop("connection");
      this.say(texts.reachable);
      this.hear("reload", null);
      if (!this.schema) void this.loadSchema();
      this.checkSoon();
    } else this.notices.keep("connection", texts.unreachable);
  }

  /** Of a run whose model is the open one, unchanged since; else nobody knows it here. */
  private clearanceOf(run: RunEntry, bearing: string): number | undefined {
    const isOpen = this.model && run.set.length === 0 && run.model === this.model.path && this.runs.textOf(run.id) === this.model.state.doc.toString();
    return isOpen ? this.machine.run?.number(`/bearings/${bearing}`, "radial_clearance") : undefined;
  }

  private runsChanged(): void {
    this.live.update(this.runs.runs);
    this.stopButton.disabled = this.runs.running.length === 0;
    this.drawFiles();
    const shown = this.runs.runs.find(({ id }) => id === this.live.shownRun);
    if (shown && shown.state !== "running" && this.below.current === "log") void this.live.readLog();
  }

  private async showRun(run: RunEntry, open = true): Promise<void> {
    this.runs.select(run.id);
    if (open && this.below.current === "problems") this.below.show("live");
    await this.live.show(run);
    this.rememberSoon();
  }

  // ---- files and documents

  private async loadFiles(): Promise<void> {
    const count = ++this.listings;
    try {
      const { files } = await this.api.get<{ files: FileEntry[] }>("/api/files");
      if (count !== this.listings) return;
      this.files = files;
    } catch (error) {
      this.fail(error);
      return;
    }
    this.drawFiles();
  }

  private drawFiles(): void {
    const order = { model: 0, table: 1, mesh: 2, text: 3, report: 4, results: 5, other: 6 } as const;
    const ofRuns = new Set(this.runs.runs.flatMap(({ results, report }) => [...results, report ?? ""]));
    const isOfRun = (path: string) => path.startsWith("runs/") || ofRuns.has(path);
    const files = this.files.filter(({ path, kind }) => kind !== "other" && !isOfRun(path)).sort((a, b) => order[a.kind] - order[b.kind] || a.path.localeCompare(b.path));
    const focused = document.activeElement?.getAttribute("data-path");
    this.fileList.replaceChildren(
      ...(files.some(({ kind }) => kind === "model") ? [] : [h("li", { class: "note" }, texts.emptyFolder)]),
      ...files.map(({ path, kind }) => {
        const open = this.editor.documents.get(path);
        const button = h("button", { type: "button", class: `file ${kind}`, "data-path": path, "aria-current": path === this.active ? "true" : "false", click: () => void this.openFile(path) }, path, open?.isDirty ? h("span", { class: "dot", "aria-label": texts.unsaved, role: "img" }, "●") : null);
        return h("li", {}, button);
      }),
    );
    if (focused) this.fileList.querySelector<HTMLElement>(`[data-path="${CSS.escape(focused)}"]`)?.focus();
  }

  private async openFile(path: string): Promise<void> {
    if (!this.editor.documents.has(path)) {
      const kind = this.files.find((f) => f.path === path)?.kind;
      if (kind === "mesh" && /\.(msh|inp)$/i.test(path)) return showMesh(this.api, path);
      if (kind === "results" || kind === "mesh") return this.say(texts.binary);
      try {
        const content = await this.api.file(path);
        if (!this.editor.documents.has(path)) this.editor.add(path, content);
      } catch (error) {
        return this.fail(error);
      }
    }
    this.activate(path);
    this.editor.view.focus();
  }

  /** Shows a text or a report. */
  private activate(key: string): void {
    const opened = this.editor.documents.get(key);
    this.active = opened || this.reports.some((report) => report.key === key) ? key : (this.editor.documents.keys().next().value ?? "");
    const shown = this.editor.documents.get(this.active) ?? null;
    if (shown) this.editor.show(shown);
    if (shown?.isModel && shown !== this.model) this.takeModel(shown);
    this.showActive();
    this.rememberSoon();
  }

  /** Another model: nothing that was found of the last one is said of it. */
  private takeModel(document: OpenDocument | null): void {
    this.model = document;
    this.checks++;
    this.findings = null;
    this.machine.clear();
    this.bearing.clear();
    this.problems.show(null, document ? texts.state.checking : texts.noModel);
    this.showCheckState();
    this.checkState.classList.remove("at-work");
    if (document) this.checkNow();
  }

  private showActive(): void {
    const isText = this.editor.documents.has(this.active);
    this.editor.element.hidden = !isText;
    for (const { frame, key, url } of this.reports) {
      frame.hidden = key !== this.active;
      // What nobody has looked at yet is not loaded.
      if (!frame.hidden && frame.getAttribute("src") !== url) frame.src = url;
    }
    if (!this.editor.element.isConnected) this.documentArea.append(this.editor.element);
    this.documentArea.querySelector(".welcome")?.remove();
    if (!this.active) this.documentArea.append(h("div", { class: "welcome" }, h("p", {}, texts.noModel), h("button", { type: "button", class: "main-button", click: () => void this.beginModel() }, texts.begin)));
    this.drawDocumentBar();
    this.drawFiles();
    const shown = this.editor.documents.get(this.active);
    this.outline.show((shown ?? this.model)?.isModel ? (shown ?? this.model)!.tree : null);
    this.saveButton.disabled = !shown?.isDirty;
  }

  private drawDocumentBar(): void {
    const had = this.documentBar.contains(document.activeElement);
    const tab = (key: string, name: string, title: string, dirty: boolean, close: () => void) => {
      const is = key === this.active;
      const button = h("button", { type: "button", role: "tab", class: "tab", title, "aria-selected": String(is), tabindex: is ? 0 : -1, click: () => this.activate(key) }, name, dirty ? h("span", { class: "dot", role: "img", "aria-label": texts.unsaved }, "●") : null);
      button.addEventListener("keydown", (event) => {
        if (event.key === "Delete") close();
      });
      button.addEventListener("auxclick", (event) => event.button === 1 && close());
      const cross = h("span", { class: "tab-close", title: texts.closeTab(name), "aria-hidden": "true", click: (event: Event) => (event.stopPropagation(), close()) }, "✕");
      button.append(cross);
      return button;
    };
    this.documentBar.replaceChildren(
      ...[...this.editor.documents.values()].map((d) => tab(d.path, d.name, d.path, d.isDirty, () => void this.closeDocument(d))),
      ...this.reports.map(({ key, title }) => tab(key, title, title, false, () => this.closeReport(key))),
    );
    if (had) this.documentBar.querySelector<HTMLElement>('[aria-selected="true"]')?.focus();
  }

  private async closeDocument(document: OpenDocument): Promise<void> {
    if (document.isDirty) {
      const answer = await ask(`${document.name}: ${texts.unsaved}`, [
        { value: "save", label: texts.save },
        { value: "drop", label: texts.close },
        { value: "keep", label: texts.cancel },
      ]);
      if (answer === "save" && !(await this.save(document))) return;
      if (answer !== "save" && answer !== "drop") return;
    }
    this.documentFiles.forget(document);
    this.editor.close(document);
    if (this.model === document) this.takeModel([...this.editor.documents.values()].find((d) => d.isModel) ?? null);
    this.activate(this.active === document.path ? "" : this.active);
  }

  private addReport(report: OpenReport): void {
    const frame = h("iframe", { title: report.title, class: "report-frame", sandbox: "allow-scripts allow-downloads", hidden: true });
    this.reports.push({ ...report, frame });
    this.documentArea.append(frame);
  }

  private openReport(report: OpenReport): void {
    const opened = this.reports.find(({ key }) => key === report.key);
    if (opened) opened.url = report.url;
    else this.addReport(report);
    this.activate(report.key);
  }

  private closeReport(key: string): void {
    this.reports.find((report) => report.key === key)?.frame.remove();
    this.reports = this.reports.filter((report) => report.key !== key);
    this.activate(this.active === key ? "" : this.active);
  }

  private async save(document = this.editor.documents.get(this.active) ?? null): Promise<boolean> {
    return document ? this.documentFiles.save(document) : false;
  }

  private async beginModel(): Promise<void> {
    let templates: Template[];
    try {
      const answer = await this.api.get<Template[] | { templates: Template[] }>("/api/templates");
      templates = Array.isArray(answer) ? answer : answer.templates;
    } catch (error) {
      return this.fail(error);
    }
    const wanted = await askTemplate(templates);
    if (!wanted) return;
    try {
      const made = await this.api.post<{ path?: string }>("/api/new", wanted);
      await this.loadFiles();
      await this.openFile(made.path ?? wanted.path);
    } catch (error) {
      this.fail(error);
    }
  }

  // ---- the model's text

  private textChanged(document: OpenDocument): void {
    this.rememberSoon();
    this.drawDirty(document);
    if (document !== this.model) return;
    this.checkSoon();
  }

  /** Redrawn only where something becomes unsaved or saved: typing costs nothing. */
  private drawDirty(document: OpenDocument): void {
    const marked = this.saveButton.disabled === false;
    if (document.path === this.active && marked === document.isDirty) return;
    this.drawDocumentBar();
    this.drawFiles();
    this.saveButton.disabled = !document.isDirty;
  }

  private checkSoon(): void {
    clearTimeout(this.checkTimer);
    this.checkTimer = window.setTimeout(() => this.checkNow(), pause);
  }

  private checkNow(): void {
    clearTimeout(this.checkTimer);
    void this.check();
  }

  private async check(): Promise<void> {
    const document = this.model;
    if (!document) return;
    const count = ++this.checks;
    const { doc } = document.state;
    this.checkState.classList.add("at-work");
    const ask = (depth: "text" | "start", scene: boolean) => this.api.post<Checked>("/api/check", { path: document.path, text: doc.toString(), depth, scene });
    // An older text's answer is of no use once a newer one is asked about.
    const isOld = () => count !== this.checks || document !== this.model || document.state.doc !== doc;
    try {
      const read = await ask("text", true);
      if (isOld()) return;
      noteText(read, doc);
      const isReadable = read.faults.length === 0;
      // What the start of the run was found to be last stays until it is known of this text.
      const shown = isReadable && this.findings ? { ...read, faults: this.findings.faults.filter(isOfStart), warnings: this.findings.warnings } : read;
      this.showFindings(document, shown);
      this.machine.show(read.scene);
      this.showModelParts(read.scene);
      this.machine.highlight(this.partAtCursor(document));
      performance.mark("hersey-checked");
      if (!isReadable) return;
      // It takes longer: it waits until the hands rest.
      await new Promise((resolve) => setTimeout(resolve, restPause));
      if (isOld()) return;
      const started = await ask("start", false);
      if (isOld()) return;
      noteText(started, doc);
      for (const fault of started.faults) startFaults.add(fault);
      this.showFindings(document, started);
    } catch (error) {
      if (count === this.checks) this.fail(error);
    } finally {
      if (count === this.checks) this.checkState.classList.remove("at-work");
    }
  }

  private showFindings(document: OpenDocument, answer: Checked): void {
    this.findings = { faults: answer.faults, warnings: answer.warnings, missing: answer.missing ?? [] };
    this.editor.setFaults(document, diagnostics(document.state.doc, document.path, this.findings, (edits) => this.repair(edits)) as Diagnostic[]);
    this.problems.show(this.findings);
    this.showCheckState(answer.runs);
  }

  private showModelParts(scene: SceneText | null): void {
    const document = this.model;
    if (!document) return;
    this.bearing.show(scene?.bearings ?? null, this.schema, document.tree, document.state.doc.toString());
    this.part.show(this.schema, document.tree, document.state.doc.toString());
    if (this.active === document.path) this.outline.show(document.tree);
    if (this.right.current === "point") this.point.refresh();
  }

  private showCheckState(runs = 1): void {
    const { faults, warnings } = this.findings ?? { faults: [], warnings: [] };
    const missing = this.findings?.missing ?? [];
    const isReady = faults.length === 0 && missing.length === 0;
    const ready = isReady ? texts.state.good(runs) : texts.state.missing(missing.length);
    const words = !this.findings ? (this.model ? texts.state.checking : texts.state.none) : faults.length > 0 ? texts.state.faults(faults.length) : [ready, ...(warnings.length > 0 ? [texts.state.warnings(warnings.length)] : [])].join(", ");
    const kind = !this.findings ? "none" : faults.length > 0 ? "bad" : warnings.length > 0 || !isReady ? "warn" : "good";
    if (this.checkState.textContent !== words) this.announcer.textContent = words;
    this.checkState.textContent = words;
    this.checkState.dataset["kind"] = kind;
    this.isReady = this.findings !== null && isReady;
    this.showRunButton();
    const count = faults.length + warnings.length;
    this.below.label("problems", count > 0 ? `${texts.problems} (${count})` : texts.problems);
  }

  /** A second start has to wait until the first one is known. */
  private showRunButton(): void {
    this.runButton.disabled = !this.isReady || this.isStarting;
  }

  private repair(edits: Edit[]): void {
    if (!this.model) return;
    if (!textOfEdits.get(edits)?.eq(this.model.state.doc)) {
      this.say(texts.repairOld);
      this.checkNow();
      return;
    }
    if (this.active !== this.model.path) this.activate(this.model.path);
    this.editor.edit(this.model, edits);
    this.checkNow();
    this.editor.view.focus();
  }

  private repairHere(): boolean {
    const found = this.editor.faultAtCursor();
    const action = found?.diagnostic.actions?.[0];
    if (!found || !action) return false;
    action.apply(this.editor.view, found.from, found.to);
    return true;
  }

  /** A change made by a form or by hand in a picture is a change of the text. */
  private setValue(key: string, value: string | null): Promise<void> {
    const document = this.model;
    if (document) this.valueSet = this.valueSet.then(() => this.setValueOf(document, key, value)).catch((error) => this.fail(error));
    return this.valueSet;
  }

  /** Each change is asked about of the text that the one before has left; who types meanwhile has it asked about again. */
  private async setValueOf(document: OpenDocument, key: string, value: string | null): Promise<void> {
    for (let i = 0; i < mostTries; i++) {
      const { doc } = document.state;
      const { text } = await this.api.post<{ text: string; edits?: Edit[] }>("/api/set", { path: document.path, text: doc.toString(), key, value });
      if (document.state.doc !== doc) continue;
      this.editor.replace(document, text);
      if (document === this.model) this.checkNow();
      return;
    }
    this.say(texts.notSet(key));
  }

  // ---- from text to picture and back

  private cursorMoved(document: OpenDocument): void {
    this.rememberSoon();
    if (document !== this.model) return;
    const part = this.partAtCursor(document);
    this.machine.highlight(part);
    if (part) this.part.choose(part);
    this.editor.markLines(null);
    if (part?.startsWith("/bearings/")) this.bearing.choose(part.split("/")[2]!);
  }

  private partAtCursor(document: OpenDocument): string | null {
    const { head } = document.state.selection.main;
    const line = document.state.doc.lineAt(head).number;
    const around = Object.entries(this.machine.sources).filter(([, source]) => source.line <= line && line <= source.endLine);
    around.sort(([, a], [, b]) => a.endLine - a.line - (b.endLine - b.line));
    if (around[0]) return around[0][0];
    const path = pathOf(nodeAt(document.tree, head));
    return path.length >= 2 && ["bodies", "joints", "bearings", "forces"].includes(path[0]!) ? `/${path[0]}/${path[1]}` : null;
  }

  private goToPart(part: string): void {
    const document = this.model;
    if (!document) return;
    if (part.startsWith("/bearings/")) this.bearing.choose(part.split("/")[2]!);
    const source = this.machine.sources[part];
    const node = find(document.tree, part.slice(1).split("/"));
    const lines = source ?? (node ? { line: document.state.doc.lineAt(node.from).number, endLine: document.state.doc.lineAt(node.to).number } : null);
    if (!lines) return;
    if (this.active !== document.path) this.activate(document.path);
    this.editor.goTo(lines.line, (node?.indent ?? 0) + 1, false);
    this.editor.markLines({ from: lines.line, to: lines.endLine });
    this.machine.highlight(part);
    this.part.choose(part);
  }

  private goToKey(key: string): void {
    const node = this.model ? find(this.model.tree, key.split(".")) : undefined;
    if (node) this.goToOffset(node.from, false);
  }

  private goToOffset(at: number, focus = true): void {
    const document = this.editor.active;
    if (!document) return;
    if (this.active !== document.path) this.activate(document.path);
    const line = document.state.doc.lineAt(Math.min(at, document.state.doc.length));
    this.editor.goTo(line.number, at - line.from + 1, focus);
  }

  private goToFault(fault: Fault): void {
    const document = this.model;
    if (!document) return;
    const isHere = !fault.file || fault.file === document.path || fault.file.endsWith(`/${document.path}`);
    if (!isHere && this.files.some(({ path }) => path === fault.file)) {
      void this.openFile(fault.file).then(() => this.editor.goTo(fault.line, fault.column));
      return;
    }
    if (this.active !== document.path) this.activate(document.path);
    this.editor.goTo(fault.line, fault.column);
  }

  private showProblems(): void {
    this.below.show("problems");
    this.element.querySelector<HTMLElement>(".problems button")?.focus();
  }

  // ---- runs

  private async runModel(): Promise<void> {
    const document = this.model;
    if (!document || this.runButton.disabled) return;
    this.isStarting = true;
    this.showRunButton();
    try {
      await this.startRun(document);
    } catch (error) {
      this.fail(error);
    } finally {
      this.isStarting = false;
      this.showRunButton();
    }
  }

  private async startRun(document: OpenDocument): Promise<void> {
    if (document.isDirty) {
      const answer = await ask(texts.saveFirst(document.name), [
        { value: "save", label: texts.saveAndRun },
        { value: "cancel", label: texts.cancel },
      ]);
      if (answer !== "save" || !(await this.save(document))) return;
    }
    const { id } = await this.api.post<{ id: string }>("/api/runs", { path: document.path, set: [], etag: document.etag });
    this.say(texts.started(id));
    await this.runs.load();
    const run = this.runs.runs.find((r) => r.id === id);
    if (!run) return;
    this.below.show("live");
    await this.showRun(run);
  }

  private async stopRun(): Promise<void> {
    const run = this.runs.running.find(({ id }) => id === this.live.shownRun) ?? this.runs.running[0];
    if (!run) return;
    try {
      await this.api.post(`/api/runs/${encodeURIComponent(run.id)}/stop`);
      await this.runs.load();
    } catch (error) {
      this.fail(error);
    }
  }

  // ---- keys, words, memory

  private key(event: KeyboardEvent): void {
    const command = event.ctrlKey || event.metaKey;
    const act = (work: () => void) => {
      event.preventDefault();
      event.stopPropagation();
      work();
    };
    if (document.querySelector("dialog[open]")) return;
    if (command && event.key.toLowerCase() === "s") act(() => void this.save());
    else if (command && event.key === "Enter" && !event.defaultPrevented) act(() => void this.runModel());
    else if (command && event.key === ".") act(() => void this.stopRun());
    else if (event.key === "F1") act(showKeys);
    else if (event.key === "F6") act(() => this.nextPane(event.shiftKey ? -1 : 1));
    else if (event.key === "F8") act(() => this.nextProblem(event.shiftKey ? -1 : 1));
    else if (event.altKey && event.key.toLowerCase() === "m") act(() => this.right.show("machine"));
  }

  private nextPane(step: number): void {
    const panes = [...this.element.querySelectorAll<HTMLElement>(".pane")];
    const at = panes.findIndex((pane) => pane.contains(document.activeElement));
    const next = panes[(at + step + panes.length) % panes.length]!;
    if (next.classList.contains("middle") && !this.editor.element.hidden) this.editor.view.focus();
    else (next.querySelector<HTMLElement>('[role="tab"][aria-selected="true"], button') ?? next).focus();
  }

  private nextProblem(step: number): void {
    const all = [...(this.findings?.faults ?? []), ...(this.findings?.warnings ?? [])].filter(({ line }) => line > 0).sort((a, b) => a.line - b.line || a.column - b.column);
    if (all.length === 0) return this.say(texts.noProblems);
    const { state } = this.editor.view;
    const here = state.doc.lineAt(state.selection.main.head);
    const column = state.selection.main.head - here.from + 1;
    const after = (f: Fault) => f.line > here.number || (f.line === here.number && f.column > column);
    const before = (f: Fault) => f.line < here.number || (f.line === here.number && f.column < column);
    this.goToFault(step > 0 ? (all.find(after) ?? all[0]!) : ([...all].reverse().find(before) ?? all[all.length - 1]!));
  }

  private switchTheme(): void {
    setTheme(isDark() ? "light" : "dark");
    localStorage.setItem("hersey-theme", isDark() ? "dark" : "light");
  }

  private nothing(words: string): boolean {
    this.say(words);
    return true;
  }

  private fail(error: unknown): void {
    if (error instanceof Unreachable) return this.connected(false);
    this.say(error instanceof Refused ? [error.message, error.advice].filter((t) => t).join(" ") : error instanceof Error ? error.message : String(error));
  }

  private say(words: string): void {
    this.notices.say(words);
  }

  private rememberSoon(): void {
    this.memory.writeSoon(() => this.present());
  }

  private remember(): void {
    this.memory.write(this.present());
  }

  /** What is open, to be found again; null until what was open before is. */
  private present(): Remembered | null {
    if (!this.isRecalled) return null;
    return {
      folder: this.hello.folder,
      documents: this.editor.remembered(),
      active: this.active,
      model: this.model?.path ?? "",
      reports: this.reports.map(({ key, title, url }) => ({ key, title, url })),
      sizes: this.sizes,
      tabs: { right: this.right.current, below: this.below.current },
      run: this.live.shownRun,
    };
  }
}
