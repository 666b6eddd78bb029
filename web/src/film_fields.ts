// The fields of one bearing's film at its stored instants, on its surface.

import type { Dataset, Numbers, Run } from "./data";
import { capital } from "./summary_table";
import { FilmAxis, surfaceOf, type Coordinate, type Surface } from "./surface";
import { displayOf, megapascal, micrometre, percent, type Display } from "./units";

export interface FieldKind {
  key: string;
  label: string;
  display: Display;
}

/** Fields with units of their own, in the order in which they are shown; others follow as their file describes them. */
const fieldKinds = ({ held, moving }: Surface): FieldKind[] => [
  { key: "pressure", label: "Film pressure", display: megapascal },
  { key: "thickness", label: "Film thickness", display: micrometre },
  { key: "fill", label: "Fill fraction", display: percent },
  { key: "asperity_pressure", label: "Asperity pressure", display: megapascal },
  { key: "fixed_wear", label: "Depth worn off the fixed surface", display: micrometre },
  { key: "moving_wear", label: "Depth worn off the moving surface", display: micrometre },
  { key: "roughness", label: "Roughness of the asperities", display: micrometre },
  { key: "shell_displacement", label: `${capital(held)} displacement`, display: micrometre },
  { key: "journal_displacement", label: `${capital(moving)} displacement`, display: micrometre },
];

/** The nodes of a bearing's film; null where the file tells none. */
function nodesOf(run: Run, bearing: string): { surface: Surface; along: FilmAxis; across: FilmAxis } | null {
  const surface = surfaceOf(run, bearing);
  const values = (key: string) => run.dataset(`/bearings/${bearing}/fields/${key}`)?.values;
  const axis = (coordinate: Coordinate, arcs?: Numbers) => {
    const nodes = values(coordinate.key);
    return nodes && nodes.length > 1 ? new FilmAxis(coordinate, nodes, arcs) : null;
  };
  const [along, across] = [axis(surface.along, values("arc")), axis(surface.across)];
  return along && across ? { surface, along, across } : null;
}

export class FilmFields {
  readonly surface: Surface;
  readonly along: FilmAxis;
  readonly across: FilmAxis;

  private constructor(
    readonly time: Numbers,
    nodes: { surface: Surface; along: FilmAxis; across: FilmAxis },
    private readonly fields: Map<string, Dataset>,
  ) {
    this.surface = nodes.surface;
    this.along = nodes.along;
    this.across = nodes.across;
  }

  static of(run: Run, bearing: string): FilmFields | null {
    const path = (name: string) => `/bearings/${bearing}/fields/${name}`;
    const time = run.dataset(path("time"))?.values;
    const nodes = nodesOf(run, bearing);
    if (!time || !nodes) return null;
    const fields = new Map<string, Dataset>();
    for (const key of run.namesAfter(path(""))) {
      const dataset = run.dataset(path(key));
      if (dataset && dataset.width === nodes.along.nodes.length * nodes.across.nodes.length) fields.set(key, dataset);
    }
    return fields.size > 0 ? new FilmFields(time, nodes, fields) : null;
  }

  /** Other fields of one instant on the nodes of a bearing's film. */
  static with(run: Run, bearing: string, fields: Map<string, Dataset>): FilmFields | null {
    const nodes = nodesOf(run, bearing);
    const fit = nodes && [...fields.values()].every(({ width }) => width === nodes.along.nodes.length * nodes.across.nodes.length);
    return fit ? new FilmFields(Float64Array.of(0), nodes, fields) : null;
  }

  /** The kinds of field stored, without an asperity pressure that is zero throughout. */
  kinds(): FieldKind[] {
    const all = fieldKinds(this.surface);
    const known = all.filter(({ key }) => {
      const dataset = this.fields.get(key);
      return dataset !== undefined && (key !== "asperity_pressure" || dataset.values.some((v) => v > 0));
    });
    const others = [...this.fields].filter(([key]) => !all.some((kind) => kind.key === key));
    return [...known, ...others.map(([key, { description, unit }]) => ({ key, label: description, display: displayOf(unit) }))];
  }

  get instants(): number {
    return this.time.length;
  }

  /** The field at one instant, index i n + j for node i along and j of n across. */
  at(key: string, instant: number): Numbers | null {
    const dataset = this.fields.get(key);
    if (!dataset) return null;
    return dataset.values.subarray(instant * dataset.width, (instant + 1) * dataset.width);
  }

  range(key: string): [number, number] {
    return extent(this.fields.get(key)?.values ?? []);
  }

  /** The field along the middle of its rows, between two rows if none lies there; once more at the end where the film closes. */
  midplane(key: string, instant: number, factor = 1): number[] | null {
    const field = this.at(key, instant);
    if (!field) return null;
    const z = this.across.nodes;
    const nz = z.length;
    let below = 0;
    const middle = 0.5 * (z[0]! + z[nz - 1]!);
    while (below < nz - 2 && z[below + 1]! <= middle + 1e-12) below++;
    const [low, high] = [z[below]!, z[below + 1] ?? z[below]!];
    const t = high > low ? Math.min(1, Math.max(0, (middle - low) / (high - low))) : 0;
    const row = Float64Array.from(this.along.nodes, (_, i) => {
      const at = i * nz + below;
      return t === 0 ? field[at]! : (1 - t) * field[at]! + t * field[at + 1]!;
    });
    return this.along.closed(row, factor);
  }
}

export function extent(values: ArrayLike<number>): [number, number] {
  let low = Infinity;
  let high = -Infinity;
  for (let i = 0; i < values.length; i++) {
    const v = values[i]!;
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return low <= high ? [low, high] : [0, 1];
}

/** The index of the value nearest to x; values ascend. */
export function nearest(values: ArrayLike<number>, x: number): number {
  let low = 0;
  let high = values.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (values[middle]! <= x) low = middle;
    else high = middle;
  }
  return Math.abs(values[high]! - x) < Math.abs(values[low]! - x) ? high : low;
}
