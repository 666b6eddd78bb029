// The figures of a study: how parameters and figures go together, which parameter matters, which run is best.

import { parameterColumn, figureColumn, shortName, type Column, type SampledFigure, type StudyText } from "./sampling_data";
import { axes, canvasOf, path, scaleOf, svg, usual, withTitle, type Frame } from "./svg_plot";
import { axisLabel, format, shownUnit, withUnit } from "./units";

/** What is chosen with a click: a run by its place. */
export type Pick = (run: number) => void;

const label = (column: Column) => axisLabel(column.label, shownUnit(column.unit));

/** More points than these make a figure slow and no clearer. */
const mostLines = 1500;
const mostPoints = 600;
const mostOfMatrix = 6;

function some(count: number, most: number): number[] {
  const stride = Math.ceil(count / most);
  return Array.from({ length: Math.ceil(count / stride) }, (_, i) => i * stride);
}

function classOf(study: StudyText, i: number): string {
  const run = study.runs[i]!;
  return study.best.includes(run.run) ? "best" : run.feasible ? "run" : "infeasible";
}

function titleOf(study: StudyText, i: number): string {
  const run = study.runs[i]!;
  const given = study.parameters.map((p, k) => `${shortName(p.name)} ${run.texts[k]}`);
  const found = study.figures.map((f, k) => `${shortName(f.key)} ${withUnit(run.outputs[k], shownUnit(f.unit))}`);
  return [...given, ...found].join("\n");
}

function pickable(element: SVGElement, study: StudyText, i: number, pick: Pick): SVGElement {
  element.setAttribute("data-run", String(i));
  element.addEventListener("click", () => pick(i));
  return withTitle(element, titleOf(study, i));
}

function columns(study: StudyText): Column[] {
  return [...study.parameters.map((_, k) => parameterColumn(study, k)), ...study.figures.map((_, k) => figureColumn(study, k))];
}

/** A line per run through all parameters and figures. */
export function parallelCoordinates(study: StudyText, pick: Pick): SVGElement {
  const all = columns(study);
  const frame: Frame = { width: Math.max(1000, 150 * all.length), height: 340, left: 75, right: 75, top: 40, bottom: 26 };
  const plot = canvasOf(frame, "Parallel coordinates of all runs");
  const at = (k: number) => frame.left + (k / Math.max(1, all.length - 1)) * (frame.width - frame.left - frame.right);
  const scales = all.map((column) => scaleOf(column.values, frame.height - frame.bottom, frame.top));
  const order = some(study.runs.length, mostLines).sort((a, b) => Number(classOf(study, a) === "best") - Number(classOf(study, b) === "best"));
  for (const i of order) {
    const points = all.flatMap((column, k): [number, number][] => {
      const value = column.values[i];
      return value === null || value === undefined ? [] : [[at(k), scales[k]!.at(value)]];
    });
    plot.append(pickable(svg("path", { d: path(points), class: `trace ${classOf(study, i)}` }), study, i, pick));
  }
  all.forEach((column, k) => {
    const scale = scales[k]!;
    plot.append(
      svg("line", { x1: at(k), x2: at(k), y1: frame.top, y2: frame.height - frame.bottom, class: "axis-line" }),
      svg("text", { x: at(k), y: 14, "text-anchor": "middle", class: "axis" }, column.label),
      svg("text", { x: at(k), y: 29, "text-anchor": "middle" }, shownUnit(column.unit)),
    );
    const numbers = column.values.filter((v): v is number => v !== null);
    for (const value of [Math.min(...numbers), Math.max(...numbers)])
      plot.append(svg("text", { x: at(k) + 5, y: scale.at(value) + 4 }, column.words ? (column.words[value] ?? "") : format(value, 3)));
  });
  return plot;
}

/** Every pair of parameters and figures. */
export function scatterMatrix(study: StudyText, pick: Pick): SVGElement {
  const given = study.parameters.map((_, k) => parameterColumn(study, k));
  const found = study.figures.map((_, k) => figureColumn(study, k));
  const all = [...given.slice(0, Math.max(1, mostOfMatrix - found.length)), ...found].slice(0, mostOfMatrix);
  const side = 120;
  const gap = 8;
  const edge = 70;
  const size = edge + all.length * (side + gap);
  const plot = canvasOf({ ...usual, width: Math.max(size, 900), height: size - edge + 24 }, "Scatter matrix");
  const shown = some(study.runs.length, mostPoints);
  all.forEach((row, r) => {
    const top = r * (side + gap);
    const y = scaleOf(row.values, top + side, top, 0.08);
    plot.append(svg("text", { transform: `translate(14 ${top + 0.5 * side}) rotate(-90)`, "text-anchor": "middle", class: "axis" }, row.label));
    plot.append(svg("text", { transform: `translate(30 ${top + 0.5 * side}) rotate(-90)`, "text-anchor": "middle" }, shownUnit(row.unit)));
    all.forEach((column, c) => {
      const left = edge - 20 + c * (side + gap);
      const x = scaleOf(column.values, left, left + side, 0.08);
      plot.append(svg("rect", { x: left, y: top, width: side, height: side, class: "pane" }));
      if (r === c) {
        bars(column.values, 14).forEach((bar) => {
          const height = bar.share * (side - 8);
          plot.append(svg("rect", { x: x.at(bar.low), y: top + side - height, width: Math.max(1, x.at(bar.high) - x.at(bar.low) - 1), height, class: "bar" }));
        });
      } else {
        for (const i of shown) {
          const [a, b] = [column.values[i], row.values[i]];
          if (a === null || b === null || a === undefined || b === undefined) continue;
          plot.append(pickable(svg("circle", { cx: x.at(a).toFixed(1), cy: y.at(b).toFixed(1), r: 1.8, class: `dot ${classOf(study, i)}` }), study, i, pick));
        }
      }
      if (r === all.length - 1) plot.append(svg("text", { x: left + 0.5 * side, y: top + side + 16, "text-anchor": "middle", class: "axis" }, column.label));
    });
  });
  return plot;
}

interface Bar {
  low: number;
  high: number;
  count: number;
  /** Of the highest. */
  share: number;
}

function bars(values: (number | null)[], count: number): Bar[] {
  const numbers = values.filter((v): v is number => v !== null && Number.isFinite(v));
  const low = Math.min(...numbers);
  const width = (Math.max(...numbers) - low) / count || 1;
  const counts = new Array<number>(count).fill(0);
  for (const value of numbers) counts[Math.min(count - 1, Math.floor((value - low) / width))]!++;
  const highest = Math.max(...counts, 1);
  return counts.map((n, k) => ({ low: low + k * width, high: low + (k + 1) * width, count: n, share: n / highest }));
}

/** How a figure scatters, with its percentiles. */
export function histogram(study: StudyText, k: number): SVGElement {
  const column = figureColumn(study, k);
  const found = study.figures[k]!.scatter!;
  const list = bars(column.values, Math.min(40, Math.max(6, Math.round(Math.sqrt(found.count)))));
  const frame = usual;
  const plot = canvasOf(frame, `Histogram of ${column.label}`);
  const x = scaleOf([list[0]!.low, list[list.length - 1]!.high], frame.left, frame.width - frame.right);
  const y = scaleOf([0, Math.max(...list.map((bar) => bar.count))], frame.height - frame.bottom, frame.top + 14, 0);
  axes(plot, frame, x, y, label(column), "runs");
  for (const bar of list)
    plot.append(
      withTitle(
        svg("rect", { x: x.at(bar.low) + 0.5, y: y.at(bar.count), width: Math.max(1, x.at(bar.high) - x.at(bar.low) - 1), height: y.at(0) - y.at(bar.count), class: "bar" }),
        `${format(bar.low)} to ${withUnit(bar.high, shownUnit(column.unit))}: ${bar.count}`,
      ),
    );
  for (const name of ["5", "50", "95"]) {
    const value = found.percentiles[name]!;
    plot.append(
      svg("line", { x1: x.at(value), x2: x.at(value), y1: frame.top + 14, y2: frame.height - frame.bottom, class: "mark" }),
      svg("text", { x: x.at(value), y: frame.top + 8, "text-anchor": "middle" }, `${name} %`),
    );
  }
  return plot;
}

/** Sobol indices of a figure: which parameter its scatter comes from. */
export function indices(study: StudyText, figure: SampledFigure): SVGElement {
  const model = figure.surrogate!;
  const order = study.parameters.map((_, k) => k).sort((a, b) => model.total[b]! - model.total[a]!);
  const frame: Frame = { ...usual, left: 130, height: 56 + 34 * order.length };
  const plot = canvasOf(frame, `Share of each parameter in the variance of ${shortName(figure.key)}`);
  const x = scaleOf([0, Math.max(1, ...model.total)], frame.left, frame.width - frame.right, 0);
  order.forEach((k, place) => {
    const top = frame.top + 34 * place;
    const wide = (value: number) => Math.max(0, x.at(Math.max(0, value)) - frame.left);
    plot.append(
      svg("text", { x: frame.left - 8, y: top + 18, "text-anchor": "end" }, shortName(study.parameters[k]!.name)),
      withTitle(svg("rect", { x: frame.left, y: top + 4, width: wide(model.total[k]!), height: 22, class: "bar total" }), `total ${format(model.total[k]!, 3)}`),
      withTitle(svg("rect", { x: frame.left, y: top + 4, width: wide(model.first[k]!), height: 22, class: "bar" }), `first order ${format(model.first[k]!, 3)}`),
      svg("text", { x: x.at(Math.max(0, model.total[k]!)) + (model.total[k]! > 0.85 ? -6 : 6), y: top + 19, "text-anchor": model.total[k]! > 0.85 ? "end" : "start", class: model.total[k]! > 0.85 ? "inside" : "" }, format(model.total[k]!, 3)),
    );
  });
  plot.append(svg("text", { x: 0.5 * (frame.left + frame.width), y: frame.height - 10, "text-anchor": "middle", class: "axis" }, "share of the variance"));
  return plot;
}

/** What a figure does as one parameter after the other goes from its smallest value to its largest. */
export function tornado(study: StudyText, figure: SampledFigure): SVGElement {
  const model = figure.surrogate!;
  const ends = model.lines.map((line) => [line.y[0]!, line.y[line.y.length - 1]!] as const);
  const swing = (k: number) => Math.abs(ends[k]![1] - ends[k]![0]);
  const order = study.parameters.map((_, k) => k).sort((a, b) => swing(b) - swing(a));
  const frame: Frame = { ...usual, left: 110, right: 24, bottom: 44, height: 70 + 34 * order.length };
  const plot = canvasOf(frame, `Swing of ${shortName(figure.key)} with each parameter`);
  const x = scaleOf([model.centre, ...ends.flat()], frame.left, frame.width - frame.right);
  const rows = scaleOf([0, 1], frame.height - frame.bottom, frame.top, 0);
  axes(plot, frame, x, { ...rows, low: 2, high: 2 }, axisLabel(shortName(figure.key), shownUnit(figure.unit)), "");
  order.forEach((k, place) => {
    const top = frame.top + 34 * place;
    const line = model.lines[k]!;
    const unit = shownUnit(study.parameters[k]!.unit);
    plot.append(svg("text", { x: frame.left - 8, y: top + 22, "text-anchor": "end" }, shortName(study.parameters[k]!.name)));
    [0, line.y.length - 1].forEach((end) => {
      const [a, b] = [x.at(model.centre), x.at(line.y[end]!)];
      const bar = svg("rect", { x: Math.min(a, b), y: top + 6, width: Math.abs(b - a), height: 22, class: end ? "swing high" : "swing" });
      plot.append(withTitle(bar, `${shortName(study.parameters[k]!.name)} ${withUnit(line.x[end]!, unit)}: ${withUnit(line.y[end]!, shownUnit(figure.unit))}`));
    });
  });
  return plot;
}

/** A figure over one parameter: all runs, and what the surrogate makes of it. */
export function response(study: StudyText, f: number, p: number, pick: Pick): SVGElement {
  const [given, found] = [parameterColumn(study, p), figureColumn(study, f)];
  const line = study.figures[f]!.surrogate?.lines[p];
  const plot = scatter(study, given, found, pick);
  if (line) {
    const [x, y] = scalesOf(given, found);
    plot.append(svg("path", { d: path(line.x.map((v, i) => [x.at(v), y.at(line.y[i]!)])), class: "curve" }));
  }
  return plot;
}

function scalesOf(a: Column, b: Column): [ReturnType<typeof scaleOf>, ReturnType<typeof scaleOf>] {
  return [scaleOf(a.values, usual.left, usual.width - usual.right), scaleOf(b.values, usual.height - usual.bottom, usual.top)];
}

function scatter(study: StudyText, a: Column, b: Column, pick: Pick): SVGElement {
  const plot = canvasOf(usual, `${b.label} over ${a.label}`);
  const [x, y] = scalesOf(a, b);
  axes(plot, usual, x, y, label(a), label(b));
  for (const i of some(study.runs.length, 3 * mostPoints)) {
    const [u, v] = [a.values[i], b.values[i]];
    if (u === null || v === null || u === undefined || v === undefined) continue;
    plot.append(pickable(svg("circle", { cx: x.at(u).toFixed(1), cy: y.at(v).toFixed(1), r: 2.6, class: `dot ${classOf(study, i)}` }), study, i, pick));
  }
  return plot;
}

/** Two objectives, and the runs that none other beats joined. */
export function paretoFront(study: StudyText, pick: Pick): SVGElement | null {
  const places = study.objectives.map((o) => study.figures.findIndex((f) => f.key === o.name));
  if (places.length < 2) return null;
  const [a, b] = [figureColumn(study, places[0]!), figureColumn(study, places[1]!)];
  const plot = scatter(study, a, b, pick);
  const [x, y] = scalesOf(a, b);
  const front = study.best
    .map((name) => study.runs.findIndex((run) => run.run === name))
    .filter((i) => i >= 0 && a.values[i] !== null && b.values[i] !== null)
    .sort((i, j) => a.values[i]! - a.values[j]!);
  plot.append(svg("path", { d: path(front.map((i) => [x.at(a.values[i]!), y.at(b.values[i]!)])), class: "curve" }));
  return plot;
}

/** How a search went on: its objective over the runs, and the best so far. */
export function progress(study: StudyText, pick: Pick): SVGElement {
  const objective = study.objectives[0]!;
  const column = figureColumn(study, study.figures.findIndex((f) => f.key === objective.name));
  const numbers: Column = { label: "run of the search", unit: "", values: study.runs.map((_, i) => i + 1) };
  const plot = scatter(study, numbers, column, pick);
  const [x, y] = scalesOf(numbers, column);
  const points: [number, number][] = [];
  let best: number | null = null;
  study.runs.forEach((run, i) => {
    const value = column.values[i];
    if (!run.feasible || value === null || value === undefined) return;
    if (best === null || (objective.maximise ? value > best : value < best)) best = value;
    points.push([x.at(i + 1), y.at(best)]);
  });
  if (points.length > 1) plot.append(svg("path", { d: path(points), class: "curve" }));
  return plot;
}
