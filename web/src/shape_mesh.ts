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
import type { ShapeData } from "./shape_data";

const up = new Vector3(0, 1, 0);

export function material(colour: string, opacity = 1): Material {
  return new MeshStandardMaterial({ color: colour, roughness: 0.55, metalness: 0.1, side: DoubleSide, transparent: opacity < 1, opacity, depthWrite: opacity === 1 });
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
  return between(new CapsuleGeometry(radius, from.distanceTo(to), 6, 16), from, to, paint);
}

export function rod(from: Vector3, to: Vector3, radius: number, paint: Material, open = false): Mesh {
  return between(new CylinderGeometry(radius, radius, from.distanceTo(to), 48, 1, open), from, to, paint);
}

export function ball(centre: Vector3, radius: number, paint: Material): Mesh {
  const mesh = new Mesh(new SphereGeometry(radius, 32, 20), paint);
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
      const mesh = new Mesh(new BoxGeometry(size.x, size.y, size.z), paint);
      const r = Array.from(shape.list("rotation"));
      if (r.length === 9) mesh.quaternion.setFromRotationMatrix(new Matrix4().set(r[0]!, r[1]!, r[2]!, 0, r[3]!, r[4]!, r[5]!, 0, r[6]!, r[7]!, r[8]!, 0, 0, 0, 0, 1));
      mesh.position.copy(shape.point("centre"));
      return mesh;
    }
    case "half_space": {
      const mesh = new Mesh(new PlaneGeometry(3 * extent, 3 * extent), paint);
      mesh.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), shape.point("normal")));
      mesh.position.copy(shape.point("point"));
      return mesh;
    }
    case "mesh": {
      const geometry = new BufferGeometry();
      geometry.setAttribute("position", new BufferAttribute(Float32Array.from(shape.list("corners")), 3));
      geometry.setIndex(Array.from(shape.list("triangles")));
      const flat = geometry.toNonIndexed();
      flat.computeVertexNormals();
      return new Mesh(flat, paint);
    }
    default:
      return null;
  }
}
