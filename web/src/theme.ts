// Light and dark: the style sheet holds the colours, canvases read them from there.

export interface Palette {
  ink: string;
  faint: string;
  line: string;
  paper: string;
  accent: string;
  series: string[];
}

let current: Palette | null = null;
const listeners = new Set<() => void>();

function read(): Palette {
  const style = getComputedStyle(document.documentElement);
  const value = (name: string) => style.getPropertyValue(name).trim();
  return {
    ink: value("--ink"),
    faint: value("--faint"),
    line: value("--line"),
    paper: value("--paper"),
    accent: value("--accent"),
    series: [1, 2, 3, 4, 5, 6].map((i) => value(`--series-${i}`)),
  };
}

export function palette(): Palette {
  current ??= read();
  return current;
}

export function onThemeChange(listener: () => void): void {
  listeners.add(listener);
}

export function isDark(): boolean {
  return document.documentElement.dataset["theme"] === "dark";
}

export function setTheme(theme: "light" | "dark"): void {
  if (document.documentElement.dataset["theme"] === theme) return;
  document.documentElement.dataset["theme"] = theme;
  current = null;
  for (const listener of listeners) listener();
}

/** Follows the system, or the page that shows this one within it, and paper: a print is always light. */
export function followSystem(): void {
  const dark = matchMedia("(prefers-color-scheme: dark)");
  setTheme(dark.matches ? "dark" : "light");
  dark.addEventListener("change", () => setTheme(dark.matches ? "dark" : "light"));
  addEventListener("message", ({ source, data }: MessageEvent<{ theme?: unknown } | null>) => {
    const theme = source === parent && parent !== window ? data?.theme : undefined;
    if (theme === "light" || theme === "dark") setTheme(theme);
  });
  let beforePrint: "light" | "dark" = "light";
  addEventListener("beforeprint", () => {
    beforePrint = isDark() ? "dark" : "light";
    setTheme("light");
  });
  addEventListener("afterprint", () => setTheme(beforePrint));
}
