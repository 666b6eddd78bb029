// From SI, as results are stored, to the units engineers read.

export interface Display {
  factor: number;
  unit: string;
}

export const micrometre: Display = { factor: 1e6, unit: "µm" };
export const millimetre: Display = { factor: 1e3, unit: "mm" };
export const megapascal: Display = { factor: 1e-6, unit: "MPa" };
export const micrometrePerMetre: Display = { factor: 1e6, unit: "µm/m" };
export const degree: Display = { factor: 180 / Math.PI, unit: "°" };
export const cubicMillimetrePerSecond: Display = { factor: 1e9, unit: "mm³/s" };
export const newtonMillimetre: Display = { factor: 1e3, unit: "N·mm" };
export const plain: Display = { factor: 1, unit: "" };
export const percent: Display = { factor: 100, unit: "%" };

const bySi: Record<string, Display> = {
  "1": plain,
  m: millimetre,
  rad: degree,
  "rad/s": { factor: 1, unit: "rad/s" },
  Pa: megapascal,
  "m^3/s": cubicMillimetrePerSecond,
  "m^3": { factor: 1e9, unit: "mm³" },
  "N m": { factor: 1, unit: "N·m" },
  "N.m": { factor: 1, unit: "N·m" },
  s: { factor: 1e3, unit: "ms" },
};

/** How a quantity of this SI unit is shown where nothing more is known of it. */
export function displayOf(siUnit: string): Display {
  return bySi[siUnit] ?? { factor: 1, unit: siUnit.replace("^2", "²").replace("^3", "³") };
}

/** A number to `digits` significant digits, without trailing zeros, with a true minus sign. */
export function format(value: number | null | undefined, digits = 4): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  let text: string;
  if (size >= 1e6 || size < 1e-4) {
    const [mantissa, exponent] = value.toExponential(Math.min(digits - 1, 2)).split("e") as [string, string];
    text = `${mantissa}·10${superscript(Number(exponent))}`;
  } else {
    text = value.toPrecision(digits);
    if (text.includes("e")) text = String(Math.round(value));
    if (text.includes(".")) text = text.replace(/\.?0+$/, "");
  }
  return text.replace("-", "−");
}

export function withUnit(value: number | null | undefined, unit: string, digits = 4): string {
  const number = format(value, digits);
  return unit === "" ? number : unit === "°" ? `${number}°` : `${number} ${unit}`;
}

/** Units and products of a plain text as they are printed: 68 um, 60 x 13, 15 mPa.s. */
export function typeset(text: string): string {
  return text
    .replace(/\bum\b/g, "µm")
    .replace(/(?<=\w) x (?=\w)/g, " × ")
    .replace(/(?<=[A-Za-z])\.(?=(?:s|m|mm|kg)\b)/g, "·")
    .replace(/\bdeg\b/g, "°");
}

export function superscript(exponent: number): string {
  const digits = "⁰¹²³⁴⁵⁶⁷⁸⁹";
  return String(exponent).replace("-", "⁻").replace(/\d/g, (d) => digits[Number(d)]!);
}

/** "attitude angle [°]", or the bare label of a pure number. */
export function axisLabel(label: string, unit: string): string {
  return unit === "" ? label : `${label} [${unit}]`;
}

/** Units of a bearing by itself as they are printed. */
export function shownUnit(unit: string): string {
  return unit.replace("mm^3/s", "mm³/s").replace("mm^3", "mm³").replace(/^deg$/, "°").replace(/^um(?=$|\/)/, "µm").replace("N.m", "N·m").replace("m.s", "m·s").replace("N.s", "N·s");
}
