// What is open, in the memory of the browser's tab: it comes back when the page is loaded anew.

import type { SavedDocument } from "./editor";

export interface OpenReport {
  /** Of the run, or of the runs compared: each has one tab. */
  key: string;
  title: string;
  url: string;
}

export interface Remembered {
  folder: string;
  documents: SavedDocument[];
  active: string;
  model: string;
  reports: OpenReport[];
  sizes: Record<string, number>;
  tabs: Record<string, string>;
  run: string;
}

const place = "hersey-workbench";
/** Pause before everything open is written [ms]. */
const pause = 400;

export class Memory {
  /** Whether the tab could take all of it. */
  isWritten = true;
  private timer = 0;

  /** Of this folder; null: nothing. */
  recall(folder: string): Remembered | null {
    try {
      const state = JSON.parse(sessionStorage.getItem(place) ?? "null") as Remembered | null;
      return state?.folder === folder && state.documents.length > 0 ? state : null;
    } catch {
      return null;
    }
  }

  writeSoon(state: () => Remembered | null): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.write(state()), pause);
  }

  /** Null: what is written stays. */
  write(state: Remembered | null): void {
    if (!state) return;
    const put = (value: Remembered) => sessionStorage.setItem(place, JSON.stringify(value));
    try {
      put(state);
      this.isWritten = true;
    } catch {
      // Too much for the tab: without the histories, else not at all.
      try {
        put({ ...state, documents: state.documents.map(withoutHistory) });
      } catch {
        this.isWritten = false;
      }
    }
  }
}

function withoutHistory(document: SavedDocument): SavedDocument {
  const { unsaved } = document;
  return unsaved ? { ...document, unsaved: { ...unsaved, state: { ...(unsaved.state as object), history: undefined } } } : document;
}
