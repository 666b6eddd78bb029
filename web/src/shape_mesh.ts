// Meshes of shapes, joints and bars.

import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  CapsuleGeometry,
  CylinderGeometry,
  DoubleSide,
  Matrix4,
  Mesh,
  MeshStandardMaterial,
  PlaneGeometry,
  Quaternion,
  SphereGeometry,
  Vector3,
  type Material,
} from "three";
import type { Numbers } from "./data";
import { digest, kept } from "./kept_geometry";
import type { ShapeData } from "./shape_data";

const up = new Vector3(0, 1, 0);

const paints = new Map<string, Material>();

/** Of all meshes of a colour: nobody may change it. Each material costs the graphics card a set-up. */
export function material(colour: string, opacity = 1): Material {
  const name = `${colour} ${opacity}`;
  const known = paints.get(name);
  if (known) return known;
  const paint = painted(colour, opacity);
  paint.userData["kept"] = true;
  paints.set(name, paint);
  return paint;
}

function painted(colour: string, opacity: number): Material {
  return new MeshStandardMaterial({ color: colour, roughness: 0.55, metalness: 0.1, side: DoubleSide, transparent: opacity < 1, opacity, depthWrite: opacity === 1 });
}

const rounded = (length: number) => length.toPrecision(9);

/** A scale of nothing would leave no normals. */
const positive = (length: number) => Math.max(length, 1e-12);

/** Triangles that are each flat. */
function facets(corners: Numbers, triangles: Numbers): BufferGeometry {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(corners), 3));
  geometry.setIndex(Array.from(triangles));
  const flat = geometry.toNonIndexed();
  flat.computeVertexNormals();
  flat.computeBoundingBox();
  return flat;
}

/** three.js lays cylinders and capsules along y around their middle. */
function between(geometry: BufferGeometry, from: Vector3, to: Vector3, paint: Material): Mesh {
  const mesh = new Mesh(geometry, paint);
  const along = to.clone().sub(from);
  mesh.position.copy(from).addScaledVector(along, 0.5);
  mesh.quaternion.setFromUnitVectors(up, along.normalize());
  return mesh;
}

export function bar(from: Vector3, to: Vector3, radius: number, paint: Material): Mesh {
  const length = from.distanceTo(to);
  return between(kept(`capsule ${rounded(radius)} ${rounded(length)}`, () => new CapsuleGeometry(radius, length, 6, 16)), from, to, paint);
}

export function rod(from: Vector3, to: Vector3, radius: number, paint: Material, open = false): Mesh {
  const mesh = between(kept(open ? "pipe" : "cylinder", () => new CylinderGeometry(1, 1, 1, 48, 1, open)), from, to, paint);
  mesh.scale.set(positive(radius), positive(from.distanceTo(to)), positive(radius));
  return mesh;
}

export function ball(centre: Vector3, radius: number, paint: Material): Mesh {
  const mesh = new Mesh(kept("sphere", () => new SphereGeometry(1, 32, 20)), paint);
  mesh.scale.setScalar(positive(radius));
  mesh.position.copy(centre);
  return mesh;
}

/** @param extent  half the size of the machine: what is drawn of a half-space. */
export function shapeMesh(shape: ShapeData, paint: Material, extent: number): Mesh | null {
  switch (shape.kind) {
    case "sphere":
      return ball(shape.point("centre"), shape.number("radius"), paint);
    case "cylinder":
      return rod(shape.point("from"), shape.point("to"), shape.number("radius"), paint);
    case "capsule":
      return bar(shape.point("from"), shape.point("to"), shape.number("radius"), paint);
    case "box": {
      const size = shape.point("size");
      const mesh = new Mesh(kept("box", () => new BoxGeometry(1, 1, 1)), paint);
      mesh.scale.set(positive(size.x), positive(size.y), positive(size.z));
      const r = Array.from(shape.list("rotation"));
      if (r.length === 9) mesh.quaternion.setFromRotationMatrix(new Matrix4().set(r[0]!, r[1]!, r[2]!, 0, r[3]!, r[4]!, r[5]!, 0, r[6]!, r[7]!, r[8]!, 0, 0, 0, 0, 1));
      mesh.position.copy(shape.point("centre"));
      return mesh;
    }
    case "half_space": {
      const mesh = new Mesh(kept("plane", () => new PlaneGeometry(3, 3)), paint);
      mesh.scale.setScalar(positive(extent));
      mesh.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), shape.point("normal")));
      mesh.position.copy(shape.point("point"));
      return mesh;
    }
    case "mesh": {
      const [corners, triangles] = [shape.list("corners"), shape.list("triangles")];
      return new Mesh(kept(`mesh ${digest(corners)} ${digest(triangles)}`, () => facets(corners, triangles)), paint);
    }
    default:
      return null;
  }
}
