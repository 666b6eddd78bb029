// Figures of a bearing by itself as text, with as many digits as their errors leave.

import type { FigureText } from "./data";
import { h } from "./dom";
import { format, shownUnit } from "./units";

/** 5.618. */
export function valueText(f: FigureText | undefined): string {
  if (f?.words) return f.words;
  if (!f || f.value === null) return "–";
  if (!f.grid_error || f.grid_error > Math.abs(f.value) || Math.abs(f.value) >= 1e6) return format(f.value);
  const decimals = Math.min(12, Math.max(0, 1 - Math.floor(Math.log10(f.grid_error))));
  return f.value.toFixed(decimals).replace("-", "−");
}

export function errorText(f: FigureText): string {
  return f.grid_error ? `± ${format(f.grid_error, 2)} (grid)` : "";
}

export function unitText(f: FigureText): HTMLElement | null {
  if (f.words) return null;
  const unit = shownUnit(f.unit);
  return unit ? h("span", { class: "unit" }, unit === "°" ? "°" : ` ${unit}`) : null;
}
