// What to begin with: the templates and examples as cards with their pictures, drawn from their texts when they come into
// sight.

import { Refused, sentences, type Api, type BearingScene, type Template } from "./api";
import { Run } from "../src/data";
import { h } from "../src/dom";
import { dialog } from "./dialogs";
import { WorkbenchMachine } from "./machine";
import type { SceneText } from "./machine_pane";
import { texts } from "./texts";

export interface Beginning {
  template?: string;
  example?: string;
  path: string;
}

interface Card extends Template {
  isExample: boolean;
}

/** Pictures that have been made, by the key of their card; they are the same as long as the program runs. */
const made = new Map<string, string>();
const keyOf = ({ name, isExample }: Card) => (isExample ? `example ${name}` : name);

/**
 * Which template or example, and what the file is called; null where nothing is begun.
 * @param create  makes it; what it refuses, such as a name that there is, is said in the window, which stays open
 */
export function askBeginning(api: Api, templates: Template[], examples: Template[], create: (wanted: Beginning) => Promise<void>): Promise<Beginning | null> {
  return new Promise((resolve) => {
    let answer: Beginning | null = null;
    const cards: Card[] = [...templates.map((t) => ({ ...t, isExample: false })), ...examples.map((t) => ({ ...t, isExample: true }))];
    const preview = h("pre", { class: "template-text", tabindex: 0, "aria-label": texts.templates.preview });
    const path = h("input", { type: "text", required: true, spellcheck: "false", autocomplete: "off", id: "template-path", "aria-describedby": "template-refusal" });
    const hint = h("p", { class: "note" }, texts.templates.words);
    const refusal = h("p", { class: "field-fault", role: "alert", id: "template-refusal", hidden: true });
    const allow = () => {
      refusal.hidden = true;
      path.removeAttribute("aria-invalid");
    };
    const pictures = new Pictures(api);
    let chosen: Card | undefined;
    const choose = (card: Card) => {
      chosen = card;
      preview.textContent = card.text;
      preview.scrollTop = 0;
      allow();
      path.value = card.isExample ? card.name : `${card.name.split("/").pop()}.yaml`;
      hint.textContent = card.isExample ? texts.templates.exampleWords : texts.templates.words;
    };
    const shown: { element: HTMLElement; radio: HTMLInputElement; words: string }[] = [];
    const cardOf = (card: Card) => {
      const radio = h("input", { type: "radio", name: "template", value: keyOf(card) });
      radio.addEventListener("change", () => choose(card));
      const image = h("img", { alt: "", width: 150, height: 96 });
      const element = h("label", { class: "card" }, radio, image, h("span", { class: "card-title" }, card.title || card.name), h("span", { class: "card-name" }, card.name));
      pictures.watch(card, image, element);
      shown.push({ element, radio, words: `${card.title} ${card.name} ${/^description:.*$/m.exec(card.text)?.[0] ?? ""}`.toLowerCase() });
      return element;
    };
    const group = (title: string, list: Card[]) => (list.length > 0 ? h("fieldset", { class: "cards" }, h("legend", {}, title), ...list.map(cardOf)) : null);
    const list = h("div", { class: "template-list", role: "group", "aria-label": texts.templates.choose }, group(texts.templates.templates, cards.filter((c) => !c.isExample)), group(texts.templates.examples, cards.filter((c) => c.isExample)));
    const nothing = h("p", { class: "note", role: "status", hidden: true }, texts.templates.nothing);
    const search = h("input", { type: "search", class: "card-search", placeholder: texts.templates.search, "aria-label": texts.templates.search, autocomplete: "off", spellcheck: "false" });
    // Cards with all the words; the first of them is chosen where the chosen one is not among them.
    const find = () => {
      const words = search.value.toLowerCase().split(/\s+/);
      for (const card of shown) card.element.hidden = !words.every((word) => card.words.includes(word));
      for (const cards of list.querySelectorAll<HTMLElement>(".cards")) cards.hidden = cards.querySelector(".card:not([hidden])") === null;
      const found = shown.filter(({ element }) => !element.hidden);
      nothing.hidden = found.length > 0;
      if (found.length > 0 && !found.some(({ radio }) => radio.checked)) found[0]!.radio.click();
    };
    search.addEventListener("input", find);
    search.addEventListener("keydown", (event) => {
      if (event.key === "Enter") event.preventDefault();
    });
    const form = h(
      "form",
      { method: "dialog" },
      hint,
      search, nothing, h("div", { class: "template-choice" }, list, preview),
      h("div", { class: "window-tools" }, h("label", { for: "template-path" }, texts.templates.path), path, h("button", { type: "submit", class: "main-button" }, texts.templates.create)),
      refusal,
    );
    let isBusy = false;
    const submit = async () => {
      if (!chosen || isBusy) return;
      isBusy = true;
      const wanted = { ...(chosen.isExample ? { example: chosen.name } : { template: chosen.name }), path: path.value.trim() };
      try {
        await create(wanted);
        answer = wanted;
        window.close();
      } catch (error) {
        refusal.textContent = error instanceof Refused ? sentences(error) : error instanceof Error ? error.message : String(error);
        refusal.hidden = false;
        path.setAttribute("aria-invalid", "true");
        path.focus();
        path.select();
      }
      isBusy = false;
    };
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      void submit();
    });
    path.addEventListener("input", () => allow());
    const window = dialog(texts.templates.title, "templates", form);
    pictures.begin(list, window);
    const first = list.querySelector<HTMLInputElement>("input");
    if (first && cards[0]) {
      first.checked = true;
      choose(cards[0]);
      first.focus();
    }
    window.addEventListener("close", () => {
      pictures.end();
      resolve(answer);
    });
  });
}

/** One machine behind the scenes stands for all pictures, one after the other. */
class Pictures {
  private readonly waiting = new Map<Element, { card: Card; image: HTMLImageElement }>();
  private readonly stage = h("div", { class: "picture-stage", "aria-hidden": "true" });
  private observer: IntersectionObserver | null = null;
  private queue: Element[] = [];
  private machine: WorkbenchMachine | null = null;
  private isBusy = false;
  private isOver = false;

  constructor(private readonly api: Api) {}

  watch(card: Card, image: HTMLImageElement, element: Element): void {
    const known = made.get(keyOf(card));
    if (known) image.src = known;
    else this.waiting.set(element, { card, image });
  }

  begin(root: Element, window: HTMLElement): void {
    window.append(this.stage);
    this.observer = new IntersectionObserver(
      (seen) => {
        for (const { target, isIntersecting } of seen) {
          this.queue = this.queue.filter((element) => element !== target);
          if (isIntersecting) this.queue.push(target);
        }
        void this.work();
      },
      { root },
    );
    for (const element of this.waiting.keys()) this.observer.observe(element);
  }

  end(): void {
    this.isOver = true;
    this.observer?.disconnect();
    this.machine?.destroy();
  }

  private async work(): Promise<void> {
    if (this.isBusy) return;
    this.isBusy = true;
    for (let element = this.queue.shift(); element && !this.isOver; element = this.queue.shift()) {
      const wanted = this.waiting.get(element);
      this.waiting.delete(element);
      this.observer?.unobserve(element);
      if (!wanted) continue;
      const { card, image } = wanted;
      try {
        const { scene } = await this.api.post<{ scene: SceneText }>("/api/template", card.isExample ? { example: card.name } : { template: card.name });
        const address = this.isOver ? null : await this.draw(scene);
        if (!address) continue;
        made.set(keyOf(card), address);
        image.src = address;
      } catch {
        // A card without a picture.
      }
    }
    this.isBusy = false;
  }

  private async draw(scene: SceneText): Promise<string | null> {
    const run = new Run(scene);
    const bearings = Object.values(scene.bearings ?? {});
    if (run.children("/bodies").length === 0) return bearings[0] ? drawingOf(bearings[0]) : null;
    const marks = { loads: (scene.loads ?? []), frames: {}, plain: true };
    if (this.machine) this.machine.take(run, marks);
    else {
      this.machine = new WorkbenchMachine(run, marks, () => undefined);
      this.stage.append(this.machine.space);
      for (let i = 0; i < 100 && !this.machine.wasShown; i++) await new Promise((resolve) => setTimeout(resolve, 20));
    }
    return this.machine.wasShown ? this.machine.photograph() : null;
  }
}

/** A bearing by itself: journal and shell in section, with its holes and grooves; a plane one with them from above. */
function drawingOf(bearing: BearingScene): string {
  const style = getComputedStyle(document.documentElement);
  const colour = (name: string) => style.getPropertyValue(name).trim();
  const [steel, oil, mark] = [colour("--series-1"), colour("--line"), colour("--accent")];
  const isRound = bearing.along === "phi" && bearing.across === "z" && bearing.grid.closes;
  const at = (phi: number, radius: number) => `${(75 + radius * Math.cos(phi)).toFixed(1)} ${(48 - radius * Math.sin(phi)).toFixed(1)}`;
  const arc = (phi: number, half: number) => `<path d="M${at(phi - half, 37)} A37 37 0 ${half > 1.57 ? 1 : 0} 0 ${at(phi + half, 37)}" stroke="${mark}" stroke-width="5" fill="none"/>`;
  const round = () =>
    `<circle cx="75" cy="48" r="44" fill="${oil}"/><circle cx="75" cy="48" r="34" fill="none" stroke="${colour("--paper")}" stroke-width="3"/><circle cx="77" cy="51" r="31" fill="${steel}"/>` +
    bearing.features.map(({ phi, arc: extent }) => arc(phi, Math.min(3.1, Math.max(0.12, extent / 2)))).join("") +
    (bearing.supply?.at === "angle" ? arc(bearing.supply.phi, 0.05) : "");
  const plane = () => {
    const { along, across } = bearing.grid;
    const [low, high, bottom, top] = [along[0]!, along[along.length - 1]!, across[0]!, across[across.length - 1]!];
    const [x, y] = [(v: number) => 15 + (120 * (v - low)) / (high - low || 1), (v: number) => 84 - (72 * (v - bottom)) / (top - bottom || 1)];
    const lines = along.filter((_, i) => i % Math.ceil(along.length / 12) === 0).map((v) => `<path d="M${x(v)} 12V84" stroke="${colour("--paper")}"/>`);
    const boxes = bearing.features.map((f) => `<rect x="${x(f.phi - f.arc / 2)}" y="${y(f.z + f.length / 2)}" width="${Math.max(2, x(f.phi + f.arc / 2) - x(f.phi - f.arc / 2))}" height="${Math.max(2, y(f.z - f.length / 2) - y(f.z + f.length / 2))}" fill="${mark}"/>`);
    return `<rect x="15" y="12" width="120" height="72" fill="${steel}" fill-opacity="0.5"/>${lines.join("")}${boxes.join("")}`;
  };
  return `data:image/svg+xml;charset=utf-8,${encodeURIComponent(`<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 150 96" width="150" height="96">${isRound ? round() : plane()}</svg>`)}`;
}
