// What a study varies: parameters, their values in each run, and the combinations of all but the first.

import type { Report, Run } from "./data";
import { typeset } from "./units";

export interface Combination {
  /** "clearance 34 µm", or empty if only one parameter varies. */
  label: string;
  /** In the order of the first parameter. */
  runs: Run[];
}

/** The parameter whose values name the study's variants: they need no name before them. */
const variant = "variant";

/** Stands for a parameter where runs are compared that belong to no study: its values are their names. */
const byName = "run";

export class Study {
  readonly runs: Run[];
  readonly parameters: string[];
  readonly combinations: Combination[];
  /** Runs beside each other that no study has made: each goes by its name. */
  readonly isComparison: boolean;
  /** Parameters of the model that differ between the runs of a comparison. */
  readonly differing: string[];

  private readonly given: Run[];

  constructor(report: Report) {
    this.given = report.runs;
    const named = report.runs[0]!.list("/", "study_parameters");
    this.isComparison = !areOneStudy(report.runs, named);
    this.parameters = this.isComparison ? [byName] : named;
    this.differing = this.isComparison ? varying(report.runs) : [];
    this.runs = this.isComparison ? report.runs : [...report.runs].sort((a, b) => this.compare(a, b));
    const groups = new Map<string, Run[]>();
    for (const run of this.runs) {
      const label = this.otherValues(run);
      groups.set(label, [...(groups.get(label) ?? []), run]);
    }
    this.combinations = [...groups].map(([label, runs]) => ({ label, runs }));
  }

  /** The first parameter: the abscissa. */
  get abscissa(): string {
    return this.parameters[0]!;
  }

  value(run: Run, parameter: string): string {
    if (this.isComparison && parameter === byName) return run.name;
    const value = run.parameters()[parameter];
    return value === undefined ? "" : tidy(String(value));
  }

  /** What tells one run from the others. */
  label(run: Run): string {
    const values = this.parameters.map((p) => this.value(run, p)).filter((v) => v);
    return values.length > 0 ? values.join(", ") : run.name;
  }

  /** The first parameter's values as numbers in one unit, or null if they are not such. */
  numbers(): { unit: string; of: (run: Run) => number } | null {
    if (this.isComparison) return null;
    const parsed = this.runs.map((run) => quantity(this.value(run, this.abscissa)));
    const unit = parsed[0]?.unit ?? "";
    if (parsed.some((p) => p === null || p.unit !== unit)) return null;
    return { unit, of: (run) => quantity(this.value(run, this.abscissa))!.value };
  }

  private otherValues(run: Run): string {
    return this.parameters.slice(1).map((p) => (p === variant ? "" : `${p.replaceAll("_", " ")} `) + this.value(run, p)).join(", ");
  }

  /** Words stand in the order in which the study gives them. */
  private place(parameter: string, word: string): number {
    return this.given.findIndex((run) => this.value(run, parameter) === word);
  }

  private compare(a: Run, b: Run): number {
    for (const parameter of [...this.parameters.slice(1), ...this.parameters.slice(0, 1)]) {
      const [va, vb] = [this.value(a, parameter), this.value(b, parameter)];
      const [qa, qb] = [quantity(va), quantity(vb)];
      const order = qa && qb && qa.unit === qb.unit ? qa.value - qb.value : this.place(parameter, va) - this.place(parameter, vb);
      if (order !== 0) return order;
    }
    return 0;
  }
}

/** Whether a study has made these runs: they vary the same parameters, and no two have the same values. */
function areOneStudy(runs: Run[], parameters: string[]): boolean {
  if (parameters.length === 0) return false;
  const sameParameters = runs.every((run) => run.list("/", "study_parameters").join("\n") === parameters.join("\n"));
  const values = runs.map((run) => parameters.map((p) => String(run.parameters()[p])).join("\n"));
  return sameParameters && new Set(values).size === runs.length;
}

/** Parameters that differ between runs. */
function varying(runs: Run[]): string[] {
  const names = [...new Set(runs.flatMap((run) => Object.keys(run.parameters())))];
  return names.filter((name) => new Set(runs.map((run) => String(run.parameters()[name]))).size > 1);
}

/** "2500 N" as a number and its unit. */
export function quantity(text: string): { value: number; unit: string } | null {
  const match = /^\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*?)\s*$/.exec(text);
  return match ? { value: Number(match[1]), unit: match[2]! } : null;
}

function tidy(text: string): string {
  return typeset(text).replace(/(\d)(?![eE][-+\d])([a-zA-Zµ])/, "$1 $2");
}
