// A table of the folder as a table: cells to be edited, rows added, its columns drawn beside; its text is the other view.

import { redo, undo } from "@codemirror/commands";
import { h } from "../src/dom";
import { axes, canvasOf, path, scaleOf, svg, usual } from "../src/svg_plot";
import type { Editor, OpenDocument } from "./editor";
import { numberOf, TableText, type Change } from "./table_text";
import { texts } from "./texts";

const rowHeight = 27; // [px], as in the style sheet
const spare = 12; // rows beyond what is seen

export class TableView {
  /** Above a table or its text. */
  readonly bar: HTMLElement;
  readonly element: HTMLElement;
  private readonly asTable = h("button", { type: "button", class: "quiet", "aria-pressed": "true" }, texts.table.table);
  private readonly asText = h("button", { type: "button", class: "quiet", "aria-pressed": "false" }, texts.table.text);
  private readonly count = h("span", { class: "note" });
  private readonly body = h("tbody");
  private readonly head = h("tr");
  private readonly scroller = h("div", { class: "table-scroll", tabindex: -1 });
  private readonly plot = h("div", { class: "table-plot" });
  private readonly across = h("select", { "aria-label": texts.table.across });
  private readonly along = h("div", { class: "table-columns", role: "group", "aria-label": texts.table.columns });
  private document: OpenDocument | null = null;
  private table = new TableText("");
  private columns = "";
  private hidden = new Set<string>();
  private readonly shownAsText = new Set<string>();
  /** The row that buttons mean. */
  private row = 0;

  constructor(
    private readonly editor: Editor,
    private readonly switched: () => void,
  ) {
    const tool = (label: string, act: () => void) => h("button", { type: "button", class: "quiet", click: act }, label);
    this.bar = h("div", { class: "table-bar", role: "toolbar", "aria-label": texts.table.tools }, this.asTable, this.asText, tool(texts.table.add, () => this.addRow()), tool(texts.table.remove, () => this.removeRow()), this.count);
    this.scroller.append(h("table", { class: "cells", "aria-label": texts.table.table }, h("thead", {}, this.head), this.body));
    this.element = h("div", { class: "table-view" }, this.scroller, h("div", { class: "table-side" }, h("div", { class: "table-axes" }, h("label", {}, `${texts.table.across} `, this.across), this.along), this.plot));
    this.asTable.addEventListener("click", () => this.choose(false));
    this.asText.addEventListener("click", () => this.choose(true));
    this.across.addEventListener("change", () => this.draw());
    this.scroller.addEventListener("scroll", () => this.fill());
    new ResizeObserver(() => this.fill()).observe(this.scroller);
    this.element.addEventListener("keydown", (event) => this.key(event));
  }

  /** Whether the text shown is a table, and shown as one. */
  get isTable(): boolean {
    return this.document !== null && !this.shownAsText.has(this.document.path);
  }

  /** Takes the text that is shown; false: it is no table. */
  show(document: OpenDocument | null): boolean {
    const isNamed = document !== null && /\.(csv|tsv)$/i.test(document.path);
    const mayBe = document !== null && /\.(txt|dat)$/i.test(document.path);
    const table = isNamed || mayBe ? new TableText(document!.state.doc.toString()) : null;
    const is = table !== null && (isNamed ? table.header !== null : table.isTable);
    if (document !== this.document) [this.row, this.columns, this.scroller.scrollTop] = [0, "", 0];
    this.document = is ? document : null;
    if (is) this.take(table!);
    return is;
  }

  changed(document: OpenDocument): void {
    if (document === this.document) this.take(new TableText(document.state.doc.toString()));
  }

  private choose(text: boolean): void {
    if (!this.document) return;
    if (text) this.shownAsText.add(this.document.path);
    else this.shownAsText.delete(this.document.path);
    this.switched();
  }

  private take(table: TableText): void {
    this.table = table;
    this.row = Math.min(this.row, Math.max(0, table.rows.length - 1));
    const isText = !this.isTable;
    this.asTable.setAttribute("aria-pressed", String(!isText));
    this.asText.setAttribute("aria-pressed", String(isText));
    this.count.textContent = texts.table.rows(table.rows.length);
    const columns = table.names.join("\n");
    if (columns !== this.columns) {
      this.columns = columns;
      this.hidden = new Set();
      this.head.replaceChildren(h("td", {}), ...table.names.map((name) => h("th", { scope: "col" }, name)));
      this.across.replaceChildren(...table.names.map((name, i) => h("option", { value: i }, name)));
      this.along.replaceChildren(
        ...table.names.map((name, i) => {
          const box = h("input", { type: "checkbox", checked: true });
          box.addEventListener("change", () => {
            if (box.checked) this.hidden.delete(name);
            else this.hidden.add(name);
            this.draw();
          });
          return h("label", { "data-column": i }, box, ` ${name}`);
        }),
      );
    }
    if (isText) return;
    this.fill(true);
    this.draw();
  }

  /** Only the rows that are seen are there. */
  private fill(anew = false): void {
    const { rows } = this.table;
    const first = Math.max(0, Math.floor(this.scroller.scrollTop / rowHeight) - spare);
    const last = Math.min(rows.length, first + Math.ceil((this.scroller.clientHeight || 600) / rowHeight) + 2 * spare);
    const range = `${first} ${last}`;
    if (!anew && this.body.dataset["range"] === range) return;
    this.body.dataset["range"] = range;
    const focused = document.activeElement instanceof HTMLInputElement && this.body.contains(document.activeElement) ? document.activeElement : null;
    const [row, column] = focused ? [focused.dataset["row"], focused.dataset["column"]] : [];
    const space = (count: number) => h("tr", { class: "space", "aria-hidden": "true" }, h("td", { style: `height:${count * rowHeight}px` }));
    this.body.replaceChildren(
      space(first),
      ...rows.slice(first, last).map(({ cells }, i) =>
        h("tr", { class: first + i === this.row ? "row chosen" : "row" }, h("th", { scope: "row" }, String(first + i + 1)), ...cells.map((cell, c) => h("td", {}, this.input(first + i, c, cell.text)))),
      ),
      space(rows.length - last),
    );
    if (row !== undefined && column !== undefined) this.inputAt(Number(row), Number(column))?.focus();
  }

  private input(row: number, column: number, text: string): HTMLElement {
    const name = this.table.names[column] ?? `${column + 1}`;
    const field = h("input", { type: "text", value: text, "data-row": row, "data-column": column, "aria-label": texts.table.cell(name, row + 1), "aria-invalid": numberOf(text) === null ? "true" : "false", spellcheck: "false", autocomplete: "off" });
    field.addEventListener("focus", () => this.chooseRow(row));
    field.addEventListener("change", () => {
      const change = this.table.changed(row, column, field.value);
      if (change) this.make(change);
      else field.value = this.table.rows[row]?.cells[column]?.text ?? "";
    });
    return field;
  }

  private inputAt(row: number, column: number): HTMLInputElement | null {
    return this.body.querySelector<HTMLInputElement>(`input[data-row="${row}"][data-column="${column}"]`);
  }

  private chooseRow(row: number): void {
    this.row = row;
    this.body.querySelector(".chosen")?.classList.remove("chosen");
    this.inputAt(row, 0)?.closest("tr")?.classList.add("chosen");
    this.draw();
  }

  private make(change: Change): void {
    if (this.document && this.document.state.doc.sliceString(change.from, change.to) !== change.insert) this.editor.change(this.document, [change], "input.table");
  }

  private addRow(): void {
    const change = this.table.inserted(this.row);
    if (!change) return;
    const isFirst = this.table.rows.length === 0;
    this.make(change);
    this.goTo(isFirst ? 0 : this.row + 1, 0);
  }

  private removeRow(): void {
    const change = this.table.removed(this.row);
    if (!change || !this.document) return;
    this.editor.change(this.document, [change], "delete.table");
    this.goTo(Math.min(this.row, this.table.rows.length - 1), 0);
  }

  /** Puts the cursor into a cell, which may have to come into sight first. */
  private goTo(row: number, column: number): void {
    if (row < 0 || row >= this.table.rows.length) return;
    const { scrollTop, clientHeight } = this.scroller;
    const top = row * rowHeight;
    if (top < scrollTop || top > scrollTop + clientHeight - 3 * rowHeight) this.scroller.scrollTop = Math.max(0, top - 0.5 * clientHeight);
    this.fill();
    const field = this.inputAt(row, column);
    field?.focus({ preventScroll: true });
    field?.select();
  }

  private key(event: KeyboardEvent): void {
    const field = event.target instanceof HTMLInputElement && event.target.dataset["row"] !== undefined ? event.target : null;
    const command = event.ctrlKey || event.metaKey;
    const letter = event.key.toLowerCase();
    if (command && (letter === "z" || letter === "y")) {
      event.preventDefault();
      const row = Number(field?.dataset["row"]);
      const before = field ? this.table.rows[row]?.cells[Number(field.dataset["column"])]?.text : undefined;
      // What is typed but not taken yet goes first.
      if (field && before !== undefined && field.value !== before) field.value = before;
      else (letter === "z" && !event.shiftKey ? undo : redo)(this.editor.view);
      return;
    }
    if (!field) return;
    const [row, column] = [Number(field.dataset["row"]), Number(field.dataset["column"])];
    const down = event.key === "Enter" || event.key === "ArrowDown" ? 1 : event.key === "ArrowUp" ? -1 : 0;
    if (event.key === "Enter" && command) {
      event.preventDefault();
      event.stopPropagation();
      field.blur();
      this.row = row;
      this.addRow();
    } else if (down !== 0) {
      event.preventDefault();
      field.blur(); // takes what was typed
      this.goTo(row + down, column);
    }
  }

  private draw(): void {
    if (!this.isTable) return;
    const x = this.table.values(Number(this.across.value || 0));
    const names = this.table.names;
    for (const choice of this.along.querySelectorAll<HTMLElement>("label")) choice.hidden = choice.dataset["column"] === (this.across.value || "0");
    const drawn = names.map((name, i) => ({ name, i })).filter(({ name, i }) => i !== Number(this.across.value || 0) && !this.hidden.has(name));
    if (x.length === 0 || drawn.length === 0) return this.plot.replaceChildren();
    // A plot for each column: their units differ.
    this.plot.replaceChildren(
      ...drawn.map(({ name, i }, k) => {
        const y = this.table.values(i);
        const frame = { ...usual, height: 220 };
        const [right, up] = [scaleOf(x, frame.left, frame.width - frame.right), scaleOf(y, frame.height - frame.bottom, frame.top)];
        const canvas = canvasOf(frame, texts.table.plot(name, names[Number(this.across.value || 0)] ?? ""));
        axes(canvas, frame, right, up, names[Number(this.across.value || 0)] ?? "", name);
        const points = x.flatMap((v, n): [number, number][] => (v === null || y[n] === null || y[n] === undefined ? [] : [[right.at(v), up.at(y[n]!)]]));
        canvas.append(svg("path", { d: path(points), fill: "none", "stroke-width": 1.6, stroke: `var(--series-${(k % 6) + 1})` }));
        const [at, height] = [x[this.row], y[this.row]];
        if (at !== null && at !== undefined && height !== null && height !== undefined) canvas.append(svg("circle", { cx: right.at(at), cy: up.at(height), r: 4, fill: "var(--accent)" }));
        return canvas;
      }),
    );
  }
}
