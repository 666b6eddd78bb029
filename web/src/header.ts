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
  const title = report.title || first.attribute("/", "title") || first.file;
  document.title = `${title} · hersey`;
  const description = first.attribute("/", "description");
  const count = report.runs.length;
  const facts = [
    count > 1 ? runCount(report) : first.file,
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

function runCount(report: Report): string {
  const completed = report.runs.filter((run) => run.attribute("/", "status") === "completed").length;
  return `${report.runs.length} runs, ${completed === report.runs.length ? "all" : completed} completed`;
}

export function statusName(run: Run): string {
  const value = run.attribute("/", "status");
  return statusText[value] ?? value;
}

/** How a run ended; what it says goes with it unless all is well. */
export function status(run: Run): HTMLElement {
  const value = run.attribute("/", "status");
  const message = run.attribute("/", "message");
  const text = statusName(run);
  return h("span", { class: `status ${value}` }, value === "completed" || !message ? text : `${text}: ${message}`);
}

export function assumptions(list: [string, string][]): HTMLElement | null {
  if (list.length === 0) return null;
  // "big_end: cavitation": where there is one bearing only, its name goes without saying.
  const owners = new Set(list.filter(([name]) => name.includes(": ")).map(([name]) => name.split(": ")[0]));
  const short = (name: string) => (owners.size === 1 ? name.replace(/^.*?: /, "") : name).replaceAll("_", " ");
  const items = list.flatMap(([name, text]) => [h("dt", {}, short(name)), h("dd", {}, typeset(text))]);
  return h("section", { class: "assumptions", "aria-label": "Assumptions" }, h("h2", {}, "Assumptions"), h("dl", {}, ...items));
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
