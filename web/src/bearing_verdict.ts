// The first lines about a bearing by itself: whether it was solved, what is worst and where.

import type { BearingKind } from "./bearing_kind";
import { figureOf, type Sweep } from "./bearing_sweep";
import type { BearingText, FigureText, SolutionText } from "./data";
import { h } from "./dom";
import { place, spaced, tile } from "./key_figures";
import { capital } from "./summary_table";
import type { Surface } from "./surface";
import { shownUnit, withUnit } from "./units";
import { judgementList, worstLevel, type Judgement } from "./verdict";

/** Where an extreme lies on the film, "φ = 194.2°, z = 0 mm". */
export function placeOf({ along, across }: Surface, solution: SolutionText, key: string): string {
  const value = (name: string) => figureOf(solution, name)?.value ?? null;
  const places = [along, across].map(({ figure, symbol, display, digits }) => {
    const at = value(`${key}_${figure}`);
    return at === null ? "" : `${symbol} = ${withUnit(at, display.unit, digits)}`.replaceAll(" ", "\u00a0");
  });
  return places.every((text) => text) ? places.join(", ") : "";
}

export function bearingVerdict(bearing: BearingText, { surface, smallestThickness = ["h_min"] }: BearingKind, sweep: Sweep): HTMLElement {
  const list = judged(bearing);
  const sweeps = bearing.solutions.length > 1;
  return h(
    "section",
    { class: `verdict ${worstLevel(list)}`, "aria-label": "Verdict" },
    sentence(bearing, surface, smallestThickness, sweep, sweeps),
    judgementList(list),
    sweeps ? h("div", { class: "tiles key-tiles" }, ...tiles(bearing, surface, smallestThickness, sweep)) : null,
  );
}

function judged(bearing: BearingText): Judgement[] {
  const { solutions } = bearing;
  const failed = solutions.filter((s) => s.error).length;
  const list: Judgement[] = [failed === 0 ? { level: "good", text: "Solved" } : { level: "bad", text: `${failed} of ${solutions.length} without a solution` }];
  const touching = solutions.filter((s) => (figureOf(s, "asperity_share")?.value ?? 0) > 1e-3).length;
  if (touching > 0) list.push({ level: "warn", text: solutions.length > 1 ? `Surfaces touch at ${touching} of ${solutions.length} operating points` : "Surfaces touch" });
  const remark = solutions.length === 1 ? solutions[0]!.remark : "";
  if (remark) list.push({ level: remark.includes("unstable") ? "warn" : "good", text: capital(remark) });
  return list;
}

type Worst = { figure: FigureText; index: number };

/** Of one figure, or of those of several films. */
function worst(bearing: BearingText, keys: string[], worse: (a: number, b: number) => boolean): Worst | null {
  let best: Worst | null = null;
  bearing.solutions.forEach((solution, index) => {
    for (const key of keys) {
      const figure = solution.error ? undefined : figureOf(solution, key);
      if (figure && figure.value !== null && (best === null || worse(figure.value, best.figure.value!))) best = { figure, index };
    }
  });
  return best;
}

const below = (a: number, b: number) => a < b;
const above = (a: number, b: number) => a > b;

function sentence(bearing: BearingText, surface: Surface, thicknesses: string[], sweep: Sweep, sweeps: boolean): HTMLElement | null {
  const thinnest = worst(bearing, thicknesses, below);
  if (!thinnest) return null;
  const { figure, index } = thinnest;
  const at = placeOf(surface, bearing.solutions[index]!, figure.key);
  const film = figure.key.startsWith("film_h_min_") ? `, ${figure.key.replace("film_h_min_", "")} film` : "";
  const who = `${sweeps ? sweep.label(index) : spaced(bearing.name)}${film}`;
  return h("p", { class: "verdict-line" }, sweeps ? `Thinnest film of ${bearing.solutions.length} operating points: ` : "Thinnest film: ", h("strong", {}, who), `, ${withUnit(figure.value, shownUnit(figure.unit))}${at ? ` at ${place(at)}` : ""}`);
}

function tiles(bearing: BearingText, surface: Surface, thicknesses: string[], sweep: Sweep): HTMLElement[] {
  const asked: [string, string[], typeof below][] = [
    ["Thinnest film", thicknesses, below],
    ["Peak film pressure", ["p_max", "film_p_max_inner", "film_p_max_outer"], above],
    ["Hottest oil", ["T_max"], above],
    ["Greatest film loss", ["power_film", "power_films"], above],
    ["Largest side flow", ["side_flow"], above],
    ["Least critical mass", ["critical_mass"], below],
  ];
  return asked.flatMap(([label, keys, worse]) => {
    const found = worst(bearing, keys, worse);
    return found ? [tile({ label, value: found.figure.value, unit: shownUnit(found.figure.unit), owner: sweep.label(found.index), where: placeOf(surface, bearing.solutions[found.index]!, found.figure.key) })] : [];
  });
}
