// What the program serves below /api/: requests with the token of the session.

import { formOf, normal, written, type FileForm } from "./file_text";

export interface Hello {
  version: string;
  folder: string;
  open: string | null;
  /** Number of the last event. */
  event?: number;
  /** Of the machine that the program runs on. */
  processors?: number;
  /** Whether it can hand runs to a cluster. */
  cluster?: boolean;
}

/** What a file holds, with "\n" between its lines. */
export interface FileContent {
  text: string;
  etag: string | null;
  form: FileForm;
}

export interface Edit {
  line: number;
  column: number;
  endLine: number;
  endColumn: number;
  text: string;
}

export interface Fault {
  line: number;
  column: number;
  endColumn?: number;
  file: string;
  path: string;
  message: string;
  found: string;
  expected: string;
  suggestion: string;
  repairs?: { label: string; edits: Edit[] }[];
}

/** Where a part of the machine stands in the text; lines from 1. */
export interface Source {
  line: number;
  column?: number;
  endLine: number;
}

/** A hole, groove or line of a bearing's unwrapped surface, in SI. */
export interface Feature {
  name: string;
  kind: string;
  surface?: "fixed" | "moving";
  phi: number;
  z: number;
  arc: number;
  length: number;
  /** The key that holds it, such as bearings.main.features.hole. */
  key?: string;
  source?: Source | null;
}

/** An arc of a bore, with where its film begins and ends [rad]. */
export interface BoreArc {
  name: string;
  from: number;
  to: number;
  /** The key that holds it, or the whole `bore` of equal arcs. */
  key: string;
  isOfBore: boolean;
}

export interface BearingScene {
  radius: number;
  width: number;
  clearance: number;
  /** Names of the coordinates, such as phi and z. */
  along: string;
  across: string;
  grid: { circumferential: number; axial: number; along: number[]; across: number[]; closes: boolean; arcs?: number[] };
  features: Feature[];
  arcs?: BoreArc[];
  supply?: { at: "angle" | "widest_gap"; phi: number };
}

export interface FileEntry {
  path: string;
  kind: "model" | "mesh" | "table" | "results" | "report" | "text" | "other";
  size: number;
  changed: string | number;
}

export type RunState = "running" | "completed" | "failed" | "stopped" | "lost";

export interface RunEntry {
  id: string;
  model: string;
  set: string[];
  folder: string;
  state: RunState;
  share: number;
  started: string | number | null;
  ended: string | number | null;
  message: string;
  results: string[];
  report: string | null;
  /** Of a failed one: the part of its model that the message is about; no `file` where it is outside the folder. */
  at?: { path: string; file: string; line: number } | null;
  can_resume?: boolean;
  study?: boolean;
}

export interface Template {
  name: string;
  title: string;
  text: string;
}

export interface BearingFigures {
  clearance?: number | null;
  h_min?: number;
  p_max?: number;
  e_x?: number;
  e_y?: number;
  power?: number;
  power_asperity?: number;
  flow?: number;
  T_max?: number;
  /** Of a film with temperatures [W]. */
  heat?: { to_oil: number | null; to_shell: number | null; to_journal: number | null; stored: number | null };
}

/** A line of a run's events: small, at most ten a second. */
export interface RunEvent {
  id: string;
  kind: string;
  /** Which one of a study. */
  run?: number;
  t?: number;
  share?: number;
  text?: string;
  bearings?: Record<string, BearingFigures>;
  /** Of the whole machine [W]. */
  powers?: { [key: string]: number | null } & { heat?: { surroundings: number | null; bodies: number | null } };
  circuit?: { nodes: Record<string, { pressure: number | null; drawn: number | null; temperature?: number }>; flows: Record<string, number | null> };
}

/** The server said no: why, and what to do. */
export class Refused extends Error {
  constructor(
    readonly status: number,
    message: string,
    readonly advice: string,
    readonly body: Record<string, unknown>,
  ) {
    super(message);
  }
}

/** Why, and what to do. */
export function sentences({ message, advice }: Refused): string {
  return advice ? `${message}${/[.!?]$/.test(message) ? "" : ";"} ${advice}` : message;
}

/** Nobody answers: the program was ended. */
export class Unreachable extends Error {}

export class Api {
  /** Called after every request: whether the program has answered it, and knows the token. */
  answered: (is: boolean) => void = () => undefined;

  constructor(private readonly token: string) {}

  async request(method: string, path: string, body?: unknown, headers: Record<string, string> = {}, signal: AbortSignal | null = null): Promise<Response> {
    const all: Record<string, string> = { Authorization: `Bearer ${this.token}`, ...headers };
    let content: string | undefined;
    if (typeof body === "string") [content, all["Content-Type"]] = [body, "text/plain; charset=utf-8"];
    else if (body !== undefined) [content, all["Content-Type"]] = [JSON.stringify(body), "application/json"];
    let response: Response;
    try {
      response = await fetch(path, { method, headers: all, ...(content === undefined ? {} : { body: content }), cache: "no-store", signal });
    } catch (error) {
      this.answered(false);
      throw new Unreachable(String(error));
    }
    if (response.status !== 401) this.answered(true);
    if (response.ok) return response;
    const said: Record<string, unknown> = await response.json().catch(() => ({}));
    throw new Refused(response.status, String(said["error"] ?? `${response.status} ${response.statusText}`), String(said["advice"] ?? ""), said);
  }

  async get<T>(path: string): Promise<T> {
    return (await this.request("GET", path)).json() as Promise<T>;
  }

  async post<T>(path: string, body: unknown = {}): Promise<T> {
    const response = await this.request("POST", path, body);
    const text = await response.text();
    return (text ? JSON.parse(text) : {}) as T;
  }

  async file(path: string): Promise<FileContent> {
    const response = await this.request("GET", `/api/file?path=${encodeURIComponent(path)}`);
    // Not text(), which drops the mark of the byte order.
    const raw = new TextDecoder("utf-8", { ignoreBOM: true }).decode(await response.arrayBuffer());
    return { text: normal(raw), etag: response.headers.get("ETag"), form: formOf(raw) };
  }

  /** Saves over what `etag` names; without one only where there is no such file yet. */
  async save(path: string, text: string, form: FileForm, etag: string | null): Promise<string | null> {
    const condition: Record<string, string> = etag ? { "If-Match": etag } : { "If-None-Match": "*" };
    const response = await this.request("PUT", `/api/file?path=${encodeURIComponent(path)}`, written(text, form), condition);
    return response.headers.get("ETag");
  }

  /** A name for this session that does not tell its token. */
  async sessionName(): Promise<string> {
    const digest = await crypto.subtle.digest("SHA-256", new TextEncoder().encode(this.token));
    return [...new Uint8Array(digest).slice(0, 8)].map((byte) => byte.toString(16).padStart(2, "0")).join("");
  }
}
