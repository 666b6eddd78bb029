// A study's data as python/hersey_study/page.py writes it.

export interface Scatter {
  count: number;
  mean: number;
  standard_deviation: number;
  smallest: number;
  largest: number;
  percentiles: Record<string, number>;
}

export interface Surrogate {
  terms: number;
  /** Share of the variance, from runs that were left out. */
  cross_validated_error: number;
  /** Sobol indices, per parameter. */
  first: number[];
  total: number[];
  /** Slopes at the middle of the parameters. */
  sensitivities: number[];
  /** With all parameters in the middle. */
  centre: number;
  /** Over each parameter, the others in the middle. */
  lines: { x: number[]; y: number[] }[];
}

export interface SampledFigure {
  key: string;
  name: string;
  unit: string;
  scatter: Scatter | null;
  surrogate: Surrogate | null;
}

export interface SampledRun {
  run: string;
  /** Values of the parameters as written. */
  texts: string[];
  inputs: number[];
  outputs: (number | null)[];
  feasible: boolean;
  seconds: number;
  /** Its report page, beside this one; empty: none. */
  report: string;
}

export interface SampledParameter {
  name: string;
  unit: string;
  values: string[];
  /** Its values are words: inputs are their places. */
  is_words: boolean;
}

interface Rows {
  parameter: string;
  unit: string;
}

export interface StudyText {
  title: string;
  model: string;
  version: string;
  plan: string;
  analysis: string;
  set: string[];
  planned: number;
  completed: number;
  failed: { reason: string; count: number }[];
  parameters: SampledParameter[];
  objectives: { name: string; maximise: boolean }[];
  constraints: { text: string; name: string; lower: boolean; bound: number }[];
  runs: SampledRun[];
  figures: SampledFigure[];
  corners: { figure: string; which: string; value: number; run: string }[];
  /** Runs that none other beats. */
  best: string[];
  campbell?: Rows & { rows: { x: number; run: string; frequency: (number | null)[]; damping_ratio: (number | null)[] }[] };
  /** How the runs scatter over time: of each series whose end is a figure. */
  bands?: Band[];
  run_up?: Rows & { series: string; rows: { x: number; run: string; frequency: number[]; amplitude: number[] }[] };
}

/** Mean and percentiles of a series over the runs, at even times [s]. */
export interface Band {
  key: string;
  name: string;
  unit: string;
  runs: number;
  time: number[];
  mean: number[];
  percentiles: { "5": number[]; "50": number[]; "95": number[] };
}

/** One column of numbers over the runs. */
export interface Column {
  /** Short, for axes. */
  label: string;
  unit: string;
  values: (number | null)[];
  words?: string[];
}

export function parameterColumn(study: StudyText, k: number): Column {
  const parameter = study.parameters[k]!;
  return {
    label: shortName(parameter.name),
    unit: parameter.unit,
    values: study.runs.map((run) => run.inputs[k]!),
    ...(parameter.is_words ? { words: parameter.values } : {}),
  };
}

export function figureColumn(study: StudyText, k: number): Column {
  const figure = study.figures[k]!;
  return { label: shortName(figure.key), unit: figure.unit, values: study.runs.map((run) => run.outputs[k] ?? null) };
}

/** "bearings.main.h_min" as "h min (main)", "modes.1.frequency" as "mode 1 frequency". */
export function shortName(name: string): string {
  const parts = name.split(".");
  if (parts[0] === "modes") return ["mode", ...parts.slice(1)].join(" ").replaceAll("_", " ");
  const last = parts.slice(parts[0] === "bearings" ? 2 : Math.max(0, parts.length - 2)).join(" ").replaceAll("_", " ");
  return parts[0] === "bearings" && parts.length > 2 ? `${last} (${parts[1]!.replaceAll("_", " ")})` : last;
}
