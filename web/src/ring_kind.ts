// What the page of a floating ring by itself shows: figures of both films, and the speed of the ring.

import { bearingAxesMatrices } from "./bearing_coefficients";
import type { BearingKind, SweepCurve, Swept, SweepFigure } from "./bearing_kind";
import type { Line } from "./bearing_sweep";
import { surfaces } from "./surface";

/** A curve of each film. */
const both = (key: string, unit: string): SweepCurve[] => [
  { key: `${key}_inner`, label: "inner film", unit },
  { key: `${key}_outer`, label: "outer film", unit, dash: [6, 4] },
];

/** Four coefficients by their size; dotted where they are negative. */
const coefficients = (name: string, unit: string, line: Line, { over }: Swept): SweepFigure => ({
  name,
  caption: `${name === "stiffness" ? "Stiffness" : "Damping"} that the journal meets ${over}, bearing axes${line.label ? `; ${line.label}` : ""}. Dotted: where a coefficient is negative.`,
  left: { label: name, unit, log: true },
  curves: ["xx", "xy", "yx", "yy"].flatMap((pair, hue): SweepCurve[] => [
    { key: `${name}_${pair}`, label: pair, unit, sign: 1, hue, ...(hue === 1 || hue === 2 ? { dash: [6, 4] } : {}) },
    { key: `${name}_${pair}`, label: `−${pair}`, unit, sign: -1, hue, dash: [2, 3] },
  ]),
  line,
});

/** Lines of a sweep whose coefficients have figures of their own. */
const mostLines = 4;

export const ring: BearingKind = {
  surface: surfaces.bore,
  title: "floating ring",
  smallestThickness: ["film_h_min_inner", "film_h_min_outer"],
  tiles: [
    ["film_h_min_inner", "Thinnest inner film"],
    ["film_h_min_outer", "Thinnest outer film"],
    ["film_p_max_inner", "Peak pressure, inner film"],
    ["film_p_max_outer", "Peak pressure, outer film"],
    ["ring_speed_ratio", "Ring’s speed over the journal’s"],
    ["power_films", "Friction power of both films"],
  ],
  sweep: (swept) => {
    const { over, lines } = swept;
    return [
      { name: "film", caption: `Smallest thickness of both films ${over}.`, left: { label: "minimum film thickness", unit: "µm", fromZero: true }, curves: both("film_h_min", "µm") },
      { name: "ring-speed", caption: `Speed of the ring over that of the journal ${over}.`, left: { label: "speed ratio", unit: "", fromZero: true }, curves: [{ key: "ring_speed_ratio", label: "speed ratio", unit: "" }] },
      { name: "eccentricity", caption: `Eccentricity ratios of journal in ring and of ring in shell ${over}.`, left: { label: "eccentricity ratio", unit: "", fromZero: true }, curves: both("film_eccentricity_ratio", "") },
      { name: "pressure", caption: `Peak pressure of both films ${over}.`, left: { label: "peak film pressure", unit: "MPa", fromZero: true }, curves: both("film_p_max", "MPa") },
      { name: "power", caption: `Power lost to friction in both films ${over}.`, left: { label: "friction power", unit: "W", fromZero: true }, curves: both("film_power", "W") },
      ...lines.slice(0, mostLines).flatMap((line) => [coefficients("stiffness", "N/m", line, swept), coefficients("damping", "N·s/m", line, swept)]),
    ];
  },
  columns: [
    ["load", "load"],
    ["ring_speed_ratio", "speed ratio"],
    ["film_eccentricity_ratio_inner", "ε inner"],
    ["film_eccentricity_ratio_outer", "ε outer"],
    ["film_h_min_inner", "h min inner"],
    ["film_h_min_outer", "h min outer"],
    ["film_p_max_inner", "p max inner"],
    ["film_p_max_outer", "p max outer"],
    ["power_films", "power"],
  ],
  coefficients: bearingAxesMatrices,
};
