// The pane with the machine: its picture, its parts as a list, its joints as sliders.

import { Refused, type Api, type BearingScene, type Source } from "./api";
import { Run, type RunText } from "../src/data";
import { h } from "../src/dom";
import { format } from "../src/units";
import { CircuitPlan, type CircuitScene } from "./circuit_plan";
import type { PlacedFrame } from "./frame_hand";
import { WorkbenchMachine, type Pose } from "./machine";
import type { Load, Marks, NamedFrame } from "./machine_marks";
import { texts } from "./texts";

export type SceneText = RunText & {
  sources?: Record<string, Source>;
  bearings?: Record<string, BearingScene>;
  /** Coordinates that can be moved. */
  joints?: Record<string, { name: string; unit: "rad" | "m"; value: number }[]>;
  loads?: Load[];
  frames?: Record<string, NamedFrame[]>;
  circuit?: CircuitScene;
  /** Why loops do not close. */
  open?: string;
};

export interface MachineHooks {
  api: Api;
  /** The model's path and text as they are now. */
  model: () => { path: string; text: string } | null;
  chosen: (part: string) => void;
  /** A frame was placed by hand. */
  placed: (frame: PlacedFrame) => void;
  say: (text: string) => void;
}

interface Coordinate {
  joint: string;
  coordinate: string;
}

export class MachinePane {
  readonly element: HTMLElement;
  private readonly stage = h("div", { class: "stage" }, h("p", { class: "note empty" }, texts.noScene));
  private readonly legend = h("div", { class: "machine-names" });
  private readonly partList = h("select", { "aria-label": texts.parts });
  private readonly sliders = h("div", { class: "joint-sliders" });
  private readonly jointBox = h("details", { class: "joints" }, h("summary", {}, texts.joints), h("p", { class: "note" }, texts.jointHelp), this.sliders);
  private readonly staleNote = h("span", { class: "stale", hidden: true }, texts.stale);
  private readonly aloneNote = h("p", { class: "note empty alone", hidden: true }, texts.noMachine);
  private readonly cutPlace = h("input", { type: "range", min: -1, max: 1, step: 0.01, value: 0, hidden: true, "aria-label": texts.sectionPlace });
  private readonly circuit = new CircuitPlan((part) => this.pick(part));
  private machine: WorkbenchMachine | null = null;
  private scene: SceneText | null = null;
  private look = "";
  private jointNames = "";
  private moving: Coordinate | null = null;
  private wanted: number | null = null;
  private busy = false;
  /** The text of which a joint was moved. */
  private movedText: string | null = null;
  /** Shows a coordinate on its slider. */
  private readonly coordinates = new Map<string, (value: number) => void>();
  /** Where the mechanism went together last, by coordinate, and in words. */
  private readonly reached = new Map<string, { value: number; words: (value: number) => string }>();
  /** Puts every slider where the model says. */
  private resetSliders = () => {};

  constructor(private readonly hooks: MachineHooks) {
    const cut = h("button", { type: "button", class: "quiet", "aria-pressed": "false" }, texts.section);
    cut.addEventListener("click", () => {
      const on = cut.getAttribute("aria-pressed") !== "true";
      cut.setAttribute("aria-pressed", String(on));
      this.cutPlace.hidden = !on;
      this.machine?.section(on ? Number(this.cutPlace.value) : null);
    });
    this.cutPlace.addEventListener("input", () => this.machine?.section(Number(this.cutPlace.value)));
    const frames = h("button", { type: "button", class: "quiet", "aria-pressed": "false" }, texts.paths);
    frames.addEventListener("click", () => {
      const on = frames.getAttribute("aria-pressed") !== "true";
      frames.setAttribute("aria-pressed", String(on));
      this.machine?.showFrames(on);
    });
    const loads = h("button", { type: "button", class: "quiet", "aria-pressed": "true" }, texts.loads);
    loads.addEventListener("click", () => {
      const on = loads.getAttribute("aria-pressed") !== "true";
      loads.setAttribute("aria-pressed", String(on));
      this.machine?.showLoads(on);
    });
    const reset = h("button", { type: "button", class: "quiet", click: () => this.machine?.resetByHand() }, texts.resetView);
    this.partList.append(h("option", { value: "" }, texts.parts));
    this.jointBox.hidden = true;
    this.partList.addEventListener("change", () => this.partList.value && this.pick(this.partList.value));
    this.element = h(
      "div",
      { class: "machine-pane" },
      h("div", { class: "pane-tools" }, this.partList, cut, this.cutPlace, loads, frames, reset),
      this.stage,
      this.legend,
      this.circuit.element,
      this.jointBox,
    );
  }

  get sources(): Record<string, Source> {
    return this.scene?.sources ?? {};
  }

  get run(): Run | null {
    return this.scene ? new Run(this.scene) : null;
  }

  /** Null keeps the last picture and says that it is not of this text. */
  show(scene: SceneText | null): void {
    this.staleNote.hidden = scene !== null ? !scene.open : this.scene === null;
    this.staleNote.textContent = scene?.open || texts.stale;
    // What the text does not say is moved nowhere.
    for (const input of this.sliders.querySelectorAll("input")) input.disabled = scene === null;
    if (!scene) return;
    if (this.movedText !== null && this.movedText !== this.hooks.model()?.text) this.moveBack();
    // Comments and settings change nothing of the picture.
    const look = JSON.stringify([scene.attributes, scene.datasets, scene.loads, scene.frames, scene.circuit]);
    const isSame = this.machine !== null && look === this.look;
    this.scene = scene;
    this.look = look;
    if (isSame) return;
    const run = new Run(scene);
    const marks: Marks = { loads: scene.loads ?? [], frames: scene.frames ?? {} };
    if (this.machine) this.machine.take(run, marks);
    else {
      this.machine = new WorkbenchMachine(run, marks, (part) => (part ? this.pick(part) : this.highlight(null)), (frame) => this.hooks.placed(frame));
      this.stage.replaceChildren(this.machine.space, this.staleNote, this.aloneNote);
      this.legend.replaceChildren(this.machine.names);
    }
    this.circuit.show(scene.circuit ?? null, run);
    this.aloneNote.hidden = run.children("/bodies").length > 0;
    this.listParts();
    this.listJoints(run);
  }

  /** Without a model. */
  clear(): void {
    this.scene = null;
    [this.wanted, this.movedText] = [null, null];
    this.machine?.destroy();
    this.machine = null;
    this.jointNames = "";
    this.circuit.show(null, null);
    this.stage.replaceChildren(h("p", { class: "note empty" }, texts.noScene));
    this.legend.replaceChildren();
    this.sliders.replaceChildren();
    this.partList.replaceChildren(h("option", { value: "" }, texts.parts));
    this.jointBox.hidden = true;
    this.staleNote.hidden = true;
  }

  /** As the text says, after a hand has moved something in vain. */
  redraw(): void {
    if (this.scene && this.machine) this.machine.take(new Run(this.scene), { loads: this.scene.loads ?? [], frames: this.scene.frames ?? {} });
  }

  highlight(part: string | null): void {
    this.machine?.choose(part);
    this.circuit.choose(part);
    const isListed = [...this.partList.options].some(({ value }) => value === part);
    this.partList.value = isListed ? part! : "";
  }

  private pick(part: string): void {
    this.highlight(part);
    this.hooks.chosen(part);
  }

  private listParts(): void {
    const chosen = this.partList.value;
    const { nodes, elements } = this.scene?.circuit ?? { nodes: [], elements: [] };
    const parts = [...this.machine!.parts(), ...nodes.map(({ name }) => `/circuit/nodes/${name}`), ...elements.map((name) => `/circuit/elements/${name}`)];
    const groups: [string, RegExp][] = [["bodies", /^\/bodies\/[^/]+$/], ["joints", /^\/joints\//], ["bearings", /^\/bearings\//], ["forces", /^\/forces\//], ["frames", /\/frames\//], ["circuit", /^\/circuit\//]];
    this.partList.replaceChildren(
      h("option", { value: "" }, texts.parts),
      ...groups.flatMap(([group, pattern]) => {
        const own = parts.filter((part) => pattern.test(part));
        if (own.length === 0) return [];
        const list = document.createElement("optgroup");
        list.label = group;
        list.append(...own.map((part) => h("option", { value: part }, group === "frames" ? part.replace(/^\/bodies\/(.*)\/frames\/(.*)$/, "$1.$2") : part.split("/").pop()!)));
        return [list];
      }),
    );
    this.partList.value = parts.includes(chosen) ? chosen : "";
  }

  private listJoints(run: Run): void {
    const isFree = (joint: string) => run.attribute(`/joints/${joint}`, "type") === "free";
    const joints = Object.entries(this.scene?.joints ?? {}).flatMap(([joint, list]) => (isFree(joint) ? [] : list.map((c) => ({ joint, ...c }))));
    this.jointBox.hidden = joints.length === 0;
    const names = joints.map(({ joint, name, value }) => `${joint}.${name}:${value}`).join();
    if (names === this.jointNames) return;
    this.jointNames = names;
    this.coordinates.clear();
    this.reached.clear();
    this.resetSliders = () => {
      for (const c of joints) this.coordinates.get(`${c.joint}.${c.name}`)?.(c.value);
    };
    const reach = Math.max(0.01, this.machine!.size);
    this.sliders.replaceChildren(
      ...joints.flatMap(({ joint, name, unit, value: start }) => {
        const isAngle = unit === "rad";
        const half = isAngle ? Math.PI : reach;
        const [low, high] = [start - half, start + half];
        const value = h("output", { class: "slider-value" });
        // The mechanism's own residue is nothing to read.
        const residue = 1e-6 * (high - low);
        const words = (x: number) => {
          const seen = Math.abs(x) < residue ? 0 : x;
          return isAngle ? `${format((seen * 180) / Math.PI, 3)}°` : `${format(1e3 * seen, 3)} mm`;
        };
        const say = (x: number) => (value.textContent = words(x));
        this.reached.set(`${joint}.${name}`, { value: start, words });
        const slider = h("input", { type: "range", min: low, max: high, step: (high - low) / 720, value: start, "aria-label": `${joint}, ${name}` });
        slider.addEventListener("input", () => {
          say(Number(slider.value));
          this.moveTo({ joint, coordinate: name }, Number(slider.value));
        });
        const reset = h("button", { type: "button", class: "quiet", "aria-label": `${joint}: ${texts.jointReset}` }, "↺");
        reset.addEventListener("click", () => this.moveBack());
        say(start);
        this.coordinates.set(`${joint}.${name}`, (x) => {
          slider.value = String(x);
          say(x);
          this.reached.set(`${joint}.${name}`, { value: x, words });
        });
        return [h("span", { class: "slider-name" }, joint), slider, value, reset];
      }),
    );
  }

  /** As the model says. */
  private moveBack(): void {
    [this.wanted, this.movedText] = [null, null];
    this.resetSliders();
    this.machine?.move(null);
  }

  /** One question at a time: the newest position waits. */
  private moveTo(coordinate: Coordinate, value: number): void {
    [this.moving, this.wanted] = [coordinate, value];
    this.movedText = this.hooks.model()?.text ?? null;
    if (!this.busy) void this.ask();
  }

  private async ask(): Promise<void> {
    this.busy = true;
    while (this.wanted !== null && this.moving) {
      const [coordinate, value] = [this.moving, this.wanted];
      this.wanted = null;
      const model = this.hooks.model();
      if (!model) break;
      try {
        const { bodies, joints } = await this.hooks.api.post<{ bodies: Record<string, Pose>; joints?: SceneText["joints"] }>("/api/move", { ...model, ...coordinate, value });
        // Of an older text, or of what has been put back meanwhile.
        const now = this.hooks.model();
        if (now?.path !== model.path || now.text !== model.text || this.movedText === null) continue;
        this.machine?.move(bodies);
        const reached = this.reached.get(`${coordinate.joint}.${coordinate.coordinate}`);
        if (reached) reached.value = value;
        for (const [joint, list] of Object.entries(joints ?? {}))
          for (const c of list) if (joint !== coordinate.joint || c.name !== coordinate.coordinate) this.coordinates.get(`${joint}.${c.name}`)?.(c.value);
        this.hooks.say("");
      } catch (error) {
        const name = `${coordinate.joint}.${coordinate.coordinate}`;
        const reached = this.reached.get(name);
        const now = this.hooks.model();
        if (error instanceof Refused && error.status === 422 && reached && now?.text === model.text && now.path === model.path) {
          // Where the hand is farther on already, it is put back by that answer.
          if (this.wanted === null) this.coordinates.get(name)?.(reached.value);
          this.hooks.say(texts.jointEnd(coordinate.joint, reached.words(reached.value)));
        } else this.hooks.say(error instanceof Error ? error.message : String(error));
      }
    }
    this.busy = false;
  }
}
