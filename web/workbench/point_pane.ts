// One bearing by itself: load, speed, clearance and viscosity on sliders, its answers as they move.

import type { Api } from "./api";
import { fieldsOnly, type DatasetText } from "../src/data";
import { h } from "../src/dom";
import { FieldMap } from "../src/field_map";
import { FilmFields } from "../src/film_fields";
import { format, shownUnit } from "../src/units";
import { texts } from "./texts";

interface Answer {
  id: string;
  figures: { key: string; group: string; name: string; unit: string; value: number | null; words?: string }[];
  position?: unknown;
  datasets?: Record<string, DatasetText>;
  point?: Record<string, { value: number; unit: string }>;
  error?: string;
  remark?: string;
  time?: number;
  ms?: number;
}

/** Around the value of the model, so many times less and more. */
const spread = 8;

interface Knob {
  key: "load" | "speed" | "radial_clearance" | "viscosity";
  unit: string;
  /** Factor from SI. */
  factor: number;
  fallback: number;
}

const knobs: Knob[] = [
  { key: "load", unit: "N", factor: 1, fallback: 1000 },
  { key: "speed", unit: "rpm", factor: 30 / Math.PI, fallback: 3000 },
  { key: "radial_clearance", unit: "um", factor: 1e6, fallback: 40 },
  { key: "viscosity", unit: "mPa.s", factor: 1e3, fallback: 10 },
];

export class PointPane {
  readonly element: HTMLElement;
  private readonly figures = h("table", { class: "figures-table" });
  private readonly map = h("div", { class: "pressure-map" });
  private readonly status = h("p", { class: "note", role: "status" }, texts.solveStart);
  private readonly sliders = new Map<string, { input: HTMLInputElement; value: HTMLElement; middle: number }>();
  private readonly touched = new Set<string>();
  private bearing = "";
  private previous: string | undefined;
  private wanted = false;
  private busy = false;
  private drawn: FieldMap | null = null;

  constructor(
    private readonly api: Api,
    private readonly model: () => { path: string; text: string } | null,
    private readonly choice: { name: () => string },
  ) {
    const rows = knobs.flatMap((knob) => {
      const input = h("input", { type: "range", min: -1, max: 1, step: 0.01, value: 0, "aria-label": texts.sliders[knob.key] });
      const value = h("output", { class: "slider-value" });
      this.sliders.set(knob.key, { input, value, middle: knob.fallback });
      input.addEventListener("input", () => {
        this.touched.add(knob.key);
        this.write(knob);
        this.ask();
      });
      this.write(knob);
      return [h("span", { class: "slider-name" }, texts.sliders[knob.key]), input, value, h("span", {})];
    });
    this.element = h("div", { class: "point-pane" }, h("div", { class: "joint-sliders" }, ...rows), this.status, h("h3", {}, texts.pressureMap), this.map, this.figures);
  }

  /** The pane has come into sight, or the text has changed. */
  refresh(): void {
    if (this.choice.name() !== this.bearing) {
      this.bearing = this.choice.name();
      this.previous = undefined;
      this.touched.clear();
    }
    if (this.bearing && this.element.isConnected && this.element.checkVisibility()) this.ask();
  }

  private current(knob: Knob): number {
    const { input, middle } = this.sliders.get(knob.key)!;
    return middle * spread ** Number(input.value);
  }

  private write(knob: Knob): void {
    this.sliders.get(knob.key)!.value.textContent = `${format(this.current(knob), 3)} ${shownUnit(knob.unit).replace("mPa.s", "mPa·s")}`;
  }

  private ask(): void {
    this.wanted = true;
    if (!this.busy) void this.work();
  }

  private async work(): Promise<void> {
    this.busy = true;
    while (this.wanted) {
      this.wanted = false;
      const model = this.model();
      if (!model || !this.bearing) break;
      const set = knobs.filter(({ key }) => this.touched.has(key)).map((knob) => `${knob.key}=${this.current(knob).toPrecision(5)} ${knob.unit}`);
      const begun = performance.now();
      try {
        const answer = await this.api.post<Answer>("/api/bearing", { ...model, bearing: this.bearing, set, ...(this.previous ? { previous: this.previous } : {}) });
        this.previous = answer.id;
        this.show(answer, performance.now() - begun);
      } catch (error) {
        this.status.textContent = error instanceof Error ? error.message : String(error);
        this.element.classList.add("old");
      }
    }
    this.busy = false;
  }

  private show(answer: Answer, ms: number): void {
    this.element.classList.remove("old");
    this.status.textContent = [answer.error, answer.remark, texts.solved(Math.round(ms))].filter((text) => text).join(" ");
    for (const knob of knobs) {
      const own = answer.point?.[knob.key];
      if (!own || this.touched.has(knob.key)) continue;
      this.sliders.get(knob.key)!.middle = own.value * knob.factor;
      this.write(knob);
    }
    const groups = [...new Set(answer.figures.map(({ group }) => group))];
    this.figures.replaceChildren(
      ...groups.flatMap((group) => [
        h("tbody", {}, h("tr", {}, h("th", { colspan: 2, class: "group" }, group)), ...answer.figures.filter((f) => f.group === group).map((f) => h("tr", { "data-figure-key": f.key }, h("th", {}, f.name), h("td", { class: "number" }, f.words ?? `${format(f.value)} ${shownUnit(f.unit)}`)))),
      ]),
    );
    this.drawMap(answer);
  }

  private drawMap({ datasets }: Answer): void {
    if (!datasets) return;
    const fields = FilmFields.of(fieldsOnly(datasets), this.bearing);
    const kind = fields?.kinds()[0];
    if (!fields || !kind) return;
    this.drawn?.destroy();
    this.drawn = new FieldMap(fields, kind, "instant");
    this.map.replaceChildren(this.drawn.element);
    this.drawn.show(0, []);
  }
}
