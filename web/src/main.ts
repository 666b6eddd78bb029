import "uplot/dist/uPlot.min.css";
import "./style.css";

import { readReport, type Report, type Run } from "./data";
import { h } from "./dom";
import { assumptions, header, status } from "./header";
import { licences } from "./licences";
import { showBearing } from "./bearing_page";
import { RunView } from "./run_view";
import { showSampling } from "./sampling_page";
import { StudyView } from "./study_view";
import { studyVerdict } from "./study_verdict";
import { followSystem } from "./theme";

function showRun(page: HTMLElement, report: Report): void {
  page.append(header(report), new RunView(report.runs[0]!, assumptions(report.runs[0]!.assumptions)).element);
}

function showStudy(page: HTMLElement, report: Report): void {
  const detail = h("section", { class: "detail", "aria-label": "Run in detail" });
  const study = new StudyView(report, (run) => show(run, true));
  const picker = h("select", { "aria-label": "Run shown in detail", change: () => show(study.runs[Number(picker.value)]!, false) });
  study.runs.forEach((run, i) => picker.append(h("option", { value: i }, study.label(run))));
  const show = (run: Run, scroll: boolean) => {
    picker.value = String(study.runs.indexOf(run));
    detail.replaceChildren(
      h("div", { class: "detail-head" }, h("h2", {}, "Run in detail"), picker, status(run)),
      new RunView(run, assumptions(ownAssumptions(report.runs, run))).element,
    );
    study.highlight(run);
    if (scroll) detail.scrollIntoView({ behavior: "smooth" });
  };
  page.append(...[header(report), studyVerdict(study), sharedAssumptions(study), study.element, detail].filter((e) => e !== null));
  show(study.runs[study.runs.length - 1]!, false);
}

function assumed(run: Run, name: string): string {
  return run.assumptions.find(([other]) => other === name)?.[1] ?? "not stated";
}

/** What the runs of a study assume under one name, each text once. */
function texts(runs: Run[], name: string): string[] {
  return [...new Set(runs.map((run) => assumed(run, name)))];
}

const mostNames = 4;

/** The assumptions of a study: where runs differ, which run assumes what. */
function sharedAssumptions(study: StudyView): HTMLElement | null {
  const runs = study.runs;
  const who = (name: string, text: string) => {
    const labels = runs.filter((run) => assumed(run, name) === text).map((run) => study.label(run));
    return labels.length <= mostNames ? labels.join(", ") : `${labels.length} runs`;
  };
  const names = [...new Set(runs.flatMap((run) => run.assumptions.map(([name]) => name)))];
  return assumptions(
    names.map((name) => {
      const all = texts(runs, name);
      return [name, all.length === 1 ? all[0]! : all.map((text) => `${text} (${who(name, text)})`).join(" | ")];
    }),
  );
}

/** What one run of a study assumes differently from another. */
function ownAssumptions(runs: Run[], run: Run): [string, string][] {
  return run.assumptions.filter(([name]) => texts(runs, name).length > 1);
}

function start(): void {
  const page = document.getElementById("page")!;
  followSystem();
  try {
    const report = readReport();
    if (report.study) showSampling(page, report.study);
    else if (report.bearing) showBearing(page, report.title, report.bearing);
    else if (report.runs.length > 1) showStudy(page, report);
    else showRun(page, report);
    page.append(licences());
  } catch (error) {
    page.append(h("p", { class: "fault" }, `This report cannot be shown: ${error instanceof Error ? error.message : String(error)}`));
    throw error;
  }
}

// On paper assumptions and licences are unfolded, sections with figures as the reader has left them.
let unfolded: Element[] = [];
addEventListener("beforeprint", () => {
  unfolded = [...document.querySelectorAll("details.assumptions:not([open]), .licences details:not([open])")];
  for (const details of unfolded) details.setAttribute("open", "");
});
addEventListener("afterprint", () => unfolded.forEach((details) => details.removeAttribute("open")));
start();
