// One bearing by itself: load, speed, clearance and viscosity on sliders, its answers as they move.

import type { Api } from "./api";
import { fieldsOnly, type FigureText, type SolutionText } from "../src/data";
import { kindOf } from "../src/bearing_kinds";
import { h } from "../src/dom";
import { FieldMap } from "../src/field_map";
import { unitText, valueText } from "../src/figure_text";
import { FilmFields } from "../src/film_fields";
import { Locus } from "../src/locus";
import { format } from "../src/units";
import type { OpenReport } from "./memory";
import { PointCurves } from "./point_curves";
import { texts } from "./texts";
import { quantityPattern } from "./units_of";
import { child, find, type TextNode } from "./yaml_tree";

interface Answer {
  id: string | null;
  solved: boolean;
  message: string;
  figures: FigureText[];
  position: { e: [number, number]; clearance: number; ratio: number } | null;
  solution: SolutionText;
  time: number;
  /** What the program has changed of the text for it. */
  set: string[];
}

/** Around the value of the model, so many times less and more. */
const spread = 8;

interface Knob {
  key: "load" | "speed" | "clearance" | "viscosity";
  unit: string;
  usual: number;
}

const knobs: Knob[] = [
  { key: "load", unit: "N", usual: 1000 },
  { key: "speed", unit: "rpm", usual: 3000 },
  { key: "clearance", unit: "um", usual: 40 },
  { key: "viscosity", unit: "mPa.s", usual: 10 },
];

/** Of units that may be typed, in that of the slider. */
const factors: Record<Knob["key"], Record<string, number>> = {
  load: { N: 1, kN: 1e3, lbf: 4.4482216152605 },
  speed: { rpm: 1, "rad/s": 30 / Math.PI, "deg/s": 1 / 6, Hz: 60 },
  clearance: { um: 1, mm: 1e3, m: 1e6, in: 25400 },
  viscosity: { "mPa.s": 1, "Pa.s": 1e3, cP: 1 },
};

const shownKnobUnit = ({ unit }: Knob) => unit.replace("um", "µm").replace("mPa.s", "mPa·s");

/** Groups of figures that are worth a line each, the first ones first. */
const groups = ["film", "films", "pads", "operating point", "friction", "power", "oil", "heat", "stability of a rigid rotor", "numbers"];

export class PointPane {
  readonly element: HTMLElement;
  private readonly figures = h("table", { class: "figures-table" });
  private readonly map = h("div", { class: "pressure-map" });
  private readonly locus = h("div", { class: "point-locus" });
  private readonly coefficients = h("div", { class: "point-coefficients" });
  private readonly curves: PointCurves;
  private readonly status = h("p", { class: "note", role: "status" }, texts.solveStart);
  private readonly report = h("button", { type: "button", class: "quiet", disabled: true }, texts.pointReport);
  /** Of the answer that is shown. */
  private set: string[] = [];
  /** `exact`: what was typed, where no position of the slider is. */
  private readonly sliders = new Map<string, { input: HTMLInputElement; value: HTMLInputElement; middle: number; isKnown: boolean; exact: number | null }>();
  private readonly touched = new Set<string>();
  private bearing = "";
  /** Path of the model that the sliders are of. */
  private path = "";
  private previous: string | null = null;
  private wanted = false;
  private busy = false;
  private isFaulty = false;
  private drawn: { map: FieldMap | null; locus: Locus | null } = { map: null, locus: null };

  constructor(
    private readonly api: Api,
    private readonly model: () => { path: string; text: string; tree: TextNode } | null,
    private readonly name: () => string,
    private readonly openReport: (report: OpenReport) => void,
  ) {
    this.report.addEventListener("click", () => void this.makeReport());
    const rows = knobs.flatMap((knob) => {
      const input = h("input", { type: "range", min: -1, max: 1, step: 0.01, value: 0, "aria-label": texts.sliders[knob.key] });
      const value = h("input", { type: "text", class: "slider-value", spellcheck: "false", autocomplete: "off", "aria-label": texts.sliderField(texts.sliders[knob.key]) });
      this.sliders.set(knob.key, { input, value, middle: knob.usual, isKnown: false, exact: null });
      value.addEventListener("change", () => this.take(knob));
      // What cannot be taken gives way to the value that counts.
      value.addEventListener("blur", () => value.hasAttribute("aria-invalid") && this.write(knob));
      input.addEventListener("input", () => {
        this.touched.add(knob.key);
        this.sliders.get(knob.key)!.exact = null;
        this.write(knob);
        this.ask();
      });
      const reset = h("button", { type: "button", class: "quiet", "aria-label": `${texts.sliders[knob.key]}: ${texts.jointReset}` }, "↺");
      reset.addEventListener("click", () => {
        this.touched.delete(knob.key);
        this.sliders.get(knob.key)!.exact = null;
        input.value = "0";
        this.write(knob);
        this.ask();
      });
      this.write(knob);
      return [h("span", { class: "slider-name" }, texts.sliders[knob.key]), input, value, reset];
    });
    this.curves = new PointCurves({
      abscissae: () => knobs.filter(({ key }) => this.sliders.get(key)!.isKnown || this.touched.has(key)).map((knob) => ({ key: knob.key, label: texts.sliders[knob.key], unit: shownKnobUnit(knob), value: this.current(knob) })),
      solve: async (key, value, previous) => {
        const { id, solved, solution } = await this.solve({ [key]: value }, ["none"], previous);
        return { id, solved, figures: solved ? solution.figures : [] };
      },
      present: () => this.previous,
    });
    this.element = h("div", { class: "point-pane" }, h("div", { class: "joint-sliders" }, ...rows), h("div", { class: "point-head" }, this.status, this.report), h("div", { class: "point-pictures" }, this.map, this.locus), this.curves.element, this.figures, this.coefficients);
  }

  /** Settings of the sliders for the program; `instead` are values in place of some. */
  private settings(tree: TextNode, instead: Partial<Record<string, number>>): string[] {
    // A bearing of a machine may have no operating point of its own.
    const hasPoint = find(tree, ["bearings", this.bearing, "operating_point"]) !== undefined || find(tree, ["use"]) !== undefined;
    const written = (knob: Knob) => `${Number((instead[knob.key] ?? this.current(knob)).toPrecision(5))} ${knob.unit}`;
    const ofPoint = (knob: Knob) => knob.key === "load" || knob.key === "speed";
    const set = knobs.filter((knob) => (this.touched.has(knob.key) || instead[knob.key] !== undefined) && (hasPoint || !ofPoint(knob))).map((knob) => `${knob.key}=${written(knob)}`);
    if (!hasPoint) set.unshift(`bearings.${this.bearing}.operating_point={journal_speed: ${written(knobs[1]!)}, load: ${written(knobs[0]!)}}`);
    return set;
  }

  /** The page of `hersey bearing --report` at these values, in a tab of its own. */
  private async makeReport(): Promise<void> {
    const model = this.model();
    if (!model) return;
    this.report.disabled = true;
    this.status.textContent = texts.pointReportMade;
    try {
      const { url } = await this.api.post<{ url: string }>("/api/bearing_report", { path: model.path, text: model.text, bearing: this.bearing, set: this.set });
      this.status.textContent = "";
      this.openReport({ key: `bearing ${model.path} ${this.bearing} ${this.set.join(" ")}`, title: texts.pointReportTitle(this.bearing), url });
    } catch (error) {
      this.status.textContent = error instanceof Error ? error.message : String(error);
    }
    this.report.disabled = false;
  }

  private solve(instead: Partial<Record<string, number>>, fields: string[], previous: string | null): Promise<Answer> {
    const model = this.model();
    if (!model) return Promise.reject(new Error(texts.noBearing));
    const set = this.settings(model.tree, instead);
    return this.api.post<Answer>("/api/bearing", { path: model.path, text: model.text, bearing: this.bearing, set, fields, ...(previous ? { previous } : {}) });
  }

  /** Another model or bearing: nothing of the last one stays, and the sliders wait for what this one says. */
  clear(): void {
    this.bearing = this.path = "";
    this.previous = null;
    this.touched.clear();
    this.curves.clear();
    for (const slider of this.sliders.values()) {
      slider.input.value = "0";
      slider.isKnown = false;
      slider.exact = null;
      slider.value.value = "–";
      slider.value.removeAttribute("aria-invalid");
      slider.input.disabled = slider.value.disabled = true;
    }
    this.report.disabled = true;
    this.drawn.map?.destroy();
    this.drawn.locus?.destroy();
    this.drawn = { map: null, locus: null };
    for (const part of [this.figures, this.map, this.locus, this.coefficients]) part.replaceChildren();
    this.status.textContent = texts.solveStart;
  }

  /** The pane has come into sight, or the text has changed. */
  refresh(): void {
    const path = this.model()?.path ?? "";
    if (this.name() !== this.bearing || path !== this.path) {
      this.clear();
      this.bearing = this.name();
      this.path = path;
    }
    if (this.isFaulty) return;
    if (!this.bearing) this.status.textContent = texts.noBearing;
    else if (this.element.checkVisibility()) this.ask();
  }

  private current(knob: Knob): number {
    const { input, middle, exact } = this.sliders.get(knob.key)!;
    if (exact !== null) return exact;
    return middle * spread ** Number(input.value);
  }

  private write(knob: Knob): void {
    const { value, exact } = this.sliders.get(knob.key)!;
    value.value = `${format(this.current(knob), exact === null ? 3 : 5)} ${shownKnobUnit(knob)}`;
    value.removeAttribute("aria-invalid");
  }

  /** A value that was typed, with its unit or in that of the slider. */
  private take(knob: Knob): void {
    const slider = this.sliders.get(knob.key)!;
    const found = /^([-+]?[\d.]+(?:e[-+]?\d+)?)\s*(\S*)$/i.exec(slider.value.value.trim().replace("·", ".").replace("µ", "u"));
    const factor = found ? (found[2] ? factors[knob.key][found[2]] : 1) : undefined;
    const value = found && factor !== undefined ? Number(found[1]) * factor : NaN;
    if (!(value > 0)) {
      slider.value.setAttribute("aria-invalid", "true");
      this.status.textContent = texts.sliderOdd(slider.value.value, Object.keys(factors[knob.key]).join(", "));
      return;
    }
    this.touched.add(knob.key);
    slider.exact = value;
    slider.input.value = String(Math.log(value / slider.middle) / Math.log(spread));
    this.write(knob);
    this.ask();
  }

  /** While the text is faulty nothing is solved. */
  faulty(is: boolean): void {
    if (is === this.isFaulty) return;
    this.isFaulty = is;
    for (const { input, value } of this.sliders.values()) input.disabled = value.disabled = is;
    this.curves.faulty(is);
    this.element.classList.toggle("old", is);
    if (is) {
      this.wanted = false;
      this.status.textContent = texts.faultyText;
    }
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
      const { bearing, path } = this;
      const begun = performance.now();
      try {
        const answer = await this.solve({}, ["pressure"], this.previous);
        // Of a model or bearing that is no longer shown.
        if (this.bearing !== bearing || this.path !== path || this.model()?.path !== path || this.isFaulty) continue;
        this.previous = answer.id ?? this.previous;
        this.show(answer, model, performance.now() - begun);
      } catch (error) {
        if (this.isFaulty) continue;
        this.status.textContent = error instanceof Error ? error.message : String(error);
        this.element.classList.add("old");
      }
    }
    this.busy = false;
  }

  private show(answer: Answer, model: { text: string; tree: TextNode }, ms: number): void {
    this.element.classList.toggle("old", !answer.solved);
    this.status.textContent = answer.solved ? texts.solved(Math.round(ms)) : answer.message;
    this.report.disabled = !answer.solved;
    this.set = answer.set;
    if (!answer.solved) {
      // Other values may have a solution.
      for (const { input, value } of this.sliders.values()) if (value.value !== "–" || !this.previous) input.disabled = value.disabled = false;
      return;
    }
    this.learn(answer, model);
    const coefficients = kindOf({ solutions: [answer.solution] }).coefficients(answer.solution);
    this.coefficients.replaceChildren(...(coefficients ? [h("h3", {}, texts.coefficients), coefficients] : []));
    // What stands in the tables of coefficients needs no lines besides.
    const listed = new Set([...this.coefficients.querySelectorAll("[data-quantity]")].map((cell) => cell.getAttribute("data-quantity")));
    const figures = answer.solution.figures.filter(({ key }) => !listed.has(key));
    this.curves.solved((without) => JSON.stringify([this.bearing, model.text, this.settings(model.tree, { [without]: 1 })]));
    const known = [...groups.filter((group) => figures.some((f) => f.group === group)), ...new Set(figures.map(({ group }) => group).filter((group) => !groups.includes(group)))];
    this.figures.replaceChildren(
      ...known.map((group) =>
        h(
          "tbody",
          {},
          h("tr", {}, h("th", { colspan: 2, class: "group" }, group)),
          ...figures.filter((f) => f.group === group).map((f) => h("tr", { "data-figure-key": f.key }, h("th", {}, f.name), h("td", { class: "number" }, valueText(f), unitText(f)))),
        ),
      ),
    );
    this.drawMap(answer);
  }

  /** Where the sliders begin: what the model says. */
  private learn({ figures, position }: Answer, { text, tree }: { text: string; tree: TextNode }): void {
    const figure = (...keys: string[]) => figures.find(({ key, value }) => keys.includes(key) && value !== null);
    const speed = figure("journal_speed", "speed");
    const oil = child(find(tree, ["bearings", this.bearing]), "lubricant");
    const name = oil ? text.slice(oil.valueFrom, oil.valueTo) : (find(tree, ["lubricants"])?.children[0]?.key ?? "");
    const viscosity = find(tree, ["lubricants", name, "viscosity"]);
    const written = viscosity ? quantityPattern.exec(text.slice(viscosity.valueFrom, viscosity.valueTo)) : null;
    const values: Record<Knob["key"], number | undefined> = {
      load: figure("load")?.value ?? undefined,
      speed: speed ? speed.value! * (speed.unit === "rpm" ? 1 : 30 / Math.PI) : undefined,
      clearance: position ? 1e6 * position.clearance : undefined,
      viscosity: written ? parseFloat(written[1]!) * ({ "Pa.s": 1e3, "mPa.s": 1, cP: 1 }[written[2]!] ?? NaN) : undefined,
    };
    for (const knob of knobs) {
      const slider = this.sliders.get(knob.key)!;
      const value = values[knob.key];
      if (this.touched.has(knob.key)) continue;
      slider.isKnown = value !== undefined && value > 0;
      slider.input.disabled = slider.value.disabled = !slider.isKnown;
      if (slider.isKnown) slider.middle = value! / spread ** Number(slider.input.value);
      this.write(knob);
      if (!slider.isKnown) slider.value.value = "–";
    }
  }

  private drawMap({ solution, position }: Answer): void {
    const film = solution.films[0];
    const fields = film ? FilmFields.of(fieldsOnly(solution.datasets), film.bearing) : null;
    const kind = fields?.kinds().find(({ key }) => key === "pressure") ?? fields?.kinds()[0];
    this.drawn.map?.destroy();
    this.drawn.locus?.destroy();
    this.drawn = { map: null, locus: null };
    if (fields && kind) {
      this.drawn.map = new FieldMap(fields, kind, "instant", film!.features);
      this.map.replaceChildren(this.drawn.map.element);
      this.drawn.map.show(0, []);
    } else this.map.replaceChildren();
    if (position) {
      const { e, clearance } = position;
      const point = { label: "", x: e[0] / clearance, y: e[1] / clearance, index: 0 };
      this.drawn.locus = new Locus({ lines: [{ colour: 0, points: [point] }], load: () => solution.load ?? [0, 0], clearance: () => clearance }, 0, () => undefined);
      this.locus.replaceChildren(this.drawn.locus.element);
    } else this.locus.replaceChildren();
  }
}
