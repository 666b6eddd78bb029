// The texts that are open, in one editor: each with its history, its faults, and what the file held when it was read.

import { autocompletion, closeBrackets, closeBracketsKeymap, completionKeymap } from "@codemirror/autocomplete";
import { defaultKeymap, history, historyField, historyKeymap, indentWithTab } from "@codemirror/commands";
import { yaml } from "@codemirror/lang-yaml";
import { bracketMatching, foldGutter, foldKeymap, HighlightStyle, indentOnInput, syntaxHighlighting } from "@codemirror/language";
import { forEachDiagnostic, lintGutter, setDiagnostics, type Diagnostic } from "@codemirror/lint";
import { highlightSelectionMatches, searchKeymap } from "@codemirror/search";
import { Compartment, EditorSelection, EditorState, Prec, StateEffect, StateField, Text, type Extension, type Range } from "@codemirror/state";
import { Decoration, drawSelection, dropCursor, EditorView, highlightActiveLine, highlightActiveLineGutter, keymap, lineNumbers, MatchDecorator, ViewPlugin, type DecorationSet, type ViewUpdate } from "@codemirror/view";
import { tags } from "@lezer/highlight";
import type { Edit, FileContent } from "./api";
import type { FileForm } from "./file_text";
import { texts } from "./texts";
import { isDark, onThemeChange } from "../src/theme";
import { readTree, type TextNode } from "./yaml_tree";

export interface SavedDocument {
  path: string;
  /** Place of the cursor in the text. */
  cursor: number;
  /** Of a text that is not saved. */
  unsaved: { state: unknown; base: string; etag: string | null; form: FileForm } | null;
}

export class OpenDocument {
  constructor(
    readonly path: string,
    public state: EditorState,
    public base: Text,
    public etag: string | null,
    public form: FileForm,
  ) {}
  scroll: StateEffect<unknown> | null = null;

  get isModel(): boolean {
    return /\.ya?ml$/i.test(this.path);
  }
  /** Whether the text is another one than the file had. */
  get isChanged(): boolean {
    return !this.state.doc.eq(this.base);
  }
  /** Whether something is to be saved: a text whose file is gone as well. */
  get isDirty(): boolean {
    return this.etag === null || this.isChanged;
  }
  get name(): string {
    return this.path.split("/").pop()!;
  }
  private treeOf: { doc: Text; tree: TextNode } | null = null;
  get tree(): TextNode {
    if (this.treeOf?.doc !== this.state.doc) this.treeOf = { doc: this.state.doc, tree: readTree(this.state.doc.toString()) };
    return this.treeOf!.tree;
  }
}

export interface EditorHooks {
  changed: (document: OpenDocument) => void;
  moved: (document: OpenDocument, byPointer: boolean) => void;
  /** Completion, hover help and the like of model texts. */
  model: Extension;
  commands: { key: string; run: () => boolean; shift?: () => boolean }[];
}

const look = HighlightStyle.define([
  { tag: [tags.definition(tags.propertyName), tags.propertyName], color: "var(--code-key)" },
  { tag: tags.string, color: "var(--code-string)" },
  { tag: [tags.comment, tags.lineComment], color: "var(--code-comment)", fontStyle: "italic" },
  { tag: [tags.keyword, tags.labelName, tags.typeName], color: "var(--code-word)" },
  { tag: [tags.separator, tags.punctuation, tags.squareBracket, tags.brace], color: "var(--soft)" },
]);

const numbers = new MatchDecorator({
  regexp: /(?<![\w.$-])[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?(?![\w])/g,
  decoration: Decoration.mark({ class: "cm-number" }),
});
const numberMarks = ViewPlugin.fromClass(
  class {
    decorations: DecorationSet;
    constructor(view: EditorView) {
      this.decorations = numbers.createDeco(view);
    }
    update(update: ViewUpdate): void {
      this.decorations = numbers.updateDeco(update, this.decorations);
    }
  },
  { decorations: (plugin) => plugin.decorations },
);

/** Lines that are wrapped go on below their beginning. */
const hanging = ViewPlugin.fromClass(
  class {
    decorations: DecorationSet;
    constructor(view: EditorView) {
      this.decorations = this.made(view);
    }
    update(update: ViewUpdate): void {
      if (update.docChanged || update.viewportChanged) this.decorations = this.made(update.view);
    }
    made(view: EditorView): DecorationSet {
      const marks: Range<Decoration>[] = [];
      for (const { from, to } of view.visibleRanges)
        for (let at = from; at <= to; ) {
          const line = view.state.doc.lineAt(at);
          const depth = line.text.search(/\S/) + 2;
          if (line.length > 40 && depth > 1) marks.push(Decoration.line({ attributes: { style: `padding-left: calc(${depth}ch + 6px); text-indent: -${depth}ch` } }).range(line.from));
          at = line.to + 1;
        }
      return Decoration.set(marks);
    }
  },
  { decorations: (plugin) => plugin.decorations },
);

/** Lines of the part chosen in the picture. */
const markPart = StateEffect.define<{ from: number; to: number } | null>();
const partLine = Decoration.line({ class: "cm-part" });
const partField = StateField.define<DecorationSet>({
  create: () => Decoration.none,
  update(value, transaction) {
    let marks = value.map(transaction.changes);
    for (const effect of transaction.effects)
      if (effect.is(markPart)) {
        const { doc } = transaction.state;
        const lines: number[] = [];
        if (effect.value) for (let n = effect.value.from; n <= Math.min(effect.value.to, doc.lines); n++) lines.push(doc.line(n).from);
        marks = Decoration.set(lines.map((at) => partLine.range(at)));
      }
    return marks;
  },
  provide: (field) => EditorView.decorations.from(field),
});

export class Editor {
  readonly element: HTMLElement;
  readonly documents = new Map<string, OpenDocument>();
  readonly view: EditorView;
  private shown: OpenDocument | null = null;
  private readonly theme = new Compartment();

  constructor(private readonly hooks: EditorHooks) {
    this.view = new EditorView({ state: EditorState.create() });
    this.element = this.view.dom;
    onThemeChange(() => this.dress());
  }

  get active(): OpenDocument | null {
    return this.shown;
  }

  private dress(): void {
    if (this.shown) this.view.dispatch({ effects: this.theme.reconfigure(EditorView.theme({}, { dark: isDark() })) });
  }

  private extensions(path: string): Extension[] {
    const isModel = /\.ya?ml$/i.test(path);
    const commands = this.hooks.commands.map(({ key, run, shift }) => ({ key, run: () => run(), ...(shift ? { shift: () => shift() } : {}), preventDefault: true }));
    return [
      Prec.highest(keymap.of(commands)),
      this.theme.of(EditorView.theme({}, { dark: isDark() })),
      lineNumbers(),
      highlightActiveLineGutter(),
      history(),
      foldGutter(),
      drawSelection(),
      dropCursor(),
      EditorView.lineWrapping,
      hanging,
      EditorState.allowMultipleSelections.of(true),
      EditorState.tabSize.of(2),
      indentOnInput(),
      syntaxHighlighting(look),
      bracketMatching(),
      closeBrackets(),
      highlightActiveLine(),
      highlightSelectionMatches(),
      partField,
      EditorView.contentAttributes.of({ "aria-label": texts.editor(path), tabindex: "0" }),
      ...(isModel ? [yaml(), numberMarks, lintGutter(), autocompletion({ icons: false, activateOnTypingDelay: 50 }), this.hooks.model] : []),
      keymap.of([...closeBracketsKeymap, ...completionKeymap, ...defaultKeymap, ...searchKeymap, ...historyKeymap, ...foldKeymap, indentWithTab]),
      EditorView.updateListener.of((update) => this.heard(update)),
    ];
  }

  private heard(update: ViewUpdate): void {
    const document = this.shown;
    if (!document) return;
    document.state = update.state;
    if (update.docChanged) this.hooks.changed(document);
    if (update.selectionSet && !update.docChanged) this.hooks.moved(document, update.transactions.some((t) => t.isUserEvent("select.pointer")));
  }

  add(path: string, { text, etag, form }: FileContent, cursor = 0): OpenDocument {
    const doc = Text.of(text.split("\n"));
    const state = EditorState.create({ doc, selection: { anchor: Math.min(cursor, doc.length) }, extensions: this.extensions(path) });
    const document = new OpenDocument(path, state, state.doc, etag, form);
    this.documents.set(path, document);
    return document;
  }

  /** As it was before the page was loaded anew, with its history. */
  restore(path: string, { state: saved, base: baseText, etag, form }: NonNullable<SavedDocument["unsaved"]>): OpenDocument {
    const base = Text.of(baseText.split("\n"));
    let state: EditorState;
    try {
      state = EditorState.fromJSON(saved, { extensions: this.extensions(path) }, { history: historyField });
    } catch {
      state = EditorState.create({ doc: base, extensions: this.extensions(path) });
    }
    const document = new OpenDocument(path, state, base, etag, form);
    this.documents.set(path, document);
    return document;
  }

  remembered(): SavedDocument[] {
    return [...this.documents.values()].map((d) => ({
      path: d.path,
      cursor: d.state.selection.main.head,
      unsaved: d.isDirty ? { state: d.state.toJSON({ history: historyField }), base: d.base.toString(), etag: d.etag, form: d.form } : null,
    }));
  }

  show(document: OpenDocument | null): void {
    if (this.shown === document) return;
    if (this.shown) this.shown.scroll = this.view.scrollSnapshot();
    this.shown = document;
    this.view.setState(document?.state ?? EditorState.create());
    this.dress();
    if (document?.scroll) this.view.dispatch({ effects: document.scroll });
  }

  close(document: OpenDocument): void {
    this.documents.delete(document.path);
    if (this.shown === document) this.show(null);
  }

  /** Changes a text, in one step that can be undone. */
  change(document: OpenDocument, changes: { from: number; to: number; insert: string }[], event = "input"): void {
    if (document === this.shown) this.view.dispatch({ changes, userEvent: event, scrollIntoView: false });
    else {
      document.state = document.state.update({ changes, userEvent: event }).state;
      this.hooks.changed(document);
    }
  }

  edit(document: OpenDocument, edits: Edit[]): void {
    this.change(document, edits.map((e) => ({ from: offset(document.state.doc, e.line, e.column), to: offset(document.state.doc, e.endLine, e.endColumn), insert: e.text })));
  }

  /** Another text in place of the present one: what they share at both ends stays. */
  replace(document: OpenDocument, text: string): void {
    const old = document.state.doc.toString();
    if (old === text) return;
    let from = 0;
    while (from < old.length && from < text.length && old[from] === text[from]) from++;
    let [oldEnd, newEnd] = [old.length, text.length];
    while (oldEnd > from && newEnd > from && old[oldEnd - 1] === text[newEnd - 1]) [oldEnd, newEnd] = [oldEnd - 1, newEnd - 1];
    this.change(document, [{ from, to: oldEnd, insert: text.slice(from, newEnd) }]);
  }

  setFaults(document: OpenDocument, faults: Diagnostic[]): void {
    const set = setDiagnostics(document.state, faults);
    if (document === this.shown) this.view.dispatch(set);
    else document.state = document.state.update(set).state;
  }

  goTo(line: number, column = 1, focus = true): void {
    const at = offset(this.view.state.doc, line, column);
    this.view.dispatch({ selection: EditorSelection.cursor(at), effects: EditorView.scrollIntoView(at, { y: "center" }) });
    if (focus) this.view.focus();
  }

  markLines(lines: { from: number; to: number } | null): void {
    if (this.shown) this.view.dispatch({ effects: markPart.of(lines) });
  }

  /** The fault under the cursor, else the first of its line. */
  faultAtCursor(): { diagnostic: Diagnostic; from: number; to: number } | null {
    const { head } = this.view.state.selection.main;
    const line = this.view.state.doc.lineAt(head);
    let best: { diagnostic: Diagnostic; from: number; to: number } | null = null;
    forEachDiagnostic(this.view.state, (diagnostic, from, to) => {
      if (!diagnostic.actions?.length || to < line.from || from > line.to) return;
      if (!best || (from <= head && head <= to)) best = { diagnostic, from, to };
    });
    return best;
  }
}

/** Lines and columns count from 1. */
export function offset(doc: Text, line: number, column: number): number {
  if (line < 1) return 0;
  if (line > doc.lines) return doc.length;
  const { from, length } = doc.line(line);
  return from + Math.min(length, Math.max(0, column - 1));
}
