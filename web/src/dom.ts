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

/** A button that saves the picture of the figure it stands in, on paper of the page's colour. */
function pictureButton(kind: string): HTMLElement {
  const button = h("button", { type: "button", class: "quiet", "aria-label": "Save the picture of this figure as PNG" }, "PNG");
  button.addEventListener("click", () => {
    const canvas = [...(button.closest("figure")?.querySelectorAll("canvas") ?? [])].find((c) => c.width > 0 && c.clientWidth > 0);
    if (!canvas) return;
    const copy = h("canvas", { width: canvas.width, height: canvas.height });
    const context = copy.getContext("2d")!;
    context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--paper").trim();
    context.fillRect(0, 0, copy.width, copy.height);
    context.drawImage(canvas, 0, 0);
    copy.toBlob((blob) => blob && save(`${kind}.png`, blob));
  });
  return button;
}

/** A drawing as text, with the colours and letters that the style sheet gives it, on paper of the page's colour. */
function drawn(drawing: SVGElement, width: number, height: number): string {
  const styles = ["fill", "fill-opacity", "stroke", "stroke-opacity", "stroke-width", "stroke-dasharray", "font-size", "font-family", "text-anchor", "paint-order"];
  const copy = drawing.cloneNode(true) as SVGElement;
  for (const [name, value] of Object.entries({ xmlns: "http://www.w3.org/2000/svg", width, height })) copy.setAttribute(name, String(value));
  copy.style.background = getComputedStyle(document.documentElement).getPropertyValue("--paper").trim();
  const originals = drawing.querySelectorAll("*");
  copy.querySelectorAll<SVGElement>("*").forEach((part, i) => {
    const look = getComputedStyle(originals[i]!);
    for (const name of styles) part.style.setProperty(name, look.getPropertyValue(name));
  });
  return new XMLSerializer().serializeToString(copy);
}

/** The drawing that a figure shows: it may have been drawn anew since. */
function drawingOf(button: HTMLElement): { drawing: SVGElement; width: number; height: number } | null {
  const drawing = button.closest("figure")?.querySelector<SVGElement>(".figure-body svg");
  if (!drawing) return null;
  const { width, height } = drawing.getBoundingClientRect();
  return { drawing, width: Math.round(width), height: Math.round(height) };
}

/** Buttons that save a drawing as it is, and as a picture twice as fine as on the screen. */
export function drawingButtons(kind: string): HTMLElement[] {
  const svg = h("button", { type: "button", class: "quiet", "aria-label": "Save the drawing of this figure as SVG" }, "SVG");
  svg.addEventListener("click", () => {
    const found = drawingOf(svg);
    if (found) saveText(`${kind}.svg`, drawn(found.drawing, found.width, found.height), "image/svg+xml");
  });
  const png = h("button", { type: "button", class: "quiet", "aria-label": "Save the picture of this figure as PNG" }, "PNG");
  png.addEventListener("click", () => {
    const found = drawingOf(png);
    if (!found) return;
    const { drawing, width, height } = found;
    const image = new Image();
    image.addEventListener("load", () => {
      const canvas = h("canvas", { width: 2 * width, height: 2 * height });
      canvas.getContext("2d")!.drawImage(image, 0, 0, canvas.width, canvas.height);
      canvas.toBlob((blob) => blob && save(`${kind}.png`, blob));
    });
    image.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(drawn(drawing, width, height))}`;
  });
  return [svg, png];
}

/** A button that saves numbers as a table. */
export function tableButton(name: string, rows: () => (string | number)[][]): HTMLElement {
  const quote = (cell: string | number) => (typeof cell === "number" ? String(cell) : `"${cell.replace(/"/g, '""')}"`);
  const text = () => rows().map((row) => row.map(quote).join(",")).join("\n");
  return h("button", { type: "button", class: "quiet", "aria-label": "Save the numbers of this figure as CSV", click: () => saveText(`${name}.csv`, text()) }, "CSV");
}

/** A figure with its caption; the number comes from the style sheet. It can be saved as a picture. */
export function figure(kind: string, caption: string, tools: Child, ...content: Child[]): HTMLElement {
  const drawing = content.find((part): part is SVGElement => part instanceof SVGElement);
  return h(
    "figure",
    { class: `figure ${kind}`, "data-figure": kind },
    h("div", { class: "figure-body" }, ...content),
    h("figcaption", {}, h("span", { class: "caption" }, caption), h("span", { class: "tools" }, ...(drawing ? drawingButtons(kind) : [pictureButton(kind)]), tools)),
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
export function saveText(name: string, text: string, type = "text/csv"): void {
  save(name, new Blob([text], { type }));
}

function save(name: string, content: Blob): void {
  const url = URL.createObjectURL(content);
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

/** Sections that were opened or closed by hand stay so when the page is drawn anew. */
const opened = new Map<string, boolean>();

/** A section that draws its figures when it is first opened. */
export function section(title: string, openAtFirst: boolean, fill: (body: HTMLElement) => void): HTMLElement {
  const body = h("div", { class: "figures" });
  const open = opened.get(title) ?? openAtFirst;
  const details = h("details", { open }, h("summary", {}, title), body);
  let drawn = false;
  const draw = () => {
    opened.set(title, details.open);
    if (!details.open || drawn) return;
    drawn = true;
    fill(body);
  };
  details.addEventListener("toggle", draw);
  draw();
  return details;
}
