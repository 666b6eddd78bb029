// What the program tells by itself: files and runs that have changed, and whether it is there at all.

import type { Api, RunEvent } from "./api";
import type { Notices } from "./notices";
import { SharedEvents } from "./shared_events";
import { texts } from "./texts";

export interface NewsHooks {
  notices: Notices;
  /** Files have changed: the list and the open texts are read again. */
  files: () => void;
  runs: () => void;
  run: (event: RunEvent) => void;
  /** Path of the model that is open. */
  model: () => string | undefined;
  /** A file that the model may be made of has changed. */
  modelFiles: () => void;
  /** The program is there again. */
  back: () => void;
}

export class News {
  isReachable = true;

  constructor(private readonly hooks: NewsHooks) {}

  /** Follows the program's events after the one numbered `from`. */
  follow(api: Api, from: number | undefined): void {
    void new SharedEvents(api, from, (event, data) => this.hear(event, data)).follow();
  }

  private hear(event: string, data: unknown): void {
    const { files, runs, run, notices } = this.hooks;
    if (event === "files") this.hearFiles((data as { paths?: string[] } | null)?.paths ?? []);
    else if (event === "runs") runs();
    else if (event === "run") run(data as RunEvent);
    else if (event === "reload") {
      files();
      runs();
    } else if (event === "refused") {
      this.isReachable = false;
      notices.keep("connection", texts.tokenRefused);
    }
  }

  private hearFiles(paths: string[]): void {
    const { files, runs, model, modelFiles } = this.hooks;
    files();
    const isOfRun = (path: string) => path.startsWith("runs/") || /\.(h5|lock|checkpoint)$/.test(path);
    if (paths.some(isOfRun)) runs();
    // A table, a mesh or a part of the model may be another one.
    if (paths.some((path) => !isOfRun(path) && path !== model())) modelFiles();
  }

  connected(is: boolean): void {
    if (is === this.isReachable) return;
    this.isReachable = is;
    const { notices, back } = this.hooks;
    if (is) {
      notices.drop("connection");
      notices.say(texts.reachable);
      this.hear("reload", null);
      back();
    } else notices.keep("connection", texts.unreachable);
  }
}
