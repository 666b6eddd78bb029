// The machine in space at the instant of the timeline: shapes of its bodies, or bars between their joints.

import {
  AmbientLight,
  Box3,
  BufferGeometry,
  Color,
  DirectionalLight,
  Group,
  Line,
  LineBasicMaterial,
  Matrix4,
  PerspectiveCamera,
  Scene,
  Sphere,
  Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Run } from "./data";
import { DeformedMesh, roundEnlargement } from "./deformed_mesh";
import { figure, h } from "./dom";
import { frameOf, MachineGeometry, type BodyMotion, type Link } from "./machine_geometry";
import type { FilmFields } from "./film_fields";
import { faceMesh, FilmMesh, pose as poseOf, type Frame } from "./film_mesh";
import { ball, bar, material, rod, shapeMesh } from "./shape_mesh";
import type { Size } from "./surface";
import { onThemeChange, palette } from "./theme";
import { format } from "./units";

/** A small motion of a body, in ground's axes. */
export interface Increment {
  rotation: Vector3;
  displacement: Vector3;
  /** Of a flexible body's shapes. */
  amplitudes?: Float64Array;
}

/** Names of more bodies would fill the page. */
const mostNamed = 100;

/** Modes are shown so large. */
export const shareOfSize = 0.15;

const views = new Set<MachineView>();
onThemeChange(() => views.forEach((view) => view.repaint()));

/** Forgets views that have left the page, with their graphics memory. */
export function sweepMachineViews(): void {
  for (const view of views) if (view.wasShown && !view.element.isConnected) view.destroy();
}

export class MachineView {
  readonly element: HTMLElement;
  protected readonly holder = h("div", { class: "machine-space", role: "img", tabindex: 0, "aria-label": "The machine in space; arrow keys turn it, plus and minus come nearer" });
  protected readonly legend = h("div", { class: "machine-legend" });
  protected readonly scene = new Scene();
  protected readonly camera = new PerspectiveCamera(30, 1, 0.01, 100);
  protected readonly groups = new Map<string, Group>();
  private readonly paths = new Group();
  private readonly skins = new Map<string, DeformedMesh>();
  private enlargement = 1;
  private readonly deformationNote = h("span", { class: "chip" });
  private readonly films: FilmMesh[] = [];
  private areFilmsShown = true;
  private isSeeThrough = false;
  protected readonly forceLines: { link: Link; line: Line }[] = [];
  protected renderer: WebGLRenderer | null = null;
  protected controls: OrbitControls | null = null;
  private readonly observer: ResizeObserver;
  protected bounds: Sphere;
  private time = 0;
  private increments: Map<string, Increment> | null = null;
  /** Changes in progress: see `together`. */
  private changing = 0;
  private isRenderWanted = false;

  static of(run: Run): MachineView | null {
    const geometry = MachineGeometry.of(run);
    return geometry ? new MachineView(geometry) : null;
  }

  protected constructor(protected geometry: MachineGeometry) {
    this.bounds = this.boundingSphere();
    const toggle = h("button", { type: "button", class: "quiet", "aria-pressed": "false" }, "Paths");
    toggle.addEventListener("click", () => {
      this.paths.visible = !this.paths.visible;
      toggle.setAttribute("aria-pressed", String(this.paths.visible));
      this.render();
    });
    const filmButton = h("button", { type: "button", class: "quiet", "aria-pressed": "true" }, "Films");
    filmButton.addEventListener("click", () => {
      this.areFilmsShown = !this.areFilmsShown;
      filmButton.setAttribute("aria-pressed", String(this.areFilmsShown));
      this.repaint();
    });
    const home = h("button", { type: "button", class: "quiet" }, "Reset view");
    home.addEventListener("click", () => this.lookFromStart());
    const films = geometry.bearings.flatMap((link) => (frameOf(link) ? (geometry.film(link.name) ?? []) : []));
    const hasFilms = films.length > 0;
    const lie = films.every(({ surface }) => surface.along.period !== undefined) ? "are wrapped on" : "lie in";
    const wrapped = hasFilms ? ` Films ${lie} their bearings, pressure as colour; bodies are see-through while they are shown.` : "";
    const caption = `The machine at the instant shown. Drag or arrow keys turn it, wheel or + and − come nearer, right button shifts it.${wrapped}`;
    this.element = figure("machine", caption, h("span", { class: "tools" }, hasFilms ? filmButton : null, toggle, home), this.holder, this.legend);
    this.holder.addEventListener("keydown", (event) => this.turnByKey(event));
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(this.holder);
    views.add(this);
  }

  /** False for a view that has not been on the page yet. */
  get wasShown(): boolean {
    return this.renderer !== null;
  }

  show(time: number): void {
    this.time = time;
    if (this.renderer) this.place();
  }

  /** Bodies displaced a little from where the results have them; nothing: as they are. */
  displace(increments: Map<string, Increment> | null): void {
    this.increments = increments;
    if (this.renderer) this.place();
  }

  /** Radius of the space the machine takes [m]. */
  get size(): number {
    return this.bounds.radius;
  }

  /** Largest displacement of a flexible body's skin by its shapes [m]; 0 of a rigid body. */
  deformationBy(body: string, amplitudes: ArrayLike<number>): number {
    return this.skins.get(body)?.reach(amplitudes) ?? 0;
  }

  /** The farthest that joints, shapes and the centre of mass of a body lie from its origin [m]. */
  reach(body: string): number {
    const places = [...this.geometry.attachments(body), this.geometry.centreOfMass(body), ...this.corners(body)];
    return Math.max(0, ...places.map((place) => place.length()));
  }

  private turnByKey(event: KeyboardEvent): void {
    const turns: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const nearer: Record<string, number> = { "+": 0.9, "=": 0.9, "-": 1 / 0.9 };
    if (!this.controls || !(event.key in turns || event.key in nearer)) return;
    event.preventDefault();
    const { target } = this.controls;
    const from = this.camera.position.clone().sub(target);
    const up = this.camera.up;
    const [across, down] = turns[event.key] ?? [0, 0];
    const step = Math.PI / 24;
    // Not over the poles, where left and right would change sides.
    const polar = from.angleTo(up);
    const tilt = Math.min(Math.PI - 0.05, Math.max(0.05, polar + down * step)) - polar;
    const side = new Vector3().crossVectors(up, from).normalize();
    from.applyAxisAngle(side, tilt).applyAxisAngle(up.clone().normalize(), across * step).multiplyScalar(nearer[event.key] ?? 1);
    this.camera.position.copy(target).add(from);
    this.controls.update();
    this.render();
  }

  /** After a change of theme. */
  repaint(): void {
    if (!this.renderer) return;
    this.build();
    this.place();
  }

  destroy(): void {
    this.observer.disconnect();
    this.controls?.dispose();
    this.renderer?.dispose();
    this.renderer?.forceContextLoss();
    views.delete(this);
  }

  private start(): boolean {
    if (this.renderer) return true;
    try {
      this.renderer = new WebGLRenderer({ antialias: true, alpha: true, preserveDrawingBuffer: true });
    } catch {
      this.holder.replaceChildren(h("p", { class: "note" }, "This browser shows no 3-D graphics (WebGL)."));
      this.observer.disconnect();
      return false;
    }
    // Asking after faults of the shaders, which are three.js's own, waits for all that is being drawn.
    this.renderer.debug.checkShaderErrors = false;
    this.holder.append(this.renderer.domElement);
    this.camera.up.copy(this.geometry.up());
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.render());
    this.build();
    this.lookFromStart();
    return true;
  }

  private resize(): void {
    const [width, height] = [this.holder.clientWidth, this.holder.clientHeight];
    if (width < 40 || height < 40 || !this.start()) return;
    this.renderer!.setPixelRatio(devicePixelRatio || 1);
    this.renderer!.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.place();
  }

  /** A machine that moves in a plane is seen from almost along its normal, any other from a corner. */
  protected lookFromStart(): void {
    const { centre, normal } = { centre: this.bounds.center, normal: this.normalOfMotion() };
    const up = this.geometry.up();
    const side = new Vector3().crossVectors(up, normal).normalize();
    if (side.lengthSq() === 0) side.set(1, 0, 0);
    const direction = normal.clone().addScaledVector(side, 0.35).addScaledVector(up, 0.3).normalize();
    const distance = (0.92 * this.bounds.radius) / Math.sin((0.5 * this.camera.fov * Math.PI) / 180);
    this.camera.near = 0.01 * distance;
    this.camera.far = 20 * distance;
    this.camera.position.copy(centre).addScaledVector(direction, distance);
    this.camera.updateProjectionMatrix();
    this.controls!.target.copy(centre);
    this.controls!.update();
    this.render();
  }

  protected normalOfMotion(): Vector3 {
    const box = new Box3();
    for (const body of this.geometry.bodies)
      for (let k = 0; k < body.position.length; k += 3) box.expandByPoint(new Vector3().fromArray(body.position, k));
    const size = box.getSize(new Vector3());
    const largest = Math.max(size.x, size.y, size.z);
    const up = this.geometry.up();
    const flat = ([["z", 2], ["x", 0], ["y", 1]] as const).find(([axis, i]) => size[axis] < 0.02 * largest && Math.abs(up.getComponent(i)) < 0.9);
    const normal = new Vector3();
    if (flat) return normal.setComponent(flat[1], flat[0] === "y" ? -1 : 1);
    const across = Math.abs(up.z) > 0.9 ? new Vector3(1, -1, 0) : new Vector3(1, 0, 1).addScaledVector(up, -new Vector3(1, 0, 1).dot(up));
    return across.normalize();
  }

  protected boundingSphere(): Sphere {
    const box = new Box3();
    const pose = new Matrix4();
    const { geometry } = this;
    const step = Math.max(1, Math.floor(geometry.time.length / 50));
    for (const body of geometry.bodies) {
      const places = [new Vector3(), ...geometry.attachments(body.name), ...this.corners(body.name)];
      for (let k = 0; k < geometry.time.length; k += step) {
        geometry.pose(body, geometry.time[k]!, pose);
        for (const place of places) box.expandByPoint(place.clone().applyMatrix4(pose));
      }
    }
    for (const place of geometry.attachments("ground")) box.expandByPoint(place);
    const sphere = box.getBoundingSphere(new Sphere());
    if (!(sphere.radius > 0)) sphere.radius = Math.max(0.1, ...geometry.bearings.map((b) => 3 * geometry.bearingSize(b.name).radius));
    return sphere;
  }

  private corners(body: string): Vector3[] {
    const pads = this.geometry.pads(body).flatMap(({ surface, frame, size }) => {
      const ends = [-0.5, 0.5].flatMap((x) => [-0.5, 0.5].map((y) => surface.point(x * size.length, y * size.width, size)));
      return ends.map((place) => new Vector3(...place).applyMatrix4(poseOf(frame)));
    });
    const shapes = this.geometry.shapes(body).flatMap((shape) => {
      const mesh = shape.kind === "half_space" ? null : shapeMesh(shape, material("#000"), 1);
      if (!mesh) return [];
      mesh.updateMatrix();
      mesh.geometry.boundingBox ?? mesh.geometry.computeBoundingBox();
      const box = mesh.geometry.boundingBox!.clone().applyMatrix4(mesh.matrix);
      return [box.min, box.max];
    });
    return [...pads, ...shapes];
  }

  protected build(): void {
    const colours = palette();
    this.scene.clear();
    this.paths.clear();
    this.groups.clear();
    this.forceLines.length = 0;
    this.films.length = 0;
    this.skins.clear();
    this.scene.add(new AmbientLight(0xffffff, 1.1));
    // Lights hang on the camera: what is seen is lit.
    const light = new DirectionalLight(0xffffff, 2.4);
    light.position.set(0.6, 1, 0.8);
    this.camera.clear();
    this.camera.add(light);
    this.scene.add(this.camera);
    // The second round of colours is paler than the first.
    const colourOf = (i: number) => {
      const colour = new Color(colours.series[i % colours.series.length]!);
      return i < colours.series.length ? `#${colour.getHexString()}` : `#${colour.lerp(new Color(colours.faint), 0.6).getHexString()}`;
    };
    this.legend.replaceChildren();
    // The further frames of a flexible body move like bodies, but there is nothing of them to draw.
    for (const frame of this.geometry.bodies.filter((body) => body.name.includes("."))) this.addFrame(frame.name);
    this.isSeeThrough = this.areFilmsShown && this.geometry.bearings.some((link) => frameOf(link) && this.geometry.film(link.name));
    const bodies = this.geometry.bodies.filter((body) => !body.name.includes("."));
    bodies.forEach((body, i) => {
      this.addBody(body.name, colourOf(i));
      this.addPath(body, colourOf(i));
      if (bodies.length <= mostNamed) this.legend.append(h("span", { class: "chip" }, h("i", { style: `background:${colourOf(i)}` }), body.name.replaceAll("_", " ")));
    });
    this.addBody("ground", colours.faint);
    this.chooseEnlargement();
    if (this.skins.size > 0) this.legend.append(this.deformationNote);
    const size = 0.018 * this.bounds.radius;
    for (const joint of this.geometry.joints) this.addJoint(joint, size, colours.ink);
    for (const bearing of this.geometry.bearings) this.addBearing(bearing, colours.accent);
    const ink = new LineBasicMaterial({ color: new Color(colours.ink) });
    for (const link of this.geometry.forces) {
      const line = new Line(new BufferGeometry().setFromPoints([new Vector3(), new Vector3()]), ink);
      this.forceLines.push({ link, line });
      this.scene.add(line);
    }
    this.scene.add(this.paths);
    this.paths.visible = false;
  }

  private addFrame(name: string): void {
    const group = new Group();
    group.matrixAutoUpdate = false;
    this.groups.set(name, group);
    this.scene.add(group);
  }

  protected addBody(name: string, colour: string): void {
    const group = new Group();
    group.matrixAutoUpdate = false;
    const shapes = this.geometry.shapes(name);
    for (const shape of shapes) {
      const deformation = this.geometry.deformation(name, shape);
      if (deformation) {
        const skin = new DeformedMesh(shape, deformation);
        this.skins.set(name, skin);
        group.add(skin.mesh);
        continue;
      }
      const paint = material(colour, shape.kind === "half_space" ? 0.25 : this.seeThrough());
      const mesh = shapeMesh(shape, paint, this.bounds.radius);
      if (mesh) group.add(mesh);
    }
    if (shapes.length === 0 && name !== "ground") this.addBars(name, group, colour);
    this.groups.set(name, group);
    this.scene.add(group);
  }

  /** Bodies hide no film that is shown. */
  private seeThrough(): number {
    return this.isSeeThrough ? 0.35 : 1;
  }

  /** Bars from the middle of a body's joints to each of them; a ball where its mass lies. */
  private addBars(name: string, group: Group, colour: string): void {
    const radius = 0.022 * this.bounds.radius;
    const paint = material(colour);
    const apart = distinct(this.geometry.attachments(name), 0.1 * radius);
    const mass = this.geometry.centreOfMass(name);
    const ends = apart.length < 2 ? distinct([...apart, mass], 0.1 * radius) : apart;
    if (ends.length === 2) group.add(bar(ends[0]!, ends[1]!, radius, paint));
    if (ends.length > 2) {
      const middle = ends.reduce((sum, end) => sum.add(end), new Vector3()).divideScalar(ends.length);
      for (const end of ends) group.add(bar(middle, end, radius, paint));
    }
    group.add(ball(mass, 1.8 * radius, paint));
  }

  protected addJoint(joint: Link, size: number, colour: string): void {
    const group = this.groups.get(joint.inboard);
    if (!group || joint.axis.lengthSq() === 0) return;
    const paint = material(colour);
    const end = joint.axis.clone().normalize().multiplyScalar(3.2 * size);
    if (joint.kind === "spherical") group.add(ball(joint.inboardPlace, 2.2 * size, paint));
    else if (["revolute", "cylindrical", "prismatic", "universal", "screw"].includes(joint.kind))
      group.add(rod(joint.inboardPlace.clone().sub(end), joint.inboardPlace.clone().add(end), size, paint));
  }

  /** The film; where it is not shown the shell, see-through and a little wider than the bore, or the face of the pad. */
  protected addBearing(bearing: Link, colour: string): void {
    const size = this.geometry.bearingSize(bearing.name);
    const { radius, width, length } = size;
    const group = this.groups.get(bearing.inboard);
    if (!group || (radius === 0 && length === 0) || bearing.axis.lengthSq() === 0) return;
    const frame = frameOf(bearing);
    const film = this.areFilmsShown && frame ? this.geometry.film(bearing.name) : null;
    if (film && frame) return this.addFilm(film, bearing.name, frame, size, group);
    if (radius === 0) {
      if (frame) group.add(faceMesh(this.geometry.surface(bearing.name), frame, size, material(colour, 0.45)));
      return;
    }
    const half = bearing.axis.clone().normalize().multiplyScalar(0.5 * width);
    group.add(rod(bearing.inboardPlace.clone().sub(half), bearing.inboardPlace.clone().add(half), 1.12 * radius, material(colour, 0.45), true));
  }

  private addFilm(fields: FilmFields, name: string, frame: Frame, size: Size, group: Group): void {
    const film = new FilmMesh(fields, frame, size);
    this.films.push(film);
    group.add(film.mesh);
    const scale = h("i", { class: "film-scale" });
    this.legend.append(h("span", { class: "chip" }, scale, `film of ${name.replaceAll("_", " ")}, 0 to ${format(1e-6 * film.largest)} MPa`));
  }

  private addPath(body: BodyMotion, colour: string): void {
    const pose = new Matrix4();
    const mass = this.geometry.centreOfMass(body.name);
    const points = Array.from(this.geometry.time, (t) => mass.clone().applyMatrix4(this.geometry.pose(body, t, pose)));
    this.paths.add(new Line(new BufferGeometry().setFromPoints(points), new LineBasicMaterial({ color: new Color(colour) })));
  }

  protected place(): void {
    for (const body of this.geometry.bodies) {
      const group = this.groups.get(body.name);
      if (!group) continue;
      this.geometry.pose(body, this.time, group.matrix);
      const increment = this.increments?.get(body.name);
      if (increment) displaceMatrix(group.matrix, increment);
      this.deform(body.name, increment);
    }
    for (const film of this.films) film.show(this.time);
    const end = (body: string, place: Vector3) => {
      const group = this.groups.get(body);
      return group ? place.clone().applyMatrix4(group.matrix) : place.clone();
    };
    for (const { link, line } of this.forceLines)
      line.geometry.setFromPoints([end(link.inboard, link.inboardPlace), end(link.outboard, link.outboardPlace)]);
    this.render();
  }

  private deform(body: string, increment: Increment | undefined): void {
    const skin = this.skins.get(body);
    if (!skin) return;
    const { low, high, share } = this.geometry.around(this.time);
    const amplitudes = increment?.amplitudes ?? skin.deformation.at(low, high, share);
    // A mode is enlarged already.
    skin.show(amplitudes, increment?.amplitudes ? 1 : this.enlargement, increment?.amplitudes ? shareOfSize * this.bounds.radius : this.largestDeformation(), Boolean(increment?.amplitudes));
  }

  private largestDeformation(): number {
    return Math.max(0, ...[...this.skins.values()].map((skin) => skin.deformation.largest));
  }

  /** Deformations are shown so much larger that they are seen. */
  private chooseEnlargement(): void {
    const largest = this.largestDeformation();
    this.enlargement = largest > 0 ? Math.max(1, roundEnlargement((0.08 * this.bounds.radius) / largest)) : 1;
    if (largest > 0) this.deformationNote.textContent = `deformations x ${this.enlargement}; brightest: ${format(1e6 * largest)} µm`;
  }

  protected render(): void {
    if (this.changing > 0) this.isRenderWanted = true;
    else this.renderer?.render(this.scene, this.camera);
  }

  /** Several changes with one picture after them all. */
  protected together(change: () => void): void {
    this.changing++;
    try {
      change();
    } finally {
      this.changing--;
    }
    if (this.changing > 0 || !this.isRenderWanted) return;
    this.isRenderWanted = false;
    this.render();
  }
}

/** Turns about the body's origin, then shifts it. */
function displaceMatrix(pose: Matrix4, { rotation, displacement }: Increment): void {
  const origin = new Vector3().setFromMatrixPosition(pose);
  const angle = rotation.length();
  if (angle > 0) pose.setPosition(0, 0, 0).premultiply(new Matrix4().makeRotationAxis(rotation.clone().divideScalar(angle), angle));
  pose.setPosition(origin.add(displacement));
}

function distinct(places: Vector3[], apart: number): Vector3[] {
  return places.reduce<Vector3[]>((kept, place) => (kept.some((k) => k.distanceTo(place) < apart) ? kept : [...kept, place]), []);
}
