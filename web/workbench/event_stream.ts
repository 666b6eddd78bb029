// The program's stream of events, as it comes from the connection.

import { Refused, type Api } from "./api";

/** A stream that says nothing for so long is dead: the program says something every five seconds [ms]. */
export const longestSilence = 20_000;

export interface StreamHooks {
  /** An event and its number. */
  event: (name: string, data: unknown, number: string) => void;
  /** Something has come, an event or a sign of life. */
  alive: () => void;
  /** It has ended, and is opened again soon. */
  broken: () => void;
}

/**
 * Hands every event on; connects again where the stream breaks or falls silent. Ends where the token is refused, with
 * true, and by `end`, with false.
 * @param start  number of the last event that is known; undefined: from now on
 */
export async function followStream(api: Api, start: number | undefined, hooks: StreamHooks, end: AbortSignal): Promise<boolean> {
  let after = start === undefined ? "" : String(start);
  let pause = 500;
  const broken = () => {
    api.answered(false);
    hooks.broken();
  };
  while (!end.aborted) {
    const watch = new AbortController();
    let timer = 0;
    const heard = () => {
      clearTimeout(timer);
      timer = window.setTimeout(() => watch.abort(), longestSilence);
    };
    heard();
    try {
      const response = await api.request("GET", `/api/events${after ? `?after=${after}` : ""}`, undefined, {}, AbortSignal.any([watch.signal, end]));
      pause = 500;
      hooks.alive();
      for await (const messages of blocks(response.body!)) {
        heard();
        hooks.alive();
        for (const { event, data, id } of messages) {
          if (id) after = id;
          hooks.event(event, data, after);
          if (event === "reload") after = "";
        }
      }
      broken();
    } catch (error) {
      if (end.aborted) return false;
      if (error instanceof Refused && error.status === 401) return true;
      // One that has fallen silent is opened again, which tells whether anybody is there.
      if (!(error instanceof Refused) && !watch.signal.aborted) broken();
    } finally {
      clearTimeout(timer);
    }
    await new Promise((resolve) => setTimeout(resolve, pause));
    pause = Math.min(5000, 2 * pause);
  }
  return false;
}

interface Message {
  event: string;
  data: unknown;
  id: string;
}

/** What each piece of the stream completes: comments complete nothing. */
async function* blocks(body: ReadableStream<Uint8Array>): AsyncGenerator<Message[]> {
  const reader = body.pipeThrough(new TextDecoderStream() as unknown as ReadableWritablePair<string, Uint8Array>).getReader();
  let rest = "";
  for (;;) {
    const { value, done } = await reader.read();
    if (done) return;
    rest += value;
    const complete = rest.split(/\r?\n\r?\n/);
    rest = complete.pop()!;
    yield complete.flatMap(messageOf);
  }
}

function messageOf(block: string): Message[] {
  const lines = block.split(/\r?\n/);
  const of = (name: string) => lines.filter((line) => line.startsWith(`${name}:`)).map((line) => line.slice(name.length + 1).trimStart());
  const data = of("data").join("\n");
  const event = of("event")[0];
  if (event === undefined && data === "") return [];
  return [{ event: event ?? "message", data: data ? parsed(data) : null, id: of("id")[0] ?? "" }];
}

function parsed(text: string): unknown {
  try {
    return JSON.parse(text);
  } catch {
    return text;
  }
}
