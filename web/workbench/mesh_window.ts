// A mesh of the folder: its size, the surfaces found in it or named by it, chosen in its picture or its list, and the
// lines of a model that uses them.

import type { Api } from "./api";
import { h } from "../src/dom";
import { format } from "../src/units";
import { dialog } from "./dialogs";
import { MeshPicture, type MeshScene } from "./mesh_picture";
import { texts } from "./texts";
import { find, type TextNode } from "./yaml_tree";

interface Found {
  name: string;
  kind: "plane" | "cylinder";
  could_be?: string;
  diameter?: number;
  width?: number;
}

interface Use {
  name: string;
  key: string;
  frame: string;
  bearing: string;
}

interface MeshAnswer {
  lines: string;
  length_unit: string;
  found: Found[];
  uses: Use[];
  mesh: Record<string, unknown>;
  picture: MeshScene;
}

/** The model into which lines are written. */
export interface MeshTarget {
  name: string;
  path: string;
  tree: TextNode;
  text: string;
  set: (key: string, value: string | null) => Promise<void>;
}

/** @param first  the unit that is taken for granted @param target  the model that is open */
export function showMesh(api: Api, path: string, first = "mm", target: () => MeshTarget | null = () => null): void {
  const unit = h("select", { "aria-label": texts.mesh.unit }, ...["mm", "m", "um", "in"].map((u) => h("option", { value: u }, u)));
  unit.value = first;
  const body = h("div", { class: "mesh-body", "aria-live": "polite" });
  let picture: MeshPicture | null = null;
  const nameAll = async (output: string) => {
    try {
      await api.post("/api/name_surfaces", { path, length_unit: unit.value, output });
      window.close();
      showMesh(api, output, "m", target);
    } catch (error) {
      body.prepend(h("p", { class: "fault" }, error instanceof Error ? error.message : String(error)));
    }
  };
  const show = async () => {
    try {
      const answer = await api.post<MeshAnswer>("/api/mesh", { path, length_unit: unit.value, picture: true, body: bodyOf(target(), path) });
      picture?.end();
      picture = fill(body, answer, path, target, nameAll);
    } catch (error) {
      body.replaceChildren(h("p", { class: "fault" }, error instanceof Error ? error.message : String(error)));
    }
  };
  unit.addEventListener("change", () => void show());
  const window = dialog(path, "mesh", h("div", { class: "window-tools" }, h("span", {}, texts.mesh.unit), unit), body);
  window.addEventListener("close", () => picture?.end());
  void show();
}

/** The body of a model that has the mesh; else a new one. */
function bodyOf(target: MeshTarget | null, path: string): string {
  if (!target) return "part";
  const name = path.split("/").pop()!;
  const bodies = find(target.tree, ["bodies"])?.children ?? [];
  const mesh = (key: string) => {
    const node = find(target.tree, ["bodies", key, "flexible", "mesh"]);
    return node ? target.text.slice(node.valueFrom, node.valueTo).replace(/["']/g, "") : "";
  };
  const own = bodies.find(({ key }) => mesh(key).split("/").pop() === name);
  return own?.key ?? (bodies.some(({ key }) => key === "part") ? "mesh_part" : "part");
}

function fill(body: HTMLElement, { found, uses, lines, mesh, picture: scene, length_unit: unit }: MeshAnswer, path: string, target: () => MeshTarget | null, nameAll: (output: string) => void): MeshPicture {
  const count = (key: string) => (typeof mesh[key] === "number" ? (mesh[key] as number) : null);
  const facts = [count("nodes") !== null ? texts.mesh.nodes(count("nodes")!) : "", count("elements") !== null ? texts.mesh.elements(count("elements")!) : ""].filter((t) => t);
  const chosen = new Set<string>();
  const text = h("pre", { class: "template-text", tabindex: 0, "aria-label": texts.mesh.lines }, lines);
  const say = h("p", { class: "note", role: "status" });
  const choose = (name: string) => {
    if (chosen.has(name)) chosen.delete(name);
    else chosen.add(name);
    for (const box of body.querySelectorAll<HTMLInputElement>(".mesh-table input")) box.checked = chosen.has(box.value);
    picture.choose(chosen);
    text.textContent = chosenUses().length > 0 ? linesOf() : lines;
    const unnamed = [...chosen].filter((one) => !uses.some((use) => use.name === one));
    const named = path.replace(/\.[^./]+$/, "_named.msh");
    say.replaceChildren(...(unnamed.length > 0 ? [`${texts.mesh.unnamed(unnamed.join(", "))} `, h("button", { type: "button", class: "quiet", click: () => nameAll(named) }, texts.mesh.name(named))] : []));
    write.disabled = chosenUses().length === 0 || !target();
  };
  const chosenUses = () => uses.filter((use) => chosen.has(use.name));
  const part = bodyOf(target(), path);
  const linesOf = () => {
    const bearings = chosenUses().filter((use) => use.bearing);
    return [
      texts.mesh.intoModel,
      `bodies:\n  ${part}:\n    flexible: {mesh: ${path}, length_unit: ${unit}}   # and a material\n    frames:`,
      ...chosenUses().map((use) => `      ${use.key}: ${use.frame}`),
      ...(bearings.length > 0 ? ["bearings:", ...bearings.map((use) => `  ${use.key}: ${use.bearing}`)] : []),
    ].join("\n");
  };
  const picture = new MeshPicture(scene, choose);
  const row = (name: string, could: string, diameter: string, width: string) => {
    const box = h("input", { type: "checkbox", value: name, "aria-label": texts.mesh.choose(name) });
    box.addEventListener("change", () => choose(name));
    return h("tr", {}, h("td", {}, box), h("th", { scope: "row" }, name), h("td", {}, could), h("td", { class: "number" }, diameter), h("td", { class: "number" }, width));
  };
  const millimetres = (x: number | undefined) => `${format(1e3 * (x ?? NaN))} mm`;
  const rows = [
    ...found.map((s) => (s.kind === "cylinder" ? row(s.name, s.could_be || "–", millimetres(s.diameter), millimetres(s.width)) : row(s.name, texts.mesh.plane, "", ""))),
    ...scene.surfaces.filter(({ name }) => !found.some((s) => s.name === name)).map(({ name }) => row(name, texts.mesh.surface, "", "")),
  ];
  const copy = h("button", { type: "button", class: "main-button", click: () => void navigator.clipboard.writeText(text.textContent!.replace(/^.*\n/, "")).then(() => (copy.textContent = texts.mesh.copied)) }, texts.mesh.copy);
  const write = h("button", { type: "button", class: "quiet", disabled: true, click: () => void intoModel() }, target() ? texts.mesh.write(target()!.name) : texts.mesh.noModel);
  const intoModel = async () => {
    const model = target();
    if (!model) return;
    write.disabled = true;
    const away = "../".repeat(model.path.split("/").length - 1);
    if (!find(model.tree, ["bodies", part, "flexible"])) await model.set(`bodies.${part}.flexible`, `{mesh: ${away}${path}, length_unit: ${unit}}`);
    for (const use of chosenUses()) await model.set(`bodies.${part}.frames.${use.key}`, use.frame);
    for (const use of chosenUses()) if (use.bearing) await model.set(`bearings.${use.key}`, use.bearing);
    say.textContent = texts.mesh.written(chosenUses().length, model.name);
  };
  body.replaceChildren(
    h("p", {}, facts.join(", ")),
    h("div", { class: "mesh-choice" }, picture.element, h("div", { class: "mesh-list" }, rows.length > 0 ? h("table", { class: "mesh-table" }, h("caption", {}, texts.mesh.found), h("tbody", {}, ...rows)) : h("p", { class: "note" }, texts.mesh.none))),
    say,
    text,
    h("div", { class: "window-tools" }, copy, write),
  );
  picture.begin();
  return picture;
}
