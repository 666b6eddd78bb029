// The files of the folder as a list, models first; opening one, and beginning another.

import type { Api, FileEntry, RunEntry, Template } from "./api";
import { h } from "../src/dom";
import { isCad, showCad } from "./cad_window";
import type { Editor } from "./editor";
import { showMesh, type MeshTarget } from "./mesh_window";
import { askBeginning } from "./template_window";
import { texts } from "./texts";

export interface FileListHooks {
  api: Api;
  editor: Editor;
  runs: () => RunEntry[];
  /** Path of the text that is shown. */
  active: () => string;
  openReport: (report: { key: string; title: string; url: string }) => void;
  /** A file has been opened by a click, and its text is to be shown. */
  opened: (path: string) => void;
  say: (words: string) => void;
  fail: (error: unknown) => void;
  /** The model that is open, to write surfaces of a mesh into it. */
  meshTarget: () => MeshTarget | null;
}

export class FileList {
  readonly element = h("ul", { class: "files" });
  files: FileEntry[] = [];
  private listings = 0;

  constructor(private readonly hooks: FileListHooks) {}

  async load(): Promise<void> {
    const count = ++this.listings;
    try {
      const { files } = await this.hooks.api.get<{ files: FileEntry[] }>("/api/files");
      if (count !== this.listings) return;
      this.files = files;
    } catch (error) {
      this.hooks.fail(error);
      return;
    }
    this.draw();
  }

  draw(): void {
    const order = { model: 0, table: 1, mesh: 2, text: 3, report: 4, results: 5, other: 6 } as const;
    const ofRuns = new Set(this.hooks.runs().flatMap(({ results, report }) => [...results, report ?? ""]));
    const isOfRun = (path: string) => path.startsWith("runs/") || ofRuns.has(path);
    const files = this.files.filter(({ path, kind }) => kind !== "other" && !isOfRun(path)).sort((a, b) => order[a.kind] - order[b.kind] || a.path.localeCompare(b.path));
    const focused = document.activeElement?.getAttribute("data-path");
    const active = this.hooks.active();
    this.element.replaceChildren(
      ...(files.some(({ kind }) => kind === "model") ? [] : [h("li", { class: "note" }, texts.emptyFolder)]),
      ...files.map(({ path, kind }) => {
        const open = this.hooks.editor.documents.get(path);
        const button = h("button", { type: "button", class: `file ${kind}`, "data-path": path, "aria-current": path === active ? "true" : "false", click: () => void this.open(path) }, path, open?.isDirty ? h("span", { class: "dot", "aria-label": texts.unsaved, role: "img" }, "●") : null);
        return h("li", {}, button);
      }),
    );
    if (focused) this.element.querySelector<HTMLElement>(`[data-path="${CSS.escape(focused)}"]`)?.focus();
  }

  async open(path: string): Promise<void> {
    const { api, editor, say, fail, opened, openReport, meshTarget } = this.hooks;
    if (!editor.documents.has(path)) {
      const kind = this.files.find((f) => f.path === path)?.kind;
      if (isCad(path)) return showCad(api, path, meshTarget, () => void this.load());
      if (kind === "mesh" && /\.(msh|inp)$/i.test(path)) return showMesh(api, path, "mm", meshTarget);
      if (kind === "results" || kind === "mesh") return say(texts.binary);
      try {
        if (kind === "report") return openReport({ key: `file ${path}`, title: path, ...(await api.post<{ url: string }>("/api/file_report", { path })) });
        const content = await api.file(path);
        if (!editor.documents.has(path)) editor.add(path, content);
      } catch (error) {
        return fail(error);
      }
    }
    opened(path);
  }

  /** Asks which template or example, and opens what is made of it. */
  async begin(): Promise<void> {
    const { api, fail } = this.hooks;
    try {
      const [templates, examples] = await Promise.all([api.get<Template[]>("/api/templates"), api.get<Template[]>("/api/examples").catch(() => [])]);
      let made = "";
      await askBeginning(api, templates, examples, async (wanted) => {
        const { path } = await api.post<{ path?: string }>("/api/new", wanted);
        made = path ?? wanted.path;
      });
      if (!made) return;
      await this.load();
      await this.open(made);
    } catch (error) {
      fail(error);
    }
  }
}
