// What describes a kind of bearing on the page of a bearing by itself.

import type { Line } from "./bearing_sweep";
import type { SolutionText } from "./data";
import type { Curve, LineFigure } from "./line_plot";
import type { Surface } from "./surface";

/** What a sweep is about. */
export interface Swept {
  /** "over speed". */
  over: string;
  lines: Line[];
  isStribeck: boolean;
  /** Whether asperities bear something somewhere. */
  rough: boolean;
}

export interface SweepCurve extends Partial<Omit<Curve, "y">> {
  key: string;
  label: string;
  unit: string;
  /** Only where a single parameter is varied: a second quantity would drown among many lines. */
  alone?: boolean;
  /** Only values of this sign, by size: for logarithmic axes. */
  sign?: 1 | -1;
}

export interface SweepFigure {
  name: string;
  caption: string;
  left: LineFigure["left"];
  right?: LineFigure["right"];
  curves: SweepCurve[];
  /** Of one line of the sweep only. */
  line?: Line;
}

export interface BearingKind {
  surface: Surface;
  /** Before its name. */
  title: string;
  /** Figures of the smallest thickness of its films; one film: h_min. */
  smallestThickness?: string[];
  /** What stands large above the figures. */
  tiles: [string, string][];
  sweep: (swept: Swept) => SweepFigure[];
  /** Figures in the table of a sweep with their short names; those that may be missing are left out where no solution has them. */
  columns: [string, string, "may be missing"?][];
  coefficients: (solution: SolutionText) => HTMLElement | null;
}
