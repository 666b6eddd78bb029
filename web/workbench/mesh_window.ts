// A mesh of the folder: its size, the bores and journals found in it, and the lines of a model that uses them.

import type { Api } from "./api";
import { h } from "../src/dom";
import { format } from "../src/units";
import { dialog } from "./dialogs";
import { texts } from "./texts";

interface Found {
  name: string;
  kind: "plane" | "cylinder";
  could_be?: string;
  diameter?: number;
  width?: number;
}

interface MeshAnswer {
  lines: string;
  found: Found[];
  mesh: Record<string, unknown>;
}

/** @param first  the unit that is taken for granted */
export function showMesh(api: Api, path: string, first = "mm"): void {
  const unit = h("select", { "aria-label": texts.mesh.unit }, ...["mm", "m", "um", "in"].map((u) => h("option", { value: u }, u)));
  unit.value = first;
  const body = h("div", { class: "mesh-body", "aria-live": "polite" });
  const show = async () => {
    try {
      const { found, lines, mesh } = await api.post<MeshAnswer>("/api/mesh", { path, length_unit: unit.value });
      const count = (key: string) => (typeof mesh[key] === "number" ? (mesh[key] as number) : null);
      const facts = [count("nodes") !== null ? texts.mesh.nodes(count("nodes")!) : "", count("elements") !== null ? texts.mesh.elements(count("elements")!) : ""].filter((t) => t);
      const cylinders = found.filter(({ kind }) => kind === "cylinder");
      const rows = cylinders.map((s) => h("tr", {}, h("th", { scope: "row" }, s.name), h("td", {}, s.could_be || "–"), h("td", { class: "number" }, `${format(1e3 * (s.diameter ?? NaN))} mm`), h("td", { class: "number" }, `${format(1e3 * (s.width ?? NaN))} mm`)));
      const text = h("pre", { class: "template-text", tabindex: 0, "aria-label": texts.mesh.lines }, lines);
      const copy = h("button", { type: "button", class: "main-button", click: () => void navigator.clipboard.writeText(lines.replace(/^.*\n/, "")).then(() => (copy.textContent = texts.mesh.copied)) }, texts.mesh.copy);
      body.replaceChildren(
        h("p", {}, facts.join(", ")),
        rows.length > 0 ? h("table", { class: "mesh-table" }, h("caption", {}, texts.mesh.found), h("tbody", {}, ...rows)) : h("p", { class: "note" }, texts.mesh.none),
        ...(lines ? [text, h("div", { class: "window-tools" }, copy)] : []),
      );
    } catch (error) {
      body.replaceChildren(h("p", { class: "fault" }, error instanceof Error ? error.message : String(error)));
    }
  };
  unit.addEventListener("change", () => void show());
  dialog(path, "mesh", h("div", { class: "window-tools" }, h("span", {}, texts.mesh.unit), unit), body);
  void show();
}
