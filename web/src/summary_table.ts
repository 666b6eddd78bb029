// Rows of the summary as tables.

import type { Run, SummaryRow } from "./data";
import { h } from "./dom";
import { place } from "./key_figures";
import { format } from "./units";

/** The rows of a group (SummaryRow.group); a long one in two tables side by side. */
export function summaryTables(run: Run, group: string, title: string): HTMLElement[] {
  const rows = run.summary.filter((row) => row.group === group);
  const half = rows.length > 10 ? Math.ceil(rows.length / 2) : rows.length;
  return [rows.slice(0, half), rows.slice(half)]
    .filter((part) => part.length > 0)
    .map((part, i) => table(i === 0 ? title : `${title}, continued`, part));
}

function table(title: string, rows: SummaryRow[]): HTMLElement {
  return h("table", {}, h("caption", {}, title), h("tbody", {}, ...rows.map(tableRow)));
}

function tableRow(row: SummaryRow): HTMLElement {
  const name = h("th", { scope: "row" }, capital(row.name), row.where ? h("span", { class: "where" }, place(row.where)) : null);
  const value = h("td", { class: "number" }, format(row.value), row.unit ? h("span", { class: "unit" }, row.unit === "°" ? "°" : ` ${row.unit}`) : null);
  return h("tr", { "data-quantity": row.name }, name, value);
}

export function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
