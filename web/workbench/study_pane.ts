// A study as a table: the runs that the model's text plans, and those of a study that was started, filling as they come.

import type { Api, Hello, RunEntry } from "./api";
import { h } from "../src/dom";
import { format } from "../src/units";
import type { OpenDocument } from "./editor";
import { OverridesField } from "./overrides";
import { texts } from "./texts";
import { find } from "./yaml_tree";

interface Planned {
  plan: string;
  parameters: { name: string; unit: string }[];
  wanted: string[];
  objectives: { name: string; maximise: boolean }[];
  constraints: string[];
  runs: { run?: string; values: string[] }[];
  total: number;
}

interface StudyRecord {
  run: string;
  values: (string | null)[];
  status: string;
  error?: string;
  figures: Record<string, number | null>;
}

interface Course {
  plan?: Planned | null;
  units: Record<string, { unit: string; si: number }>;
  records: StudyRecord[];
  at: string;
  more: boolean;
  /** Runs that go on, with how far they are. */
  running?: { run: string; values: (string | null)[]; share: number }[];
  state: RunEntry["state"];
}

export interface StudyPaneHooks {
  api: Api;
  machine: Pick<Hello, "processors" | "cluster">;
  model: () => OpenDocument | null;
  studies: () => RunEntry[];
  start: (request: { set: string[]; study: true; on: string; jobs: number }) => Promise<void>;
  act: (run: RunEntry, what: "stop" | "resume" | "report") => Promise<void>;
  /** Shows the plots of one run of a study while it goes on. @param label  as the table calls it */
  showLive: (study: string, run: string, label: string) => void;
  /** How many runs are planned; 0: no study. */
  counted: (runs: number) => void;
}

/** Pause of typing before a study is planned anew [ms]. */
const planPause = 400;
/** Between two readings of a study that goes on [ms]. */
const readPause = 700;

/** As it is written, with no more figures than one reads. */
function shown(text: string | null): string {
  const parts = /^(-?\d+\.\d{4,}(?:e[-+]?\d+)?)(.*)$/i.exec(text ?? "");
  return parts ? `${format(parseFloat(parts[1]!), 5)}${parts[2]}` : (text ?? "–");
}

interface Row {
  row: HTMLElement;
  state: HTMLElement;
  figures: HTMLElement[];
}

/** The table of one study, planned or begun. */
class StudyTable {
  readonly element: HTMLElement;
  done = 0;
  failed = 0;
  private readonly body = h("tbody", {});
  /** By the run's name; the same values twice are one run. */
  private readonly rows = new Map<string, Row[]>();
  private readonly counted = new Map<string, string>();
  private names: string[] | null;
  private readonly head = h("tr", {});
  private readonly units: Course["units"] = {};

  constructor(
    private readonly plan: Planned,
    private readonly state: string,
    private readonly showLive: (run: string, label: string) => void = () => undefined,
  ) {
    this.names = plan.wanted.length > 0 ? plan.wanted : null;
    this.drawHead();
    plan.runs.forEach(({ run, values }, i) => this.add(run ?? String(i), values));
    const rest = plan.total - plan.runs.length;
    this.element = h("div", { class: "study-rows", tabindex: 0, role: "region", "aria-label": texts.studies.table }, h("table", { class: "study-table" }, h("thead", {}, this.head), this.body), rest > 0 ? h("p", { class: "note" }, texts.studies.cut(rest)) : null);
  }

  private drawHead(): void {
    const column = (name: string, words = name, kind = "") => h("th", { scope: "col", title: name, class: kind }, words);
    const figure = (name: string) => {
      const unit = this.units[name]?.unit;
      return column(name, `${name.replace(/^bearings\./, "")}${unit ? ` [${unit.replace(/^um$/, "µm")}]` : ""}`, "number");
    };
    this.head.replaceChildren(column(texts.studies.run), ...this.plan.parameters.map(({ name }) => column(name, name, "number")), column(texts.studies.state), ...(this.names ?? []).map(figure));
  }

  private add(run: string, values: (string | null)[]): Row[] {
    const state = h("td", { class: `study-state ${this.state}` }, texts.studies.states[this.state]!);
    const figures = (this.names ?? []).map(() => h("td", { class: "number" }));
    const row = h("tr", { "data-study-run": run }, h("th", { scope: "row" }, String(this.body.children.length + 1)), ...values.map((value) => h("td", { class: "number" }, shown(value))), state, ...figures);
    this.body.append(row);
    const rows = [...(this.rows.get(run) ?? []), { row, state, figures }];
    this.rows.set(run, rows);
    return rows;
  }

  /** Runs that are not of the plan's first ones count, but have no row; those of an optimum come one by one. */
  take({ records, units }: Course): void {
    Object.assign(this.units, units);
    if (!this.names && records.some(({ status }) => status === "completed")) {
      this.names = Object.keys(records.find(({ status }) => status === "completed")!.figures);
      for (const row of [...this.rows.values()].flat()) {
        row.figures = this.names.map(() => h("td", { class: "number" }));
        row.row.append(...row.figures);
      }
    }
    if (Object.keys(units).length > 0 || records.length > 0) this.drawHead();
    for (const record of records) {
      this.counted.set(record.run, record.status);
      const rows = this.rows.get(record.run) ?? (this.plan.total === 0 ? this.add(record.run, record.values) : []);
      for (const row of rows) this.fill(row, record);
    }
    this.failed = [...this.counted.values()].filter((status) => status !== "completed").length;
    this.done = this.counted.size - this.failed;
  }

  private fill(row: Row, { status, error, figures }: StudyRecord): void {
    const isDone = status === "completed";
    row.state.className = `study-state ${isDone ? "completed" : "failed"}`;
    row.state.textContent = isDone ? texts.studies.states["completed"]! : `${texts.studies.states["failed"]}: ${error ?? ""}`;
    row.figures.forEach((cell, i) => {
      const name = this.names![i]!;
      const value = figures[name];
      cell.textContent = value === null || value === undefined ? "–" : format(value / (this.units[name]?.si ?? 1), 4);
    });
  }

  /** Runs that go on: how far they are, and a button that leads to their plots. */
  private underWay(running: NonNullable<Course["running"]>): Set<string> {
    const names = new Set<string>();
    for (const { run, values, share } of running) {
      if (this.counted.has(run)) continue;
      names.add(run);
      for (const { row, state } of this.rows.get(run) ?? (this.plan.total === 0 ? this.add(run, values) : [])) {
        const words = `${texts.studies.states["running"]!}, ${Math.round(100 * share)} %`;
        const before = state.querySelector("button");
        state.className = "study-state running";
        if (before) before.textContent = words;
        else {
          const label = texts.studies.runNumber(row.querySelector("th")!.textContent ?? "");
          state.replaceChildren(h("button", { type: "button", class: "quiet", title: texts.studies.showLive, "aria-label": `${texts.studies.showLive}: ${label}`, click: () => this.showLive(run, label) }, words));
        }
      }
    }
    return names;
  }

  /** What has no record yet. */
  rest(state: "waiting" | "missing", running: NonNullable<Course["running"]> = []): void {
    const names = this.underWay(running);
    for (const { state: cell } of [...this.rows].flatMap(([run, rows]) => (this.counted.has(run) || names.has(run) ? [] : rows))) {
      cell.className = `study-state ${state}`;
      cell.textContent = texts.studies.states[state]!;
    }
  }
}

export class StudyPane {
  readonly element: HTMLElement;
  private readonly choice = h("select", { "aria-label": texts.studies.shown });
  private readonly words = h("span", { class: "study-words", role: "status" });
  private readonly jobs = h("input", { type: "number", min: 1, max: 4096, step: 1, title: texts.studies.jobsHelp, "aria-label": texts.studies.jobs });
  private readonly where = h("select", { "aria-label": texts.studies.where }, h("option", { value: "local" }, texts.studies.here), h("option", { value: "slurm" }, texts.studies.cluster));
  private readonly startButton = h("button", { type: "button", class: "main-button", disabled: true, click: () => void this.start() }, texts.studies.start);
  private readonly starting: HTMLElement;
  private readonly acting = h("span", { class: "study-actions" });
  private readonly content = h("div", { class: "study-content" });
  private readonly overrides: OverridesField;
  private timer = 0;
  private plans = 0;
  private plannedOf = "";
  /** The study that is shown; empty: the plan. */
  private run = "";
  private table: StudyTable | null = null;
  private at = "";
  private readTimer = 0;
  private total = 0;

  constructor(private readonly hooks: StudyPaneHooks) {
    this.jobs.value = String(hooks.machine.processors ?? 1);
    // A model whose study is one run's length is checked by planning it.
    this.overrides = new OverridesField(() => this.planSoon());
    const where = hooks.machine.cluster ? h("label", {}, `${texts.studies.where} `, this.where) : null;
    this.starting = h("span", { class: "study-starting" }, h("label", {}, `${texts.studies.jobs} `, this.jobs), where, this.overrides.element, this.startButton);
    this.choice.addEventListener("change", () => this.show(this.choice.value));
    this.element = h("div", { class: "study-pane" }, h("div", { class: "pane-tools" }, this.choice, this.words, this.starting, this.acting), this.content);
    this.content.append(h("p", { class: "note" }, texts.studies.none));
    this.starting.hidden = true;
    this.choice.hidden = true;
  }

  /** Whether the model that is open plans one. */
  get hasStudy(): boolean {
    const model = this.hooks.model();
    return model !== null && find(model.tree, ["study"]) !== undefined;
  }

  /** All combinations of the values in its lists, which `hersey run` does as well. */
  get isWrittenOut(): boolean {
    const model = this.hooks.model();
    const plan = model ? find(model.tree, ["study", "plan"]) : undefined;
    return !plan || model!.state.sliceDoc(plan.valueFrom, plan.valueTo).trim() === "full_factorial";
  }

  /** The pane has come into sight, or the model's text is another one. */
  refresh(): void {
    this.drawChoice();
    if (this.run) void this.read();
    else if (!this.hasStudy) this.showNothing();
    else this.planSoon(0);
    if (!this.hasStudy) this.hooks.counted(0);
  }

  /** The list of runs is another one. */
  listed(): void {
    this.drawChoice();
    this.drawActions();
    if (this.run) this.readSoon();
  }

  /** A study that was started, or with an empty name the plan of the model. */
  show(run: string): void {
    this.run = run;
    this.table = null;
    this.at = "";
    this.plannedOf = "";
    this.words.textContent = "";
    this.content.replaceChildren();
    this.drawChoice();
    this.drawActions();
    this.refresh();
  }

  focusStart(): void {
    if (this.run) this.show("");
    this.startButton.focus();
  }

  private showNothing(): void {
    this.plannedOf = "";
    this.words.textContent = "";
    this.starting.hidden = true;
    this.content.replaceChildren(h("p", { class: "note" }, texts.studies.none));
  }

  private drawChoice(): void {
    const model = this.hooks.model();
    const studies = this.hooks.studies();
    if (this.run && !studies.some(({ id }) => id === this.run)) this.run = "";
    const plan = this.hasStudy || !this.run ? [h("option", { value: "" }, texts.studies.plan(model?.name ?? "–"))] : [];
    const options = [...plan, ...studies.map(({ id }) => h("option", { value: id }, id))];
    const isSame = options.length === this.choice.options.length && options.every((option, i) => this.choice.options[i]!.textContent === option.textContent);
    if (!isSame) this.choice.replaceChildren(...options);
    this.choice.value = this.run;
    this.choice.hidden = studies.length === 0 && !this.hasStudy;
    this.starting.hidden = this.run !== "" || !this.hasStudy;
  }

  private drawActions(): void {
    const run = this.hooks.studies().find(({ id }) => id === this.run);
    const button = (what: "stop" | "resume" | "report") => h("button", { type: "button", class: "quiet", "data-act": what, click: () => void this.hooks.act(run!, what) }, texts[what]);
    const wanted = run ? ([...(run.state === "running" ? ["stop"] : run.can_resume ? ["resume"] : []), ...(run.report ? ["report"] : [])] as ("stop" | "resume" | "report")[]) : [];
    if ([...this.acting.children].map((b) => b.getAttribute("data-act")).join() !== wanted.join()) this.acting.replaceChildren(...wanted.map(button));
  }

  // ---- the plan

  private planSoon(pause = planPause): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => void this.plan(), pause);
  }

  private async plan(): Promise<void> {
    const model = this.hooks.model();
    if (this.run || !model || !this.hasStudy || !this.element.checkVisibility()) return;
    const request = { path: model.path, text: model.state.doc.toString(), set: this.overrides.values };
    const key = JSON.stringify(request);
    if (key === this.plannedOf) return;
    this.plannedOf = key;
    const count = ++this.plans;
    this.words.textContent = texts.studies.planning;
    this.startButton.disabled = true;
    try {
      const plan = await this.hooks.api.post<Planned>("/api/plan", request);
      if (count !== this.plans || this.run) return;
      this.words.textContent = texts.studies.planned(plan.plan, plan.total);
      this.table = new StudyTable(plan, "planned");
      const optimum = plan.objectives.map(({ name, maximise }) => `${maximise ? "maximise" : "minimise"} ${name}`);
      const goal = [...optimum, ...plan.constraints].join(", ");
      this.content.replaceChildren(...(goal ? [h("p", { class: "note" }, goal)] : []), this.table.element);
      this.startButton.disabled = false;
      this.overrides.say([]);
      this.hooks.counted(plan.total);
    } catch (error) {
      if (count !== this.plans || this.run) return;
      this.words.textContent = "";
      const words = error instanceof Error ? error.message : String(error);
      this.content.replaceChildren(h("pre", { class: "study-fault" }, words));
    }
  }

  private async start(): Promise<void> {
    const jobs = Math.round(Number(this.jobs.value));
    await this.hooks.start({ set: this.overrides.values, study: true, on: this.hooks.machine.cluster ? this.where.value : "local", jobs: jobs >= 1 ? jobs : 1 });
  }

  // ---- a study that was started

  private readSoon(): void {
    clearTimeout(this.readTimer);
    this.readTimer = window.setTimeout(() => void this.read(), readPause);
  }

  private async read(): Promise<void> {
    const { run } = this;
    if (!run || !this.element.checkVisibility()) return;
    clearTimeout(this.readTimer);
    let course: Course;
    try {
      course = await this.hooks.api.get<Course>(`/api/runs/${encodeURIComponent(run)}/study${this.at ? `?after=${encodeURIComponent(this.at)}` : ""}`);
    } catch (error) {
      if (run === this.run) this.words.textContent = error instanceof Error ? error.message : String(error);
      return;
    }
    if (run !== this.run) return;
    if (!this.table) {
      // It plans its runs before it begins with them.
      if (!course.plan) return course.state === "running" ? this.readSoon() : void (this.words.textContent = texts.runState[course.state]);
      this.table = new StudyTable(course.plan, "waiting", (part, label) => this.hooks.showLive(run, part, label));
      this.total = course.plan.total;
      this.content.replaceChildren(this.table.element);
    }
    this.at = course.at;
    this.table.take(course);
    const isRunning = course.state === "running";
    this.table.rest(isRunning ? "waiting" : "missing", course.running);
    this.words.textContent = `${texts.studies.done(this.table.done, this.total, this.table.failed)}, ${texts.runState[course.state]}`;
    if (course.more) return void this.read();
    if (isRunning) this.readSoon();
  }
}
