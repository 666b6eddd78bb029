// The first lines of a report: how the run went, what is worst and where, and the numbers asked for first.

import type { Run, SummaryRow } from "./data";
import { h } from "./dom";
import { contactLoss, filmLoss, hottestOil, keyRow, keyValue, largestLoad, moft, place, pofp, sideFlow, spaced, sumOf, tile, tileOf, total, worstFirst } from "./key_figures";
import { magnitude } from "./series";
import { capital } from "./summary_table";
import { format, withUnit } from "./units";

export type Level = "good" | "warn" | "bad";

export interface Judgement {
  level: Level;
  text: string;
}

/** Above these a balance deserves a look before the figures are used. */
const largestMassError = 1e-6; // of the largest flow; Newton's method leaves 1e-8 and less
const largestEnergyError = 5; // [%] of the energy at the start and put in since; the error of a coarse step
/** Below this share of its losses a film's contact is the tail of a distribution of heights [%]. */
const leastContact = 0.1;

/** What is to be said of a run before its figures are used. */
export function judgements(run: Run): Judgement[] {
  return [ending(run), ...contact(run), ...balances(run), ...unstableModes(run)];
}

export function worstLevel(list: Judgement[]): Level {
  return list.some((j) => j.level === "bad") ? "bad" : list.some((j) => j.level === "warn") ? "warn" : "good";
}

function ending(run: Run): Judgement {
  const message = run.attribute("/", "message");
  const said = message ? `: ${message}` : "";
  switch (run.attribute("/", "status")) {
    case "completed":
      return { level: "good", text: `Completed${said}` };
    case "failed":
      return { level: "bad", text: `Failed${said}; the figures are those until then` };
    case "stopped":
      return { level: "warn", text: `Stopped${said}; the figures are those until then` };
    default:
      return { level: "warn", text: "Unfinished; the figures are those so far" };
  }
}

/** The share of a film's losses that is contact [%]. */
export function contactShare(run: Run, bearing: string): number {
  const [contact, film] = [keyValue(run, bearing, contactLoss) ?? 0, keyValue(run, bearing, filmLoss) ?? 0];
  return contact + film > 0 ? (100 * contact) / (contact + film) : 0;
}

function contact(run: Run): Judgement[] {
  const bearings = worstFirst(run);
  if (bearings.length === 0) return [];
  const touching = bearings.filter((b) => contactShare(run, b) >= leastContact);
  if (touching.length > 0)
    return [{ level: "warn", text: `Surfaces touch: ${touching.map((b) => `${spaced(b)} (${format(contactShare(run, b), 2)} % of its losses)`).join(", ")}` }];
  const modelled = bearings.filter((b) => !["", "none"].includes(run.attribute(`/bearings/${b}`, "contact")));
  if (modelled.length === 0) return [{ level: "good", text: "Contact is not modelled" }];
  return [{ level: "good", text: bearings.length === 1 ? "The film carries alone" : "The films carry alone" }];
}

function balances(run: Run): Judgement[] {
  const errors = run.children("/bearings").flatMap((b) => keyValue(run, b, "worst mass-balance error of the film") ?? []).map(Math.abs);
  const energy = keyValue(run, "run", "the same, share of the energy at the start and put in since");
  const parts: Judgement[] = [];
  if (errors.length > 0) parts.push({ level: Math.max(...errors) > largestMassError ? "warn" : "good", text: `Oil is conserved to ${format(Math.max(...errors), 2)}` });
  if (energy !== null) parts.push({ level: energy > largestEnergyError ? "warn" : "good", text: `Energy balances to ${withUnit(energy, "%", 2)}` });
  return parts;
}

function unstableModes(run: Run): Judgement[] {
  const modes = run.summary.filter((row) => row.group === "modes" && row.name.endsWith("damping ratio"));
  if (modes.length === 0) return [];
  const unstable = modes.filter((row) => row.where === "unstable");
  return [unstable.length > 0 ? { level: "bad", text: `Unstable: ${unstable.map((row) => row.name.split(":")[0]).join(", ")}` } : { level: "good", text: "Every damped mode is stable" }];
}

export function judgementList(list: Judgement[]): HTMLElement {
  return h("ul", { class: "judgements" }, ...list.map((j) => h("li", { class: j.level }, h("span", { class: "visually-hidden" }, j.level === "good" ? "" : "Mind: "), j.text)));
}

/** The verdict on one run. */
export function verdict(run: Run): HTMLElement {
  const list = judgements(run);
  return h(
    "section",
    { class: `verdict ${worstLevel(list)}`, "aria-label": `Verdict on ${run.name}` },
    sentence(run),
    judgementList(list),
    h("div", { class: "tiles key-tiles" }, ...tiles(run)),
  );
}

/** Which bearing has the thinnest film, where and when. */
function sentence(run: Run): HTMLElement | null {
  const bearings = worstFirst(run);
  const worst = bearings[0];
  const row = worst === undefined ? undefined : keyRow(run, worst, moft);
  if (!worst || !row) return null;
  const who = bearings.length > 1 ? `Worst of ${bearings.length} bearings: ` : "Thinnest film: ";
  return h("p", { class: "verdict-line" }, who, h("strong", {}, spaced(worst)), `, ${withUnit(row.value, row.unit)} at ${place(row.where)}`);
}

function tiles(run: Run): HTMLElement[] {
  const bearings = run.children("/bearings");
  const own = bearings.length > 0 ? ofBearings(run, bearings) : [...ofModes(run), ...ofContacts(run), ...ofJoints(run)];
  return [...own, ...(bearings.length > 0 ? [] : ofMachine(run))].slice(0, 6);
}

/** The most extreme row of all bearings. */
function extreme(run: Run, bearings: string[], name: string, label: string, worse: (a: number, b: number) => boolean): HTMLElement[] {
  let best: { row: SummaryRow; bearing: string } | null = null;
  for (const bearing of bearings) {
    const row = keyRow(run, bearing, name);
    if (row && row.value !== null && (best === null || worse(row.value, best.row.value!))) best = { row, bearing };
  }
  return best ? [tileOf(label, best.row, bearings.length > 1 ? spaced(best.bearing) : undefined)] : [];
}

function ofBearings(run: Run, bearings: string[]): HTMLElement[] {
  const above = (a: number, b: number) => a > b;
  const loss = total(run, bearings, filmLoss);
  const rubbed = total(run, bearings, contactLoss) ?? 0;
  const flow = sumOf(bearings.map((bearing) => sideFlow(run, bearing)));
  const least = 1e-3; // [W]: below it contact is the tail of a distribution of heights
  return [
    ...extreme(run, bearings, moft, "Thinnest film", (a, b) => a < b),
    ...extreme(run, bearings, pofp, "Peak film pressure", above),
    ...extreme(run, bearings, hottestOil, "Hottest oil", above),
    ...extreme(run, bearings, largestLoad, "Largest load", above),
    ...(loss === null ? [] : [tile({ label: bearings.length > 1 ? "Losses of all films" : "Losses of the film", value: loss + rubbed, unit: "W", where: rubbed > least ? `of which contact ${format(rubbed, 3)} W` : "mean" })]),
    ...(flow === null ? [] : [tile({ label: bearings.length > 1 ? "Side flow of all films" : "Side flow", value: flow, unit: "mm³/s", where: "mean" })]),
  ];
}

function ofModes(run: Run): HTMLElement[] {
  const rows = run.summary.filter((row) => row.group === "modes" && row.name.endsWith("natural frequency"));
  return rows.slice(0, 4).map((row) => tileOf(capital(row.name.split(":")[0]!), row));
}

function ofContacts(run: Run): HTMLElement[] {
  const rows = run.summary.filter((row) => row.group.startsWith("contact ") && ["largest normal force", "smallest distance"].includes(row.name));
  return rows.slice(0, 2).map((row) => tileOf(capital(row.name), row, spaced(row.group.replace("contact ", ""))));
}

/** The largest reaction among the joints, of the instants in this page. */
function ofJoints(run: Run): HTMLElement[] {
  const time = run.column("/time");
  let best: { joint: string; size: number; time: number } | null = null;
  for (const joint of run.children("/joints")) {
    const sizes = magnitude(run, `/joints/${joint}/reaction_force`);
    sizes?.forEach((size, i) => {
      if (Number.isFinite(size) && size > (best?.size ?? 0)) best = { joint, size, time: time?.[i] ?? 0 };
    });
  }
  const found = best as { joint: string; size: number; time: number } | null;
  return found ? [tile({ label: "Largest joint force", value: found.size, unit: "N", owner: spaced(found.joint), where: `t = ${format(1e3 * found.time)} ms` })] : [];
}

function ofMachine(run: Run): HTMLElement[] {
  const rows: [string, string][] = [
    ["energy put in by drives and loads", "Energy put in"],
    ["energy dissipated", "Energy dissipated"],
    ["the same, share of the energy at the start and put in since", "Energy unexplained"],
    ["simulated time", "Simulated time"],
  ];
  return rows.flatMap(([name, label]) => {
    const row = keyRow(run, "run", name);
    return row ? [tileOf(label, row)] : [];
  });
}
