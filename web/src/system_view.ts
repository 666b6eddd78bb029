// Collapsible sections about the machine and the solution: mechanism, energy, solver, model file.

import { BeamFigures, beamsOf } from "./beam_figures";
import { circuitDrawings } from "./circuit_drawing";
import type { Run } from "./data";
import { figure, h, section } from "./dom";
import { furtherFigures } from "./further_series";
import { mechanismGraph } from "./mechanism_graph";
import { LinePlot, type Curve, type LineFigure } from "./line_plot";
import { Axis, columns, curve, scaled, timeDisplay, type Abscissa } from "./series";
import { RunUpView } from "./run_up_view";
import { SpectraView } from "./spectra_view";
import { stateFigure } from "./state_table";
import { summaryTables } from "./summary_table";
import { degree, millimetre, plain, type Display } from "./units";

export class SystemView {
  readonly element = h("div", { class: "sections" });
  private readonly axis: Axis;
  private readonly plots: LinePlot[] = [];
  private beams: BeamFigures | null = null;
  private time = 0;

  constructor(
    private readonly run: Run,
    abscissa: Abscissa,
    private readonly pickTime: (time: number) => void,
    private readonly hoverRow: (row: number | null) => void,
  ) {
    this.axis = new Axis(run, abscissa);
    // With bearings their figures come first and the solution matters next; a mechanism is looked at for its motion.
    const alone = run.children("/bearings").length === 0;
    const solution = () => {
      if (run.dataset("/solver/dt") || !alone)
        this.element.append(section("Solution: step size, iterations, balances", !alone, (body) => this.solver(body)));
    };
    const runUp = RunUpView.of(run);
    if (runUp)
      this.element.append(
        section(runUp.title, true, (body) => {
          body.replaceWith(runUp.element);
          runUp.render();
        }),
      );
    if (!alone) solution();
    if (run.datasetNames("/power").length > 0) this.element.append(section("Power and energy of the system", alone, (body) => this.power(body)));
    if (beamsOf(run).length > 0) this.element.append(section("Beams", alone, (body) => this.beamFigures(body)));
    const spectra = SpectraView.of(run);
    if (spectra)
      this.element.append(
        section("Spectra and orders", alone && SpectraView.isRunUp(run), (body) => {
          body.replaceWith(spectra.element);
          spectra.render();
        }),
      );
    const graph = mechanismGraph(run);
    if (graph) this.element.append(section("Mechanism", false, (body) => body.append(graph)));
    const joints = run.children("/joints").length;
    if (joints > 0) this.element.append(section("Joints", alone && joints <= 4, (body) => this.joints(body)));
    if (run.children("/contacts").length > 0) this.element.append(section("Contacts", alone, (body) => this.contacts(body)));
    for (const [group, title] of [["/drives", "Drives"], ["/couplings", "Couplings"], ["/joint_forces", "Springs, friction and control in joints"]] as const) {
      if (run.children(group).length > 0) this.element.append(section(title, false, (body) => this.efforts(body, group)));
    }
    const fmus = run.children("/fmus").filter((fmu) => run.growingIn(`/fmus/${fmu}`).length > 0);
    if (fmus.length > 0) this.element.append(section("Signals of FMUs", alone, (body) => fmus.forEach((fmu) => this.further(body, `/fmus/${fmu}`))));
    if (run.children("/bodies").length > 0) this.element.append(section("Bodies", false, (body) => this.bodies(body)));
    for (const [group, title] of [["/forces", "Forces between bodies"], ["/surface_loads", "Loads on surfaces"]] as const) {
      const things = run.children(group).filter((thing) => run.growingIn(`${group}/${thing}`).length > 0);
      if (things.length > 0) this.element.append(section(title, false, (body) => things.forEach((thing) => this.further(body, `${group}/${thing}`))));
    }
    const groups = run.children("/groups");
    if (groups.length > 0) this.element.append(section("Bearings of several films", alone, (body) => groups.forEach((group) => this.further(body, `/groups/${group}`))));
    if (run.growingIn("/circuit").length > 0) this.element.append(section("Oil circuit", alone, (body) => this.circuit(body)));
    if (run.growingIn("/thermal").length > 0) this.element.append(section("Thermal network", false, (body) => this.further(body, "/thermal")));
    if (alone) solution();
    if (run.model) this.element.append(h("details", {}, h("summary", {}, "Model as it was run"), h("pre", { class: "model", tabindex: 0, role: "region", "aria-label": "Model file" }, run.model)));
  }

  show(time: number): void {
    this.time = time;
    for (const plot of this.plots) plot.mark(this.axis.at(time));
    this.beams?.show(time);
  }

  private circuit(body: HTMLElement): void {
    body.append(...circuitDrawings(this.run));
    this.further(body, "/circuit");
  }

  private beamFigures(body: HTMLElement): void {
    this.beams = new BeamFigures(this.run);
    body.append(...this.beams.elements);
    this.beams.show(this.time);
  }

  private add(body: HTMLElement, name: string, caption: string, left: LineFigure["left"], curves: Curve[]): void {
    if (curves.length === 0) return;
    if (this.axis.isOneInstant) return body.append(stateFigure(name, caption, curves));
    const time = this.run.column("/time");
    const pick = (row: number) => this.pickTime(time?.[row] ?? 0);
    const plot = new LinePlot({ name, x: this.axis.x, left, curves, height: 200, pick, hover: this.hoverRow });
    plot.mark(this.axis.at(this.time));
    this.plots.push(plot);
    body.append(figure(name, caption, plot.tools, plot.element));
  }

  private solver(body: HTMLElement): void {
    const { run } = this;
    const time = timeDisplay(run);
    const fine = time.unit === "ms" ? { factor: 1e6, unit: "µs" } : { factor: 1e3, unit: "ms" };
    this.add(body, "step", "Length of the time steps.", { label: "step", unit: fine.unit, fromZero: true }, curve(run, "/solver/dt", "step", fine, { stepped: true }));
    this.add(body, "newton", "Newton iterations of the system in each step, and linearisations of the film.", { label: "iterations", unit: "", fromZero: true }, [
      ...curve(run, "/solver/newton_iterations", "system", plain, { stepped: true }),
      ...run.children("/bearings").flatMap((b) => curve(run, `/bearings/${b}/film_iterations`, `film of ${b.replaceAll("_", " ")}`, plain, { stepped: true })),
    ]);
    const meaning = run.dataset("/solver/residual")?.description || "residual";
    this.add(body, "residual", `What was left when each step was accepted: ${meaning}.`, { label: "residual", unit: "", log: true }, [
      ...curve(run, "/solver/residual", "system", plain, { dots: true }),
      ...curve(run, "/solver/film_residual", "film", plain, { dots: true }),
    ]);
    this.add(body, "mass", "Mass balance of the film: what supply, side flow and storage leave unexplained, relative.", { label: "mass-balance error", unit: "", log: true },
      run.children("/bearings").flatMap((bearing) => sizes(curve(run, `/bearings/${bearing}/mass_balance_error`, bearing.replaceAll("_", " "), plain))));
    this.further(body, "/solver", ["dt", "newton_iterations", "residual", "film_residual"]);
    const unit = run.dataset("/power/balance_error")?.unit ?? "1";
    const display = { factor: 1, unit: unit === "1" ? "" : unit };
    this.add(body, "balance", "Residual power of the equations of motion; and what drives, loads, losses and storage leave unexplained when films count by their own integrals instead of their forces.", { label: "power", unit: display.unit, log: true },
      [...sizes(curve(run, "/power/balance_error", "equations of motion", display)), ...sizes(curve(run, "/power/unexplained", "unexplained", display))]);
    const cost = summaryTables(run, "computing", "Computing time");
    if (cost.length > 0) body.append(h("section", { class: "summary cost", "aria-label": "Computing time" }, ...cost));
  }

  private power(body: HTMLElement): void {
    const { run } = this;
    const all = (group: string, unit: string) =>
      run.datasetNames(group).filter((name) => name !== "balance_error" && name !== "unexplained")
        .flatMap((name) => curve(run, `${group}/${name}`, name.replaceAll("_", " "), { factor: 1, unit }))
        .filter((c) => Array.from(c.y).some((v) => v !== 0));
    this.add(body, "power-terms", "Powers, positive where they feed the system.", { label: "power", unit: "W" }, all("/power", "W"));
    this.add(body, "energy", "Stored energy.", { label: "energy", unit: "J" }, all("/energy", "J"));
    this.add(body, "energy-since-start", "Where the energy put in since the start has gone.", { label: "energy", unit: "J" }, all("/energy/since_start", "J"));
  }

  private joints(body: HTMLElement): void {
    const { run } = this;
    for (const joint of run.children("/joints")) {
      const path = (name: string) => `/joints/${joint}/${name}`;
      const coordinates = run.dataset(path("coordinates"));
      const given = coordinates?.columns.length ? coordinates.columns : run.list(`/joints/${joint}`, "coordinate_names");
      for (const [kind, label] of [["coordinates", "coordinate"], ["rates", "rate"]] as const)
        this.mixed(body, path(kind), `${joint}-${kind}`, `${joint}: ${kind}`, label, given);
      this.vector(body, path("reaction_force"), `${joint}-force`, `${joint}: reaction force`, "reaction force");
      this.vector(body, path("reaction_torque"), `${joint}-torque`, `${joint}: reaction torque`, "reaction torque");
    }
  }

  private contacts(body: HTMLElement): void {
    const { run } = this;
    const newton = { factor: 1, unit: "N" }, watt = { factor: 1, unit: "W" };
    for (const contact of run.children("/contacts")) {
      const path = (name: string) => `/contacts/${contact}/${name}`, name = contact.replaceAll("_", " ");
      this.add(body, `${contact}-force`, `${name}: normal and friction force`, { label: "force", unit: "N", fromZero: true },
        [...curve(run, path("normal_force"), "normal", newton), ...curve(run, path("friction_force"), "friction", newton)]);
      this.add(body, `${contact}-gap`, `${name}: distance of the shapes, negative where they overlap`, { label: "distance", unit: "mm" },
        curve(run, path("gap"), "distance", millimetre));
      this.add(body, `${contact}-power`, `${name}: power lost`, { label: "power", unit: "W", fromZero: true },
        [...curve(run, path("damping_power"), "damping", watt), ...curve(run, path("friction_power"), "friction", watt)]);
      this.further(body, `/contacts/${contact}`, ["normal_force", "friction_force", "gap", "damping_power", "friction_power"]);
    }
  }

  private efforts(body: HTMLElement, group: string): void {
    for (const drive of this.run.children(group)) {
      for (const [name, label] of [["force_or_torque", "force or torque"], ["power", "power"]] as const) {
        if (!this.run.dataset(`${group}/${drive}/${name}`)) continue;
        const { curves, unit: stored } = this.generic(`${group}/${drive}/${name}`, [label]);
        const unit = stored === "SI" ? "N or N·m" : stored;
        this.add(body, `${drive}-${name}`, `${drive}: ${label}`, { label, unit }, curves.map((c) => ({ ...c, unit })));
      }
    }
  }

  private bodies(body: HTMLElement): void {
    for (const name of this.run.children("/bodies")) this.further(body, `/bodies/${name}`);
  }

  /** Whatever the file holds of a thing and no figure of its own shows. */
  private further(body: HTMLElement, group: string, shown: string[] = []): void {
    const thing = group.split("/").slice(2).join("/");
    for (const { name, caption, left, curves } of furtherFigures(this.run, group, new Set(shown)))
      this.add(body, thing ? `${thing}-${name}` : name, thing ? `${thing}: ${caption}` : caption, left, curves);
  }

  /** Columns of which some turn and some shift: a figure for each kind where the dataset has no unit of its own. */
  private mixed(body: HTMLElement, path: string, name: string, caption: string, label: string, columnNames: string[]): void {
    const { curves, unit } = this.generic(path, columnNames);
    const rate = name.endsWith("rates");
    if (unit !== "SI") return this.add(body, name, caption, { label, unit }, curves);
    const turning = (c: Curve) => /rotation|orientation|angular/.test(c.label);
    const convert = (c: Curve, display: Display) => ({ ...c, y: scaled(c.y as ArrayLike<number>, display.factor), unit: display.unit });
    const turn = rate ? { factor: 1, unit: "rad/s" } : degree;
    const shift = rate ? { factor: 1, unit: "m/s" } : millimetre;
    this.add(body, `${name}-rotation`, `${caption}, rotation`, { label, unit: turn.unit }, curves.filter(turning).map((c) => convert(c, turn)));
    this.add(body, `${name}-translation`, `${caption}, translation`, { label, unit: shift.unit }, curves.filter((c) => !turning(c)).map((c) => convert(c, shift)));
  }

  private generic(path: string, labels: string[]): { curves: Curve[]; unit: string } {
    const curves = columns(this.run, path, labels);
    return { curves, unit: curves[0]?.unit ?? "" };
  }

  private vector(body: HTMLElement, path: string, name: string, caption: string, label: string): void {
    const { curves, unit } = this.generic(path, ["x", "y", "z"]);
    this.add(body, name, caption, { label, unit }, curves);
  }
}

/** Sizes of errors, as dots on a logarithmic axis. */
function sizes(curves: Curve[]): Curve[] {
  return curves.map((c) => ({ ...c, dots: true, y: Float64Array.from(c.y, (v) => Math.abs(v ?? NaN)) }));
}
