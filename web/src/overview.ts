// All bearings of a run in one table, the worst first, and what they make together.

import type { Run } from "./data";
import { h } from "./dom";
import { contactLoss, filmLoss, hottestOil, isOfCycle, keyRow, keyValue, moft, place, pofp, sideFlow, spaced, sumOf, total, worstFirst } from "./key_figures";
import { SparkLine } from "./spark_line";
import { format } from "./units";

/** Rows of the time series within the last whole cycle, or all of them. */
export function lastCycle(run: Run): { from: number; to: number } {
  const time = run.column("/time");
  const bearing = run.children("/bearings")[0];
  const last = (name: string) => run.column(`/bearings/${bearing}/cycles/fields/${name}`)?.at(-1);
  const [begin, end] = [last("begin"), last("end")];
  const all = { from: 0, to: time?.length ?? 0 };
  if (!time || begin === undefined || end === undefined || last("complete") !== 1) return all;
  // Stored begins and ends may be rounded where those of rows are not.
  const slack = 1e-6 * (end - begin);
  const from = time.findIndex((t) => t >= begin - slack);
  const to = time.findIndex((t) => t > end + slack);
  return from < 0 ? all : { from, to: to < 0 ? time.length : to };
}

/** Extremes of the summary with the series that shows them over time. */
const columns = [
  { name: moft, short: "MOFT", unit: "µm", title: "Minimum film thickness", series: "h_min", extreme: "low" },
  { name: pofp, short: "POFP", unit: "MPa", title: "Peak film pressure", series: "p_max", extreme: "high" },
  { name: hottestOil, short: "Hottest oil", unit: "°C", title: "Temperature of the hottest oil", series: "T_max", extreme: "high" },
] as const;

export class Overview {
  readonly element: HTMLElement;
  private readonly sparks: SparkLine[] = [];
  private readonly rows = new Map<string, HTMLElement>();

  constructor(
    private readonly run: Run,
    private readonly choose: (bearing: string) => void,
  ) {
    const bearings = worstFirst(run);
    const shown = columns.filter(({ name }) => bearings.some((b) => keyRow(run, b, name)));
    const head = [
      h("th", { scope: "col" }, "Bearing"),
      ...shown.map(({ short, unit, title }) => h("th", { scope: "col", title }, `${short} [${unit}]`)),
      h("th", { scope: "col", class: "number", title: "Mean power lost in the film" }, "Film loss [W]"),
      h("th", { scope: "col", class: "number", title: "Mean power lost in asperity contact" }, "Contact [W]"),
      h("th", { scope: "col", class: "number", title: "Mean oil flow over both edges, over the whole run" }, "Side flow [mm³/s]"),
    ];
    const cycle = bearings.some((b) => isOfCycle(keyRow(run, b, moft)));
    const caption = h("caption", {}, bearings.length > 1 ? "All bearings, the thinnest film first" : "The bearing", h("span", { class: "where" }, cycle ? "over the last cycle" : "over the whole run"));
    const body = bearings.map((bearing) => this.row(bearing, shown));
    this.element = h(
      "div",
      { class: "wide-table overview", tabindex: 0, role: "region", "aria-label": "All bearings" },
      h("table", {}, caption, h("thead", {}, h("tr", {}, ...head)), h("tbody", {}, ...body), bearings.length > 1 ? this.sums(bearings, shown.length) : null),
    );
  }

  /** Marks the bearing that is shown in detail. */
  highlight(bearing: string): void {
    this.rows.forEach((row, name) => {
      row.classList.toggle("chosen", name === bearing);
      row.querySelector("button")?.setAttribute("aria-pressed", name === bearing ? "true" : "false");
    });
  }

  show(time: number): void {
    for (const spark of this.sparks) spark.show(time);
  }

  private row(bearing: string, shown: readonly (typeof columns)[number][]): HTMLElement {
    const { run } = this;
    const number = (value: number | null) => h("td", { class: "number" }, format(rounded(value)));
    const row = h(
      "tr",
      { "data-bearing": bearing },
      h("th", { scope: "row" }, h("button", { type: "button", class: "pick", title: `Show ${spaced(bearing)} in detail`, click: () => this.choose(bearing) }, spaced(bearing))),
      ...shown.map((column) => this.extreme(bearing, column, shown.length > 2)),
      number(keyValue(run, bearing, filmLoss)),
      number(keyValue(run, bearing, contactLoss)),
      number(sideFlow(run, bearing)),
    );
    this.rows.set(bearing, row);
    return row;
  }

  private extreme(bearing: string, column: (typeof columns)[number], narrow: boolean): HTMLElement {
    const row = keyRow(this.run, bearing, column.name);
    if (!row) return h("td", {}, "–");
    return h(
      "td",
      { class: "extreme" },
      h("span", { class: "extreme-value" }, format(row.value), h("span", { class: "where" }, place(shortened(row.where, narrow)))),
      this.spark(bearing, column),
    );
  }

  private spark(bearing: string, { series, title, extreme }: (typeof columns)[number]): HTMLElement | null {
    const time = this.run.column("/time");
    const values = this.run.column(`/bearings/${bearing}/${series}`);
    const { from, to } = lastCycle(this.run);
    if (!time || !values || to - from < 2) return null;
    const spark = new SparkLine({ label: `${title} of ${spaced(bearing)} over time`, x: time.slice(from, to), y: values.slice(from, to), extreme });
    this.sparks.push(spark);
    return spark.element;
  }

  private sums(bearings: string[], extremes: number): HTMLElement {
    const { run } = this;
    const flow = sumOf(bearings.map((b) => sideFlow(run, b)));
    return h(
      "tfoot",
      {},
      h(
        "tr",
        {},
        h("th", { scope: "row" }, "together"),
        h("td", { colspan: extremes }),
        ...[total(run, bearings, filmLoss), total(run, bearings, contactLoss), flow].map((v) => h("td", { class: "number" }, format(rounded(v)))),
      ),
    );
  }
}

/** The instant by the crank's angle alone where there is one; the axial place where there is room for it. */
function shortened(where: string, narrow: boolean): string {
  const text = where.includes("crank") ? where.replace(/^t = [^,]*, /, "") : where;
  return narrow ? text.replace(/, z = .*$/, "") : text;
}

/** Without the tails of distributions of heights, which are no contact [W]. */
function rounded(value: number | null): number | null {
  return value !== null && Math.abs(value) < 1e-6 ? 0 : value;
}
