// Marks over the picture of a machine: forces and torques as arrows with their names, springs, axes of joints, frames, gravity.

import { AxesHelper, BufferGeometry, CanvasTexture, Color, ConeGeometry, Group, Line, LineDashedMaterial, Mesh, MeshStandardMaterial, Quaternion, Sprite, SpriteMaterial, SRGBColorSpace, TorusGeometry, Vector3, type Material, type Object3D } from "three";
import { rod } from "../src/shape_mesh";
import { palette } from "../src/theme";
import { format } from "../src/units";
import { texts } from "./texts";

/** A force of the model; see scene_parts.h. */
export interface Load {
  name: string;
  kind: string;
  body?: string;
  at?: [number, number, number];
  torque?: boolean;
  axes?: "ground" | "body";
  direction?: [number, number, number];
  value?: number;
  unit?: string;
  when?: "always" | "start" | "largest";
  from?: string;
  to?: string;
  joint?: string;
  coordinate?: string;
}

export interface NamedFrame {
  name: string;
  position: [number, number, number];
  /** w, x, y, z */
  orientation: [number, number, number, number];
}

/** What the text says besides what a run records. */
export interface Marks {
  loads: Load[];
  frames: Record<string, NamedFrame[]>;
  /** A small picture: no arrows and no names. */
  plain?: boolean;
}

/** More names than that would hide the machine. */
const mostLabels = 80;
const labelHeight = 17; // [px]

/** "gas, 12 kN at most". */
export function wordsOf(load: Load): string {
  if (load.value === undefined || load.unit === undefined) return load.name;
  const scales: Record<string, [number, string][]> = { N: [[1e3, "kN"], [1, "N"]], "N m": [[1e3, "kN m"], [1, "N m"]], Pa: [[1e6, "MPa"], [1e3, "kPa"], [1, "Pa"]] };
  const [factor, unit] = (scales[load.unit] ?? [[1, load.unit] as [number, string]]).find(([f]) => load.value! >= f) ?? [1, load.unit];
  return `${load.name}, ${format(load.value / factor, 3)} ${unit}${load.when === "start" ? ` ${texts.atStart}` : load.when === "largest" ? ` ${texts.atMost}` : ""}`;
}

/** Seen through all bodies. */
function paintOver(colour: string): Material {
  return new MeshStandardMaterial({ color: colour, roughness: 0.6, depthTest: false, transparent: true });
}

function over(object: Object3D, part: string): void {
  object.traverse((o) => {
    o.userData["part"] = part;
    o.userData["over"] = true;
    o.renderOrder = 10;
  });
}

const alongZ = new Vector3(0, 0, 1);
const alongY = new Vector3(0, 1, 0);

/** From outside onto the origin, along `direction`. */
function arrow(direction: Vector3, length: number, colour: string): Group {
  const group = new Group();
  const paint = paintOver(colour);
  const tip = 0.28 * length;
  const neck = direction.clone().multiplyScalar(-tip);
  group.add(rod(direction.clone().multiplyScalar(-length), neck, 0.035 * length, paint));
  const cone = new Mesh(new ConeGeometry(0.1 * length, tip, 20), paint);
  cone.quaternion.setFromUnitVectors(alongY, direction);
  cone.position.copy(neck).multiplyScalar(0.5);
  group.add(cone);
  return group;
}

/** Around `axis`, right-handed. */
function turnArrow(axis: Vector3, radius: number, colour: string): Group {
  const group = new Group();
  const paint = paintOver(colour);
  const angle = 1.5 * Math.PI;
  group.add(new Mesh(new TorusGeometry(radius, 0.06 * radius, 10, 48, angle), paint));
  const cone = new Mesh(new ConeGeometry(0.17 * radius, 0.45 * radius, 20), paint);
  // At the end of three quarters, where the tangent is +x.
  cone.position.set(0.2 * radius, -radius, 0);
  cone.quaternion.setFromUnitVectors(alongY, new Vector3(1, 0, 0));
  group.add(cone);
  group.quaternion.setFromUnitVectors(alongZ, axis);
  return group;
}

/** Letters that have been drawn: a text changes more often than they do. */
const drawnLabels = new Map<string, { map: CanvasTexture; aspect: number }>();

function letters(words: string, colour: string): { map: CanvasTexture; aspect: number } {
  const key = `${colour} ${palette().paper} ${words}`;
  const known = drawnLabels.get(key);
  if (known) return known;
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d")!;
  const font = "600 26px system-ui, sans-serif";
  context.font = font;
  [canvas.width, canvas.height] = [Math.ceil(context.measureText(words).width) + 12, 36];
  context.font = font;
  context.lineWidth = 6;
  context.lineJoin = "round";
  context.strokeStyle = palette().paper;
  context.fillStyle = colour;
  context.strokeText(words, 6, 27);
  context.fillText(words, 6, 27);
  if (drawnLabels.size > 4 * mostLabels) {
    for (const { map } of drawnLabels.values()) map.dispose();
    drawnLabels.clear();
  }
  const texture = new CanvasTexture(canvas);
  texture.colorSpace = SRGBColorSpace;
  const made = { map: texture, aspect: canvas.width / canvas.height };
  drawnLabels.set(key, made);
  return made;
}

function label(words: string, colour: string): Sprite {
  const { map, aspect } = letters(words, colour);
  const sprite = new Sprite(new SpriteMaterial({ map, depthTest: false, sizeAttenuation: false }));
  sprite.userData["aspect"] = aspect;
  sprite.center.set(0.5, -0.15);
  sprite.renderOrder = 11;
  return sprite;
}

/** Points of a coil drawn flat between two places. */
export function coil(from: Vector3, to: Vector3, width: number): Vector3[] {
  const along = to.clone().sub(from);
  const across = new Vector3().crossVectors(along, Math.abs(along.z) > 0.9 * along.length() ? new Vector3(1, 0, 0) : alongZ).normalize().multiplyScalar(width);
  const turns = 7;
  const at = (share: number, side: number) => from.clone().addScaledVector(along, share).addScaledVector(across, side);
  return [from.clone(), at(0.2, 0), ...Array.from({ length: 2 * turns }, (_, i) => at(0.2 + (0.6 * (i + 0.5)) / (2 * turns), i % 2 === 0 ? 1 : -1)), at(0.8, 0), to.clone()];
}

/** The marks of one state of the text, to be added to the groups of their bodies. */
export class MachineMarks {
  /** Arrows whose directions are in ground; their bodies carry their places along. */
  private readonly carried: { object: Object3D; body: string; at: Vector3 }[] = [];
  private readonly labels: Sprite[] = [];
  /** In ground. */
  readonly group = new Group();

  constructor(
    private readonly groups: Map<string, Group>,
    private readonly radius: number,
  ) {}

  /** Of many the values are in the list below the picture. */
  addLoads(loads: Load[]): void {
    const few = 3;
    const isFew = loads.filter(({ at, direction }) => at && direction).length <= few;
    for (const load of loads) this.addLoad(load, isFew ? wordsOf(load) : load.name);
  }

  private addLoad(load: Load, words: string): void {
    if (load.body === undefined || !load.at || !load.direction) return;
    const colour = palette().series[load.torque ? 3 : 1] ?? palette().accent;
    const direction = new Vector3(...load.direction).normalize();
    const length = 0.34 * this.radius;
    const mark = load.torque ? turnArrow(direction, 0.5 * length, colour) : arrow(direction, length, colour);
    const whole = new Group();
    whole.add(mark);
    this.addLabel(whole, load.torque ? new Vector3() : direction.clone().multiplyScalar(-length), words, colour);
    over(whole, `/forces/${load.name}`);
    const at = new Vector3(...load.at);
    if (load.axes === "body" && this.groups.has(load.body)) {
      whole.position.copy(at);
      this.groups.get(load.body)!.add(whole);
    } else {
      this.carried.push({ object: whole, body: load.body, at });
      this.group.add(whole);
    }
  }

  /** A spring, friction or motor on the coordinate of a joint: around its axis, or along it. */
  addOnJoint(load: Load, joint: { inboard: string; inboardPlace: Vector3; axis: Vector3 }): void {
    const group = this.groups.get(joint.inboard);
    if (!group || joint.axis.lengthSq() === 0) return;
    const colour = palette().series[4] ?? palette().accent;
    const axis = joint.axis.clone().normalize();
    const size = 0.14 * this.radius;
    const isTurn = load.coordinate?.startsWith("rotation") ?? false;
    const whole = new Group();
    whole.add(isTurn ? turnArrow(axis, size, colour) : arrow(axis, 2 * size, colour));
    this.addLabel(whole, new Vector3(), load.name, colour);
    whole.position.copy(joint.inboardPlace);
    over(whole, `/forces/${load.name}`);
    group.add(whole);
  }

  private addLabel(to: Object3D, at: Vector3, words: string, colour: string): void {
    if (this.labels.length >= mostLabels) return;
    const sprite = label(words, colour);
    sprite.position.copy(at);
    this.labels.push(sprite);
    to.add(sprite);
  }

  /** @param at  where there is room for it */
  addGravity(direction: Vector3, at: Vector3): void {
    const mark = arrow(direction, 0.3 * this.radius, palette().faint);
    mark.position.copy(at);
    this.addLabel(mark, direction.clone().multiplyScalar(-0.3 * this.radius), "g", palette().faint);
    over(mark, "/gravity");
    this.group.add(mark);
  }

  addFrames(frames: Record<string, NamedFrame[]>): void {
    for (const [body, list] of Object.entries(frames))
      for (const { name, position, orientation: [w, x, y, z] } of list) {
        const axes = new AxesHelper(0.1 * this.radius);
        const whole = new Group();
        whole.position.set(...position);
        whole.quaternion.copy(new Quaternion(x, y, z, w));
        whole.add(axes);
        this.addLabel(whole, new Vector3(), name, palette().ink);
        over(whole, `/bodies/${body}/frames/${name}`);
        (this.groups.get(body) ?? this.group).add(whole);
      }
  }

  /** A dashed line through the place of a joint, with tips where it slides. */
  static axis(kind: string, at: Vector3, axis: Vector3, radius: number): Object3D | null {
    if (axis.lengthSq() === 0 || ["fixed", "free", "spherical"].includes(kind)) return null;
    const colour = palette().ink;
    const half = axis.clone().normalize().multiplyScalar(0.22 * radius);
    const whole = new Group();
    const geometry = new BufferGeometry().setFromPoints([at.clone().sub(half), at.clone().add(half)]);
    const line = new Line(geometry, new LineDashedMaterial({ color: new Color(colour), dashSize: 0.03 * radius, gapSize: 0.015 * radius, transparent: true, opacity: 0.8 }));
    line.computeLineDistances();
    whole.add(line);
    if (kind === "prismatic" || kind === "cylindrical")
      for (const sign of [-1, 1]) {
        const tip = new Mesh(new ConeGeometry(0.016 * radius, 0.05 * radius, 12), new MeshStandardMaterial({ color: colour }));
        tip.quaternion.setFromUnitVectors(alongY, half.clone().normalize().multiplyScalar(sign));
        tip.position.copy(at).addScaledVector(half, sign);
        whole.add(tip);
      }
    return whole;
  }

  /** After the bodies have their places. */
  place(): void {
    for (const { object, body, at } of this.carried) {
      object.position.copy(at);
      const group = this.groups.get(body);
      if (group) object.position.applyMatrix4(group.matrix);
    }
  }

  /** Letters are as high on every screen. @param height  of the picture [px] */
  scale(height: number, fieldOfView: number): void {
    const size = ((2 * labelHeight) / Math.max(100, height)) * Math.tan((0.5 * fieldOfView * Math.PI) / 180);
    for (const sprite of this.labels) sprite.scale.set(size * (sprite.userData["aspect"] as number), size, 1);
  }
}

/** Of a line whose points may become more or fewer. */
class Course extends BufferGeometry {
  override setFromPoints(points: Vector3[]): this {
    this.deleteAttribute("position");
    return super.setFromPoints(points);
  }
}

/** A line through more points than it had, or fewer. */
export function redraw(line: Line, points: Vector3[]): void {
  line.geometry.dispose();
  line.geometry = new Course().setFromPoints(points);
}
