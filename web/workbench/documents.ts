// What is open in the middle of the page: texts and reports, their tabs, which one is shown, and which text is the model.

import type { Api } from "./api";
import { h } from "../src/dom";
import { isDark, onThemeChange } from "../src/theme";
import { ask } from "./dialogs";
import type { DocumentFiles } from "./document_files";
import type { Editor, OpenDocument, SavedDocument } from "./editor";
import type { OpenReport } from "./memory";
import { walkable } from "./layout";
import { TableView } from "./table_view";
import { texts } from "./texts";

export interface DocumentsHooks {
  editor: Editor;
  documentFiles: DocumentFiles;
  /** Another text is the model, or none. */
  modelTaken: (document: OpenDocument | null) => void;
  /** Another text or report is shown, or its text is saved now. */
  shown: () => void;
  begin: () => void;
}

/** A report has no origin of its own that a word could be addressed to; this one may be heard by anybody. */
function tellTheme(frame: HTMLIFrameElement): void {
  frame.contentWindow?.postMessage({ theme: isDark() ? "dark" : "light" }, "*");
}

export class Documents {
  readonly bar = h("div", { class: "tabs documents", role: "tablist", "aria-label": texts.panes.middle });
  readonly area = h("div", { class: "document-area" });
  model: OpenDocument | null = null;
  /** Path of a text or key of a report; empty: nothing is open. */
  active = "";
  private readonly tables: TableView;
  private reports: (OpenReport & { frame: HTMLIFrameElement })[] = [];

  constructor(private readonly hooks: DocumentsHooks) {
    walkable(this.bar);
    this.tables = new TableView(hooks.editor, () => this.show());
    onThemeChange(() => this.reports.forEach(({ frame }) => tellTheme(frame)));
  }

  /** A table is drawn anew. */
  textChanged(document: OpenDocument): void {
    this.tables.changed(document);
  }

  /** The text that is shown; null where a report is. */
  get shown(): OpenDocument | null {
    return this.hooks.editor.documents.get(this.active) ?? null;
  }

  get openReports(): OpenReport[] {
    return this.reports.map(({ key, title, url }) => ({ key, title, url }));
  }

  /** Shows a text or a report. */
  activate(key: string): void {
    const { documents } = this.hooks.editor;
    this.active = documents.has(key) || this.reports.some((report) => report.key === key) ? key : (documents.keys().next().value ?? "");
    const { shown } = this;
    if (shown) this.hooks.editor.show(shown);
    if (shown?.isModel && shown !== this.model) this.takeModel(shown);
    this.show();
  }

  /** Shows the model's text. */
  showModel(): void {
    if (this.model && this.active !== this.model.path) this.activate(this.model.path);
  }

  private takeModel(document: OpenDocument | null): void {
    this.model = document;
    this.hooks.modelTaken(document);
  }

  show(): void {
    const { element } = this.hooks.editor;
    const hasTable = this.tables.show(this.shown);
    this.area.classList.toggle("with-table", hasTable);
    if (hasTable) this.area.append(this.tables.bar, this.tables.element);
    else for (const part of [this.tables.bar, this.tables.element]) part.remove();
    this.tables.element.hidden = !this.tables.isTable;
    element.hidden = !this.shown || (hasTable && this.tables.isTable);
    for (const { frame, key, url } of this.reports) {
      frame.hidden = key !== this.active;
      // What nobody has looked at yet is not loaded.
      if (!frame.hidden && frame.getAttribute("src") !== url) frame.src = url;
    }
    if (!element.isConnected) this.area.append(element);
    this.area.querySelector(".welcome")?.remove();
    if (!this.active) this.area.append(h("div", { class: "welcome" }, h("p", {}, texts.noModel), h("button", { type: "button", class: "main-button", click: () => this.hooks.begin() }, texts.begin)));
    this.drawBar();
    this.hooks.shown();
  }

  drawBar(): void {
    const had = this.bar.contains(document.activeElement);
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
    this.bar.replaceChildren(
      ...[...this.hooks.editor.documents.values()].map((d) => tab(d.path, d.name, d.path, d.isDirty, () => void this.close(d))),
      ...this.reports.map(({ key, title }) => tab(key, title, title, false, () => this.closeReport(key))),
    );
    this.bar.querySelector('[aria-selected="true"]')?.scrollIntoView({ block: "nearest", inline: "nearest" });
    if (had) this.bar.querySelector<HTMLElement>('[aria-selected="true"]')?.focus();
  }

  private async close(document: OpenDocument): Promise<void> {
    const { editor, documentFiles } = this.hooks;
    if (document.isDirty) {
      const answer = await ask(`${document.name}: ${texts.unsaved}`, [
        { value: "save", label: texts.save },
        { value: "drop", label: texts.close },
        { value: "keep", label: texts.cancel },
      ]);
      if (answer === "save" && !(await documentFiles.save(document))) return;
      if (answer !== "save" && answer !== "drop") return;
    }
    documentFiles.forget(document);
    editor.close(document);
    if (this.model === document) this.takeModel([...editor.documents.values()].find((d) => d.isModel) ?? null);
    this.activate(this.active === document.path ? "" : this.active);
  }

  /** What was not saved comes from the tab's memory, all else from the file as it is now. */
  async recall(saved: SavedDocument[], reports: OpenReport[], api: Api, fail: (error: unknown) => void): Promise<void> {
    const { editor } = this.hooks;
    const contents = await Promise.all(saved.map(({ path, unsaved }) => (unsaved ? null : api.file(path).catch(fail))));
    saved.forEach(({ path, unsaved, cursor }, i) => {
      const content = contents[i];
      if (editor.documents.has(path)) return;
      if (unsaved) editor.restore(path, unsaved);
      else if (content) editor.add(path, content, cursor);
    });
    for (const report of reports) this.addReport(report);
  }

  private addReport(report: OpenReport): void {
    const frame = h("iframe", { title: report.title, class: "report-frame", sandbox: "allow-scripts allow-downloads", hidden: true });
    frame.addEventListener("load", () => tellTheme(frame));
    this.reports.push({ ...report, frame });
    this.area.append(frame);
  }

  openReport(report: OpenReport): void {
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
}
