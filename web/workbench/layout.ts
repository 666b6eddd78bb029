// Panes, their tabs and the bars between them that change their sizes, by mouse and by keys.

import { h } from "../src/dom";

export interface Tab {
  key: string;
  label: string;
  content: HTMLElement;
}

/** A few contents of which one is shown. */
export class Tabs {
  readonly bar: HTMLElement;
  readonly element: HTMLElement;
  private chosen = "";
  private readonly buttons = new Map<string, HTMLButtonElement>();

  constructor(
    label: string,
    private readonly tabs: Tab[],
    private readonly shown: (key: string) => void = () => undefined,
  ) {
    this.bar = h("div", { class: "tabs", role: "tablist", "aria-label": label });
    for (const { key, label: name, content } of tabs) {
      const button = h("button", { type: "button", role: "tab", id: `tab-${key}`, "aria-controls": `panel-${key}`, class: "tab", click: () => this.show(key) }, name);
      this.buttons.set(key, button);
      this.bar.append(button);
      content.id = `panel-${key}`;
      content.setAttribute("role", "tabpanel");
      content.setAttribute("aria-labelledby", `tab-${key}`);
      content.classList.add("panel");
    }
    walkable(this.bar);
    this.element = h("div", { class: "tabbed" }, this.bar, ...tabs.map(({ content }) => content));
    this.show(tabs[0]!.key);
  }

  get current(): string {
    return this.chosen;
  }

  label(key: string, text: string): void {
    this.buttons.get(key)!.textContent = text;
  }

  show(key: string): void {
    if (!this.buttons.has(key)) return;
    this.chosen = key;
    for (const { key: own, content } of this.tabs) {
      const is = own === key;
      content.hidden = !is;
      this.buttons.get(own)!.setAttribute("aria-selected", String(is));
      this.buttons.get(own)!.tabIndex = is ? 0 : -1;
    }
    this.buttons.get(key)!.scrollIntoView({ block: "nearest", inline: "nearest" });
    this.shown(key);
  }
}

/** Arrow keys go from tab to tab and choose. */
export function walkable(bar: HTMLElement): void {
  bar.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const tabs = [...bar.querySelectorAll<HTMLElement>('[role="tab"]')];
    const at = tabs.indexOf(document.activeElement as HTMLElement);
    if (at < 0) return;
    event.preventDefault();
    const next = tabs[(at + step + tabs.length) % tabs.length]!;
    next.click();
    next.focus();
  });
}

/** A bar that changes a size of the layout, a property of `holder` in pixels. */
export function splitter(holder: HTMLElement, property: string, label: string, towards: "right" | "left" | "up", start: number, changed: (size: number) => void): HTMLElement {
  const isUpright = towards !== "up";
  const bar = h("div", { class: `splitter ${{ right: "upright at-left", left: "upright at-right", up: "level" }[towards]}`, role: "separator", tabindex: 0, "aria-label": label, "aria-orientation": isUpright ? "vertical" : "horizontal", "aria-valuemin": 120 });
  let size = start;
  const set = (wanted: number) => {
    const room = isUpright ? innerWidth : innerHeight;
    size = Math.round(Math.min(0.7 * room, Math.max(120, wanted)));
    holder.style.setProperty(property, `${size}px`);
    bar.setAttribute("aria-valuenow", String(size));
    bar.setAttribute("aria-valuemax", String(Math.round(0.7 * room)));
  };
  set(start);
  const sign = towards === "right" ? 1 : -1;
  // The page may have changed it with the window's size.
  const read = () => (size = parseFloat(holder.style.getPropertyValue(property)) || size);
  bar.addEventListener("pointerdown", (event) => {
    bar.setPointerCapture(event.pointerId);
    const [from, before] = [isUpright ? event.clientX : event.clientY, read()];
    const move = (e: PointerEvent) => set(before + sign * ((isUpright ? e.clientX : e.clientY) - from));
    bar.addEventListener("pointermove", move);
    bar.addEventListener("lostpointercapture", () => {
      bar.removeEventListener("pointermove", move);
      changed(size);
    }, { once: true });
  });
  bar.addEventListener("keydown", (event) => {
    const step = isUpright ? { ArrowRight: 1, ArrowLeft: -1 }[event.key] : { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    set(read() + sign * step * (event.shiftKey ? 80 : 20));
    changed(size);
  });
  return bar;
}
