// From a place in the text to the part of the machine, and back.

import type { Fault } from "./api";
import type { Documents } from "./documents";
import type { Editor, OpenDocument } from "./editor";
import type { FileList } from "./file_list";
import type { ModelPanes } from "./model_panes";
import { find, nodeAt, pathOf } from "./yaml_tree";

export interface PlacesHooks {
  editor: Editor;
  documents: Documents;
  fileList: FileList;
  panes: ModelPanes;
}

export class Places {
  constructor(private readonly hooks: PlacesHooks) {}

  /** Of the model: the part around the cursor is shown in the picture and in the forms. */
  cursorMoved(document: OpenDocument): void {
    const { editor } = this.hooks;
    const { machine, part: form, bearing } = this.hooks.panes;
    const part = this.partAtCursor(document);
    machine.highlight(part);
    if (part) form.choose(part);
    editor.markLines(null);
    if (part?.startsWith("/bearings/")) bearing.choose(part.split("/")[2]!);
  }

  partAtCursor(document: OpenDocument): string | null {
    const { head } = document.state.selection.main;
    const line = document.state.doc.lineAt(head).number;
    const around = Object.entries(this.hooks.panes.machine.sources).filter(([, source]) => source.line <= line && line <= source.endLine);
    around.sort(([, a], [, b]) => a.endLine - a.line - (b.endLine - b.line));
    if (around[0]) return around[0][0];
    const path = pathOf(nodeAt(document.tree, head));
    return path.length >= 2 && ["bodies", "joints", "bearings", "forces"].includes(path[0]!) ? `/${path[0]}/${path[1]}` : null;
  }

  goToPart(part: string): void {
    const { documents, editor } = this.hooks;
    const { machine, bearing, part: form } = this.hooks.panes;
    const document = documents.model;
    if (!document) return;
    if (part.startsWith("/bearings/")) bearing.choose(part.split("/")[2]!);
    const source = machine.sources[part];
    const node = find(document.tree, part.slice(1).split("/"));
    const lines = source ?? (node ? { line: document.state.doc.lineAt(node.from).number, endLine: document.state.doc.lineAt(node.to).number } : null);
    if (!lines) return;
    documents.showModel();
    editor.goTo(lines.line, (node?.indent ?? 0) + 1, false);
    editor.markLines({ from: lines.line, to: lines.endLine });
    machine.highlight(part);
    form.choose(part);
  }

  goToKey(key: string): void {
    const { model } = this.hooks.documents;
    const node = model ? find(model.tree, key.split(".")) : undefined;
    if (node) this.goToOffset(node.from, false);
  }

  goToOffset(at: number, focus = true): void {
    const { editor, documents } = this.hooks;
    const document = editor.active;
    if (!document) return;
    if (documents.active !== document.path) documents.activate(document.path);
    const line = document.state.doc.lineAt(Math.min(at, document.state.doc.length));
    editor.goTo(line.number, at - line.from + 1, focus);
  }

  /** Opens a file at a part of its model; where the text no longer has that, at the line where it was. */
  async goToPlace(file: string, at: { path: string; line: number } | null): Promise<void> {
    const { editor, fileList } = this.hooks;
    if (!at) return;
    await fileList.open(file);
    const document = editor.active;
    if (document?.path !== file) return;
    const node = at.path ? find(document.tree, at.path.split(".")) : undefined;
    if (node) return this.goToOffset(node.from);
    if (at.line > 0) editor.goTo(Math.min(at.line, document.state.doc.lines), 1);
  }

  goToFault(fault: Fault): void {
    const { editor, fileList, documents } = this.hooks;
    const document = documents.model;
    if (!document) return;
    const isHere = !fault.file || fault.file === document.path || fault.file.endsWith(`/${document.path}`);
    if (!isHere && fileList.files.some(({ path }) => path === fault.file)) {
      void fileList.open(fault.file).then(() => editor.goTo(fault.line, fault.column));
      return;
    }
    documents.showModel();
    editor.goTo(fault.line, fault.column);
  }
}
