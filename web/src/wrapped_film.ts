// The film of a bearing where it is: wrapped on the bore in the machine, its pressure as colour.

import { BufferAttribute, BufferGeometry, DoubleSide, Matrix4, Mesh, MeshBasicMaterial, SRGBColorSpace, Color, Vector3 } from "three";
import { colour } from "./colormap";
import { nearest, type FilmFields } from "./film_fields";

/** In the axes of the body that has the bore. */
export interface Bore {
  centre: Vector3;
  axis: Vector3;
  /** Where bearing angles begin. */
  start: Vector3;
  radius: number;
}

/** Drawn a little wider than the bore, so that the journal does not touch it. */
const wider = 1.04;

export class WrappedFilm {
  readonly mesh: Mesh;
  /** The largest pressure of the run [Pa]: the brightest colour. */
  readonly largest: number;
  private readonly colours: BufferAttribute;
  private instant = -1;

  constructor(
    private readonly fields: FilmFields,
    bore: Bore,
  ) {
    const [around, along] = [fields.phi.length + 1, fields.z.length];
    this.largest = fields.range("pressure")[1];
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(places(fields, wider * bore.radius), 3));
    this.colours = new BufferAttribute(new Float32Array(3 * around * along), 3);
    geometry.setAttribute("color", this.colours);
    geometry.setIndex(triangles(around, along));
    this.mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide }));
    const across = new Vector3().crossVectors(bore.axis, bore.start);
    this.mesh.applyMatrix4(new Matrix4().makeBasis(bore.start, across, bore.axis).setPosition(bore.centre));
    this.show(0);
  }

  /** Shows the film at a time [s]. */
  show(time: number): void {
    const instant = nearest(this.fields.time, time);
    if (instant === this.instant) return;
    this.instant = instant;
    const pressure = this.fields.at("pressure", instant)!;
    const n = this.fields.phi.length;
    const along = this.fields.z.length;
    const paint = new Color();
    for (let i = 0; i <= n; i++)
      for (let j = 0; j < along; j++) {
        const share = this.largest > 0 ? pressure[(i % n) * along + j]! / this.largest : 0;
        const [r, g, b] = colour(share);
        paint.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace);
        this.colours.setXYZ(i * along + j, paint.r, paint.g, paint.b);
      }
    this.colours.needsUpdate = true;
  }
}

/** Nodes on a cylinder about z, closed after a turn. */
function places(fields: FilmFields, radius: number): Float32Array {
  const n = fields.phi.length;
  const list: number[] = [];
  for (let i = 0; i <= n; i++) for (const z of fields.z) list.push(radius * Math.cos(fields.phi[i % n]!), radius * Math.sin(fields.phi[i % n]!), z);
  return new Float32Array(list);
}

function triangles(around: number, along: number): number[] {
  const list: number[] = [];
  for (let i = 0; i + 1 < around; i++)
    for (let j = 0; j + 1 < along; j++) {
      const [a, b] = [i * along + j, (i + 1) * along + j];
      list.push(a, b, b + 1, a, b + 1, a + 1);
    }
  return list;
}
