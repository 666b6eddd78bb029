// Changes by a form or by hand in a picture: each is a change of the text, one after another.

import type { Api, Edit } from "./api";
import type { Editor, OpenDocument } from "./editor";
import { texts } from "./texts";

export interface ValueEditsHooks {
  api: Api;
  editor: Editor;
  model: () => OpenDocument | null;
  /** The model's text has been changed. */
  changed: () => void;
  say: (words: string) => void;
  fail: (error: unknown) => void;
}

/** So often a change is asked about while the text goes on changing. */
const mostTries = 5;

export class ValueEdits {
  /** The last change. */
  private last: Promise<void> = Promise.resolve();

  constructor(private readonly hooks: ValueEditsHooks) {}

  set(key: string, value: string | null): Promise<void> {
    const document = this.hooks.model();
    if (document) this.last = this.last.then(() => this.setOf(document, key, value)).catch((error) => this.hooks.fail(error));
    return this.last;
  }

  /** Each change is asked about of the text that the one before has left; who types meanwhile has it asked about again. */
  private async setOf(document: OpenDocument, key: string, value: string | null): Promise<void> {
    const { api, editor, model, changed, say } = this.hooks;
    for (let i = 0; i < mostTries; i++) {
      const { doc } = document.state;
      const { text } = await api.post<{ text: string; edits?: Edit[] }>("/api/set", { path: document.path, text: doc.toString(), key, value });
      if (document.state.doc !== doc) continue;
      editor.replace(document, text);
      if (document === model()) changed();
      return;
    }
    say(texts.notSet(key));
  }
}
