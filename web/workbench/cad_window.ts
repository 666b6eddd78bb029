// A CAD file of the folder becomes a mesh, by `hersey mesh` and the program gmsh; then its bores are shown.

import type { Api } from "./api";
import { h } from "../src/dom";
import { dialog } from "./dialogs";
import { showMesh, type MeshTarget } from "./mesh_window";
import { texts } from "./texts";

interface CadState {
  state: "running" | "made" | "failed";
  seconds: number;
  output: string;
  message: string;
}

export const isCad = (path: string) => /\.(step|stp|iges|igs|brep)$/i.test(path);

/** @param target  the model into which surfaces are written @param made  called once the folder has the mesh */
export function showCad(api: Api, path: string, target: () => MeshTarget | null, made: () => void): void {
  const words = texts.cad;
  const field = (id: string, label: string, control: HTMLElement, help = "") => [h("label", { for: id }, label), control, h("span", { class: "note" }, help)];
  const size = h("input", { id: "cad-size", type: "text", value: "4 mm", required: true, spellcheck: "false", autocomplete: "off" });
  const order = h("select", { id: "cad-order" }, h("option", { value: 2 }, words.second), h("option", { value: 1 }, words.first));
  const around = h("input", { id: "cad-around", type: "number", min: 4, max: 1000, value: 16 });
  const unit = h("select", { id: "cad-unit" }, ...["mm", "m", "um", "in"].map((u) => h("option", { value: u }, u)));
  const output = h("input", { id: "cad-output", type: "text", value: path.replace(/\.[^./]+$/, ".msh"), required: true, spellcheck: "false", autocomplete: "off" });
  const said = h("p", { class: "cad-said", role: "status" });
  const go = h("button", { type: "submit", class: "main-button" }, words.go);
  const stop = h("button", { type: "button", class: "quiet", disabled: true }, texts.stop);
  const hasNoUnit = /\.brep$/i.test(path);
  const form = h(
    "form",
    { class: "cad-form" },
    h("p", { class: "note" }, words.words),
    h(
      "div",
      { class: "cad-fields" },
      ...field("cad-size", words.size, size, words.sizeHelp),
      ...field("cad-order", words.order, order),
      ...field("cad-around", words.around, around, words.aroundHelp),
      ...(hasNoUnit ? field("cad-unit", texts.mesh.unit, unit) : []),
      ...field("cad-output", words.output, output),
    ),
    said,
    h("div", { class: "window-tools" }, go, stop),
  );
  const window = dialog(path, "cad", form);
  let job: string | null = null;
  const atWork = (is: boolean) => {
    go.disabled = is;
    stop.disabled = !is;
  };
  const fail = (error: unknown) => {
    said.textContent = error instanceof Error ? error.message : String(error);
    said.classList.add("fault");
    atWork(false);
  };
  const follow = async (id: string) => {
    for (;;) {
      const now = await api.get<CadState>(`/api/cad/${id}`);
      if (now.state === "running") {
        said.textContent = words.running(now.seconds);
        await new Promise((resolve) => setTimeout(resolve, 400));
        continue;
      }
      job = null;
      if (now.state === "failed") return fail(new Error(now.message));
      made();
      if (!window.open) return;
      window.close();
      // It is written in metres.
      return showMesh(api, now.output, "m", target);
    }
  };
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    said.classList.remove("fault");
    atWork(true);
    const wanted = { path, size: size.value.trim(), order: Number(order.value), around: Number(around.value), output: output.value.trim(), ...(hasNoUnit ? { length_unit: unit.value } : {}) };
    api
      .post<{ id: string }>("/api/cad", wanted)
      .then(({ id }) => follow((job = id)))
      .catch(fail);
  });
  const end = () => (job ? api.post(`/api/cad/${job}/stop`).catch(fail) : undefined);
  stop.addEventListener("click", () => void end());
  window.addEventListener("close", () => void end());
  size.focus();
  size.select();
}
