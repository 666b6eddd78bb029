// Stiffness and damping of a bearing by itself as tables.

import { figureOf } from "./bearing_sweep";
import type { FigureText, SolutionText } from "./data";
import { h } from "./dom";
import { errorText, unitText, valueText } from "./figure_text";
import { format } from "./units";

function tables(...parts: HTMLElement[]): HTMLElement {
  return h("section", { class: "summary matrices", "aria-label": "Stiffness and damping" }, ...parts);
}

/** Of a journal: four matrices, or those that there are. */
export function matrices(solution: SolutionText): HTMLElement | null {
  return journalMatrices(solution, [
    ["K = k c/W, axes of the load", "K"],
    ["C = b c ω/W, axes of the load", "C"],
    ["Stiffness k [N/m], bearing axes", "stiffness"],
    ["Damping b [N·s/m], bearing axes", "damping"],
  ], "Axes of the load: x along the load, y a quarter turn on in the sense of rotation.");
}

/** Of a journal whose coefficients have no load or clearance to be related to. */
export function bearingAxesMatrices(solution: SolutionText): HTMLElement | null {
  return journalMatrices(solution, [
    ["Stiffness k [N/m], bearing axes", "stiffness"],
    ["Damping b [N·s/m], bearing axes", "damping"],
  ], "All parts of the bearing follow the journal at the whirl frequency.");
}

function journalMatrices(solution: SolutionText, wanted: [string, string][], note: string): HTMLElement | null {
  const present = wanted.filter(([, key]) => figureOf(solution, `${key}_xx`));
  if (present.length === 0) return null;
  const axes = ["x", "y"];
  const cell = (key: string) => h("td", { class: "number", "data-quantity": key }, format(figureOf(solution, key)?.value ?? null));
  // One error for all entries of a matrix.
  const error = (key: string) => solution.figures.find((f) => f.key === `${key}_xx` && f.grid_error);
  const foot = (f: FigureText) => h("tfoot", {}, h("tr", {}, h("td", { class: "number", colspan: "3" }, h("span", { class: "where" }, errorText(f)))));
  const matrix = (title: string, key: string) => {
    const known = error(key);
    return h(
      "table",
      { class: "matrix" },
      h("caption", {}, title),
      h("thead", {}, h("tr", {}, h("td", {}), ...axes.map((axis) => h("th", { scope: "col", class: "number" }, axis)))),
      h("tbody", {}, ...axes.map((row) => h("tr", {}, h("th", { scope: "row" }, row), ...axes.map((column) => cell(`${key}_${row}${column}`))))),
      known ? foot(known) : null,
    );
  };
  return tables(
    ...present.map(([title, key]) => matrix(title, key)),
    h("p", { class: "note" }, `Row: force of the film on the shell; column: displacement or velocity of the journal. ${note}`),
  );
}

/** Of a pad: approach and tilts, a table each of stiffness and damping. */
/** All nine coefficients of a thrust bearing, by the axis and both tilts. */
export function thrustMatrices(solution: SolutionText): HTMLElement | null {
  const entries = (axial: string, tilting: string, load: string, moment: string): [string, string][] => [
    [axial, "Load by distance"],
    ...["xx", "xy", "yx", "yy"].map((pair): [string, string] => [`${tilting}_${pair}`, `Moment by tilt, ${pair}`]),
    ...["x", "y"].map((way): [string, string] => [`${load}_${way}`, `Load by tilt, ${way}`]),
    ...["x", "y"].map((way): [string, string] => [`${moment}_${way}`, `Moment by distance, ${way}`]),
  ];
  const row = ([key, label]: [string, string]) => {
    const f = figureOf(solution, key);
    if (!f) return [];
    const error = errorText(f);
    return [h("tr", {}, h("th", { scope: "row" }, label, error ? h("span", { class: "where" }, error) : null), h("td", { class: "number", "data-quantity": key }, valueText(f), unitText(f)))];
  };
  const table = (title: string, of: [string, string][]) => {
    const rows = of.flatMap(row);
    return rows.length > 0 ? [h("table", {}, h("caption", {}, title), h("tbody", {}, ...rows))] : [];
  };
  const parts = [
    ...table("Stiffness", entries("stiffness", "tilting_stiffness", "load_by_tilt", "moment_by_distance")),
    ...table("Damping", entries("damping", "tilting_damping", "load_by_tilting", "moment_by_approach")),
  ];
  return parts.length > 0 ? tables(...parts, h("p", { class: "note" }, "Tilts are slopes of the runner’s axis towards x and y; a moment is the one that works on such a slope. Damping: the same by rates.")) : null;
}

export function approachAndTilt(solution: SolutionText): HTMLElement | null {
  const motions: [string, string][] = [
    ["", "Approach"],
    ["_along", "Tilt along"],
    ["_across", "Tilt across"],
    ["_coupling", "Load by tilt along"],
  ];
  const row = ([motion, label]: [string, string], key: string) => {
    const f = figureOf(solution, key + motion);
    if (!f) return [];
    const error = errorText(f);
    return [h("tr", {}, h("th", { scope: "row" }, label, error ? h("span", { class: "where" }, error) : null), h("td", { class: "number", "data-quantity": key + motion }, valueText(f), unitText(f)))];
  };
  const table = (title: string, key: string) => {
    const rows = motions.flatMap((motion) => row(motion, key));
    return rows.length > 0 ? [h("table", {}, h("caption", {}, title), h("tbody", {}, ...rows))] : [];
  };
  const parts = [...table("Stiffness", "stiffness"), ...table("Damping", "damping")];
  return parts.length > 0 ? tables(...parts, h("p", { class: "note" }, "Approach: load by the runner’s distance. Tilts: moment about the pad’s middle by the runner’s slope along and across the sliding direction.")) : null;
}
