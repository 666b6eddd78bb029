// Everything about one bearing of one run.

import { AngleTimeMap } from "./angle_time_map";
import { cycleMaps } from "./cycle_maps";
import type { Run } from "./data";
import { figure, h, section, segmented, tableButton } from "./dom";
import { FieldMap, type Mark } from "./field_map";
import { extent, FilmFields, nearest, type FieldKind } from "./film_fields";
import { furtherFigures } from "./further_series";
import { LinePlot, type Curve, type LineFigure } from "./line_plot";
import { Orbit } from "./orbit";
import { Axis, curve, magnitude, scaled, type Abscissa } from "./series";
import { stateFigure } from "./state_table";
import { axisName, surfaceOf, type Surface } from "./surface";
import { cubicMillimetrePerSecond, degree, megapascal, micrometre, micrometrePerMetre, millimetre, newtonMillimetre, percent, plain, type Display } from "./units";

const newton = { factor: 1, unit: "N" };
const watt = { factor: 1, unit: "W" };
const metrePerSecond = { factor: 1, unit: "m/s" };

/** Figures of a bearing that follow the instant shown. */
export class BearingView {
  readonly element = h("div", { class: "figures" });
  /** Folded. */
  readonly further = h("div", { class: "sections" });
  readonly fields: FilmFields | null;
  private readonly surface: Surface;
  private readonly axis: Axis;
  private readonly followers: ((time: number, instant: number) => void)[] = [];
  private time: number | null = null;

  constructor(
    private readonly run: Run,
    private readonly bearing: string,
    abscissa: Abscissa,
    private readonly pickTime: (time: number) => void,
    private readonly hoverRow: (row: number | null) => void,
  ) {
    this.axis = new Axis(run, abscissa);
    this.surface = surfaceOf(run, bearing);
    this.fields = FilmFields.of(run, bearing);
    this.addOrbit();
    this.addMap();
    this.addMidplane();
    this.addAround();
    const cycle = cycleMaps(run, bearing);
    if (cycle) this.element.append(cycle);
    this.addSeries();
  }

  show(time: number, instant: number): void {
    this.time = time;
    for (const follow of this.followers) follow(time, instant);
  }

  private path(name: string): string {
    return `/bearings/${this.bearing}/${name}`;
  }

  private addOrbit(): void {
    const time = this.run.column("/time");
    const x = this.run.column(this.path("eccentricity"), 0);
    const y = this.run.column(this.path("eccentricity"), 1);
    const clearance = this.run.number(`/bearings/${this.bearing}`, "radial_clearance");
    if (!time || !x || !y || !clearance) return;
    const fx = this.run.column(this.path("force"), 0);
    const fy = this.run.column(this.path("force"), 1);
    const orbit = new Orbit({ time, x, y, clearance, force: fx && fy ? { x: fx, y: fy } : null });
    this.followers.push((t) => orbit.show(t));
    this.element.append(
      figure("orbit", "Journal orbit in the bearing’s axes: path of the journal centre, its position now, and the direction of the load (arrow).", tableButton(`${this.bearing}-orbit`, () => orbit.numbers()), orbit.element),
    );
  }

  private addMap(): void {
    const fields = this.fields;
    if (!fields) return;
    const kinds = fields.kinds();
    const map = new FieldMap(fields, kinds[0]!);
    this.followers.push((t, instant) => map.show(instant, [...this.mark("p_max", "cross", t), ...this.mark("h_min", "ring", t)]));
    const choices = kinds.map(({ key, label }) => ({ value: key, label: label.replace("Film ", "").replace(/^./, (c) => c.toUpperCase()) }));
    const controls = h(
      "div",
      { class: "controls" },
      segmented("Field shown", choices, kinds[0]!.key, (key) => map.choose(kinds.find((k: FieldKind) => k.key === key)!)),
      segmented("Colour scale", [{ value: "run", label: "Scale of the run" }, { value: "instant", label: "of the instant" }], "run", (s) => map.rescale(s as "run" | "instant")),
    );
    this.element.append(
      figure("map", `The film on ${this.surface.map} at the instant shown. White line: edge of the full film; cross: peak pressure; ring: smallest film thickness.`, tableButton(`${this.bearing}-film`, () => map.numbers()), controls, map.element),
    );
  }

  /** Where a quantity has its extreme at a time. */
  private mark(series: string, symbol: Mark["symbol"], at: number): Mark[] {
    const time = this.run.column("/time");
    const along = this.run.column(this.path(`${series}_${this.surface.along.key}`));
    const across = this.run.column(this.path(`${series}_${this.surface.across.key}`));
    if (!time || !along || !across) return [];
    const row = nearest(time, at);
    return [{ along: along[row]!, across: across[row]!, symbol }];
  }

  private addMidplane(): void {
    const fields = this.fields;
    if (!fields || !fields.at("pressure", 0)) return;
    const { along } = fields;
    const curves = (instant: number): Curve[] => [
      { label: "pressure", y: fields.midplane("pressure", instant, megapascal.factor)!, unit: "MPa", fill: true },
      ...(fields.at("thickness", instant)
        ? [{ label: "film thickness", y: fields.midplane("thickness", instant, micrometre.factor)!, unit: "µm", axis: "right" as const }]
        : []),
    ];
    const plot = new LinePlot({
      name: `${this.bearing}-midplane`,
      x: { label: axisName(along.coordinate), unit: along.coordinate.display.unit, values: along.shown() },
      left: { label: `pressure at ${this.surface.middle}`, unit: "MPa", fromZero: true },
      ...(fields.at("thickness", 0) ? { right: { label: "film thickness", unit: "µm", fromZero: true } } : {}),
      curves: curves(0),
    });
    this.followers.push((_t, instant) => plot.update(curves(instant).map((c) => c.y)));
    this.element.append(figure("midplane", `Pressure and film thickness along the middle of ${this.surface.whole} at the instant shown.`, plot.tools, plot.element));
  }

  private addAround(): void {
    const time = this.run.column("/time");
    if (this.axis.isOneInstant) return;
    const map = AngleTimeMap.of(this.run, this.bearing, this.axis, (row) => this.pickTime(time?.[row] ?? 0));
    if (!map) return;
    this.followers.push((t) => map.mark(this.axis.at(t)));
    const choices = map.kinds.map(({ key, label }) => ({ value: key, label }));
    const controls = h("div", { class: "controls" }, segmented("Map over time", choices, choices[0]!.value, (key) => map.choose(map.kinds.find((kind) => kind.key === key)!)));
    this.element.append(
      figure("around", `Extremes over ${this.surface.whole}’s width, ${this.surface.way} and over the run. White line: the instant shown; a click shows another.`, tableButton(`${this.bearing}-around`, () => map.numbers()), controls, map.element),
    );
  }

  private add(name: string, caption: string, left: LineFigure["left"], curves: Curve[], right?: LineFigure["right"], into: HTMLElement = this.element): void {
    if (curves.length === 0) return;
    if (this.axis.isOneInstant) return into.append(stateFigure(name, caption, curves));
    const time = this.run.column("/time");
    const plot = new LinePlot({
      name: `${this.bearing}-${name}`,
      x: this.axis.x,
      left,
      ...(right ? { right } : {}),
      curves,
      pick: (index) => this.pickTime(time?.[index] ?? 0),
      hover: this.hoverRow,
    });
    this.followers.push((t) => plot.mark(this.axis.at(t)));
    if (this.time !== null) plot.mark(this.axis.at(this.time));
    into.append(figure(name, caption, plot.tools, plot.element));
  }

  /** Whatever else the file holds of the film, drawn when it is asked for. */
  private addFurther(shown: ReadonlySet<string>): void {
    const figures = furtherFigures(this.run, `/bearings/${this.bearing}`, shown, (name) => (/_[yz]$/.test(name) ? millimetre : micrometre));
    if (figures.length === 0) return;
    this.further.replaceChildren(
      section("Further quantities of the film", false, (body) => {
        for (const { name, caption, left, curves } of figures) this.add(name, caption, left, curves, undefined, body);
      }),
    );
  }

  private addSeries(): void {
    const { run, surface } = this;
    // The orbit shows the first, figures of the solution the others.
    const shown = new Set(["eccentricity", "film_iterations", "mass_balance_error"]);
    const of = (name: string, label: string, display: typeof newton, extra: Parameters<typeof curve>[4] = {}) => {
      shown.add(name);
      return curve(run, this.path(name), label, display, extra);
    };
    this.add("thickness", surface.thickness, { label: "film thickness", unit: "µm", fromZero: true }, [
      ...of("h_min", "smallest", micrometre),
      ...of("h_min_centre", `smallest at ${surface.middle}`, micrometre, { dash: [6, 4] }),
      ...of("film_thickness_middle", `at ${surface.whole}’s middle`, micrometre, { dash: [2, 3] }),
      ...of("film_thickness_axis", "on the axis", micrometre, { dash: [2, 3] }),
    ]);
    this.add("peak-pressure", "Peak film pressure.", { label: "peak pressure", unit: "MPa", fromZero: true }, of("p_max", "peak pressure", megapascal));
    const size = magnitude(run, this.path("force"));
    const force = run.dataset(this.path("force"));
    this.add("force", `Force of the film and the asperities on the ${surface.held}, ${surface.axes}.`, { label: `force on the ${surface.held}`, unit: "N" }, [
      ...(size ? [{ label: "magnitude", y: size, unit: "N" }] : []),
      ...["x", "y", "z"].flatMap((label, column) =>
        force && column < force.width && !negligible(run.column(this.path("force"), column)!, size)
          ? of("force", label, newton, { column, ...(column === 2 ? { dash: [3, 3] } : {}) })
          : [],
      ),
    ]);
    this.add("eccentricity", "Eccentricity ratio, and angle from the load to the line of centres.", { label: "eccentricity ratio", unit: "", fromZero: true }, [
      ...of("eccentricity_ratio", "eccentricity ratio", plain),
      ...of("attitude", "attitude angle", degree, { axis: "right", dash: [6, 4] }),
    ], { label: "attitude", unit: "°" });
    this.add("power", "Power lost to friction.", { label: "power loss", unit: "W", fromZero: true }, [
      ...of("power_film", "oil film", watt),
      ...of("power_asperity", "asperity contact", watt),
    ]);
    this.add("torque", `Friction torque on the ${surface.moving} about its axis and on the ${surface.held} about its own.`, { label: "friction torque", unit: "N·mm" }, [
      ...of("torque_journal", "on the journal", newtonMillimetre),
      ...of("torque_runner", "on the runner", newtonMillimetre),
      ...of("torque_shell", "on the shell", newtonMillimetre),
      ...of("torque_stator", "on the stator", newtonMillimetre),
    ]);
    this.add("flow", surface.flow, { label: "flow", unit: "mm³/s", fromZero: true }, [
      ...of("flow_left", "side flow, left", cubicMillimetrePerSecond),
      ...of("flow_inner", "over inner edges", cubicMillimetrePerSecond),
      ...of("flow_outer", "over outer edges", cubicMillimetrePerSecond, { dash: [6, 4] }),
      ...of("flow_right", "side flow, right", cubicMillimetrePerSecond, { dash: [6, 4] }),
      ...of("flow_leading", "leading end", cubicMillimetrePerSecond),
      ...of("flow_trailing", "trailing end", cubicMillimetrePerSecond, { dash: [6, 4] }),
      ...of("flow_supply", "supply", cubicMillimetrePerSecond),
      ...run
        .namesAfter(this.path("flow_feature_"))
        .flatMap((name) => of(`flow_feature_${name}`, name, cubicMillimetrePerSecond, { dash: [2, 3] })),
    ]);
    this.add("cavitated", `Share of ${surface.whole}’s surface where the film is cavitated.`, { label: "cavitated share", unit: "%", fromZero: true }, of("cavitated_share", "cavitated share", percent));
    const tilt = run.dataset(this.path("tilt"));
    if (tilt && extent(scaled(tilt.values, 1)).some((v) => Math.abs(v) > 1e-9))
      this.add("tilt", "Tilt of the journal against the shell.", { label: "tilt", unit: "mrad" }, [
        ...of("tilt", "about x", { factor: 1e3, unit: "mrad" }, { column: 0 }),
        ...of("tilt", "about y", { factor: 1e3, unit: "mrad" }, { column: 1 }),
      ]);
    const runner = run.dataset(this.path("runner_tilt"));
    if (runner && runner.values.some((v) => Math.abs(v) > 1e-9))
      this.add("runner-tilt", "Slopes of the runner’s axis towards x and y, in the stator’s frame.", { label: "slope", unit: "µm/m" }, [
        ...of("runner_tilt", "towards x", micrometrePerMetre, { column: 0 }),
        ...of("runner_tilt", "towards y", micrometrePerMetre, { column: 1, dash: [6, 4] }),
      ]);
    this.addSlides(of);
    this.addSecondaryMotion(of);
    this.addFurther(shown);
  }

  /** Of films on planes. */
  private addSlides(of: (name: string, label: string, display: Display, extra?: Parameters<typeof curve>[4]) => Curve[]): void {
    const { moving, whole, held } = this.surface;
    const slope = this.run.dataset(this.path("slope"));
    if (slope && slope.values.some((v) => Math.abs(v) > 1e-9))
      this.add("slope", `Slopes of the ${moving} along and across the sliding direction, in the ${held}’s frame.`, { label: "slope", unit: "µm/m" }, [
        ...of("slope", "along", micrometrePerMetre, { column: 0 }),
        ...of("slope", "across", micrometrePerMetre, { column: 1, dash: [6, 4] }),
      ]);
    this.add("sliding-speed", `Speed of the ${moving} along the ${held}’s y-axis.`, { label: "sliding speed", unit: "m/s", fromZero: true }, of("sliding_speed", "sliding speed", metrePerSecond));
    const bounds = [...of("rupture_y", "ruptures", millimetre, { points: true }), ...of("reformation_y", "re-forms", millimetre, { points: true })];
    this.add("rupture", `Where the film at mid-width ruptures and re-forms along ${whole}; gaps: it is whole.`, { label: "y", unit: "mm" }, bounds.some(({ y }) => Array.from(y).some((v) => v !== null && Number.isFinite(v))) ? bounds : []);
  }

  /** Of skirts. */
  private addSecondaryMotion(of: (name: string, label: string, display: Display, extra?: Parameters<typeof curve>[4]) => Curve[]): void {
    this.add("offsets", "How far the skirt’s axis is off that of the liner, towards the thrust side.", { label: "offset", unit: "µm" }, [
      ...of("offset_top", "top of the skirt", micrometre),
      ...of("offset_bottom", "bottom of the skirt", micrometre, { dash: [6, 4] }),
    ]);
    this.add("sides", "Smallest film thickness of both sides.", { label: "film thickness", unit: "µm", fromZero: true }, [
      ...of("h_min_thrust", "thrust side", micrometre),
      ...of("h_min_antithrust", "antithrust side", micrometre, { dash: [6, 4] }),
    ]);
    this.add("side-force", "Side force, and what film and contact of both sides bear.", { label: "force", unit: "N" }, [
      ...of("side_force", "side force", newton),
      ...of("side_force_thrust", "thrust side", newton, { dash: [6, 4] }),
      ...of("side_force_antithrust", "antithrust side", newton, { dash: [2, 3] }),
    ]);
    this.add("skirt-friction", "Friction force on the skirt along the liner, positive towards the crown.", { label: "friction force", unit: "N" }, of("skirt_friction", "friction force", newton));
  }
}

/** Whether a component is nothing beside the whole vector. */
function negligible(component: ArrayLike<number>, size: ArrayLike<number> | null): boolean {
  const most = (values: ArrayLike<number>) => Math.max(...extent(values).map(Math.abs));
  return size !== null && most(component) < 1e-9 * most(size);
}
