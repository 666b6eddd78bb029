// The runs of the folder, newest first: how far they are, what their models differ in, what can be done with them.

import { Refused, sentences, type Api, type RunEntry } from "./api";
import { h } from "../src/dom";
import { ask } from "./dialogs";
import { normal } from "./file_text";
import { difference, differences, type RunSource } from "./run_difference";
import { texts } from "./texts";

/** Of a run, in the address of a request. */
export const path = (id: string) => encodeURIComponent(id);

export interface RunsHooks {
  api: Api;
  chosen: (run: RunEntry) => void;
  openReport: (report: { key: string; title: string; url: string }) => void;
  /** Shows the part of its model that a failed run is about. */
  showPlace: (run: RunEntry) => void;
  say: (text: string) => void;
  changed: () => void;
}

export class RunsPane {
  readonly element: HTMLElement;
  runs: RunEntry[] = [];
  selected = "";
  private readonly list = h("ul", { class: "runs" });
  private readonly compareButton = h("button", { type: "button", class: "quiet", disabled: true, title: texts.compareHelp, click: () => void this.compare() }, texts.compare);
  private readonly compared = new Set<string>();
  private loads = 0;
  private taken = 0;
  private readonly models = new Map<string, string | null>();

  constructor(private readonly hooks: RunsHooks) {
    this.list.addEventListener("keydown", (event) => {
      const id = (event.target as HTMLElement).closest("[data-run]")?.getAttribute("data-run");
      const run = this.runs.find((r) => r.id === id);
      if (event.key !== "Delete" || !run || run.state === "running") return;
      event.preventDefault();
      void this.remove(run);
    });
    this.element = h("div", { class: "runs-pane" }, this.list, h("div", { class: "pane-tools" }, this.compareButton));
    this.draw();
  }

  get running(): RunEntry[] {
    return this.runs.filter(({ state }) => state === "running");
  }

  async load(): Promise<void> {
    const count = ++this.loads;
    const { runs } = await this.hooks.api.get<{ runs: RunEntry[] }>("/api/runs");
    // An answer that a later one has overtaken is of no use.
    if (count < this.taken) return;
    this.taken = count;
    this.runs = runs;
    for (const id of this.compared) if (!runs.some((run) => run.id === id)) this.compared.delete(id);
    this.draw();
    this.hooks.changed();
    void this.loadModels();
  }

  /** The texts that the runs were made of, to tell what differs. */
  private async loadModels(): Promise<void> {
    // Results made elsewhere do not say of which model they are.
    const unknown = this.runs.filter(({ id, model }) => model && !this.models.has(id)).slice(0, 20);
    for (const run of unknown) {
      this.models.set(run.id, null);
      try {
        this.models.set(run.id, await (await this.hooks.api.request("GET", `/api/runs/${path(run.id)}/model`)).text());
      } catch {
        // A run of before may have none.
      }
    }
    if (unknown.length > 0) this.draw();
  }

  /** Of the model that a run was made of, as the editor would have it; undefined: not known. */
  textOf(id: string): string | undefined {
    const text = this.models.get(id);
    return text ? normal(text) : undefined;
  }

  progress(id: string, share: number): void {
    const run = this.runs.find((r) => r.id === id);
    if (!run) return;
    run.share = share;
    const bar = this.list.querySelector<HTMLProgressElement>(`[data-run="${CSS.escape(id)}"] progress`);
    if (bar) bar.value = share;
    const text = this.list.querySelector(`[data-run="${CSS.escape(id)}"] .share`);
    if (text) text.textContent = `${Math.round(100 * share)} %`;
  }

  select(id: string): void {
    this.selected = id;
    for (const item of this.list.querySelectorAll("[data-run]")) item.classList.toggle("chosen", item.getAttribute("data-run") === id);
  }

  private draw(): void {
    const focused = document.activeElement?.closest("[data-run]") ? { run: document.activeElement.closest("[data-run]")!.getAttribute("data-run"), text: document.activeElement.textContent } : null;
    this.list.replaceChildren(...(this.runs.length > 0 ? this.runs.map((run) => this.row(run)) : [h("li", { class: "note" }, texts.noRuns)]));
    this.compareButton.disabled = this.compared.size < 2;
    if (focused) [...this.list.querySelectorAll<HTMLElement>(`[data-run="${CSS.escape(focused.run!)}"] button`)].find((b) => b.textContent === focused.text)?.focus();
  }

  private name(run: RunEntry): string {
    return (run.model.split("/").pop() ?? run.model).replace(/\.ya?ml$/, "");
  }

  /** Its model with its number, as the list calls it; results made elsewhere by where they are. */
  private title(run: RunEntry): string {
    return run.model ? `${this.name(run)} ${/\d+$/.exec(run.id)?.[0] ?? ""}`.trim() : run.id.replace(/:/g, "/");
  }

  private source(run: RunEntry): RunSource {
    return { text: this.textOf(run.id), set: run.set };
  }

  /** The run of the same model before. */
  private before(run: RunEntry): RunEntry | undefined {
    return this.runs.slice(this.runs.indexOf(run) + 1).find(({ model }) => model === run.model);
  }

  /** What a run has otherwise than the one before, or than its text. */
  private what(run: RunEntry): string {
    const before = this.before(run);
    return difference(this.source(run), before ? this.source(before) : null, texts);
  }

  /** Names of compared runs, by what they differ in. */
  private legends(runs: RunEntry[]): string[] {
    const of = differences(runs.map((run) => this.source(run)), texts);
    const isOneModel = runs.every(({ model }) => model !== "" && model === runs[0]!.model);
    const names = runs.map((run, i) => (!of[i] ? this.title(run) : isOneModel ? of[i]! : run.model ? `${this.name(run)}: ${of[i]}` : this.title(run)));
    return names.map((name, i) => (names.filter((other) => other === name).length > 1 ? `${name} (${runs[i]!.id})` : name));
  }

  private row(run: RunEntry): HTMLElement {
    const { api, say } = this.hooks;
    const act = (label: string, work: () => Promise<unknown>, isOther = true) =>
      h("button", { type: "button", class: "quiet", "aria-label": `${label}: ${texts.runOf(this.name(run), run.id)}`, click: () => void work().then(() => (isOther ? this.load() : undefined)).catch((error: Error) => say(error.message)) }, label);
    const take = h("input", { type: "checkbox", "aria-label": `${texts.chooseRun}: ${texts.runOf(this.name(run), run.id)}`, checked: this.compared.has(run.id), disabled: run.results.length === 0 });
    take.addEventListener("change", () => {
      if (take.checked) this.compared.add(run.id);
      else this.compared.delete(run.id);
      this.compareButton.disabled = this.compared.size < 2;
    });
    const what = this.what(run);
    const pick = h("button", { type: "button", class: "run-name", title: [`${run.model}, ${run.id}`, ...run.set].join("\n"), click: () => this.hooks.chosen(run) }, this.title(run), what ? h("span", { class: "run-what" }, what) : null);
    const isRunning = run.state === "running";
    const share = isRunning ? h("span", { class: "run-progress" }, h("progress", { max: 1, value: run.share ?? 0, "aria-label": texts.runOf(this.name(run), run.id) }), h("span", { class: "share" }, `${Math.round(100 * (run.share ?? 0))} %`)) : null;
    return h(
      "li",
      { "data-run": run.id, class: run.id === this.selected ? "chosen" : "" },
      h("div", { class: "run-head" }, take, pick, h("span", { class: `run-state ${run.state}` }, texts.runState[run.state] ?? run.state)),
      share,
      run.message && run.state !== "completed" ? h("p", { class: `run-message ${run.state}` }, run.message) : null,
      ...this.changedLines(run),
      h(
        "div",
        { class: "run-tools" },
        run.state === "failed" && run.at ? act(texts.showInText, async () => this.hooks.showPlace(run), false) : null,
        isRunning ? act(texts.stop, () => api.post(`/api/runs/${path(run.id)}/stop`)) : null,
        run.can_resume ? act(texts.resume, () => api.post(`/api/runs/${path(run.id)}/resume`)) : null,
        !isRunning && (run.results.length > 0 || run.report) ? act(texts.report, () => this.open(run)) : null,
        isRunning ? null : act(texts.remove, () => this.remove(run), false),
      ),
    );
  }

  /** Stops or resumes a run, or opens its report. */
  async act(run: RunEntry, what: "stop" | "resume" | "report"): Promise<void> {
    try {
      if (what === "report") return await this.open(run);
      await this.hooks.api.post(`/api/runs/${path(run.id)}/${what}`);
      await this.load();
    } catch (error) {
      this.hooks.say(error instanceof Error ? error.message : String(error));
    }
  }

  /** Asks first: nothing brings it back. The run that follows in the list is focused then. */
  private async remove(run: RunEntry): Promise<void> {
    const name = this.title(run);
    const answer = await ask(texts.removeTitle(name, run.folder || run.results.join(", ")), [
      { value: "keep", label: texts.keepRun },
      { value: "remove", label: texts.remove },
    ]);
    const at = this.runs.findIndex(({ id }) => id === run.id);
    try {
      if (answer === "remove") {
        await this.hooks.api.post(`/api/runs/${path(run.id)}/remove`);
        this.hooks.say(texts.removed(name));
        await this.load();
      }
    } catch (error) {
      this.hooks.say(error instanceof Refused ? sentences(error) : error instanceof Error ? error.message : String(error));
    }
    const next = this.runs.some(({ id }) => id === run.id) ? run : (this.runs[at] ?? this.runs[at - 1]);
    if (next) this.list.querySelector<HTMLElement>(`[data-run="${CSS.escape(next.id)}"] .run-name`)?.focus();
  }

  private async open(run: RunEntry): Promise<void> {
    const { url } = await this.hooks.api.post<{ url: string }>(`/api/runs/${path(run.id)}/report`);
    this.hooks.openReport({ key: `report ${run.id}`, title: this.title(run), url });
  }

  private async compare(): Promise<void> {
    const runs = this.runs.filter(({ id }) => this.compared.has(id)).reverse();
    const ids = runs.map(({ id }) => id);
    try {
      const { url } = await this.hooks.api.post<{ url: string }>("/api/compare", { ids, names: this.legends(runs) });
      this.hooks.openReport({ key: `comparison ${[...ids].sort().join(" ")}`, title: texts.comparison, url });
    } catch (error) {
      this.hooks.say(error instanceof Error ? error.message : String(error));
    }
  }

  /** Lines that the run before of the same model had otherwise. */
  private changedLines(run: RunEntry): HTMLElement[] {
    const before = this.before(run);
    const [now, then] = [this.models.get(run.id), before ? this.models.get(before.id) : null];
    if (!now || !then) return [];
    const lines = (text: string) => text.split("\n").map((line) => line.trim()).filter((line) => line && !line.startsWith("#"));
    const [a, b] = [lines(then), lines(now)];
    const left = new Set(a);
    const right = new Set(b);
    const changes = [...b.filter((line) => !left.has(line)).map((line) => ["ins", line] as const), ...a.filter((line) => !right.has(line)).map((line) => ["del", line] as const)];
    if (changes.length === 0) return [];
    const shown = changes.slice(0, 6).map(([tag, line]) => h("li", {}, h(tag, {}, line)));
    return [h("ul", { class: "run-changes", "aria-label": texts.runChange }, ...shown, changes.length > 6 ? h("li", {}, `… ${changes.length - 6} more`) : null)];
  }
}
