// What runs differ in: values of the texts that they were made of, and values given beside them.

import { readTree, type TextNode } from "./yaml_tree";

/** Of a run: its model's text, if it is known, and NAME=VALUE of the command line. */
export interface RunSource {
  text?: string | undefined;
  set: string[];
}

const written = (value: string) => value.replace(/\s+/g, " ").trim();
/** "500N" as one writes it in words. */
const spaced = (value: string) => written(value).replace(/^([-+]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?)\s*([a-zA-Zµ°%].*)$/i, "$1 $2");

/** Longer texts are not read: lists of runs are drawn often. */
const longest = 300_000;
/** Of texts that were read. */
const known = new Map<string, Map<string, string>>();

/** Values of a text by the path of their key; a parameter's is its name alone, as on the command line. */
function readValues(text: string): Map<string, string> {
  const values = new Map<string, string>();
  const walk = (node: TextNode, path: string) => {
    const isLeaf = node.children.length === 0 || node.kind === "list";
    const name = path.replace(/^parameters\.(?=[^.]+$)/, "");
    if (isLeaf && path && node.valueTo > node.valueFrom) values.set(name, spaced(text.slice(node.valueFrom, node.valueTo)));
    if (!isLeaf) for (const child of node.children) walk(child, path ? `${path}.${child.key}` : child.key);
  };
  walk(readTree(text), "");
  return values;
}

function valuesOf({ text, set }: RunSource): Map<string, string> {
  if (known.size > 200) known.clear();
  if (text && text.length < longest && !known.has(text)) known.set(text, readValues(text));
  const values = new Map(known.get(text ?? ""));
  for (const change of set) {
    const equals = change.indexOf("=");
    if (equals > 0) values.set(change.slice(0, equals).trim().replace(/^parameters\./, ""), spaced(change.slice(equals + 1)));
  }
  return values;
}

/** The last parts of paths, as many as tell them apart. */
function shortNames(paths: string[]): Map<string, string> {
  const end = (path: string, parts: number) => path.split(".").slice(-parts).join(".");
  return new Map(paths.map((path) => {
    const depth = path.split(".").length;
    let parts = 1;
    while (parts < depth && (paths.some((other) => other !== path && end(other, parts) === end(path, parts)) || /^\d+$/.test(end(path, parts).split(".")[0]!))) parts++;
    return [path, end(path, parts)];
  }));
}

export interface DifferenceWords {
  without: (key: string) => string;
  more: (count: number) => string;
}

/** So many values are named before the rest is counted. */
const most = 3;

function listed(entries: string[], words: DifferenceWords): string {
  return entries.length <= most ? entries.join(", ") : `${entries.slice(0, most - 1).join(", ")}, ${words.more(entries.length - most + 1)}`;
}

/** Of each run the values that not all of them have, "load = 500 N, grid.axial = 20"; empty where nothing differs. */
export function differences(runs: RunSource[], words: DifferenceWords): string[] {
  const values = runs.map(valuesOf);
  const paths = new Set(values.flatMap((own) => [...own.keys()]));
  const differing = [...paths].filter((path) => values.some((own) => own.get(path) !== values[0]!.get(path)));
  // A key that other keys stand below is told by them.
  const leaves = differing.filter((path) => !differing.some((other) => other.startsWith(`${path}.`)));
  const names = shortNames(leaves);
  return values.map((own) => listed(leaves.map((path) => (own.has(path) ? `${names.get(path)} = ${own.get(path)}` : words.without(names.get(path)!))), words));
}

/** What a run has otherwise than its text says, and its text otherwise than that of the run before. */
export function difference(run: RunSource, before: RunSource | null, words: DifferenceWords): string {
  const now = valuesOf(run);
  const given = new Set(run.set.map((change) => change.slice(0, Math.max(0, change.indexOf("="))).trim().replace(/^parameters\./, "")));
  const then = run.text && before?.text ? valuesOf({ text: before.text, set: [] }) : null;
  const edited = then ? [...new Set([...now.keys(), ...then.keys()])].filter((path) => !given.has(path) && now.get(path) !== then.get(path)) : [];
  const paths = [...[...given].filter((path) => path), ...edited];
  const names = shortNames(paths);
  return listed(paths.map((path) => (now.has(path) ? `${names.get(path)} = ${now.get(path)}` : words.without(names.get(path)!))), words);
}
