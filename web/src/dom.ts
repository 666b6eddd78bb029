type Child = Node | string | null | undefined;
type Properties = Record<string, string | number | boolean | EventListener>;

/** An element: h("p", {class: "note"}, "text"). Functions become listeners, `true` an empty attribute. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false) element.setAttribute(name, String(value));
  }
  element.append(...children.filter((child): child is Node | string => child !== null && child !== undefined));
  return element;
}

/** A figure with its caption; the number comes from the style sheet. */
export function figure(kind: string, caption: string, tools: Child, ...content: Child[]): HTMLElement {
  return h(
    "figure",
    { class: `figure ${kind}`, "data-figure": kind },
    h("div", { class: "figure-body" }, ...content),
    h("figcaption", {}, h("span", { class: "caption" }, caption), tools),
  );
}

export interface Choice {
  value: string;
  label: string;
}

/** A row of buttons of which one is chosen; arrow keys move as in any radio group. */
export function segmented(
  label: string,
  choices: Choice[],
  chosen: string,
  choose: (value: string) => void,
): HTMLElement {
  const name = `choice-${++choiceCount}`;
  return h(
    "fieldset",
    { class: "segmented" },
    h("legend", { class: "visually-hidden" }, label),
    ...choices.map((choice) =>
      h(
        "label",
        {},
        h("input", {
          type: "radio",
          name,
          value: choice.value,
          checked: choice.value === chosen,
          change: () => choose(choice.value),
        }),
        h("span", {}, choice.label),
      ),
    ),
  );
}

let choiceCount = 0;

/** Offers text as a file to save. */
export function saveText(name: string, text: string): void {
  const url = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
  const link = h("a", { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 1000);
}

/** Puts a tooltip beside a point of its holder, on the side where there is room. */
export function placeTooltip(tooltip: HTMLElement, holder: HTMLElement, x: number, y: number): void {
  const gap = 14;
  const fits = x + gap + tooltip.offsetWidth < holder.clientWidth;
  tooltip.style.left = `${fits ? x + gap : Math.max(0, x - gap - tooltip.offsetWidth)}px`;
  tooltip.style.top = `${Math.max(0, Math.min(y - 12, holder.clientHeight - tooltip.offsetHeight))}px`;
}
