// The first lines: what was simulated, how it ended, and what was assumed.

import type { Report, Run } from "./data";
import { h } from "./dom";
import { typeset } from "./units";
import { isDark, onThemeChange, setTheme } from "./theme";

const statusText: Record<string, string> = {
  completed: "completed",
  stopped: "stopped on request",
  failed: "failed",
  running: "unfinished",
};

export function header(report: Report): HTMLElement {
  const first = report.runs[0]!;
  const title = report.title || sharedTitle(report.runs);
  document.title = `${title} · hersey`;
  const description = first.attribute("/", "description");
  const count = report.runs.length;
  const facts = [
    count > 1 ? runCount(report) : first.name,
    `hersey ${first.attribute("/", "hersey_version")}`.trim(),
    date(first.attribute("/", "created")),
  ].filter((text) => text);
  return h(
    "header",
    { class: "title-block" },
    h("div", { class: "title-row" }, h("h1", {}, title), themeButton()),
    description ? h("p", { class: "lead" }, description) : null,
    h("p", { class: "facts" }, facts.join(" · "), ...(count === 1 ? [" ", status(first)] : [])),
  );
}

/** The title of all runs; where they differ, the runs by their names. */
function sharedTitle(runs: Run[]): string {
  const titles = new Set(runs.map((run) => run.attribute("/", "title")));
  const [title] = titles;
  if (titles.size === 1 && title) return title;
  const names = runs.map((run) => run.name);
  return names.length <= 4 ? names.join(", ") : `${names.slice(0, 3).join(", ")} and ${names.length - 3} more`;
}

function runCount(report: Report): string {
  const completed = report.runs.filter((run) => run.attribute("/", "status") === "completed").length;
  return `${report.runs.length} runs, ${completed === report.runs.length ? "all" : completed} completed`;
}

export function statusName(run: Run): string {
  const value = run.attribute("/", "status");
  return statusText[value] ?? value;
}

/** How a run ended, in a word; the verdict says more. */
export function status(run: Run): HTMLElement {
  return h("span", { class: `status ${run.attribute("/", "status")}` }, statusName(run));
}

export function assumptions(list: [string, string][]): HTMLElement | null {
  if (list.length === 0) return null;
  const owners = new Set(list.map(([name]) => split(name).owner).filter((owner) => owner));
  const items = [...byTopic(list)].flatMap(([topic, said]) => [h("dt", {}, topic), h("dd", {}, ...sayings(said, owners.size))]);
  const topics = byTopic(list).size;
  return h("details", { class: "assumptions" }, h("summary", {}, "Assumptions", h("span", { class: "where" }, `${topics} ${topics === 1 ? "topic" : "topics"}`)), h("dl", {}, ...items));
}

type Said = { owner: string; text: string };

/** "big_end: cavitation": what is assumed, and for which bearing. */
function split(name: string): { owner: string; topic: string } {
  const end = name.indexOf(": ");
  const [owner, topic] = end < 0 ? ["", name] : [name.slice(0, end), name.slice(end + 2)];
  return { owner: owner.replaceAll("_", " "), topic: topic.replaceAll("_", " ") };
}

function byTopic(list: [string, string][]): Map<string, Said[]> {
  const topics = new Map<string, Said[]>();
  for (const [name, text] of list) {
    const { owner, topic } = split(name);
    topics.set(topic, [...(topics.get(topic) ?? []), { owner, text }]);
  }
  return topics;
}

/** One text where all bearings share it; else each text after the bearings that it is said of. */
function sayings(said: Said[], bearings: number): (HTMLElement | string)[] {
  const texts = [...new Set(said.map(({ text }) => text))];
  if (said.some(({ owner }) => !owner) || (texts.length === 1 && said.length === bearings)) return texts.map(typeset);
  return texts.map((text) => {
    const owners = said.filter((one) => one.text === text).map(({ owner }) => owner);
    return h("div", {}, h("span", { class: "owners" }, `${owners.join(", ")}: `), typeset(text));
  });
}

export function themeButton(): HTMLElement {
  const button = h("button", { type: "button", class: "quiet theme-button", click: () => setTheme(isDark() ? "light" : "dark") });
  const label = () => {
    button.textContent = isDark() ? "Light" : "Dark";
    button.setAttribute("aria-label", isDark() ? "Switch to light colours" : "Switch to dark colours");
  };
  onThemeChange(label);
  label();
  return button;
}

export function date(iso: string): string {
  const parsed = new Date(iso);
  return Number.isNaN(parsed.getTime()) ? iso : `${parsed.toISOString().slice(0, 16).replace("T", " ")} UTC`;
}
