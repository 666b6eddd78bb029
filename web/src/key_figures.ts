// The rows of the closing table that stand first: of the last whole cycle where the file has one, else of the whole run.

import type { Run, SummaryRow } from "./data";
import { h } from "./dom";
import { format } from "./units";

const ofTheCycle = ", last cycle";

/** A row of the closing table by what it tells. */
export function keyRow(run: Run, group: string, name: string): SummaryRow | undefined {
  const rows = run.summary.filter((row) => row.group === group);
  return rows.find((row) => row.name === name + ofTheCycle) ?? rows.find((row) => row.name === name);
}

/** Its number, or null where there is none. */
export function keyValue(run: Run, group: string, name: string): number | null {
  return keyRow(run, group, name)?.value ?? null;
}

export function isOfCycle(row: SummaryRow | undefined): boolean {
  return row?.name.endsWith(ofTheCycle) === true;
}

export const moft = "minimum film thickness (MOFT)";
export const pofp = "peak film pressure (POFP)";
export const largestLoad = "largest load";
export const filmLoss = "mean power loss in the film";
export const contactLoss = "mean power loss in asperity contact";
export const hottestOil = "hottest oil";

export function spaced(name: string): string {
  return name.replaceAll("_", " ");
}

/** Bearings, the one with the thinnest film first; those whose films tell no thickness last. */
export function worstFirst(run: Run): string[] {
  const thickness = (bearing: string) => keyValue(run, bearing, moft) ?? Infinity;
  return run.children("/bearings").sort((a, b) => thickness(a) - thickness(b));
}

/** The sum of a row over groups, or null where one of them lacks it. */
export function total(run: Run, groups: string[], name: string): number | null {
  return sumOf(groups.map((group) => keyValue(run, group, name)));
}

/** The sum, or null where one is missing. */
export function sumOf(values: (number | null)[]): number | null {
  return values.length === 0 || values.some((v) => v === null) ? null : values.reduce<number>((sum, v) => sum + v!, 0);
}

/** Oil that leaves over both edges, mean over the run [mm³/s]. */
export function sideFlow(run: Run, bearing: string): number | null {
  const [left, right] = ["left", "right"].map((side) => keyValue(run, bearing, `mean side flow, ${side}`));
  return typeof left === "number" && typeof right === "number" ? left + right : null;
}

export interface Tile {
  label: string;
  value: number | null;
  unit: string;
  /** Whose it is, where there are several. */
  owner?: string;
  where?: string;
}

/** A number that stands large. */
export function tile({ label, value, unit, owner, where }: Tile): HTMLElement {
  return h(
    "div",
    { class: "tile" },
    h("div", { class: "tile-label" }, label, owner ? h("span", { class: "tile-owner" }, ` · ${owner}`) : null),
    h("div", { class: "tile-value" }, format(value), unit ? h("span", { class: "unit" }, unit === "°" ? "°" : ` ${unit}`) : null),
    h("div", { class: "tile-where" }, place(where ?? "") || "\u00a0"),
  );
}

export function tileOf(label: string, row: SummaryRow, owner?: string): HTMLElement {
  return tile({ label, value: row.value, unit: row.unit, where: row.where, ...(owner ? { owner } : {}) });
}

/** With true minus signs, and line breaks only after commas. */
export function place(text: string): string {
  return text.replace(/-(?=\d)/g, "−").replace(/(?<!,) /g, "\u00a0");
}
