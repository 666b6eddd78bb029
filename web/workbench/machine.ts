// The machine as its text says, at its start: the report's picture, kept while the text changes; parts can be chosen,
// joints moved, and the whole cut by a plane.

import { AxesHelper, Line, Matrix4, Mesh, Plane, Quaternion, Raycaster, Vector2, Vector3, type Material, type MeshStandardMaterial, type Object3D } from "three";
import { isKept } from "../src/kept_geometry";
import type { Run } from "../src/data";
import { MachineGeometry, type Link } from "../src/machine_geometry";
import { MachineView } from "../src/machine_view";
import { coil, MachineMarks, redraw, wordsOf, type Marks } from "./machine_marks";
import { h } from "../src/dom";

export interface Pose {
  position: [number, number, number];
  /** w, x, y, z */
  orientation: [number, number, number, number];
}

export class WorkbenchMachine extends MachineView {
  private chosen: string | null = null;
  private poses: Map<string, Matrix4> | null = null;
  private cut: number | null = null;
  private framesShown = false;
  private loadsShown = true;
  private drawn: MachineMarks | null = null;
  private isTurned = false;

  /** @param pick  called with the part that was clicked, such as /bodies/rod; null beside them all */
  constructor(run: Run, private marks: Marks, pick: (part: string | null) => void) {
    super(new MachineGeometry(run));
    // Who has turned the machine keeps the view; else it fits into every size of the pane.
    new ResizeObserver(() => this.controls && !this.isTurned && this.reset()).observe(this.holder);
    for (const kind of ["pointerdown", "wheel", "keydown"]) this.holder.addEventListener(kind, () => (this.isTurned = true), { passive: true });
    let down: [number, number] | null = null;
    this.holder.addEventListener("pointerdown", (event) => (down = [event.clientX, event.clientY]));
    this.holder.addEventListener("pointerup", (event) => {
      // Turning the machine is no choice.
      if (down && event.button === 0 && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < 4) pick(this.partAt(event.clientX, event.clientY));
      down = null;
    });
  }

  get space(): HTMLElement {
    return this.holder;
  }
  get names(): HTMLElement {
    return this.legend;
  }
  get joints(): Link[] {
    return this.geometry.joints;
  }

  parts(): string[] {
    const { bodies, joints, bearings } = this.geometry;
    return [
      ...bodies.filter((b) => !b.name.includes(".")).map((b) => `/bodies/${b.name}`),
      ...joints.map((j) => `/joints/${j.name}`),
      ...bearings.map((b) => `/bearings/${b.name}`),
      ...this.marks.loads.map((f) => `/forces/${f.name}`),
      ...Object.entries(this.marks.frames).flatMap(([body, list]) => list.map(({ name }) => `/bodies/${body}/frames/${name}`)),
    ];
  }

  /** Another state of the text; the eye stays where it is unless the machine's size has changed much. */
  take(run: Run, marks: Marks): void {
    const size = this.bounds.radius;
    this.marks = marks;
    this.geometry = new MachineGeometry(run);
    this.bounds = this.boundingSphere();
    this.poses = null;
    if (!this.renderer) return;
    const old = this.meshes();
    this.together(() => {
      this.build();
      this.place();
      if (this.bounds.radius > 2 * size || this.bounds.radius < 0.5 * size) this.reset();
    });
    // Not before the new ones are drawn: shaders that nothing uses would have to be made again.
    for (const mesh of old) {
      if (!isKept(mesh.geometry)) mesh.geometry.dispose();
      for (const paint of [ownPaint(mesh)].flat()) if (!paint.userData["kept"]) paint.dispose();
    }
  }

  resetByHand(): void {
    this.isTurned = false;
    this.reset();
  }

  reset(): void {
    if (!this.renderer || !this.controls) return;
    this.camera.up.copy(this.geometry.up());
    this.lookFromStart();
  }

  /** Poses of a joint's other position; null: as the text says. */
  move(poses: Record<string, Pose> | null): void {
    this.poses = poses
      ? new Map(
          Object.entries(poses).map(([name, { position, orientation: [w, x, y, z] }]) => [name, new Matrix4().compose(new Vector3(...position), new Quaternion(x, y, z, w), new Vector3(1, 1, 1))]),
        )
      : null;
    if (this.renderer) this.place();
  }

  /** The machine from its usual side, as the address of a picture. */
  photograph(): string {
    this.resetByHand();
    return this.renderer!.domElement.toDataURL("image/png");
  }

  choose(part: string | null): void {
    if (this.chosen === part) return;
    this.chosen = part;
    if (!this.renderer) return;
    this.light();
    this.render();
  }

  showFrames(shown: boolean): void {
    this.framesShown = shown;
    if (this.renderer) this.repaint();
  }

  showLoads(shown: boolean): void {
    this.loadsShown = shown;
    if (this.renderer) this.repaint();
  }

  /** Cuts along the plane of motion, `place` from -1 to 1 through the machine; null: whole. */
  section(place: number | null): void {
    this.cut = place;
    this.clip();
    this.render();
  }

  private clip(): void {
    if (!this.renderer) return;
    if (this.cut === null) {
      this.renderer.clippingPlanes = [];
      return;
    }
    const normal = this.normalOfMotion().negate();
    const through = this.bounds.center.clone().addScaledVector(normal, -this.cut * this.bounds.radius);
    this.renderer.clippingPlanes = [new Plane().setFromNormalAndCoplanarPoint(normal, through)];
  }

  private partAt(x: number, y: number): string | null {
    const box = this.holder.getBoundingClientRect();
    const ray = new Raycaster();
    ray.params.Line.threshold = 0.012 * this.bounds.radius;
    ray.setFromCamera(new Vector2((2 * (x - box.left)) / box.width - 1, 1 - (2 * (y - box.top)) / box.height), this.camera);
    const plane = this.renderer?.clippingPlanes[0];
    const hits = ray.intersectObjects([...this.groups.values(), ...(this.drawn ? [this.drawn.group] : []), ...this.forceLines.map(({ line }) => line)], true).filter(({ object, point }) => object.userData["part"] && (!plane || plane.distanceToPoint(point) >= 0));
    // What is drawn over everything is chosen before everything.
    const above = hits.find(({ object }) => object.userData["over"]);
    if (above) return above.object.userData["part"] as string;
    // Half-spaces lie behind everything; films and joints are small and win over the body around them.
    const nearest = hits[0];
    if (!nearest) return null;
    const small = hits.find(({ object, distance }) => !/^\/bodies\/[^/]+$/.test(String(object.userData["part"])) && distance < nearest.distance + 0.04 * this.bounds.radius);
    return (small ?? nearest).object.userData["part"] as string;
  }

  private meshes(): Mesh[] {
    const found: Mesh[] = [];
    for (const group of [...this.groups.values(), ...(this.drawn ? [this.drawn.group] : [])]) group.traverse((object: Object3D) => object instanceof Mesh && found.push(object));
    return found;
  }

  /** What `add` puts into the scene belongs to a part. */
  private named(part: string, group: () => Object3D | undefined, add: () => void): void {
    const before = group()?.children.length ?? 0;
    add();
    for (const object of (group()?.children ?? []).slice(before)) object.traverse((o) => (o.userData["part"] = part));
  }

  protected override build(): void {
    super.build();
    this.drawMarks();
    this.clip();
    this.light();
  }

  protected override addBody(name: string, colour: string): void {
    super.addBody(name, colour);
    const group = this.groups.get(name);
    group?.traverse((o) => (o.userData["part"] = `/bodies/${name}`));
    if (this.framesShown && group) group.add(new AxesHelper(0.15 * this.bounds.radius));
  }

  private drawMarks(): void {
    // Not before the new ones are drawn, as with meshes.
    const old = this.drawn;
    if (old) setTimeout(() => old.dispose());
    this.drawn = new MachineMarks(this.groups, this.bounds.radius);
    if (this.loadsShown && !this.marks.plain) {
      this.drawn.addLoads(this.marks.loads);
      const down = this.geometry.gravity();
      if (down.lengthSq() > 0) {
        const up = this.geometry.up();
        const side = new Vector3().crossVectors(up, this.normalOfMotion()).normalize();
        this.drawn.addGravity(down.normalize(), this.bounds.center.clone().addScaledVector(side, -0.8 * this.bounds.radius).addScaledVector(up, 0.6 * this.bounds.radius));
      }
      this.legend.append(...this.marks.loads.filter(({ body }) => body !== undefined).map((load) => h("span", { class: "chip load" }, `${load.torque ? "↻" : "→"} ${wordsOf(load)}`)));
    }
    if (this.framesShown) this.drawn.addFrames(this.marks.frames);
    for (const { link, line } of this.forceLines) {
      line.visible = this.loadsShown;
      line.userData["part"] = `/forces/${link.name}`;
    }
    this.scene.add(this.drawn.group);
  }


  protected override addJoint(joint: Link, size: number, colour: string): void {
    this.named(`/joints/${joint.name}`, () => this.groups.get(joint.inboard), () => {
      super.addJoint(joint, size, colour);
      const axis = MachineMarks.axis(joint.kind, joint.inboardPlace, joint.axis, this.bounds.radius);
      if (axis) this.groups.get(joint.inboard)?.add(axis);
    });
  }

  protected override addBearing(bearing: Link, colour: string): void {
    this.named(`/bearings/${bearing.name}`, () => this.groups.get(bearing.inboard), () => super.addBearing(bearing, colour));
  }

  /** A pane may be higher than wide, one instant shows less than a whole motion, and arrows reach out: a step back. */
  protected override lookFromStart(): void {
    super.lookFromStart();
    const { target } = this.controls!;
    this.camera.position.sub(target).multiplyScalar((this.marks.loads.some(({ at, direction }) => at && direction) ? 1.3 : 1.12) / Math.min(1, this.camera.aspect)).add(target);
    this.controls!.update();
    this.render();
  }

  protected override place(): void {
    this.together(() => this.placeAll());
  }

  private placeAll(): void {
    super.place();
    for (const [name, pose] of this.poses ?? []) this.groups.get(name)?.matrix.copy(pose);
    const end = (body: string, place: Vector3) => place.clone().applyMatrix4(this.groups.get(body)?.matrix ?? new Matrix4());
    const springs = new Set(this.marks.loads.flatMap(({ name, kind }) => (kind === "spring_damper" || kind === "bushing" ? [name] : [])));
    for (const { link, line } of this.forceLines) {
      const [from, to] = [end(link.inboard, link.inboardPlace), end(link.outboard, link.outboardPlace)];
      redraw(line as Line, springs.has(link.name) ? coil(from, to, 0.03 * this.bounds.radius) : [from, to]);
    }
    this.drawn?.place();
    this.render();
  }

  protected override render(): void {
    this.drawn?.scale(this.holder.clientHeight, this.camera.fov);
    super.render();
  }

  /** The chosen part glows; where it is not drawn by itself, such as a shape, the body around it. */
  private light(): void {
    const drawn = new Set(this.meshes().map((mesh) => mesh.userData["part"]));
    const owner = this.chosen?.split("/").slice(0, 3).join("/");
    const lit = this.chosen !== null && !drawn.has(this.chosen) ? owner : this.chosen;
    for (const group of [...this.groups.values(), ...(this.drawn ? [this.drawn.group] : [])])
      group.traverse((object: Object3D) => {
        if (!(object instanceof Mesh)) return;
        const own = ownPaint(object);
        const on = lit !== null && object.userData["part"] === lit;
        object.userData["paint"] = own;
        object.material = !on ? own : Array.isArray(own) ? own.map(glowing) : glowing(own);
      });
  }
}

/** What a mesh is painted with while it is not chosen. */
function ownPaint(mesh: Mesh): Material | Material[] {
  return (mesh.userData["paint"] as Material | Material[] | undefined) ?? mesh.material;
}

const glow = new WeakMap<Material, Material>();

/** As a chosen part is painted; the same where it cannot glow. */
function glowing(own: Material): Material {
  if (!("emissive" in own)) return own;
  let paint = glow.get(own) as MeshStandardMaterial | undefined;
  if (!paint) {
    paint = (own as MeshStandardMaterial).clone();
    paint.color.set("#e08a00");
    paint.emissive.set("#c87400");
    paint.emissiveIntensity = 0.35;
    glow.set(own, paint);
  }
  return paint;
}
