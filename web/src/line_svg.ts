// A line figure as a drawing to save: the same axes, curves and legend as on the screen, as SVG text.

import type uPlot from "uplot";
import { axisLabel } from "./units";

export interface SvgCurve {
  label: string;
  colour: string;
  scale: "y" | "right";
  dash: number[];
  dots: boolean;
  points: boolean;
  stepped: boolean;
  values: ArrayLike<number | null | undefined>;
}

export interface SvgAxis {
  label: string;
  unit: string;
}

export interface SvgColours {
  ink: string;
  line: string;
  paper: string;
}

/** Where uPlot keeps the ticks it has drawn. */
type DrawnAxis = { _splits?: number[]; _values?: (string | null)[] };

const escape = (text: string) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);
const round = (v: number) => Math.round(10 * v) / 10;

/** What stands on the axes, from the left of the picture and from the top of the plot. */
export function lineSvg(plot: uPlot, axes: { x: SvgAxis; left: SvgAxis; right: SvgAxis | null }, curves: SvgCurve[], colours: SvgColours): string {
  const legend = legendRows(curves, plot.width);
  const top = 22 * legend.length + 4;
  const area = { x: plot.over.offsetLeft, y: plot.over.offsetTop + top, width: plot.over.clientWidth, height: plot.over.clientHeight };
  const [width, height] = [plot.width, plot.height + top];
  const parts = [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}" font-family="system-ui, sans-serif" font-size="12">`,
    `<rect width="${width}" height="${height}" fill="${colours.paper}"/>`,
    `<clipPath id="area"><rect x="${area.x}" y="${area.y}" width="${area.width}" height="${area.height}"/></clipPath>`,
    ...legendText(legend, colours.ink),
    ...axisText(plot, axes, area, height, colours),
    `<g clip-path="url(#area)">`,
    ...curves.flatMap((curve) => curveText(plot, curve, area.x, area.y)),
    "</g>",
    "</svg>",
  ];
  return parts.join("\n");
}

function legendRows(curves: SvgCurve[], width: number): { x: number; curve: SvgCurve }[][] {
  const rows: { x: number; curve: SvgCurve }[][] = [[]];
  let x = 8;
  for (const curve of curves) {
    const wide = 40 + 7 * curve.label.length;
    if (x > 8 && x + wide > width) {
      rows.push([]);
      x = 8;
    }
    rows[rows.length - 1]!.push({ x, curve });
    x += wide;
  }
  return rows;
}

function legendText(rows: ReturnType<typeof legendRows>, ink: string): string[] {
  return rows.flatMap((row, k) =>
    row.flatMap(({ x, curve }) => [
      `<line x1="${x}" x2="${x + 16}" y1="${22 * k + 14}" y2="${22 * k + 14}" stroke="${curve.colour}" stroke-width="3"${dashes(curve.dash)}/>`,
      `<text x="${x + 23}" y="${22 * k + 18}" fill="${ink}">${escape(curve.label)}</text>`,
    ]),
  );
}

function axisText(plot: uPlot, axes: { x: SvgAxis; left: SvgAxis; right: SvgAxis | null }, area: { x: number; y: number; width: number; height: number }, height: number, { ink, line }: SvgColours): string[] {
  const bottom = area.y + area.height;
  const end = area.x + area.width;
  const drawn = plot.axes as unknown as DrawnAxis[];
  const ticks = (axis: DrawnAxis | undefined, scale: string) =>
    (axis?._splits ?? []).flatMap((split, i) => {
      const text = axis?._values?.[i];
      return text === null || text === undefined || text === "" ? [] : [{ at: round(plot.valToPos(split, scale)), text: escape(text) }];
    });
  const middle = area.y + area.height / 2;
  const parts = [
    ...ticks(drawn[0], "x").flatMap(({ at, text }) => [
      `<line x1="${area.x + at}" x2="${area.x + at}" y1="${area.y}" y2="${bottom + 4}" stroke="${line}"/>`,
      `<text x="${area.x + at}" y="${bottom + 17}" text-anchor="middle" fill="${ink}">${text}</text>`,
    ]),
    ...ticks(drawn[1], "y").flatMap(({ at, text }) => [
      `<line x1="${area.x - 4}" x2="${end}" y1="${area.y + at}" y2="${area.y + at}" stroke="${line}"/>`,
      `<text x="${area.x - 8}" y="${area.y + at + 4}" text-anchor="end" fill="${ink}">${text}</text>`,
    ]),
    `<text x="${area.x + area.width / 2}" y="${height - 6}" text-anchor="middle" fill="${ink}">${escape(axisLabel(axes.x.label, axes.x.unit))}</text>`,
    `<text transform="translate(14 ${middle}) rotate(-90)" text-anchor="middle" fill="${ink}">${escape(axisLabel(axes.left.label, axes.left.unit))}</text>`,
  ];
  if (!axes.right) return parts;
  return [
    ...parts,
    ...ticks(drawn[2], "right").map(({ at, text }) => `<text x="${end + 8}" y="${area.y + at + 4}" fill="${ink}">${text}</text>`),
    `<text transform="translate(${plot.width - 6} ${middle}) rotate(-90)" text-anchor="middle" fill="${ink}">${escape(axisLabel(axes.right.label, axes.right.unit))}</text>`,
  ];
}

function dashes(dash: number[]): string {
  return dash.length > 0 ? ` stroke-dasharray="${dash.join(" ")}"` : "";
}

function curveText(plot: uPlot, curve: SvgCurve, left: number, top: number): string[] {
  const x = plot.data[0];
  const place = (i: number) => [round(left + plot.valToPos(x[i]!, "x")), round(top + plot.valToPos(curve.values[i]!, curve.scale))] as const;
  const shown = Array.from(x, (_, i) => i).filter((i) => curve.values[i] !== null && curve.values[i] !== undefined);
  const marks = curve.dots || curve.points ? shown.map((i) => place(i)).map(([px, py]) => `<circle cx="${px}" cy="${py}" r="${curve.dots ? 1.6 : 3}" fill="${curve.colour}"/>`) : [];
  if (curve.dots) return marks;
  let path = "";
  shown.forEach((i, k) => {
    const [px, py] = place(i);
    const follows = k > 0 && shown[k - 1] === i - 1;
    path += !follows ? `M${px} ${py}` : curve.stepped ? `H${px}V${py}` : `L${px} ${py}`;
  });
  return [`<path d="${path}" fill="none" stroke="${curve.colour}" stroke-width="1.6"${dashes(curve.dash)}/>`, ...marks];
}
