// Open texts and their files: reading anew what was changed outside, saving, and what is asked where both have changed.

import type { Text } from "@codemirror/state";
import { Refused, sentences, type Api, type FileContent } from "./api";
import { askTexts } from "./dialogs";
import type { Editor, OpenDocument } from "./editor";
import { formOf, normal, type FileForm } from "./file_text";
import type { Notices } from "./notices";
import { texts } from "./texts";

export interface DocumentFilesHooks {
  api: Api;
  editor: Editor;
  notices: Notices;
  fail: (error: unknown) => void;
  /** Something is saved, or no longer. */
  changed: () => void;
}

export class DocumentFiles {
  private readonly turns = new WeakMap<OpenDocument, Promise<unknown>>();

  constructor(private readonly hooks: DocumentFilesHooks) {}

  /** One exchange with a document's file at a time: the next one begins where the last one has left it. */
  private inTurn<T>(document: OpenDocument, work: () => Promise<T>): Promise<T> {
    const next = (this.turns.get(document) ?? Promise.resolve()).then(work);
    this.turns.set(document, next.catch(() => undefined));
    return next;
  }

  /** Texts that were changed outside: read anew where nothing is lost by it, asked about otherwise. */
  async refresh(): Promise<void> {
    await Promise.all([...this.hooks.editor.documents.values()].map((document) => this.inTurn(document, () => this.readAgain(document)).catch((error) => this.hooks.fail(error))));
  }

  private async readAgain(document: OpenDocument): Promise<void> {
    const { etag } = document;
    let now: FileContent;
    try {
      now = await this.hooks.api.file(document.path);
    } catch (error) {
      if (error instanceof Refused && error.status === 404 && document.etag !== null) {
        document.etag = null;
        this.hooks.notices.say(texts.gone(document.name));
        this.hooks.changed();
      }
      return;
    }
    // Something else has been read or written meanwhile, or the text is closed.
    if (document.etag !== etag || this.hooks.editor.documents.get(document.path) !== document || now.etag === etag) return;
    // Removed, and there again as it was.
    if (now.text === document.base.toString()) return this.isOfFile(document, document.base, now.etag, now.form);
    const isSame = document.state.doc.toString() === now.text;
    if (document.isChanged && !isSame) return this.noticeConflict(document);
    if (!isSame) {
      this.hooks.editor.replace(document, now.text);
      this.hooks.notices.say(texts.reloaded(document.name));
    }
    this.isOfFile(document, document.state.doc, now.etag, now.form);
  }

  /** The file has this text. */
  private isOfFile(document: OpenDocument, doc: Text, etag: string | null, form: FileForm): void {
    [document.base, document.etag, document.form] = [doc, etag, form];
    this.forget(document);
    this.hooks.changed();
  }

  private noticeConflict(document: OpenDocument): void {
    this.hooks.notices.keep(`conflict-${document.path}`, texts.changedOnDisk(document.name), [{ label: texts.compareTexts, act: () => void this.inTurn(document, () => this.resolve(document)) }]);
  }

  private async resolve(document: OpenDocument): Promise<boolean> {
    let now: FileContent;
    try {
      now = await this.hooks.api.file(document.path);
    } catch (error) {
      this.hooks.fail(error);
      return false;
    }
    const text = await askTexts(document.name, document.state.doc.toString(), now.text);
    if (text === null) return false;
    this.hooks.editor.replace(document, text);
    if (text === now.text) {
      this.isOfFile(document, document.state.doc, now.etag, now.form);
      return true;
    }
    document.etag = now.etag;
    document.form = now.form;
    return this.write(document);
  }

  /** @returns whether the file has the text now */
  save(document: OpenDocument): Promise<boolean> {
    return this.inTurn(document, () => this.write(document));
  }

  /** What was said of its file is settled. */
  forget({ path }: OpenDocument): void {
    for (const kind of ["conflict", "save"]) this.hooks.notices.drop(`${kind}-${path}`);
  }

  private async write(document: OpenDocument): Promise<boolean> {
    const doc = document.state.doc;
    const put = (etag: string | null) => this.hooks.api.save(document.path, doc.toString(), document.form, etag);
    try {
      let words = texts.saved(document.name);
      const etag = await put(document.etag).catch((error: unknown) => {
        if (document.etag === null || !(error instanceof Refused) || error.status !== 404) throw error;
        words = texts.savedNew(document.name);
        return put(null);
      });
      this.isOfFile(document, doc, etag, document.form);
      this.hooks.notices.say(words);
      return true;
    } catch (error) {
      if (error instanceof Refused && error.status === 412) {
        const raw = String(error.body["text"] ?? "");
        if (normal(raw) !== doc.toString()) return this.resolve(document);
        // Somebody else, or an answer that never came, has written just this.
        this.isOfFile(document, doc, String(error.body["etag"]), formOf(raw));
        this.hooks.notices.say(texts.saved(document.name));
        return true;
      }
      const words = error instanceof Refused ? sentences(error) : texts.unreachable;
      this.hooks.notices.keep(`save-${document.path}`, `${texts.notSaved(document.name)} ${words}`);
      return false;
    }
  }
}
