// One stream of events for all tabs of a session: a browser opens six connections to one host, and each stream would keep
// one of them. The tab that has the lock follows the stream and passes on what it hears; when it is closed, the next one
// goes on where it was.

import type { Api } from "./api";
import { followStream, longestSilence } from "./event_stream";

/** What the tab with the stream tells the others, and what a new one asks. */
type Word =
  | { kind: "event"; event: string; data: unknown; number: number }
  /** The stream is there; all events up to this one have been passed on. */
  | { kind: "alive"; number: number | null }
  | { kind: "broken" }
  | { kind: "refused" }
  | { kind: "where" };

export type Hear = (event: string, data: unknown) => void;

export class SharedEvents {
  /** Number of the last event that this tab has had; null: not known. */
  private last: number | null;
  private channel: BroadcastChannel | null = null;
  /** Ends this tab's stream. */
  private stream: AbortController | null = null;
  private silence = 0;
  /** Ends the wait for the lock. */
  private wait: AbortController | null = null;
  private takes = false;
  private isOver = false;

  /** @param start  number of the last event that is known; undefined: from now on */
  constructor(
    private readonly api: Api,
    start: number | undefined,
    private readonly hear: Hear,
  ) {
    this.last = start ?? null;
  }

  /** Ends where the token is refused. */
  async follow(): Promise<void> {
    if (!navigator.locks || typeof BroadcastChannel === "undefined") return this.lead();
    const name = `hersey-events-${await this.api.sessionName()}`;
    this.channel = new BroadcastChannel(name);
    this.channel.onmessage = ({ data }: MessageEvent<Word>) => this.take(data);
    this.say({ kind: "where" });
    while (!this.isOver) {
      this.wait = new AbortController();
      this.listen();
      try {
        await navigator.locks.request(name, this.takes ? { steal: true } : { signal: this.wait.signal }, () => this.lead());
      } catch {
        // Taken away: this tab had fallen silent, and listens from now on. Or the wait was ended, to take it.
        this.stream?.abort();
        this.stream = null;
      }
    }
    clearTimeout(this.silence);
    this.channel.close();
  }

  private say(word: Word): void {
    this.channel?.postMessage(word);
  }

  /** Follows the stream for all. */
  private async lead(): Promise<void> {
    clearTimeout(this.silence);
    this.takes = false;
    const stream = (this.stream = new AbortController());
    const event = (name: string, data: unknown, number: string) => {
      this.last = number ? Number(number) : this.last;
      this.hear(name, data);
      this.say({ kind: "event", event: name, data, number: this.last ?? 0 });
    };
    const isRefused = await followStream(this.api, this.last ?? undefined, { event, alive: () => this.say({ kind: "alive", number: this.last }), broken: () => this.say({ kind: "broken" }) }, stream.signal);
    if (!isRefused) return;
    this.say({ kind: "refused" });
    this.refuse();
  }

  private refuse(): void {
    this.isOver = true;
    this.wait?.abort();
    this.hear("refused", null);
  }

  /** A tab that has the stream and says nothing, not even that it has none, is asleep. */
  private listen(): void {
    clearTimeout(this.silence);
    if (this.stream) return;
    this.silence = window.setTimeout(() => {
      this.takes = true;
      this.wait?.abort();
    }, 1.5 * longestSilence);
  }

  private take(word: Word): void {
    if (word.kind === "where") {
      if (this.stream) this.say({ kind: "alive", number: this.last });
      return;
    }
    if (this.stream) return;
    this.listen();
    if (word.kind === "refused") return this.refuse();
    this.api.answered(word.kind !== "broken");
    if (word.kind === "event") {
      if (this.last !== null && word.number <= this.last && word.event !== "reload") return;
      this.last = word.number;
      this.hear(word.event, word.data);
    } else if (word.kind === "alive" && word.number !== null && word.number !== this.last) {
      // Something was said before this tab listened.
      const isBehind = this.last !== null && this.last < word.number;
      this.last = Math.max(this.last ?? 0, word.number);
      if (isBehind) this.hear("reload", null);
    }
  }
}
