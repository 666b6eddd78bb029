// What a key of the model file may hold, from the JSON Schema of `hersey schema` and what the text has beside it.

import { child, type TextNode } from "./yaml_tree";

export interface Schema {
  type?: string | string[];
  properties?: Record<string, Schema>;
  additionalProperties?: boolean | Schema;
  propertyNames?: { pattern?: string };
  items?: Schema;
  anyOf?: Schema[];
  oneOf?: Schema[];
  $ref?: string;
  $defs?: Record<string, Schema>;
  const?: string | number | boolean;
  enum?: (string | number | boolean)[];
  required?: string[];
  then?: { required?: string[] };
  description?: string;
  default?: unknown;
  examples?: unknown[];
  pattern?: string;
  title?: string;
}

export interface KeyHelp {
  key: string;
  description: string;
  default: string;
  required: boolean;
  /** It holds further keys. */
  isMap: boolean;
}

/** What a group of keys may be, by the word that decides about its further keys. */
export interface Group {
  /** Key of that word; empty where there is one kind alone. */
  decides: string;
  kinds: { word: string; keys: (KeyHelp & { schema: Schema })[] }[];
}

export interface ValueHelp {
  value: string;
  description: string;
  kind: "word" | "example";
}

export class ModelSchema {
  constructor(private readonly root: Schema) {}

  /** A schema's alternatives, references followed. */
  private flat(schema: Schema | undefined): Schema[] {
    if (!schema) return [];
    if (schema.$ref) return this.flat(this.root.$defs?.[schema.$ref.replace("#/$defs/", "")]);
    const alternatives = schema.anyOf ?? schema.oneOf;
    return alternatives ? alternatives.flatMap((one) => this.flat(one)) : [schema];
  }

  /** Of alternatives with keys, those that fit the words the text has: `kind: journal`, `type: revolute`. */
  private fitting(alternatives: Schema[], node: TextNode | undefined, text: string): Schema[] {
    const maps = alternatives.filter((one) => one.properties);
    if (maps.length < 2) return maps;
    const deciding = [...new Set(maps.flatMap((one) => Object.entries(one.properties!).flatMap(([key, s]) => (s.const !== undefined ? [key] : []))))];
    let left = maps;
    for (const key of deciding) {
      const said = child(node, key);
      const value = said ? text.slice(said.valueFrom, said.valueTo).replace(/^["']|["']$/g, "") : "";
      const words = (one: Schema) => this.flat(one.properties?.[key]).flatMap((s) => (s.const !== undefined ? [String(s.const)] : []));
      const matching = value ? left.filter((one) => words(one).includes(value)) : [];
      if (matching.length > 0) left = matching;
      else if (!value) {
        // Without the word it is the alternative that does not ask for it.
        const usual = left.filter((one) => words(one).length > 0 && !(one.required ?? one.then?.required ?? []).includes(key));
        if (usual.length > 0 && usual.length < left.length) left = usual;
      }
    }
    return left;
  }

  /** Schemas of the value of a node. */
  schemasOf(node: TextNode, text: string): Schema[] {
    if (!node.parent) return this.flat(this.root);
    const above = this.schemasOf(node.parent, text);
    const maps = this.fitting(above, node.parent, text);
    const among = maps.some((m) => m.properties![node.key]) ? maps : above;
    return among.flatMap((one) => {
      const own = one.properties?.[node.key];
      if (own) return this.flat(own);
      if (one.items && /^\d+$/.test(node.key)) return this.flat(one.items);
      return typeof one.additionalProperties === "object" ? this.flat(one.additionalProperties) : [];
    });
  }

  /** Keys that a map may have, and has not. */
  keys(map: TextNode, text: string): KeyHelp[] {
    const schemas = this.schemasOf(map, text);
    const maps = this.fitting(schemas, map, text);
    const found = new Map<string, KeyHelp>();
    for (const one of maps)
      for (const [key, s] of Object.entries(one.properties ?? {})) {
        if (found.has(key) || child(map, key)) continue;
        found.set(key, { ...this.describe(key, s), required: (one.required ?? one.then?.required ?? []).includes(key) });
      }
    return [...found.values()];
  }

  /** Every key of a map, whether written or not, with the schema of its value. */
  fields(map: TextNode, text: string): (KeyHelp & { schema: Schema })[] {
    const found = new Map<string, KeyHelp & { schema: Schema }>();
    for (const one of this.fitting(this.schemasOf(map, text), map, text))
      for (const [key, schema] of Object.entries(one.properties ?? {}))
        if (!found.has(key)) found.set(key, { ...this.describe(key, schema), required: (one.required ?? one.then?.required ?? []).includes(key), schema });
    return [...found.values()];
  }

  /** Of a key whose value is a group of keys; null where it may be something else, words aside, or names of one's own. */
  group(schema: Schema): Group | null {
    const flat = this.flat(schema);
    const maps = flat.filter((one) => one.properties);
    const isOther = (one: Schema) => !one.properties && one.const === undefined && one.enum === undefined && !(one.pattern ?? "").includes("\\$\\{");
    if (maps.length === 0 || flat.some(isOther)) return null;
    const words = Object.keys(maps[0]!.properties!).filter((key) => maps.every((one) => one.properties![key]?.const !== undefined));
    const decides = maps.length > 1 ? (words[0] ?? "") : "";
    if (maps.length > 1 && !decides) return null;
    const kinds = maps.map((one) => {
      const needed = one.required ?? one.then?.required ?? [];
      const keys = Object.entries(one.properties!).filter(([key]) => key !== decides).map(([key, own]) => ({ ...this.describe(key, own), required: needed.includes(key), schema: own }));
      // Groups within the group are added to it afterwards.
      return { word: decides ? String(one.properties![decides]!.const) : "", keys: keys.filter(({ required, isMap }) => required || !isMap) };
    });
    return { decides, kinds };
  }

  private describe(key: string, schema: Schema): KeyHelp {
    const flat = this.flat(schema);
    const isMap = flat.length > 0 && flat.every((s) => s.properties || s.additionalProperties || s.items || s.pattern?.includes("$\\{"));
    const fallback = schema.default ?? flat.find((s) => s.default !== undefined)?.default;
    return {
      key,
      description: schema.description ?? flat.find((s) => s.description)?.description ?? "",
      default: fallback === undefined ? "" : String(fallback),
      required: false,
      isMap,
    };
  }

  /** Words and examples that a value may be. */
  values(node: TextNode, text: string): ValueHelp[] {
    // All kinds are offered in place of the one that is written.
    const above = node.parent ? this.schemasOf(node.parent, text).filter((one) => one.properties?.[node.key]) : [];
    const schemas = above.length > 0 ? above.flatMap((one) => this.flat(one.properties![node.key])) : this.schemasOf(node, text);
    return this.words(schemas);
  }

  words(schemas: Schema[]): ValueHelp[] {
    const found = new Map<string, ValueHelp>();
    for (const s of schemas) {
      if (s.const !== undefined) found.set(String(s.const), { value: String(s.const), description: s.description ?? "", kind: "word" });
      for (const value of s.enum ?? []) found.set(String(value), { value: String(value), description: s.description ?? "", kind: "word" });
      for (const value of s.examples ?? []) if (!found.has(String(value))) found.set(String(value), { value: String(value), description: s.description ?? "", kind: "example" });
      const types = Array.isArray(s.type) ? s.type : [s.type];
      if (types.includes("boolean") && types.length === 1) for (const value of ["true", "false"]) found.set(value, { value, description: "", kind: "word" });
    }
    return [...found.values()];
  }

  /** Nothing but words is allowed, parameters aside. */
  isOfWords(schema: Schema): boolean {
    return this.flat(schema).every((s) => s.const !== undefined || s.enum !== undefined || (s.pattern ?? "").startsWith("\\$\\{") || (s.type === "boolean" && s.const === undefined));
  }

  wordsOf(schema: Schema): ValueHelp[] {
    return this.words(this.flat(schema));
  }

  /** What the names are of that a value may be: "a body or body.frame", "a lubricant". */
  kindsOfName(node: TextNode, text: string): string[] {
    return this.schemasOf(node, text).flatMap((s) => (s.type === "string" && s.pattern?.startsWith("^[A-Za-z]") && s.description ? [s.description] : []));
  }

  /** Of the key at a node: what `hersey explain` says of it. */
  help(node: TextNode, text: string): { title: string; description: string; kinds: string[]; default: string } | null {
    if (!node.parent) return null;
    const above = this.schemasOf(node.parent, text);
    const fitting = this.fitting(above, node.parent, text);
    const own = [...fitting, ...above].map((one) => one.properties?.[node.key]).find((s) => s !== undefined);
    const schemas = this.schemasOf(node, text);
    if (!own && schemas.length === 0) return null;
    const described = own ? this.describe(node.key, own) : null;
    const kinds = [...new Set(schemas.flatMap((s) => (s.const === 0 ? [] : s.const !== undefined ? [`${s.const}${s.description ? `: ${s.description}` : ""}`] : s.description && s.description !== described?.description ? [s.description] : [])))];
    return { title: node.key, description: described?.description ?? "", kinds: kinds.slice(0, 12), default: described?.default ?? "" };
  }

  /** A group of keys, each of the same kind, such as `bearings`: the schema of what may be put in. */
  isGroup(node: TextNode, text: string): boolean {
    return this.schemasOf(node, text).some((s) => typeof s.additionalProperties === "object");
  }
}
