// Geometries of meshes that are alike, made once: of a machine of a thousand bodies most are, and of a text that changes
// almost all stay.

import type { BufferGeometry } from "three";

const known = new Map<string, BufferGeometry>();
const most = 2000;

/** The geometry of this name, which says all that it depends on. Nobody may change or dispose of it. */
export function kept(name: string, make: () => BufferGeometry): BufferGeometry {
  let geometry = known.get(name);
  if (geometry) known.delete(name); // the one used last stands last
  else {
    geometry = make();
    geometry.userData["kept"] = true;
  }
  known.set(name, geometry);
  if (known.size > most) forget(known.keys().next().value!);
  return geometry;
}

function forget(name: string): void {
  known.get(name)?.dispose(); // made again on the graphics card where it is still drawn
  known.delete(name);
}

export function isKept(geometry: BufferGeometry): boolean {
  return geometry.userData["kept"] === true;
}

/** Tells two lists of numbers apart: FNV-1a of their bits, with their number. */
export function digest(values: ArrayLike<number>): string {
  const bits = new Uint32Array(Float32Array.from(values).buffer);
  let [a, b] = [0x811c9dc5, 0x01000193];
  for (let i = 0; i < bits.length; i++) {
    a = Math.imul(a ^ bits[i]!, 0x01000193);
    b = Math.imul(b ^ (bits[i]! >>> 13) ^ (bits[i]! << 19), 0x85ebca6b) ^ i;
  }
  return `${bits.length} ${a >>> 0} ${b >>> 0}`;
}
