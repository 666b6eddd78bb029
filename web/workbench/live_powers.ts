// Where the power of a run's machine comes from and where it goes, while the run goes on; and where the films' heat goes.

import type { RunEvent } from "./api";
import { NamedCourse, type Figure, type PlotKind } from "./live_columns";
import { texts } from "./texts";

const watts = { unit: "W", fromZero: true, hidesZeros: true, shown: (x: number) => x };
const kinds: PlotKind[] = [
  { key: "balance", label: texts.powers.balance, ...watts },
  { key: "friction", label: texts.powers.friction, ...watts },
  { key: "heat", label: texts.powers.heat, ...watts },
];

/** Keys of a film's heat; of all films together. */
const heats = ["to_oil", "to_shell", "to_journal", "stored"] as const;

function figures({ powers, bearings }: RunEvent): Figure[] {
  if (!powers) return [];
  const { balance, friction, heat, bodies } = texts.powers.of;
  const list: Figure[] = Object.entries(balance).map(([key, name]): Figure => ["balance", name, powers[key as keyof typeof balance]]);
  list.push(...Object.entries(friction).map(([key, name]): Figure => ["friction", name, powers[key as keyof typeof friction]]));
  const films = Object.values(bearings ?? {}).flatMap((bearing) => bearing.heat ?? []);
  if (films.length > 0) list.push(...heats.map((key): Figure => ["heat", heat[key], films.reduce((sum, film) => sum + (film[key] ?? NaN), 0)]));
  if (powers.heat) list.push(["heat", bodies.surroundings, powers.heat.surroundings], ["heat", bodies.bodies, powers.heat.bodies]);
  return list;
}

export const powerCourse = () => new NamedCourse(kinds, figures);
