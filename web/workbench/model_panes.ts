// The panes that show the model beside its text: machine, bearing, part, operating point.

import type { Api, Fault } from "./api";
import { BearingPane } from "./bearing_pane";
import type { OpenDocument } from "./editor";
import type { PlacedFrame } from "./frame_hand";
import { Tabs } from "./layout";
import { MachinePane, type SceneText } from "./machine_pane";
import type { OpenReport } from "./memory";
import type { ModelSchema } from "./model_schema";
import { PartPane } from "./part_pane";
import { PointPane } from "./point_pane";
import { texts } from "./texts";
import { find, type TextNode } from "./yaml_tree";

export interface ModelPanesHooks {
  api: Api;
  model: () => OpenDocument | null;
  schema: () => ModelSchema | null;
  /** A form or a drag sets a key of the text. */
  set: (key: string, value: string | null) => Promise<void>;
  goToKey: (key: string) => void;
  goToPart: (part: string) => void;
  say: (words: string) => void;
  openReport: (report: OpenReport) => void;
  /** Another tab is shown. */
  changed: () => void;
}

export class ModelPanes {
  readonly machine: MachinePane;
  readonly bearing: BearingPane;
  readonly part: PartPane;
  readonly point: PointPane;
  readonly tabs: Tabs;
  /** The tab before the operating point was shown by itself; empty: it was not. */
  private tabBefore = "";

  constructor(private readonly hooks: ModelPanesHooks) {
    const { api, model, set, goToKey, goToPart, say, changed } = hooks;
    const text = () => (model() ? { path: model()!.path, text: model()!.state.doc.toString() } : null);
    this.machine = new MachinePane({ api, model: text, chosen: goToPart, placed: (frame) => void this.place(frame), say });
    this.bearing = new BearingPane({ set, goToKey, chosen: (name) => (this.machine.highlight(`/bearings/${name}`), this.point.refresh()) });
    this.point = new PointPane(api, () => (model() ? { ...text()!, tree: model()!.tree } : null), () => this.bearing.name, hooks.openReport);
    this.part = new PartPane(set);
    const contents = { machine: this.machine.element, bearing: this.bearing.element, part: this.part.element, point: this.point.element };
    const tabs = (["machine", "bearing", "part", "point"] as const).map((key) => ({ key, label: texts[key], content: contents[key] }));
    this.tabs = new Tabs(texts.panes.right, tabs, (key) => {
      if (key === "point") setTimeout(() => this.point.refresh());
      if (key === "bearing") this.bearing.draw();
      if (key === "part") this.part.draw();
      changed();
    });
  }

  /** A frame's origin becomes what a hand has made of it; coordinates that were not moved stay as they are written. */
  private async place({ body, name, position }: PlacedFrame): Promise<void> {
    const { model, set, say } = this.hooks;
    const document = model();
    if (!document || position.every((x) => x === null)) return this.machine.redraw();
    const path = ["bodies", body, "frames", name];
    const origin = find(document.tree, [...path, "origin"]);
    const written = origin ? document.state.doc.sliceString(origin.valueFrom, origin.valueTo).trim() : "";
    const words = written.split(/\s+/);
    const unit = (/[a-z]+$/i.exec(written) ?? ["mm"])[0];
    const scale = ({ mm: 1e3, m: 1, cm: 1e2, um: 1e6 } as Record<string, number>)[unit];
    const isPlain = written === "" || (words.length === 4 && words.slice(0, 3).every((word) => Number.isFinite(Number(word))));
    const hasNodes = find(document.tree, [...path, "nodes"]) !== undefined;
    if (!isPlain || scale === undefined || (hasNodes && written === "")) {
      say(texts.frameNotPlain(name));
      return this.machine.redraw();
    }
    const old = written === "" ? ["0", "0", "0"] : words;
    await set([...path, "origin"].join("."), `${position.map((x, i) => (x === null ? old[i] : String(Number((scale * x).toPrecision(9))))).join(" ")} ${unit}`);
  }

  /** Of a model that is opened: a bearing by itself has nothing to be seen of a machine. */
  showFirst(tree: TextNode): void {
    const has = (key: string) => find(tree, [key]) !== undefined;
    const before = this.tabBefore;
    this.tabBefore = "";
    if (has("bearings") && !has("bodies") && !has("simulation") && !has("use")) {
      this.tabBefore = before || this.tabs.current;
      this.tabs.show("point");
    } else if (before && this.tabs.current === "point") this.tabs.show(before);
  }

  clear(): void {
    this.machine.clear();
    this.bearing.clear();
    this.point.clear();
  }

  /** @param part  that of the cursor */
  show(scene: SceneText | null, part: () => string | null): void {
    this.machine.show(scene);
    this.point.faulty(scene === null);
    this.showParts(scene);
    this.machine.highlight(part());
  }

  /** What is wrong with the text, for the forms. */
  mark(faults: Fault[]): void {
    this.bearing.mark(faults);
    this.part.mark(faults);
  }

  /** The forms of the model. */
  showParts(scene: SceneText | null): void {
    const document = this.hooks.model();
    if (!document) return;
    const schema = this.hooks.schema();
    const text = document.state.doc.toString();
    this.bearing.show(scene?.bearings ?? null, schema, document.tree, text);
    this.part.show(schema, document.tree, text);
    if (this.tabs.current === "point") this.point.refresh();
  }
}
