// Curves of whatever the results file holds of a thing and no figure of its own shows: a quantity that the program
// learns to write down appears in the report without a line of it being changed.

import type { Run, SeriesText } from "./data";
import type { Curve, LineFigure } from "./line_plot";
import { curve } from "./series";
import { spaced } from "./key_figures";
import { capital } from "./summary_table";
import { displayOf, type Display } from "./units";

/** A figure of one vector, or of numbers of one unit whose names begin alike. */
export interface FurtherFigure {
  name: string;
  caption: string;
  left: LineFigure["left"];
  curves: Curve[];
}

/** Rows of more numbers are maps and shapes, which curves do not show. */
const widest = 6;

const axes: Record<number, string[]> = { 2: ["x", "y"], 3: ["x", "y", "z"], 4: ["w", "x", "y", "z"] };

/**
 * @param shown  names of those that have figures of their own
 * @param length  how the length of a name is shown; as `displayOf` says where it is not given
 */
export function furtherFigures(run: Run, group: string, shown: ReadonlySet<string>, length?: (name: string) => Display): FurtherFigure[] {
  const display = ({ name, unit }: SeriesText) => (unit === "m" && length ? length(name) : displayOf(unit));
  const families = new Map<string, SeriesText[]>();
  for (const series of run.growingIn(group)) {
    if (shown.has(series.name) || series.width > widest || !run.dataset(`${group}/${series.name}`)) continue;
    const family = series.width > 1 ? series.name : `${series.name.split("_")[0]} ${display(series).unit}`;
    families.set(family, [...(families.get(family) ?? []), series]);
  }
  return [...families.values()].map((family) => figureOf(run, group, family, display(family[0]!)));
}

function figureOf(run: Run, group: string, family: SeriesText[], display: Display): FurtherFigure {
  const { name, width } = family[0]!;
  const columns = run.dataset(`${group}/${name}`)?.columns ?? [];
  const labels = columns.length > 0 ? columns : (axes[width] ?? []);
  const curves =
    width > 1
      ? Array.from({ length: width }, (_, column) => curve(run, `${group}/${name}`, labels[column] ?? `${column + 1}`, display, { column })).flat()
      : family.flatMap((one) => curve(run, `${group}/${one.name}`, spaced(one.name), display));
  const caption = family.map((one) => `${capital(spaced(one.name))}: ${one.description}.`).join(" ");
  return { name, caption, left: { label: family.length > 1 ? name.split("_")[0]! : spaced(name), unit: display.unit }, curves };
}
