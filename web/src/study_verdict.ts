// The first lines of a report of several runs: how they ended, and the worst figures of all of them.

import type { Run, SummaryRow } from "./data";
import { h } from "./dom";
import { filmLoss, hottestOil, keyRow, largestLoad, moft, place, pofp, spaced, tileOf } from "./key_figures";
import type { StudyView } from "./study_view";
import { withUnit } from "./units";
import { judgementList, judgements, worstLevel, type Judgement } from "./verdict";

interface Found {
  row: SummaryRow;
  run: Run;
  bearing: string;
}

/** The most extreme row of all bearings of all runs. */
function extreme(runs: Run[], name: string, worse: (a: number, b: number) => boolean): Found | null {
  let best: Found | null = null;
  for (const run of runs)
    for (const bearing of run.children("/bearings")) {
      const row = keyRow(run, bearing, name);
      if (row && row.value !== null && (best === null || worse(row.value, best.row.value!))) best = { row, run, bearing };
    }
  return best;
}

export function studyVerdict(study: StudyView): HTMLElement {
  const { runs } = study;
  const several = runs.some((run) => run.children("/bearings").length > 1);
  const owner = ({ run, bearing }: Found) => study.label(run) + (several ? `, ${spaced(bearing)}` : "");
  const above = (a: number, b: number) => a > b;
  const thinnest = extreme(runs, moft, (a, b) => a < b);
  const found: [string, Found | null][] = [
    ["Thinnest film", thinnest],
    ["Peak film pressure", extreme(runs, pofp, above)],
    ["Hottest oil", extreme(runs, hottestOil, above)],
    ["Largest load", extreme(runs, largestLoad, above)],
    ["Greatest film loss", extreme(runs, filmLoss, above)],
  ];
  const list = judged(study);
  const tiles = found.flatMap(([label, one]) => (one ? [tileOf(label, one.row, owner(one))] : []));
  return h(
    "section",
    { class: `verdict ${worstLevel(list)}`, "aria-label": "Verdict" },
    thinnest ? h("p", { class: "verdict-line" }, `Worst of ${runs.length} runs: `, h("strong", {}, owner(thinnest)), `, ${withUnit(thinnest.row.value, thinnest.row.unit)} at ${place(thinnest.row.where)}`) : null,
    judgementList(list),
    tiles.length > 0 ? h("div", { class: "tiles key-tiles" }, ...tiles) : null,
  );
}

/** What is to be minded of some runs, each remark once with the runs it is made of. */
function judged(study: StudyView): Judgement[] {
  const remarks = new Map<string, { judgement: Judgement; runs: string[] }>();
  for (const run of study.runs)
    for (const judgement of judgements(run).filter((j) => j.level !== "good")) {
      const known = remarks.get(judgement.text);
      if (known) known.runs.push(study.label(run));
      else remarks.set(judgement.text, { judgement, runs: [study.label(run)] });
    }
  const most = 4;
  const all = [...remarks.values()];
  const shown: Judgement[] = all.slice(0, most).map(({ judgement, runs }) => ({ level: judgement.level, text: `${runs.length > 3 ? `${runs.length} runs` : runs.join("; ")}: ${judgement.text}` }));
  if (all.length > most) shown.push({ level: worstLevel(all.slice(most).map(({ judgement }) => judgement)), text: `${all.length - most} more remarks on single runs` });
  return shown.length > 0 ? shown : [{ level: "good", text: "Every run completed, without contact, with its balances closed" }];
}
