// The runs of the folder, newest first: how far they are, what their models differ in, what can be done with them.

import type { Api, RunEntry } from "./api";
import { h } from "../src/dom";
import { normal } from "./file_text";
import { texts } from "./texts";

/** Of a run, in the address of a request. */
export const path = (id: string) => encodeURIComponent(id);

export interface RunsHooks {
  api: Api;
  chosen: (run: RunEntry) => void;
  openReport: (report: { key: string; title: string; url: string }) => void;
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
    this.list.replaceChildren(...(this.runs.length > 0 ? this.runs.map((run, i) => this.row(run, i)) : [h("li", { class: "note" }, texts.noRuns)]));
    this.compareButton.disabled = this.compared.size < 2;
    if (focused) [...this.list.querySelectorAll<HTMLElement>(`[data-run="${CSS.escape(focused.run!)}"] button`)].find((b) => b.textContent === focused.text)?.focus();
  }

  private name(run: RunEntry): string {
    return (run.model.split("/").pop() ?? run.model).replace(/\.ya?ml$/, "");
  }

  private row(run: RunEntry, index: number): HTMLElement {
    const { api, say } = this.hooks;
    const act = (label: string, work: () => Promise<unknown>) =>
      h("button", { type: "button", class: "quiet", "aria-label": `${label}: ${texts.runOf(this.name(run), run.id)}`, click: () => void work().then(() => this.load()).catch((error: Error) => say(error.message)) }, label);
    const take = h("input", { type: "checkbox", "aria-label": `${texts.chooseRun}: ${texts.runOf(this.name(run), run.id)}`, checked: this.compared.has(run.id), disabled: run.results.length === 0 });
    take.addEventListener("change", () => {
      if (take.checked) this.compared.add(run.id);
      else this.compared.delete(run.id);
      this.compareButton.disabled = this.compared.size < 2;
    });
    const pick = h("button", { type: "button", class: "run-name", title: `${run.model}, ${run.id}`, click: () => this.hooks.chosen(run) }, `${this.name(run)} ${/\d+$/.exec(run.id)?.[0] ?? ""}`);
    const isRunning = run.state === "running";
    const share = isRunning ? h("span", { class: "run-progress" }, h("progress", { max: 1, value: run.share ?? 0, "aria-label": texts.runOf(this.name(run), run.id) }), h("span", { class: "share" }, `${Math.round(100 * (run.share ?? 0))} %`)) : null;
    return h(
      "li",
      { "data-run": run.id, class: run.id === this.selected ? "chosen" : "" },
      h("div", { class: "run-head" }, take, pick, h("span", { class: `run-state ${run.state}` }, texts.runState[run.state] ?? run.state)),
      share,
      run.message && run.state !== "completed" ? h("p", { class: `run-message ${run.state}` }, run.message) : null,
      ...this.difference(run, index),
      h(
        "div",
        { class: "run-tools" },
        isRunning ? act(texts.stop, () => api.post(`/api/runs/${path(run.id)}/stop`)) : null,
        run.can_resume ? act(texts.resume, () => api.post(`/api/runs/${path(run.id)}/resume`)) : null,
        !isRunning && (run.results.length > 0 || run.report) ? act(texts.report, () => this.open(run)) : null,
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

  private async open(run: RunEntry): Promise<void> {
    const { url } = await this.hooks.api.post<{ url: string }>(`/api/runs/${path(run.id)}/report`);
    this.hooks.openReport({ key: `report ${run.id}`, title: run.id, url });
  }

  private async compare(): Promise<void> {
    const ids = [...this.compared];
    try {
      const { url } = await this.hooks.api.post<{ url: string }>("/api/compare", { ids });
      this.hooks.openReport({ key: `comparison ${[...ids].sort().join(" ")}`, title: texts.comparison, url });
    } catch (error) {
      this.hooks.say(error instanceof Error ? error.message : String(error));
    }
  }

  /** Lines that the run before of the same model had otherwise. */
  private difference(run: RunEntry, index: number): HTMLElement[] {
    const set = run.set.length > 0 ? [h("p", { class: "run-set" }, run.set.join(", "))] : [];
    const before = this.runs.slice(index + 1).find(({ model }) => model === run.model);
    const [now, then] = [this.models.get(run.id), before ? this.models.get(before.id) : null];
    if (!now || !then) return set;
    const lines = (text: string) => text.split("\n").map((line) => line.trim()).filter((line) => line && !line.startsWith("#"));
    const [a, b] = [lines(then), lines(now)];
    const left = new Set(a);
    const right = new Set(b);
    const changes = [...b.filter((line) => !left.has(line)).map((line) => ["ins", line] as const), ...a.filter((line) => !right.has(line)).map((line) => ["del", line] as const)];
    if (changes.length === 0) return set;
    const shown = changes.slice(0, 6).map(([tag, line]) => h("li", {}, h(tag, {}, line)));
    return [...set, h("ul", { class: "run-changes", "aria-label": texts.runChange }, ...shown, changes.length > 6 ? h("li", {}, `… ${changes.length - 6} more`) : null)];
  }
}
