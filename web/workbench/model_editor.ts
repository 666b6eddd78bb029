// The editor with what it offers in a model's text: completion, help, units, repairs, and the keys for them.

import type { Api } from "./api";
import { Editor, type EditorHooks } from "./editor";
import { explainHere, modelHelp, offerUnits, type ModelHelpers } from "./model_help";
import type { ModelSchema } from "./model_schema";
import { texts } from "./texts";

export interface ModelEditorHooks extends Pick<EditorHooks, "changed" | "moved"> {
  api: Api;
  schema: () => ModelSchema | null;
  /** Repairs the fault at the cursor; false: there is none. */
  repair: () => boolean;
  run: () => void;
  say: (words: string) => void;
}

export function modelEditor({ api, schema, changed, moved, repair, run, say }: ModelEditorHooks): Editor {
  const convert = async (value: string, unit: string) => (await api.post<{ text: string }>("/api/convert", { text: value, unit })).text;
  const helpers: ModelHelpers = { schema, convert, say };
  const nothing = (words: string) => (say(words), true);
  const editor: Editor = new Editor({
    changed,
    moved,
    model: modelHelp(helpers),
    commands: [
      { key: "Alt-Enter", run: repair },
      { key: "Alt-u", run: () => offerUnits(editor.view) || nothing(texts.convertNone) },
      { key: "Alt-h", run: () => explainHere(editor.view, helpers) || nothing(texts.explainNone) },
      { key: "Mod-Enter", run: () => (run(), true) },
    ],
  });
  return editor;
}
