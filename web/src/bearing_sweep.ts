// The solutions of a bearing by itself as a sweep: what is varied, and figures over it.

import type { BearingText, FigureText, SolutionText } from "./data";
import { quantity } from "./study";
import { typeset } from "./units";

export interface Line {
  /** Values of all parameters but the first; empty if there are none. */
  label: string;
  /** Indices of solutions in the order of the abscissa. */
  solutions: number[];
}

export class Sweep {
  readonly solutions: SolutionText[];
  readonly parameters: string[];
  readonly unit: string;
  readonly x: number[];
  readonly isLog: boolean;
  readonly lines: Line[];
  private readonly places: (number | null)[];

  constructor(bearing: BearingText) {
    this.solutions = bearing.solutions;
    this.parameters = this.solutions[0]!.values.map(([name]) => name);
    const first = this.solutions.map((s) => quantity(s.values[0]?.[1] ?? ""));
    this.unit = first[0]?.unit ?? "";
    const isNumber = first.every((q) => q !== null && q.unit === this.unit);
    this.places = first.map((q, i) => (isNumber ? q!.value : i));
    this.x = [...new Set(this.places.map((p) => p!))].sort((a, b) => a - b);
    this.isLog = this.x.length > 2 && this.x[0]! > 0 && this.x[this.x.length - 1]! / this.x[0]! > 50 && isGeometric(this.x);
    const lines = new Map<string, number[]>();
    this.solutions.forEach((s, i) => {
      const label = s.values.slice(1).map(([name, text]) => `${name.replaceAll("_", " ")} ${typeset(text)}`).join(", ");
      lines.set(label, [...(lines.get(label) ?? []), i]);
    });
    this.lines = [...lines].map(([label, indices]) => ({ label, solutions: indices.sort((a, b) => this.places[a]! - this.places[b]!) }));
  }

  get abscissa(): string {
    return (this.parameters[0] ?? "solution").replaceAll("_", " ");
  }

  /** Whether the friction over the abscissa is a Stribeck curve: over a factor of the Hersey number. */
  get isStribeck(): boolean {
    return ["speed", "journal_speed", "viscosity", "load"].includes(this.parameters[0] ?? "");
  }

  label(index: number): string {
    const s = this.solutions[index]!;
    return s.values.map(([name, text]) => `${name.replaceAll("_", " ")} ${typeset(text)}`).join(", ");
  }

  place(index: number): number {
    return this.places[index]!;
  }

  /** A figure over the abscissa along a line; null where there is no solution or no number. */
  along(line: Line, key: string, of: (value: number) => number = (v) => v): (number | null)[] {
    return this.x.map((x) => {
      const index = line.solutions.find((i) => this.places[i] === x);
      const value = index === undefined ? null : valueOf(this.solutions[index]!, key);
      return value === null ? null : of(value);
    });
  }

  /** The solution of a line at the k-th value of the abscissa. */
  at(line: Line, k: number): number | undefined {
    return line.solutions.find((i) => this.places[i] === this.x[k]);
  }
}

export function figureOf(solution: SolutionText, key: string): FigureText | undefined {
  return solution.figures.find((f) => f.key === key);
}

/** A rotor that is stable at every mass has no whirl. */
function valueOf(solution: SolutionText, key: string): number | null {
  if (key === "whirl_ratio" && figureOf(solution, "critical_mass")?.value === null) return null;
  return figureOf(solution, key)?.value ?? null;
}

function isGeometric(x: number[]): boolean {
  const ratios = x.slice(1).map((v, i) => v / x[i]!);
  return Math.max(...ratios) / Math.min(...ratios) < 1.5;
}
