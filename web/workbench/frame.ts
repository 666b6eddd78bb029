// The page's frame: the bar at the top, the panes around the text, and the sizes that are drawn by hand.

import { h } from "../src/dom";
import { isDark, onThemeChange, setTheme } from "../src/theme";
import { showKeys } from "./dialogs";
import { splitter } from "./layout";
import { texts } from "./texts";

function themeButton(): HTMLElement {
  const switchTheme = () => {
    setTheme(isDark() ? "light" : "dark");
    localStorage.setItem("hersey-theme", isDark() ? "dark" : "light");
  };
  const button = h("button", { type: "button", class: "quiet", click: switchTheme });
  const label = () => {
    button.textContent = isDark() ? texts.theme.light : texts.theme.dark;
    button.setAttribute("aria-label", isDark() ? texts.theme.toLight : texts.theme.toDark);
  };
  onThemeChange(label);
  label();
  return button;
}

/** @param left, right  what stands on either side of the bar's room */
export function bar(folder: string, left: HTMLElement[], right: HTMLElement[]): HTMLElement {
  return h(
    "header",
    { class: "bar" },
    h("h1", { class: "brand" }, "hersey", h("span", { class: "visually-hidden" }, " workbench")),
    h("span", { class: "folder", title: folder }, folder.split("/").pop() || folder),
    ...left,
    h("span", { class: "spacer" }),
    ...right,
    h("button", { type: "button", class: "quiet", click: () => showKeys() }, texts.shortcuts),
    themeButton(),
  );
}

type Side = "left" | "right" | "below";

export interface FrameParts {
  bar: HTMLElement;
  /** Groups of the pane at the left, with their titles. */
  left: [title: string, content: HTMLElement][];
  middle: HTMLElement[];
  right: HTMLElement;
  below: HTMLElement;
  further: HTMLElement[];
}

/**
 * @param sizes    those set by hand, by side [px]; written to
 * @param changed  after one is
 */
export function frame(parts: FrameParts, sizes: Record<string, number>, changed: () => void): HTMLElement {
  const root = h("div", { class: "bench" });
  const usual = (): Record<Side, number> => ({
    left: Math.min(420, Math.max(200, 0.17 * innerWidth)),
    right: Math.max(380, 0.36 * innerWidth),
    below: Math.max(215, 0.3 * innerHeight),
  });
  const size = (name: Side) => sizes[name] ?? usual()[name];
  // What nobody has set by hand follows the window.
  addEventListener("resize", () => {
    for (const name of ["left", "right", "below"] as const) if (sizes[name] === undefined) root.style.setProperty(`--${name}`, `${usual()[name]}px`);
  });
  const remember = (name: Side) => (value: number) => {
    sizes[name] = value;
    changed();
  };
  const group = ([title, content]: [string, HTMLElement]) => h("section", { class: "group", "aria-label": title }, h("h2", {}, title), content);
  root.append(
    parts.bar,
    h(
      "section",
      { class: "splitters", "aria-label": texts.panes.sizes },
      splitter(root, "--left", texts.splitters.left, "right", size("left"), remember("left")),
      splitter(root, "--right", texts.splitters.right, "left", size("right"), remember("right")),
      splitter(root, "--below", texts.splitters.below, "up", size("below"), remember("below")),
    ),
    h("nav", { class: "pane left", "aria-label": texts.panes.left, tabindex: -1 }, ...parts.left.map(group)),
    h("main", { class: "pane middle", "aria-label": texts.panes.middle, tabindex: -1 }, ...parts.middle),
    h("aside", { class: "pane right", "aria-label": texts.panes.right, tabindex: -1 }, parts.right),
    h("section", { class: "pane below", "aria-label": texts.panes.below, tabindex: -1 }, parts.below),
    ...parts.further,
  );
  return root;
}

/** Focus goes to the next pane, or to the one before. */
export function nextPane(root: HTMLElement, step: number, focusText: () => boolean): void {
  const panes = [...root.querySelectorAll<HTMLElement>(".pane")];
  const at = panes.findIndex((pane) => pane.contains(document.activeElement));
  const next = panes[(at + step + panes.length) % panes.length]!;
  if (next.classList.contains("middle") && focusText()) return;
  (next.querySelector<HTMLElement>('[role="tab"][aria-selected="true"], button') ?? next).focus();
}
