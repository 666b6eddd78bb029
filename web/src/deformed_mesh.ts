// The surface of a flexible body: its corners moved by the body's shapes, coloured by how far.

import { BufferAttribute, BufferGeometry, DoubleSide, Mesh, MeshStandardMaterial, Quaternion, Vector3 } from "three";
import { colour } from "./colormap";
import type { Numbers, Run } from "./data";
import type { ShapeData } from "./shape_data";

/** Writes u, three numbers per corner, for given amplitudes. */
type Mover = (amplitudes: ArrayLike<number>, u: Float32Array) => void;

/** Every corner moves by a sum of shapes. */
function moverByShapes(shapes: Numbers, count: number): Mover {
  return (amplitudes, u) => {
    u.fill(0);
    for (let k = 0; k < count; k++) {
      const a = amplitudes[k]!;
      if (a === 0) continue;
      const from = k * u.length;
      for (let i = 0; i < u.length; i++) u[i]! += a * shapes[from + i]!;
    }
  };
}

/** Numbers per node of a beam: its displacement, and what its x-, y- and z-axis change. */
const perNode = 12;

/** Every corner rides on a node of a beam, so far away. */
function moverByNodes(node: Numbers, offset: Numbers): Mover {
  return (amplitudes, u) => {
    for (let corner = 0; corner < node.length; corner++) {
      const a = perNode * node[corner]!;
      const at = 3 * corner;
      for (let i = 0; i < 3; i++)
        u[at + i] =
          amplitudes[a + i]! + offset[at]! * amplitudes[a + 3 + i]! + offset[at + 1]! * amplitudes[a + 6 + i]! + offset[at + 2]! * amplitudes[a + 9 + i]!;
    }
  };
}

/** How a beam that is held at both ends has turned as a whole, from the line between them; `axis`: that line at rest. */
function chordTurn(axis: Vector3, last: number): (amplitudes: ArrayLike<number>) => Quaternion {
  const rest = axis.clone().normalize();
  return (amplitudes) => {
    const end = new Vector3(...[0, 1, 2].map((i) => amplitudes[perNode * last + i]! - amplitudes[i]!)).add(axis);
    return new Quaternion().setFromUnitVectors(rest, end.normalize());
  };
}

/** Amplitudes of a body over the stored instants, and how they move the corners of its skin. */
export class Deformation {
  /** Largest displacement of any corner over the run [m]. */
  readonly largest: number;

  static of(run: Run, body: string, skin: ShapeData): Deformation | null {
    const amplitudes = run.dataset(`/bodies/${body}/amplitudes`);
    if (!amplitudes) return null;
    const { values, width } = amplitudes;
    const corners = Float32Array.from(skin.list("corners"));
    const [shapes, node] = [skin.list("deformation"), skin.list("node")];
    if (shapes.length > 0) return new Deformation(moverByShapes(shapes, width), corners, values, width);
    if (node.length === 0) return null;
    const offset = skin.list("offset");
    const centre = (corner: number) => new Vector3(...[0, 1, 2].map((i) => corners[3 * corner + i]! - offset[3 * corner + i]!));
    const axis = centre(node.length - 1).sub(centre(0));
    const turn = skin.heldAtBothEnds && axis.lengthSq() > 0 ? chordTurn(axis, node[node.length - 1]!) : null;
    return new Deformation(moverByNodes(node, offset), corners, values, width, turn);
  }

  private constructor(
    /** Displacements of all corners. */
    readonly displacements: Mover,
    /** The corners at rest. */
    readonly rest: Float32Array,
    private readonly amplitudes: Numbers,
    readonly count: number,
    /** What of the motion of all corners is a turn of the whole and no deformation. */
    private readonly turn: ((amplitudes: ArrayLike<number>) => Quaternion) | null = null,
  ) {
    const rows = amplitudes.length / count;
    const step = Math.max(1, Math.floor(rows / 60));
    const u = new Float32Array(rest.length);
    const base = new Float32Array(rest.length);
    let largest = 0;
    for (let row = 0; row < rows; row += step) {
      this.deform(this.at(row, row, 0), base, u);
      largest = Math.max(largest, largestOf(u));
    }
    this.largest = largest;
  }

  /** Writes where the corners would be undeformed, the whole being turned, and their displacements from there. */
  deform(amplitudes: ArrayLike<number>, base: Float32Array, u: Float32Array): void {
    this.displacements(amplitudes, u);
    base.set(this.rest);
    if (!this.turn) return;
    const turn = this.turn(amplitudes);
    const place = new Vector3();
    for (let i = 0; i < base.length; i += 3) {
      place.fromArray(this.rest, i).applyQuaternion(turn).toArray(base, i);
      for (let k = i; k < i + 3; k++) u[k]! += this.rest[k]! - base[k]!;
    }
  }

  /** Amplitudes between two stored instants. */
  at(low: number, high: number, share: number): Float64Array {
    const { amplitudes, count } = this;
    return Float64Array.from({ length: count }, (_, k) => (1 - share) * amplitudes[low * count + k]! + share * amplitudes[high * count + k]!);
  }
}

export class DeformedMesh {
  readonly mesh: Mesh;
  private readonly base: Float32Array;
  private readonly u: Float32Array;
  private readonly position: BufferAttribute;
  private readonly colours: BufferAttribute;

  constructor(
    skin: ShapeData,
    readonly deformation: Deformation,
  ) {
    this.base = deformation.rest.slice();
    this.u = new Float32Array(this.base.length);
    this.position = new BufferAttribute(this.base.slice(), 3);
    this.colours = new BufferAttribute(new Float32Array(this.base.length), 3);
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", this.position);
    geometry.setAttribute("color", this.colours);
    geometry.setIndex(Array.from(skin.list("triangles")));
    this.mesh = new Mesh(geometry, new MeshStandardMaterial({ vertexColors: true, flatShading: true, roughness: 0.6, side: DoubleSide }));
    this.mesh.frustumCulled = false;
  }

  /** @param colourAt  displacement that the brightest colour stands for [m].
   *  @param isMode     amplitudes are increments: there is no turn of the whole to take out of them. */
  show(amplitudes: ArrayLike<number>, enlargement: number, colourAt: number, isMode: boolean): void {
    const { u, base } = this;
    if (isMode) {
      base.set(this.deformation.rest);
      this.deformation.displacements(amplitudes, u);
    } else this.deformation.deform(amplitudes, base, u);
    for (let i = 0; i < u.length; i += 3) {
      const size = Math.hypot(u[i]!, u[i + 1]!, u[i + 2]!);
      const [r, g, b] = colour(colourAt > 0 ? size / colourAt : 0);
      this.position.setXYZ(i / 3, base[i]! + enlargement * u[i]!, base[i + 1]! + enlargement * u[i + 1]!, base[i + 2]! + enlargement * u[i + 2]!);
      this.colours.setXYZ(i / 3, linear(r), linear(g), linear(b));
    }
    this.position.needsUpdate = true;
    this.colours.needsUpdate = true;
  }

  /** Largest displacement for given amplitudes [m]. */
  reach(amplitudes: ArrayLike<number>): number {
    this.deformation.displacements(amplitudes, this.u);
    return largestOf(this.u);
  }
}

/** Vertex colours are linear light, the table is sRGB. */
function linear(byte: number): number {
  return (byte / 255) ** 2.2;
}

function largestOf(u: Float32Array): number {
  let largest = 0;
  for (let i = 0; i < u.length; i += 3) largest = Math.max(largest, Math.hypot(u[i]!, u[i + 1]!, u[i + 2]!));
  return largest;
}

/** 1, 2 or 5 times a power of ten, not above `value`. */
export function roundEnlargement(value: number): number {
  const power = 10 ** Math.floor(Math.log10(value));
  return (value / power >= 5 ? 5 : value / power >= 2 ? 2 : 1) * power;
}
