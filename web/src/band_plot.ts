// How a series scatters over the runs of a study: the band between two percentiles, with median and mean.

import { shortName, type Band } from "./sampling_data";
import { axes, canvasOf, path, scaleOf, svg, usual, withTitle, type Frame } from "./svg_plot";
import { axisLabel, shownUnit } from "./units";

const wide: Frame = { ...usual, width: 560, height: 300 };

export function bandOverTime(band: Band): SVGElement {
  const { "5": low, "50": median, "95": high } = band.percentiles;
  const plot = canvasOf(wide, `Band of ${shortName(band.key)} over time`);
  const x = scaleOf(band.time, wide.left, wide.width - wide.right, 0);
  const y = scaleOf([...low, ...high, ...band.mean], wide.height - wide.bottom, wide.top);
  axes(plot, wide, x, y, "time [s]", axisLabel(shortName(band.key), shownUnit(band.unit)));
  const line = (values: number[]) => values.map((value, i): [number, number] => [x.at(band.time[i]!), y.at(value)]);
  plot.append(
    withTitle(svg("path", { d: `${path([...line(low), ...line(high).reverse()])}Z`, class: "bar total" }), "from the 5th to the 95th percentile"),
    svg("path", { d: path(line(band.mean)), class: "curve mean" }),
    svg("path", { d: path(line(median)), class: "curve" }),
  );
  return plot;
}
