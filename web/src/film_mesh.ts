// The film of a bearing where it is in the machine, its pressure as colour.

import { BufferAttribute, BufferGeometry, DoubleSide, Matrix4, Mesh, MeshBasicMaterial, SRGBColorSpace, Color, Vector3, type Material } from "three";
import { colour } from "./colormap";
import { nearest, type FilmFields } from "./film_fields";
import type { Size, Surface } from "./surface";

/** The frame that places of a film are given in, in the axes of the body that has it. */
export interface Frame {
  centre: Vector3;
  axis: Vector3;
  /** The direction of x. */
  start: Vector3;
}

export class FilmMesh {
  readonly mesh: Mesh;
  /** The largest pressure of the run [Pa]: the brightest colour. */
  readonly largest: number;
  private readonly colours: BufferAttribute;
  private instant = -1;

  constructor(
    private readonly fields: FilmFields,
    frame: Frame,
    size: Size,
  ) {
    const { along, across, surface } = fields;
    this.largest = fields.range("pressure")[1];
    const places = Array.from({ length: along.cells + 1 }, (_, i) => along.place(i));
    const geometry = patch(surface, places, across.nodes, size, (cell) => along.isFilm(cell));
    this.colours = new BufferAttribute(new Float32Array(3 * places.length * across.nodes.length), 3);
    geometry.setAttribute("color", this.colours);
    // A body's face in the plane of a flat film does not hide it in patches.
    const flat = along.coordinate.period === undefined ? { polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2 } : {};
    this.mesh = new Mesh(geometry, new MeshBasicMaterial({ vertexColors: true, side: DoubleSide, ...flat }));
    this.mesh.applyMatrix4(pose(frame));
    this.show(0);
  }

  /** Shows the film at a time [s]. */
  show(time: number): void {
    const instant = nearest(this.fields.time, time);
    if (instant === this.instant) return;
    this.instant = instant;
    const pressure = this.fields.at("pressure", instant)!;
    const { along, across } = this.fields;
    const n = across.nodes.length;
    const paint = new Color();
    for (let i = 0; i <= along.cells; i++)
      for (let j = 0; j < n; j++) {
        const share = this.largest > 0 ? pressure[along.node(i) * n + j]! / this.largest : 0;
        const [r, g, b] = colour(share);
        paint.setRGB(r / 255, g / 255, b / 255, SRGBColorSpace);
        this.colours.setXYZ(i * n + j, paint.r, paint.g, paint.b);
      }
    this.colours.needsUpdate = true;
  }
}

/** The face of a pad whose film is not shown. */
export function faceMesh(surface: Surface, frame: Frame, size: Size, paint: Material): Mesh {
  const geometry = patch(surface, [-0.5 * size.length, 0.5 * size.length], [-0.5 * size.width, 0.5 * size.width], size);
  geometry.computeVertexNormals();
  const mesh = new Mesh(geometry, paint);
  mesh.applyMatrix4(pose(frame));
  return mesh;
}

/** In the body's axes. */
export function pose({ centre, axis, start }: Frame): Matrix4 {
  return new Matrix4().makeBasis(start, new Vector3().crossVectors(axis, start), axis).setPosition(centre);
}

function patch(surface: Surface, along: ArrayLike<number>, across: ArrayLike<number>, size: Size, isShown: (cell: number) => boolean = () => true): BufferGeometry {
  const places = Array.from(along).flatMap((x) => Array.from(across).flatMap((y) => surface.point(x, y, size)));
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(new Float32Array(places), 3));
  geometry.setIndex(triangles(along.length, across.length, isShown));
  return geometry;
}

function triangles(along: number, across: number, isShown: (cell: number) => boolean): number[] {
  const list: number[] = [];
  for (let i = 0; i + 1 < along; i++)
    for (let j = 0; isShown(i) && j + 1 < across; j++) {
      const [a, b] = [i * across + j, (i + 1) * across + j];
      list.push(a, b, b + 1, a, b + 1, a + 1);
    }
  return list;
}
