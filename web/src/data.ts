// The report's data as the C++ side writes it (libs/report/src/run_data.cpp): attributes and datasets by path.

export interface SummaryRow {
  group: string;
  name: string;
  value: number | null;
  unit: string;
  where: string;
}

export interface DatasetText {
  unit: string;
  /** A single instant has none. */
  description?: string;
  shape: number[];
  type: "f4" | "f8" | "u2";
  data: string;
  /** Of "u2": value = low + step code, a low and a step for each row; 65535 is no number. */
  low?: string;
  step?: string;
  columns?: string[];
}

import type { StudyText } from "./sampling_data";

/** What the file says of a time series; `width` numbers a row. */
export interface SeriesText {
  name: string;
  unit: string;
  description: string;
  width: number;
}

type Attribute = string | number | string[];

export interface RunText {
  file: string;
  /** By file or folder; no other run of the report has it. */
  name: string;
  rows: number;
  series_stride: number;
  field_stride: number;
  /** Of maps over angle and time: rows of the time series between theirs. */
  around_stride: number;
  attributes: Record<string, Record<string, Attribute>>;
  datasets: Record<string, DatasetText>;
  assumptions: [string, string][];
  summary: SummaryRow[];
  model?: string;
  /** Files with all instants of a film, where the page has but some. */
  beside?: FieldsFile[];
  /** Of a run-up or coast-down. */
  run_up?: RunUpText;
}

/** Orders and spectra of what moves while a shaft changes its speed, from all rows of the run (libs/report/src/run_up.cpp). */
export interface RunUpText {
  shaft: string;
  /** Whole ones of a window in which orders are tracked. */
  revolutions: number;
  orders: number[];
  displacements: DisplacementText[];
}

/** A row for each window; `amplitude` and `lag` have a column for each order. */
export interface DisplacementText {
  path: string;
  column: number;
  /** Whose orders these are: that of the run, or a second shaft that it rotates with. */
  shaft: string;
  revolutions: number;
  time: DatasetText;
  speed: DatasetText;
  peak_to_peak: DatasetText;
  amplitude: DatasetText;
  lag: DatasetText;
  /** Amplitudes have a row for each piece of the run, and a column for each frequency. */
  cascade: { speed: DatasetText; frequency: DatasetText; amplitude: DatasetText };
}

/** A script beside the page (libs/report/src/write_html.cpp). */
export interface FieldsFile {
  bearing: string;
  file: string;
  bytes: number;
  instants: number;
}

interface ReportText {
  title: string;
  runs: RunText[];
  bearing?: BearingText;
  study?: StudyText;
}

/** A bearing by itself, as libs/report/src/bearing_page.cpp writes it. */
export interface BearingText {
  description: string;
  file: string;
  name: string;
  created: string;
  version: string;
  conditions: [string, string][];
  solutions: SolutionText[];
}

export interface FigureText {
  key: string;
  group: string;
  name: string;
  unit: string;
  /** null where it is infinite, or where there is none. */
  value: number | null;
  grid_error?: number;
  /** Said in place of a value that is no number. */
  words?: string;
}

/** A hole or groove in the film; `phi` and `arc` are along the motion, in SI: angles of a bore, lengths on a plane. Without an arc it is a line. */
export interface FeatureText {
  name: string;
  round: boolean;
  phi: number;
  z: number;
  arc: number;
  length: number;
}

/** A film of a bearing by itself. */
export interface FilmText {
  /** "inner"; empty where it is the only one. */
  name: string;
  /** The bearing that its datasets are of. */
  bearing: string;
  features: FeatureText[];
  /** Of a surface in a bore. */
  clearance?: number;
  e?: [number, number];
}

export interface SolutionText {
  label: string;
  values: [string, string][];
  error: string;
  remark: string;
  figures: FigureText[];
  /** One, or those of a floating ring, the inner first; none where there is no solution. */
  films: FilmText[];
  /** Of a journal in a bore. */
  load?: [number, number];
  datasets: Record<string, DatasetText>;
}

export type Numbers = Float32Array | Float64Array;

/** A dataset with its numbers, row-major; `width` numbers per entry of the first dimension. */
export interface Dataset {
  unit: string;
  description: string;
  shape: number[];
  width: number;
  values: Numbers;
  columns: string[];
}

function bytesOf(text: string): ArrayBuffer {
  const raw = atob(text);
  const bytes = new Uint8Array(raw.length);
  for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
  return bytes.buffer;
}

function decode(text: DatasetText, width: number): Numbers {
  if (text.type === "f8") return new Float64Array(bytesOf(text.data));
  if (text.type === "f4") return new Float32Array(bytesOf(text.data));
  const codes = new Uint16Array(bytesOf(text.data));
  const [low, step] = [new Float32Array(bytesOf(text.low!)), new Float32Array(bytesOf(text.step!))];
  const values = new Float32Array(codes.length);
  for (let row = 0, i = 0; i < codes.length; row++)
    for (const end = i + width; i < end; i++) values[i] = codes[i] === 65535 ? NaN : low[row]! + step[row]! * codes[i]!;
  return values;
}

/** The numbers of a dataset by itself. */
export function numbersOf(text: DatasetText): Numbers {
  return decode(text, text.shape.slice(1).reduce((a, b) => a * b, 1));
}

/** Last parts of paths by what stands before them. */
function namesByGroup(paths: Record<string, unknown>): Map<string, string[]> {
  const names = new Map<string, string[]>();
  for (const path of Object.keys(paths)) {
    const slash = path.lastIndexOf("/");
    const group = path.slice(0, slash);
    const known = names.get(group);
    if (known) known.push(path.slice(slash + 1));
    else names.set(group, [path.slice(slash + 1)]);
  }
  return names;
}

/** One results file. Datasets are decoded when first asked for. */
export class Run {
  private readonly decoded = new Map<string, Dataset | null>();
  private groups: Map<string, string[]> | null = null;
  private datasetsByGroup: Map<string, string[]> | null = null;

  constructor(private readonly text: RunText) {}

  get file(): string {
    return this.text.file;
  }
  get name(): string {
    return this.text.name;
  }
  get rows(): number {
    return this.text.rows;
  }
  get seriesStride(): number {
    return this.text.series_stride;
  }
  get fieldStride(): number {
    return this.text.field_stride;
  }
  get aroundStride(): number {
    return this.text.around_stride;
  }
  get assumptions(): [string, string][] {
    return this.text.assumptions;
  }
  get summary(): SummaryRow[] {
    return this.text.summary;
  }
  get runUp(): RunUpText | undefined {
    return this.text.run_up;
  }
  get model(): string | undefined {
    return this.text.model;
  }

  /** Where all instants of a bearing's film are, while the page has but some. */
  fieldsBeside(bearing: string): FieldsFile | null {
    return this.text.beside?.find((file) => file.bearing === bearing) ?? null;
  }

  /** Takes datasets in place of what it had of them. */
  take(datasets: Record<string, DatasetText>): void {
    for (const path of Object.keys(datasets)) this.decoded.delete(path);
    Object.assign(this.text.datasets, datasets);
    this.datasetsByGroup = null;
    this.text.beside = this.text.beside?.filter(({ bearing }) => !Object.keys(datasets).some((path) => path.startsWith(`/bearings/${bearing}/`))) ?? [];
  }

  /** Datasets whose path begins with `prefix`: what follows it. */
  namesAfter(prefix: string): string[] {
    return Object.keys(this.text.datasets).flatMap((path) => (path.startsWith(prefix) ? [path.slice(prefix.length)] : []));
  }

  attribute(object: string, name: string): string {
    const value = this.text.attributes[object]?.[name];
    return value === undefined ? "" : Array.isArray(value) ? value.join(", ") : String(value);
  }

  /** The datasets in a group with a row for each of the time series', with what the file says of them. */
  growingIn(group: string): SeriesText[] {
    return this.datasetNames(group).flatMap((name) => {
      const { unit, description = "" } = this.text.datasets[`${group}/${name}`]!;
      const width = this.widthOf(`${group}/${name}`);
      return width === undefined ? [] : [{ name, unit, description, width }];
    });
  }

  /** Numbers in each row of a dataset with a row for each instant of the time series. */
  private widthOf(path: string): number | undefined {
    const { shape } = this.text.datasets[path]!;
    return shape[0] === this.text.datasets["/time"]?.shape[0] ? shape.slice(1).reduce((a, b) => a * b, 1) : undefined;
  }

  /** Those of one number a row. */
  seriesIn(group: string): SeriesText[] {
    return this.growingIn(group).filter(({ width }) => width === 1);
  }

  /** All datasets with a row for each instant of the time series, and a few numbers in each. */
  seriesPaths(): { path: string; unit: string; description: string; width: number; columns: string[] }[] {
    return Object.entries(this.text.datasets).flatMap(([path, { unit, description = "", columns }]) => {
      const width = this.widthOf(path);
      return width !== undefined && width <= 9 ? [{ path, unit, description, width, columns: columns ?? [] }] : [];
    });
  }

  number(object: string, name: string): number | undefined {
    const value = this.text.attributes[object]?.[name];
    return typeof value === "number" ? value : undefined;
  }

  list(object: string, name: string): string[] {
    const value = this.text.attributes[object]?.[name];
    return Array.isArray(value) ? value : typeof value === "string" && value ? [value] : [];
  }

  parameters(): Record<string, Attribute> {
    return this.text.attributes["/parameters"] ?? {};
  }

  /** Names of the groups directly below a group, such as the bearings below "/bearings". */
  children(group: string): string[] {
    this.groups ??= namesByGroup(this.text.attributes);
    return this.groups.get(group) ?? [];
  }

  /** Names of the datasets directly in a group. */
  datasetNames(group: string): string[] {
    this.datasetsByGroup ??= namesByGroup(this.text.datasets);
    return this.datasetsByGroup.get(group) ?? [];
  }

  /** The dataset at a path, or null where the file has none (or one without rows). */
  dataset(path: string): Dataset | null {
    const known = this.decoded.get(path);
    if (known !== undefined) return known;
    const text = this.text.datasets[path];
    const width = text?.shape.slice(1).reduce((a, b) => a * b, 1) ?? 1;
    const found =
      text === undefined || (text.shape[0] ?? 0) === 0
        ? null
        : { unit: text.unit, description: text.description ?? "", shape: text.shape, width, values: decode(text, width), columns: text.columns ?? [] };
    this.decoded.set(path, found);
    return found;
  }

  /** Column `index` of a dataset, or null. */
  column(path: string, index = 0): Numbers | null {
    const dataset = this.dataset(path);
    if (dataset === null || index >= dataset.width) return null;
    if (dataset.width === 1) return dataset.values;
    const rows = dataset.shape[0]!;
    const column = new Float32Array(rows);
    for (let i = 0; i < rows; i++) column[i] = dataset.values[i * dataset.width + index]!;
    return column;
  }
}

export interface Report {
  title: string;
  runs: Run[];
  /** In a report of a bearing by itself, which has no runs. */
  bearing?: BearingText;
  /** Likewise of a study of many runs. */
  study?: StudyText;
}

/** A run that has fields only, of one instant. */
export function fieldsOnly(datasets: Record<string, DatasetText>): Run {
  return new Run({ file: "", name: "", rows: 1, series_stride: 1, field_stride: 1, around_stride: 1, attributes: {}, datasets, assumptions: [], summary: [] });
}

/** Reads the data element of the page. */
export function readReport(): Report {
  const element = document.getElementById("hersey-data");
  const text = element?.textContent ?? "";
  if (!text) throw new Error("this page is a template without data: write a report with `hersey report RESULTS`");
  const report = JSON.parse(text) as ReportText;
  return { title: report.title, runs: report.runs.map((run) => new Run(run)), ...(report.bearing ? { bearing: report.bearing } : {}), ...(report.study ? { study: report.study } : {}) };
}
