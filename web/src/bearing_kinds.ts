// What the page of a bearing by itself shows of each kind: key numbers, figures of a sweep, columns of its table,
// stiffness and damping. Figures that a solution lacks are left out.

import { approachAndTilt, matrices, thrustMatrices } from "./bearing_coefficients";
import type { BearingKind, SweepCurve, Swept, SweepFigure } from "./bearing_kind";
import type { Line } from "./bearing_sweep";
import type { BearingText } from "./data";
import { ring } from "./ring_kind";
import { surfaceOfPage, surfaces } from "./surface";

/** Lines of a sweep whose coefficients have figures of their own. */
const mostLines = 4;

const film = ({ over }: Swept, more: SweepCurve[] = []): SweepFigure => ({
  name: "film",
  caption: `Smallest film thickness${more.length > 0 ? `, and ${more.map(({ label }) => label).join(", ")}` : ""} ${over}.`,
  left: { label: more.length > 0 ? "film thickness" : "minimum film thickness", unit: "µm", fromZero: true },
  curves: [{ key: "h_min", label: "smallest", unit: "µm" }, ...more],
});

const friction = ({ over, isStribeck, rough }: Swept, key: string): SweepFigure => ({
  name: "friction",
  caption: `Friction coefficient ${over}${isStribeck ? ": the Stribeck curve" : ""}${rough ? ", with the share of the load on asperities" : ""}.`,
  left: { label: "friction coefficient", unit: "", log: true },
  right: { label: "share on asperities", unit: "", fromZero: true },
  curves: [
    { key, label: "friction coefficient", unit: "" },
    ...(rough ? [{ key: "asperity_share", label: "share on asperities", unit: "", alone: true, axis: "right", dash: [6, 4] } satisfies SweepCurve] : []),
  ],
});

const pressure = ({ over }: Swept): SweepFigure => ({
  name: "pressure",
  caption: `Peak film pressure ${over}.`,
  left: { label: "peak film pressure", unit: "MPa", fromZero: true },
  curves: [{ key: "p_max", label: "peak pressure", unit: "MPa" }],
});

const flow = ({ over }: Swept, where: string, more: SweepCurve[] = []): SweepFigure => ({
  name: "flow",
  caption: `Oil leaving over ${where} ${over}.`,
  left: { label: more.length > 0 ? "flow" : "side flow", unit: "mm³/s", fromZero: true },
  curves: [{ key: "side_flow", label: "side flow", unit: "mm³/s" }, ...more],
});

const power = ({ over, rough }: Swept): SweepFigure => ({
  name: "power",
  caption: `Power lost to friction ${over}.`,
  left: { label: "friction power", unit: "W", fromZero: true },
  curves: [
    { key: "power_film", label: "oil film", unit: "W" },
    ...(rough ? [{ key: "power_asperity", label: "asperities", unit: "W", alone: true, dash: [6, 4] } satisfies SweepCurve] : []),
  ],
});

/** A coefficient by its size on a logarithmic axis, dotted where it is negative. */
const signed = (key: string, label: string, unit: string, hue: number, dash?: number[]): SweepCurve[] => [
  { key, label, unit, sign: 1, points: true, hue, ...(dash ? { dash } : {}) },
  { key, label: `−${label}`, unit, sign: -1, points: true, hue, dash: [2, 3] },
];

/** Of a journal along a line of the sweep. */
function coefficients(line: Line, { over }: Swept): SweepFigure[] {
  const of = line.label ? `; ${line.label}` : "";
  const axes = "x along the load, y a quarter turn on in the sense of rotation";
  const figure = (name: string, title: string, symbol: string): SweepFigure => ({
    name,
    caption: `${title} ${over}, ${axes}${of}. Dotted, as −${symbol}: where a coefficient is negative.`,
    left: { label: `${name} ±${symbol}`, unit: "", log: true },
    curves: ["xx", "xy", "yx", "yy"].flatMap((pair, hue) => signed(`${symbol}_${pair}`, `${symbol}${pair}`, "", hue, hue === 1 || hue === 2 ? [6, 4] : undefined)),
    line,
  });
  return [figure("stiffness", "Stiffness coefficients K = k c/W", "K"), figure("damping", "Damping coefficients C = b c ω/W", "C")];
}

const journal: BearingKind = {
  surface: surfaces.bore,
  title: "bearing",
  tiles: [
    ["h_min", "Minimum film thickness"],
    ["p_max", "Peak film pressure"],
    ["eccentricity_ratio", "Eccentricity ratio"],
    ["attitude", "Attitude angle"],
    ["friction_journal", "Friction coefficient"],
    ["side_flow", "Side flow"],
  ],
  sweep: (swept) => {
    const { over, lines } = swept;
    const single = lines.length === 1;
    return [
      film(swept),
      {
        name: "eccentricity",
        caption: `Eccentricity ratio${single ? " and attitude angle" : ""} ${over}.`,
        left: { label: "eccentricity ratio", unit: "", fromZero: true },
        right: { label: "attitude angle", unit: "°" },
        curves: [
          { key: "eccentricity_ratio", label: "eccentricity ratio", unit: "" },
          { key: "attitude", label: "attitude", unit: "°", alone: true, axis: "right", dash: [6, 4] },
        ],
      },
      friction(swept, "friction_journal"),
      pressure(swept),
      ...lines.slice(0, mostLines).flatMap((line) => coefficients(line, swept)),
      {
        name: "stability",
        caption: `Critical mass of a rigid rotor${single ? " and its whirl ratio (whirl frequency by the journal’s speed)" : ""} ${over}; gaps: stable at every mass.`,
        left: { label: "critical mass", unit: "kg", log: true },
        right: { label: "whirl ratio", unit: "", fromZero: true },
        curves: [
          { key: "critical_mass", label: "critical mass", unit: "kg" },
          { key: "whirl_ratio", label: "whirl ratio", unit: "", alone: true, axis: "right", dash: [6, 4] },
        ],
      },
      flow(swept, "both edges"),
      power(swept),
    ];
  },
  columns: [
    ["load", "load"],
    ["eccentricity_ratio", "ε"],
    ["attitude", "attitude"],
    ["h_min", "h min"],
    ["p_max", "p max"],
    ["friction_journal", "friction"],
    ["asperity_share", "contact"],
    ["side_flow", "side flow"],
    ["critical_mass", "critical mass"],
    ["sommerfeld_S", "S"],
  ],
  coefficients: matrices,
};

/** A line of the sweep for each approach; tilts where only one parameter is varied. */
function padDynamics(name: string, approach: string, tilt: string, { over }: Swept): SweepFigure[] {
  const left = (unit: string) => ({ label: name, unit, log: true });
  const title = name === "stiffness" ? "Stiffness" : "Damping";
  const alone = (curves: SweepCurve[]) => curves.map((curve): SweepCurve => ({ ...curve, alone: true }));
  return [
    { name, caption: `${title} of approach ${over}.`, left: left(approach), curves: [{ key: name, label: "approach", unit: approach }] },
    {
      name: `tilt-${name}`,
      caption: `${title} of tilts ${over}: moment about the pad’s middle by slope. Dotted: where it is negative.`,
      left: left(tilt),
      curves: alone([...signed(`${name}_along`, "tilt along", tilt, 0), ...signed(`${name}_across`, "tilt across", tilt, 1, [6, 4])]),
    },
  ];
}

const slider: BearingKind = {
  surface: surfaces.plane,
  title: "plane slider",
  tiles: [
    ["h_min", "Minimum film thickness"],
    ["p_max", "Peak film pressure"],
    ["film_thickness_middle", "Film thickness at the middle"],
    ["friction_runner", "Friction coefficient"],
    ["side_flow", "Side flow"],
    ["power_film", "Friction power"],
  ],
  sweep: (swept) => {
    const { over, lines } = swept;
    const ends = lines.length === 1 ? " and, positive where it leaves, over the leading and the trailing end" : "";
    return [
      film(swept, lines.length === 1 ? [{ key: "film_thickness_middle", label: "at the pad’s middle", unit: "µm", alone: true, dash: [6, 4] }] : []),
      friction(swept, "friction_runner"),
      pressure(swept),
      { name: "centre", caption: `Where the load acts, along the sliding direction, ${over}.`, left: { label: "centre of pressure, y", unit: "mm" }, curves: [{ key: "centre_y", label: "centre of pressure", unit: "mm" }] },
      {
        name: "tilt",
        caption: `Slope of the runner in the pad’s frame ${over}.`,
        left: { label: "slope", unit: "µm/m", fromZero: true },
        curves: [
          { key: "tilt_along", label: "along", unit: "µm/m" },
          { key: "tilt_across", label: "across", unit: "µm/m", alone: true, dash: [6, 4] },
        ],
      },
      ...padDynamics("stiffness", "N/m", "N·m/rad", swept),
      ...padDynamics("damping", "N·s/m", "N·m·s/rad", swept),
      flow(swept, `both sides${ends}`, [
        { key: "flow_leading", label: "leading end", unit: "mm³/s", alone: true },
        { key: "flow_trailing", label: "trailing end", unit: "mm³/s", alone: true, dash: [6, 4] },
      ]),
      power(swept),
    ];
  },
  columns: [
    ["sliding_speed", "sliding speed"],
    ["load", "load"],
    ["film_thickness_middle", "h middle"],
    ["tilt_along", "slope", "may be missing"],
    ["h_min", "h min"],
    ["p_max", "p max"],
    ["centre_y", "centre y"],
    ["friction_runner", "friction"],
    ["asperity_share", "contact", "may be missing"],
    ["side_flow", "side flow"],
    ["power_film", "power"],
  ],
  coefficients: approachAndTilt,
};

const thrust: BearingKind = {
  surface: surfaces.annulus,
  title: "thrust bearing",
  tiles: [
    ["h_min", "Minimum film thickness"],
    ["p_max", "Peak film pressure"],
    ["film_thickness_axis", "Film thickness on the axis"],
    ["friction_runner", "Friction coefficient"],
    ["side_flow", "Flow over both edges"],
    ["power_film", "Friction power"],
  ],
  sweep: (swept) => {
    const { over, lines } = swept;
    const edges = lines.length === 1 ? " and, positive where it leaves, over leading and trailing edges" : "";
    return [
      film(swept, lines.length === 1 ? [{ key: "film_thickness_axis", label: "on the axis", unit: "µm", alone: true, dash: [6, 4] }] : []),
      friction(swept, "friction_runner"),
      pressure(swept),
      { name: "stiffness", caption: `Stiffness along the axis ${over}.`, left: { label: "stiffness", unit: "N/m", log: true }, curves: [{ key: "stiffness", label: "along the axis", unit: "N/m" }] },
      {
        name: "tilt-stiffness",
        caption: `Stiffness of tilts ${over}: moment by the slope of the runner’s axis. Dotted: where it is negative.`,
        left: { label: "stiffness", unit: "N·m/rad", log: true },
        curves: [...signed("tilting_stiffness_xx", "xx", "N·m/rad", 0), ...signed("tilting_stiffness_yy", "yy", "N·m/rad", 1, [6, 4])].map((curve): SweepCurve => ({ ...curve, alone: true })),
      },
      { name: "damping", caption: `Damping along the axis ${over}.`, left: { label: "damping", unit: "N·s/m", log: true }, curves: [{ key: "damping", label: "along the axis", unit: "N·s/m" }] },
      flow(swept, `inner and outer edges${edges}`, [
        { key: "flow_leading", label: "leading edges", unit: "mm³/s", alone: true },
        { key: "flow_trailing", label: "trailing edges", unit: "mm³/s", alone: true, dash: [6, 4] },
      ]),
      power(swept),
    ];
  },
  columns: [
    ["runner_speed", "speed"],
    ["load", "load"],
    ["film_thickness_axis", "h axis"],
    ["h_min", "h min"],
    ["p_max", "p max"],
    ["friction_runner", "friction"],
    ["asperity_share", "contact", "may be missing"],
    ["side_flow", "flow"],
    ["power_film", "power"],
  ],
  coefficients: thrustMatrices,
};

const skirt: BearingKind = {
  surface: surfaces.skirt,
  title: "piston skirt",
  tiles: [
    ["h_min", "Minimum film thickness"],
    ["p_max", "Peak film pressure"],
    ["side_force", "Side force"],
    ["skirt_friction", "Friction force"],
    ["power_film", "Friction power"],
  ],
  sweep: (swept) => {
    const { over } = swept;
    return [
      film(swept, [
        { key: "h_min_thrust", label: "thrust side", unit: "µm", alone: true, dash: [6, 4] },
        { key: "h_min_antithrust", label: "antithrust side", unit: "µm", alone: true, dash: [2, 3] },
      ]),
      {
        name: "side-force",
        caption: `Side force, and what both sides bear of it, ${over}.`,
        left: { label: "force", unit: "N" },
        curves: [
          { key: "side_force", label: "side force", unit: "N" },
          { key: "side_force_thrust", label: "thrust side", unit: "N", alone: true, dash: [6, 4] },
          { key: "side_force_antithrust", label: "antithrust side", unit: "N", alone: true, dash: [2, 3] },
        ],
      },
      pressure(swept),
      { name: "friction-force", caption: `Friction force on the skirt, positive towards the crown, ${over}.`, left: { label: "friction force", unit: "N" }, curves: [{ key: "skirt_friction", label: "friction force", unit: "N" }] },
      power(swept),
    ];
  },
  columns: [
    ["skirt_speed", "speed"],
    ["side_force", "side force"],
    ["offset_top", "offset top"],
    ["offset_bottom", "offset bottom"],
    ["h_min", "h min"],
    ["p_max", "p max"],
    ["skirt_friction", "friction"],
    ["power_film", "power"],
  ],
  coefficients: () => null,
};

const kinds = [journal, slider, thrust, skirt];

export function kindOf(bearing: Pick<BearingText, "solutions">): BearingKind {
  if (bearing.solutions.some(({ films }) => films.length > 1)) return ring;
  const surface = surfaceOfPage(bearing);
  return kinds.find((kind) => kind.surface === surface) ?? journal;
}
