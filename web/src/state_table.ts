// What a figure over time says of a run of one instant: the values of its curves.

import { h } from "./dom";
import type { Curve } from "./line_plot";
import { format } from "./units";

/** A figure with a table in place of curves, which one instant does not make. */
export function stateFigure(name: string, caption: string, curves: Curve[]): HTMLElement {
  const rows = curves.map(({ label, y, unit }) =>
    h("tr", {}, h("th", { scope: "row" }, label), h("td", { class: "number" }, format(y[0]), unit ? h("span", { class: "unit" }, ` ${unit}`) : null)),
  );
  return h(
    "figure",
    { class: "figure state", "data-figure": name },
    h("div", { class: "figure-body summary" }, h("table", {}, h("tbody", {}, ...rows))),
    h("figcaption", {}, h("span", { class: "caption" }, caption)),
  );
}
