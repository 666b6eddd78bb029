// What the machine looks like, from the results: shapes of bodies, places of joints and bearings, motion of the bodies.

import { Matrix4, Quaternion, Vector3 } from "three";
import type { Numbers, Run } from "./data";
import { Deformation } from "./deformed_mesh";
import { FilmFields } from "./film_fields";
import type { Frame } from "./film_mesh";
import type { ShapeData } from "./shape_data";
import { surfaceOf, type Size, type Surface } from "./surface";

export interface BodyMotion {
  name: string;
  position: Numbers;
  orientation: Numbers;
}

/** Two bodies and the place in each where something connects them; the axis is one of the inboard body. */
export interface Link {
  name: string;
  kind: string;
  inboard: string;
  outboard: string;
  inboardPlace: Vector3;
  outboardPlace: Vector3;
  axis: Vector3;
  /** Where bearing angles begin, in the inboard body; zero where the file does not tell. */
  start: Vector3;
}

export class MachineGeometry {
  readonly time: Numbers;
  readonly bodies: BodyMotion[];
  readonly joints: Link[];
  readonly bearings: Link[];
  readonly forces: Link[];
  /** Ends of links by body. */
  private places: Map<string, Vector3[]> | null = null;

  /** Of a run that may hold less than a picture needs: see `of`. */
  constructor(private readonly run: Run) {
    this.time = run.column("/time") ?? new Float64Array();
    this.bodies = run.children("/bodies").flatMap((name) => {
      const position = run.dataset(`/bodies/${name}/position`)?.values;
      const orientation = run.dataset(`/bodies/${name}/orientation`)?.values;
      return position && orientation ? [{ name, position, orientation }] : [];
    });
    this.joints = this.links("/joints", (name) => run.attribute(`/joints/${name}`, "type"));
    this.bearings = this.links("/bearings", () => "bearing");
    this.forces = this.links("/forces", () => "force");
  }

  /** Nothing where the results hold no motion of bodies or were written without their geometry. */
  static of(run: Run): MachineGeometry | null {
    const geometry = new MachineGeometry(run);
    const parts = geometry.joints.length + geometry.forces.length + run.namesAfter("/bodies/").filter((name) => name.endsWith("/amplitudes")).length;
    return geometry.bodies.length > 0 && parts > 0 && geometry.time.length > 0 ? geometry : null;
  }

  /** Up is against gravity; y without gravity. */
  up(): Vector3 {
    const g = this.gravity();
    return g.lengthSq() > 0 ? g.normalize().negate() : new Vector3(0, 1, 0);
  }

  gravity(): Vector3 {
    return vector(this.run.dataset("/ground/gravity")?.values);
  }

  centreOfMass(body: string): Vector3 {
    return vector(this.run.dataset(`/bodies/${body}/centre_of_mass`)?.values);
  }

  bearingSize(name: string): Size {
    const number = (key: string) => this.run.number(`/bearings/${name}`, key) ?? 0;
    return { radius: number("radius"), length: number("length"), width: number("width") };
  }

  surface(name: string): Surface {
    return surfaceOf(this.run, name);
  }

  /** The pads that a body has, with their frames. */
  pads(body: string): { surface: Surface; frame: Frame; size: Size }[] {
    return this.bearings.flatMap((link) => {
      const size = this.bearingSize(link.name);
      const frame = frameOf(link);
      return link.inboard === body && size.length > 0 && frame ? [{ surface: this.surface(link.name), frame, size }] : [];
    });
  }

  /** The pressures in a bearing's film, where they are stored. */
  film(name: string): FilmFields | null {
    const fields = FilmFields.of(this.run, name);
    return fields?.at("pressure", 0) ? fields : null;
  }

  shapes(body: string): ShapeData[] {
    const group = body === "ground" ? "/ground/shapes" : `/bodies/${body}/shapes`;
    return this.run.children(group).map((name) => {
      const values = (part: string) => this.run.dataset(`${group}/${name}/${part}`)?.values ?? new Float64Array();
      return {
        name,
        kind: this.run.attribute(`${group}/${name}`, "shape"),
        point: (part) => vector(values(part)),
        number: (part) => values(part)[0] ?? 0,
        list: values,
        heldAtBothEnds: this.run.number(`${group}/${name}`, "held_at_both_ends") === 1,
      };
    });
  }

  /** Places where joints, bearings and forces hold a body. */
  attachments(body: string): Vector3[] {
    this.places ??= this.placesOfLinks();
    return this.places.get(body) ?? [];
  }

  private placesOfLinks(): Map<string, Vector3[]> {
    const places = new Map<string, Vector3[]>();
    const add = (body: string, place: Vector3) => {
      const known = places.get(body);
      if (known) known.push(place);
      else places.set(body, [place]);
    };
    for (const link of [...this.joints, ...this.bearings, ...this.forces]) {
      add(link.inboard, link.inboardPlace);
      add(link.outboard, link.outboardPlace);
    }
    return places;
  }

  /** How the skin of a flexible body moves; nothing of a rigid one. */
  deformation(body: string, skin: ShapeData): Deformation | null {
    return Deformation.of(this.run, body, skin);
  }

  /** The stored instants around a time, and how far it is from the first to the second. */
  around(time: number): { low: number; high: number; share: number } {
    const last = this.time.length - 1;
    let low = 0;
    let high = last;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.time[middle]! <= time) low = middle;
      else high = middle;
    }
    const span = this.time[high]! - this.time[low]!;
    return { low, high, share: span > 0 ? Math.min(1, Math.max(0, (time - this.time[low]!) / span)) : 0 };
  }

  /** Pose of a body at a time, between the stored instants. */
  pose(body: BodyMotion, time: number, into: Matrix4): Matrix4 {
    const { low, high, share } = this.around(time);
    const at = (k: number) => new Vector3().fromArray(body.position, 3 * k);
    // Stored w first, three.js has it last.
    const turned = (k: number) => {
      const [w, x, y, z] = [0, 1, 2, 3].map((i) => body.orientation[4 * k + i]!);
      return new Quaternion(x, y, z, w);
    };
    return into.compose(at(low).lerp(at(high), share), turned(low).slerp(turned(high), share), new Vector3(1, 1, 1));
  }

  private links(group: string, kind: (name: string) => string): Link[] {
    return this.run.children(group).flatMap((name) => {
      const path = `${group}/${name}`;
      const [inboard, outboard] = [this.run.attribute(path, "inboard"), this.run.attribute(path, "outboard")];
      if (!inboard || !outboard) return [];
      const place = (part: string) => vector(this.run.dataset(`${path}/${part}`)?.values);
      return [{ name, kind: kind(name), inboard, outboard, inboardPlace: place("inboard_origin"), outboardPlace: place("outboard_origin"), axis: place("axis"), start: place("x_axis") }];
    });
  }
}

/** Of a bearing; nothing where the file does not tell. */
export function frameOf({ inboardPlace, axis, start }: Link): Frame | null {
  if (axis.lengthSq() === 0 || start.lengthSq() === 0) return null;
  return { centre: inboardPlace, axis: axis.clone().normalize(), start: start.clone().normalize() };
}

function vector(values: ArrayLike<number> | undefined): Vector3 {
  return new Vector3(values?.[0] ?? 0, values?.[1] ?? 0, values?.[2] ?? 0);
}
