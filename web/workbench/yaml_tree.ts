// The keys of a model text and where they stand. It reads what is half written, too: completion, outline and help ask
// for the place of the cursor while the text is no YAML yet.

export interface TextNode {
  key: string;
  parent: TextNode | null;
  /** Where the key begins and ends. */
  from: number;
  keyTo: number;
  /** The value on the key's own line, or a whole flow collection; equal where there is none. */
  valueFrom: number;
  valueTo: number;
  /** End of the last thing that belongs to it. */
  to: number;
  /** Column of the key; -1 of the root. */
  indent: number;
  /** Inside braces or brackets. */
  flow: boolean;
  kind: "block" | "map" | "list" | "scalar" | "none" | "loose";
  children: TextNode[];
}

export function pathOf(node: TextNode): string[] {
  const path: string[] = [];
  for (let n: TextNode | null = node; n?.parent; n = n.parent) path.unshift(n.key);
  return path;
}

export function child(node: TextNode | undefined, key: string): TextNode | undefined {
  return node?.children.find((c) => c.key === key && c.kind !== "loose");
}

export function find(root: TextNode, path: string[]): TextNode | undefined {
  return path.reduce<TextNode | undefined>(child, root);
}

const keyPattern = /^("(?:[^"\\]|\\.)*"|'[^']*'|[^\s#:{}[\],&*!|>'"%@`-][^:#{}[\],]*?|-[^\s:#][^:#{}[\],]*?)\s*:(?=\s|$)/;
const unquoted = (key: string) => key.replace(/^(["'])(.*)\1$/, "$2");

class Reader {
  private at = 0;
  constructor(private readonly text: string) {}

  read(): TextNode {
    const root: TextNode = { key: "", parent: null, from: 0, keyTo: 0, valueFrom: 0, valueTo: 0, to: this.text.length, indent: -1, flow: false, kind: "block", children: [] };
    const open: TextNode[] = [root];
    while (this.at < this.text.length) this.line(open);
    this.close(root);
    return root;
  }

  private endOfLine(from: number): number {
    const end = this.text.indexOf("\n", from);
    return end < 0 ? this.text.length : end;
  }

  private line(open: TextNode[]): void {
    const start = this.at;
    const end = this.endOfLine(start);
    this.at = end + 1;
    const line = this.text.slice(start, end);
    let column = line.search(/\S/);
    if (column < 0 || line[column] === "#" || line.startsWith("---")) return;
    let dash = /^-(\s+|$)/.exec(line.slice(column));
    while (dash) {
      this.leave(open, column, true);
      const parent = open[open.length - 1]!;
      const item = this.add(parent, String(parent.children.length), start + column, start + column + 1, column + 0.5);
      item.kind = "block";
      open.push(item);
      column += dash[0].length;
      if (column >= line.length) return;
      dash = /^-(\s+|$)/.exec(line.slice(column));
    }
    const content = line.slice(column);
    const key = keyPattern.exec(content);
    this.leave(open, column, false);
    const parent = open[open.length - 1]!;
    const from = start + column;
    if (!key) {
      const text = content.replace(/\s+#.*$/, "").trimEnd();
      if (parent.kind === "block" && parent.key !== "" && Number.isInteger(parent.indent) === false && parent.children.length === 0) {
        this.value(parent, from, end);
        return;
      }
      const loose = this.add(parent, text, from, from + text.length, column);
      loose.kind = "loose";
      loose.to = loose.valueFrom = loose.valueTo = loose.keyTo;
      return;
    }
    const node = this.add(parent, unquoted(key[1]!), from, from + key[1]!.length, column);
    open.push(node);
    this.value(node, from + key[0].length, end);
  }

  /** What follows a key's colon on its line. */
  private value(node: TextNode, from: number, end: number): void {
    const rest = this.text.slice(from, end);
    const skipped = /^\s*((?:[&!]\S*\s+)*)/.exec(rest)![0].length;
    const begin = from + skipped;
    const first = this.text[begin];
    node.valueFrom = node.valueTo = Math.min(begin, end);
    if (begin >= end || first === "#") {
      node.valueFrom = node.valueTo = Math.min(end, from + 1);
      node.kind = "block";
      node.to = Math.max(node.keyTo, from);
      return;
    }
    if (first === "{" || first === "[") {
      node.kind = first === "{" ? "map" : "list";
      node.valueTo = node.to = this.collection(node, begin);
      this.at = Math.max(this.at, this.endOfLine(node.to) + 1);
      return;
    }
    if (first === "|" || first === ">") {
      node.kind = "scalar";
      let last = end;
      while (this.at < this.text.length) {
        const stop = this.endOfLine(this.at);
        const line = this.text.slice(this.at, stop);
        const column = line.search(/\S/);
        if (column >= 0 && column <= node.indent) break;
        if (column >= 0) last = stop;
        this.at = stop + 1;
      }
      node.valueTo = node.to = last;
      return;
    }
    node.kind = "scalar";
    node.valueTo = node.to = begin + this.scalarLength(this.text.slice(begin, end), false);
  }

  private scalarLength(rest: string, flow: boolean): number {
    const quoted = /^("(?:[^"\\]|\\.)*"?|'(?:[^']|'')*'?)/.exec(rest);
    if (quoted && (rest[0] === '"' || rest[0] === "'")) return quoted[0].length;
    const plain = (flow ? /^(?:\$\{\w*\}|[^,{}[\]\n#]|(?<=\S)#)*/ : /^(?:[^\n#]|(?<=\S)#)*/).exec(rest)![0];
    return plain.trimEnd().length;
  }

  /** A flow collection from its bracket; gives where it ends. It also ends where a line stands no deeper than its key. */
  private collection(node: TextNode, from: number): number {
    const close = this.text[from] === "{" ? "}" : "]";
    let owner = node;
    while (owner.flow && owner.parent) owner = owner.parent;
    let at = from + 1;
    let index = 0;
    const skip = (): boolean => {
      for (;;) {
        const c = this.text[at];
        if (c === undefined) return false;
        if (c === "#") at = this.endOfLine(at);
        else if (c === "\n") {
          const line = this.text.slice(at + 1, this.endOfLine(at + 1));
          const column = line.search(/\S/);
          if (column >= 0 && column <= owner.indent && !/^\s*[}\]]/.test(line)) return false;
          at++;
        } else if (c === " " || c === "\t" || c === ",") at++;
        else return true;
      }
    };
    while (skip()) {
      const c = this.text[at]!;
      if (c === close) return at + 1;
      if (c === "}" || c === "]") return at;
      if (close === "]") {
        const item = this.add(node, String(index++), at, at, owner.indent);
        item.flow = true;
        at = this.flowValue(item, at);
        continue;
      }
      const rest = this.text.slice(at, this.endOfLine(at));
      const key = /^("(?:[^"\\]|\\.)*"|'[^']*'|[^:,{}[\]#]*?)\s*:(?=[\s,}]|$)/.exec(rest);
      if (!key) {
        const text = /^[^,{}[\]#]*/.exec(rest)![0];
        const loose = this.add(node, text.trimEnd(), at, at + text.trimEnd().length, owner.indent);
        loose.flow = true;
        loose.kind = "loose";
        loose.to = loose.valueFrom = loose.valueTo = loose.keyTo;
        at += Math.max(1, text.length);
        continue;
      }
      const entry = this.add(node, unquoted(key[1]!), at, at + key[1]!.length, owner.indent);
      entry.flow = true;
      at += key[0].length;
      entry.valueFrom = entry.valueTo = entry.to = at;
      while (this.text[at] === " ") at++;
      at = this.flowValue(entry, at);
    }
    return Math.min(at, this.text.length);
  }

  private flowValue(node: TextNode, at: number): number {
    const c = this.text[at];
    node.valueFrom = at;
    if (c === "{" || c === "[") {
      node.kind = c === "{" ? "map" : "list";
      node.valueTo = node.to = this.collection(node, at);
    } else {
      node.kind = "scalar";
      const length = this.scalarLength(this.text.slice(at, this.endOfLine(at)), true);
      if (length === 0 && node.key !== "") node.valueFrom = at;
      node.valueTo = node.to = at + length;
    }
    return Math.max(node.to, at);
  }

  private add(parent: TextNode, key: string, from: number, keyTo: number, indent: number): TextNode {
    const node: TextNode = { key, parent, from, keyTo, valueFrom: keyTo, valueTo: keyTo, to: keyTo, indent, flow: false, kind: "none", children: [] };
    parent.children.push(node);
    return node;
  }

  /** Items of a list may stand as deep as its key. */
  private leave(open: TextNode[], column: number, item: boolean): void {
    const level = item ? column + 0.5 : column;
    while (open.length > 1 && open[open.length - 1]!.indent >= level) open.pop();
  }

  private close(node: TextNode): number {
    for (const c of node.children) node.to = Math.max(node.to, this.close(c));
    return node.to;
  }
}

export function readTree(text: string): TextNode {
  return new Reader(text).read();
}

/** The deepest key whose text holds a position. */
export function nodeAt(root: TextNode, position: number): TextNode {
  let node = root;
  for (;;) {
    const next = node.children.find((c) => c.from <= position && position <= c.to);
    if (!next) return node;
    node = next;
  }
}

/** What may be written at a position: a key of `map`, or the value of `node`. */
export type Place = { what: "key"; map: TextNode; from: number; written: string } | { what: "value"; node: TextNode; from: number; written: string } | null;

export function placeAt(root: TextNode, text: string, position: number): Place {
  const start = text.lastIndexOf("\n", position - 1) + 1;
  const before = text.slice(start, position);
  if (/(^|\s)#/.test(before.replace(/"[^"]*"|'[^']*'/g, (m) => " ".repeat(m.length)))) return null;
  const node = nodeAt(root, position);
  // Inside braces.
  const flowOwner = node.flow || (["map", "list"].includes(node.kind) && position > node.valueFrom && position <= node.valueTo && !(position === node.valueTo && /[}\]]/.test(text[position - 1] ?? "")));
  if (flowOwner) {
    if (node.kind === "loose") return { what: "key", map: node.parent!, from: node.from, written: text.slice(node.from, position) };
    if (node.flow && position <= node.keyTo && node.parent!.kind === "map") return { what: "key", map: node.parent!, from: node.from, written: text.slice(node.from, position) };
    if (node.kind === "map") return { what: "key", map: node, from: position, written: "" };
    const list = node.kind === "list";
    return { what: "value", node, from: list ? position : Math.min(node.valueFrom, position), written: list ? "" : text.slice(Math.min(node.valueFrom, position), position) };
  }
  // After the colon of a key, or in the item of a list.
  const same = (n: TextNode | null): n is TextNode => n !== null && n.parent !== null && n.from >= start && n.from <= position;
  const onLine = same(node) && node.kind !== "loose" ? node : null;
  if (onLine && position > onLine.keyTo && onLine.kind !== "block") return { what: "value", node: onLine, from: Math.min(onLine.valueFrom, position), written: text.slice(Math.min(onLine.valueFrom, position), position) };
  const key = /^(\s*(?:-\s+)*)([^\s:#]*)$/.exec(before);
  if (key) {
    const column = key[1]!.replace(/-/g, " ").length;
    const dashed = key[1]!.includes("-");
    let map = root;
    for (let next: TextNode | undefined = root; next; ) {
      map = next;
      next = [...next.children].reverse().find((c) => c.kind !== "loose" && c.from < start + (dashed ? column : 0) && c.indent < column && !c.flow && c.kind === "block");
    }
    return { what: "key", map, from: position - key[2]!.length, written: key[2]! };
  }
  const value = /:\s+(\S*.*)$/.exec(before);
  if (value) {
    // The cursor stands after a key without a value yet.
    const last = lastBefore(root, position);
    if (last && last.from >= start) return { what: "value", node: last, from: position - value[1]!.length, written: value[1]! };
  }
  return null;
}

function lastBefore(root: TextNode, position: number): TextNode | null {
  let node: TextNode | null = null;
  for (let next: TextNode | undefined = root; next; ) {
    next = [...next.children].reverse().find((c) => c.from < position);
    if (next) node = next;
  }
  return node;
}
