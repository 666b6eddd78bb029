// Units that a value may be written in, by the kind of its quantity.

const families: string[][] = [
  ["mm", "um", "cm", "m", "in"],
  ["mm^2", "cm^2", "m^2", "in^2"],
  ["mm^3", "l", "m^3"],
  ["N", "kN", "lbf"],
  ["N.m", "N.mm", "kN.m"],
  ["N/m", "N/um", "N/mm", "kN/mm"],
  ["N.s/m", "N.s/mm", "kN.s/m"],
  ["N.m/rad", "N.m/deg", "kN.m/rad"],
  ["N.m.s/rad", "N.mm.s/rad"],
  ["bar", "MPa", "Pa", "kPa", "GPa", "psi"],
  ["mPa.s", "Pa.s", "cP"],
  ["rpm", "rad/s", "deg/s", "Hz"],
  ["deg", "rad", "rev"],
  ["kg", "g", "t"],
  ["kg.m^2", "kg.mm^2", "g.mm^2"],
  ["kg/m^3", "g/cm^3"],
  ["ms", "s", "us", "min"],
  ["m/s", "mm/s", "km/h"],
  ["m/s^2", "mm/s^2"],
  ["degC", "K", "degF"],
  ["l/min", "mm^3/s", "m^3/s", "l/h"],
  ["W", "kW"],
  ["J", "kJ"],
  ["1/K", "1/degC"],
  ["W/(m.K)", "W/(m.degC)"],
  ["J/(kg.K)", "kJ/(kg.K)"],
  ["W/(m^2.K)", "kW/(m^2.K)"],
  ["1/GPa", "1/Pa", "1/MPa"],
];

/** One number or several, and the unit they stand in. */
export const quantityPattern = /^((?:[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?\s+)*[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-z%µ°][^\s,#]*|1\/[^\s,#]*)$/;

/** The other units of the same quantity. */
export function unitsLike(unit: string): string[] {
  return families.find((family) => family.includes(unit))?.filter((other) => other !== unit) ?? [];
}

export function familyOf(unit: string): string[] {
  return families.find((family) => family.includes(unit)) ?? [unit];
}
