// What the surfaces of one bearing go through in a cycle: maps of extremes and of loads averaged over it.

import type { Dataset, Run } from "./data";
import { figure, h, segmented, tableButton } from "./dom";
import { FieldMap, type Mark } from "./field_map";
import { FilmFields, type FieldKind } from "./film_fields";
import { capital } from "./summary_table";
import { degree, format, megapascal, micrometre, type Display } from "./units";

const wattPerSquareMillimetre: Display = { factor: 1e-6, unit: "W/mm²" };

/** The maps of the last cycle in the file, or of the whole run where the model has no cycle; null without any. */
export function cycleMaps(run: Run, bearing: string): HTMLElement | null {
  const path = (name: string) => `/bearings/${bearing}/cycles/fields/${name}`;
  const last = (name: string) => run.column(path(name))?.at(-1);
  const [begin, end] = [last("begin"), last("end")];
  if (begin === undefined || end === undefined) return null;
  const clock = clockOf(run, begin);
  const all: FieldKind[] = [
    { key: "thickness_min", label: "Smallest film thickness", display: micrometre },
    { key: "thickness_min_time", label: `Thinnest at ${clock.label}`, display: clock.display },
    { key: "pressure_max", label: "Peak film pressure", display: megapascal },
    { key: "pressure_max_time", label: `Peak at ${clock.label}`, display: clock.display },
    { key: "asperity_pressure_mean", label: "Mean contact pressure", display: megapascal },
    { key: "wear_load", label: "Wear load", display: wattPerSquareMillimetre },
  ];
  const fields = new Map<string, Dataset>();
  for (const { key } of all) {
    const dataset = run.dataset(path(key));
    if (dataset) fields.set(key, lastRow(dataset, key.endsWith("_time") ? clock.begin : 0));
  }
  const kinds = all.filter(({ key }) => fields.get(key)?.values.some((value) => value !== 0));
  const film = FilmFields.with(run, bearing, fields);
  if (!film || kinds.length === 0) return null;

  const marks = (["pofp", "moft"] as const).flatMap((name): Mark[] => {
    const [along, across] = [last(`${name}_${film.surface.along.key}`), last(`${name}_${film.surface.across.key}`)];
    return along === undefined || across === undefined ? [] : [{ along, across, symbol: name === "pofp" ? "cross" : "ring" }];
  });
  const map = new FieldMap(film, kinds[0]!);
  map.show(0, marks);
  const choices = kinds.map(({ key, label }) => ({ value: key, label }));
  const controls = h("div", { class: "controls" }, segmented("Map shown", choices, kinds[0]!.key, (key) => map.choose(kinds.find((k) => k.key === key)!)));
  return figure("cycle", caption(film.surface.whole, last("complete") === 1, run.column(path("begin"))!.length, begin, end, kinds), tableButton(`${bearing}-cycle`, () => map.numbers()), controls, map.element);
}

function caption(whole: string, isCycle: boolean, count: number, begin: number, end: number, kinds: FieldKind[]): string {
  const span = `t = ${format(1e3 * begin)} to ${format(1e3 * end)} ms`;
  const over = isCycle ? `the last of ${count === 1 ? "one cycle" : `${count} cycles`}, ${span}` : `the whole run, ${span}`;
  const wear = kinds.some(({ key }) => key === "wear_load") ? " Wear load: contact pressure times sliding speed, averaged." : "";
  return `${capital(whole)} over ${over}. Cross: peak pressure; ring: smallest film thickness.${wear}`;
}

/** How instants within the cycle are shown: by the crank's angle where there is one, else by the time since its beginning. */
function clockOf(run: Run, begin: number): { label: string; begin: number; display: Display } {
  const time = run.column("/time");
  const angle = run.column("/crank_angle");
  const n = time?.length ?? 0;
  if (!time || !angle || n < 2 || time[n - 1]! === time[0]!) return { label: "time", begin, display: { factor: 1e3, unit: "ms" } };
  const speed = (angle[n - 1]! - angle[0]!) / (time[n - 1]! - time[0]!);
  // The crank's own zero, in the turn in which the cycle begins.
  const at = angle[0]! + speed * (begin - time[0]!);
  const turn = 2 * Math.PI * Math.floor(at / (2 * Math.PI) + 1e-6);
  return { label: "crank angle", begin: begin - (at - turn) / speed, display: { factor: degree.factor * speed, unit: "°" } };
}

function lastRow(dataset: Dataset, origin: number): Dataset {
  const values = Float64Array.from(dataset.values.slice(-dataset.width), (value) => value - origin);
  return { ...dataset, values, shape: [1, ...dataset.shape.slice(1)] };
}
