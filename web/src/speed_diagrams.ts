// Diagrams over a speed: natural frequencies with the orders of the speed, and a waterfall of spectra.

import { shortName, type StudyText } from "./sampling_data";
import { axes, canvasOf, scaleOf, svg, usual, withTitle, type Frame } from "./svg_plot";
import { axisLabel, format, shownUnit } from "./units";
import { waterfall } from "./waterfall";

const wide: Frame = { ...usual, width: 640, height: 380 };
const orders = [1, 2, 3];
/** Turns per second of one of a speed's units. */
const perSecond: Record<string, number> = { rpm: 1 / 60, "1/s": 1, Hz: 1, "rad/s": 1 / (2 * Math.PI) };

/** Natural frequencies; full dots are lightly damped. */
export function campbell(study: StudyText): SVGElement {
  const data = study.campbell!;
  const plot = canvasOf(wide, "Campbell diagram");
  const x = scaleOf([0, ...data.rows.map((row) => row.x)], wide.left, wide.width - wide.right);
  const turns = perSecond[data.unit];
  const fastest = Math.max(...data.rows.map((row) => row.x));
  const lowest = data.rows.flatMap((row) => row.frequency.slice(0, 8)).filter((v): v is number => v !== null);
  const highest = turns ? Math.max(3.2 * turns * fastest, ...data.rows.map((row) => row.frequency[0] ?? 0)) : Math.max(...lowest);
  const y = scaleOf([0, highest], wide.height - wide.bottom, wide.top, 0);
  axes(plot, wide, x, y, axisLabel(shortName(data.parameter), shownUnit(data.unit)), "frequency [Hz]");
  if (turns) {
    for (const order of orders) {
      plot.append(svg("line", { x1: x.at(0), y1: y.at(0), x2: x.at(fastest), y2: y.at(order * turns * fastest), class: "order" }));
      plot.append(svg("text", { x: x.at(fastest) - 4, y: y.at(order * turns * fastest) - 5, "text-anchor": "end" }, `${order}×`));
    }
  }
  for (const row of data.rows) {
    row.frequency.forEach((value, k) => {
      const ratio = row.damping_ratio[k];
      if (value === null || value > y.high || value <= 0) return;
      const kind = (ratio ?? 0) < 0 ? "unstable" : (ratio ?? 0) > 0.3 ? "damped" : "run";
      plot.append(
        withTitle(svg("circle", { cx: x.at(row.x), cy: y.at(value), r: 3.4, class: `dot mode ${kind}` }), `${format(value)} Hz, damping ratio ${format(ratio)} at ${format(row.x)} ${shownUnit(data.unit)}`),
      );
    });
  }
  return plot;
}

/** Spectra of the runs of a study, each at its speed. */
export function studyWaterfall(study: StudyText): SVGElement {
  const { rows, parameter, unit } = study.run_up!;
  const turns = perSecond[unit];
  return waterfall(
    rows.map(({ x, frequency, amplitude }) => ({ at: x, frequency, amplitude })),
    { x: "frequency [Hz]", y: axisLabel(shortName(parameter), shownUnit(unit)), unit: shownUnit(unit), amplitude: "(SI)", ...(turns ? { turns } : {}) },
  );
}
