// The pressure in a film as the run has stored it last, asked for while it can be seen.

import type { Api, RunEntry } from "./api";
import { fieldsOnly, type DatasetText } from "../src/data";
import { h } from "../src/dom";
import { FieldMap } from "../src/field_map";
import { FilmFields, type FieldKind } from "../src/film_fields";
import { path } from "./runs_pane";
import { texts } from "./texts";

interface Film {
  t: number | null;
  datasets: Record<string, DatasetText>;
}

/** Between two looks at the results: they are written at most twice a second [ms]. */
const pause = 1000;

/** As high as the plots beside it. */
class LowMap extends FieldMap {
  constructor(
    fields: FilmFields,
    kind: FieldKind,
    private readonly low: number,
  ) {
    super(fields, kind, "instant");
  }

  protected override heightFor(): number {
    return this.low ?? 150;
  }
}

export class LiveMap {
  readonly element = h("div", { class: "live-plot live-map", "data-plot": "map", hidden: true });
  private readonly title = h("p", { class: "live-map-title" });
  private readonly holder = h("div", {});
  private run: RunEntry | null = null;
  private bearing = "";
  private height = 150;
  private drawn: LowMap | null = null;
  private instant: number | null = null;
  private asks = 0;
  private lastAsked = 0;

  constructor(private readonly api: Api) {
    this.element.append(this.title, this.holder);
    setInterval(() => {
      if (this.run?.state === "running" && performance.now() - this.lastAsked >= pause) void this.ask();
    }, pause / 2);
  }

  /** The film of a bearing of this run; its state may be another one than before. */
  show(run: RunEntry | null, bearing: string, height: number): void {
    const isOther = run?.id !== this.run?.id || bearing !== this.bearing || height !== this.height;
    const hasEnded = this.run?.state === "running" && run?.state !== "running";
    [this.run, this.bearing, this.height] = [run, bearing, height];
    if (isOther) this.clear();
    if (isOther || hasEnded) void this.ask();
  }

  private clear(): void {
    this.drawn?.destroy();
    this.drawn = null;
    this.instant = null;
    this.element.hidden = true;
    this.holder.replaceChildren();
  }

  private async ask(): Promise<void> {
    const { run, bearing } = this;
    if (!run || !bearing || !this.element.parentElement?.checkVisibility()) return;
    const count = ++this.asks;
    this.lastAsked = performance.now();
    let film: Film;
    try {
      film = await this.api.get<Film>(`/api/runs/${path(run.id)}/film?bearing=${encodeURIComponent(bearing)}`);
    } catch {
      return; // The results may be there the next time.
    }
    if (count !== this.asks || film.t === null || film.t === this.instant) return;
    this.instant = film.t;
    const fields = FilmFields.of(fieldsOnly(film.datasets), bearing);
    const kind = fields?.kinds().find(({ key }) => key === "pressure");
    if (!fields || !kind) return;
    this.drawn?.destroy();
    this.drawn = new LowMap(fields, kind, this.height);
    this.title.textContent = texts.liveMap(`${(1e3 * film.t).toPrecision(4)} ms`);
    this.element.hidden = false;
    this.holder.replaceChildren(this.drawn.element);
    this.drawn.show(0, []);
  }
}
