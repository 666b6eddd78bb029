// A table as the program reads it from a text: a line of column names, then rows; blank lines and comments between them.
// Every change is an edit of single cells or lines, so that all else stays as it is written.

export interface Cell {
  text: string;
  /** Offsets in the whole text, without blanks around. */
  from: number;
  to: number;
}

export interface Row {
  /** Offsets of its line, without its end. */
  from: number;
  to: number;
  cells: Cell[];
}

export interface Change {
  from: number;
  to: number;
  insert: string;
}

const isBlank = (letter: string | undefined) => letter === " " || letter === "\t" || letter === "\r";

export class TableText {
  header: Row | null = null;
  readonly rows: Row[] = [];
  separator = ",";

  constructor(readonly text: string) {
    let from = text.startsWith("\uFEFF") ? 1 : 0;
    while (from <= text.length) {
      const end = text.indexOf("\n", from);
      const to = end < 0 ? text.length : end;
      const line = text.slice(from, to);
      const content = line.trim();
      if (content !== "" && !content.startsWith("#")) {
        if (!this.header) {
          this.separator = [";", ",", "\t"].find((letter) => line.includes(letter)) ?? ",";
          this.header = { from, to, cells: this.cellsOf(line, from) };
        } else this.rows.push({ from, to, cells: this.cellsOf(line, from) });
      }
      from = to + 1;
    }
  }

  private cellsOf(line: string, begin: number): Cell[] {
    const cells: Cell[] = [];
    for (let start = 0; start <= line.length; ) {
      const found = line.indexOf(this.separator, start);
      const end = found < 0 ? line.length : found;
      let [from, to] = [start, end];
      while (from < to && isBlank(line[from])) from++;
      while (to > from && isBlank(line[to - 1])) to--;
      cells.push({ text: line.slice(from, to), from: begin + from, to: begin + to });
      start = end + 1;
    }
    return cells;
  }

  /** Whether a text of any kind has columns of numbers. */
  get isTable(): boolean {
    const first = this.rows[0];
    return this.header !== null && this.header.cells.length > 1 && first !== undefined && first.cells.length === this.header.cells.length && first.cells.every(({ text }) => numberOf(text) !== null);
  }

  get names(): string[] {
    return this.header?.cells.map(({ text }) => text) ?? [];
  }

  /** Null where the value cannot stand in a cell. */
  changed(row: number, column: number, value: string): Change | null {
    const cell = this.rows[row]?.cells[column];
    if (!cell || value.includes(this.separator) || /[\n\r]/.test(value) || (column === 0 && value.trim().startsWith("#"))) return null;
    return { from: cell.from, to: cell.to, insert: value.trim() };
  }

  /** A row below another, written as that is: half way to the next one, or as far beyond the last as that from the one before. */
  inserted(row: number): Change | null {
    const here = this.rows[row];
    if (!here) {
      const at = this.text.length;
      const values = this.names.map(() => "0").join(`${this.separator} `);
      return this.header ? { from: at, to: at, insert: `${this.text === "" || this.text.endsWith("\n") ? "" : "\n"}${values}\n` } : null;
    }
    const [next, before] = [this.rows[row + 1], this.rows[row - 1]];
    let line = "";
    let at = here.from;
    here.cells.forEach((cell, i) => {
      const [value, after, last] = [numberOf(cell.text), numberOf(next?.cells[i]?.text ?? ""), numberOf(before?.cells[i]?.text ?? "")];
      const made = value === null ? null : after !== null ? 0.5 * (value + after) : last !== null ? 2 * value - last : value;
      line += this.text.slice(at, cell.from) + (made === null ? cell.text : String(Number(made.toPrecision(10))));
      at = cell.to;
    });
    line += this.text.slice(at, here.to);
    return { from: here.to, to: here.to, insert: `\n${line}` };
  }

  removed(row: number): Change | null {
    const here = this.rows[row];
    if (!here) return null;
    const isLast = here.to >= this.text.length;
    return isLast ? { from: Math.max(0, here.from - 1), to: here.to, insert: "" } : { from: here.from, to: here.to + 1, insert: "" };
  }

  values(column: number): (number | null)[] {
    return this.rows.map(({ cells }) => numberOf(cells[column]?.text ?? ""));
  }
}

/** As the program reads numbers: no thousands, no decimal comma. */
export function numberOf(text: string): number | null {
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(text) ? Number(text) : null;
}
