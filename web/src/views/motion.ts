// Time series with events, and the phase portrait.
import { choice, element } from "../dom.ts";
import { short } from "../numbers.ts";
import type { Layer } from "../plot/layers.ts";
import { Plot } from "../plot/plot.ts";
import type { Palette } from "../plot/palette.ts";
import type { Player } from "../player.ts";
import type { ModelCard } from "../protocol.ts";
import type { MotionWindow } from "../window.ts";

const series = (i: number) => (colours: Palette): string => colours.series[i % colours.series.length] as string;

/** Under the curves: a strip for each contact at rest; above them: a tick for each impact. */
export function eventLayers(window: MotionWindow, card: ModelCard): Layer[] {
  const resting = card.contacts.map((contact, i) => ({ contact, rests: window.rests(i) })).filter(({ rests }) => rests.from.length > 0);
  const layers: Layer[] = resting.map(({ contact, rests }, row) => ({
    kind: "spans", name: `${contact.kind === "friction" ? "stuck at" : "contact at"} ${contact.name}`, ...rests,
    colour: (colours: Palette) => (contact.kind === "friction" ? colours.stick : colours.contact), opacity: 0.9,
    strip: [row, resting.length],
  }));
  for (const { contact, rests } of resting)
    if (contact.kind === "friction")
      layers.unshift({ kind: "spans", name: "", ...rests, colour: (colours) => colours.stick, opacity: 0.1 });
  const hits = window.events.filter(({ kind }) => kind === "impact" || kind === "engage" || kind === "chatter");
  layers.push({
    kind: "marks", name: "impacts", shape: "tick", x: hits.map(({ time }) => time), y: hits.map(() => 0),
    texts: hits.map(({ w }) => `w ${short(w)}`), colour: (colours) => colours.impact,
  });
  return layers;
}

export class MotionViews {
  readonly time: Plot;
  readonly phase: Plot;
  readonly phaseChoices = document.createElement("span");

  constructor(private readonly player: Player, private readonly choose: (axis: "x" | "y", name: string) => void) {
    this.time = new Plot({
      name: "time series of the displacements, with impacts and contacts at rest", xLabel: "time / period", yLabel: "displacement",
      pick: (x) => player.seek(x),
    });
    this.phase = new Plot({ name: "phase portrait", xLabel: "x", yLabel: "v" });
  }

  show(window: MotionWindow, card: ModelCard, x: string, y: string): void {
    const names = card.mechanism.coordinates.slice(0, 6).map(({ name }) => name);
    const unit = card.mechanism.coordinates[0]?.unit;
    this.time.xLabel = card.forced ? "time / forcing period" : "time";
    this.time.yLabel = names.length === 1 ? `${names[0]}${unit ? `  (${unit})` : ""}` : `displacement${unit ? `  (${unit})` : ""}`;
    this.time.fixedX = [0, window.periods];
    const curves = names.map((name, i): Layer => ({ kind: "line", name, x: window.time, y: window.column(name), colour: series(i) }));
    this.time.set([...eventLayers(window, card), ...curves]);
    this.legend(card, names);
    this.phase.xLabel = x;
    this.phase.yLabel = y;
    this.phase.set([{ kind: "line", name: `${y} over ${x}`, x: window.column(x), y: window.column(y), colour: series(0) }]);
    this.choices(card, x, y);
    this.frame(x, y);
  }

  frame(x: string, y: string): void {
    const { window, time } = this.player;
    this.time.cursorX = time;
    this.phase.dot = window && { x: window.at(x, time), y: window.at(y, time) };
    this.time.overlay();
    this.phase.overlay();
  }

  private legend(card: ModelCard, names: readonly string[]): void {
    const place = document.querySelector<HTMLElement>("#time-legend"), key = [card.name, ...names].join();
    if (!place || place.dataset["key"] === key) return;
    place.dataset["key"] = key;
    const has = (...kinds: string[]): boolean => card.contacts.some(({ kind }) => kinds.includes(kind));
    const items: [string, string][] = names.map((name, i) => [`series${i}`, name]);
    if (has("stop", "compliant")) items.push(["impact", "impact"], ["contact", "in contact"]);
    if (has("friction")) items.push(["stick", "stuck"]);
    place.replaceChildren(...items.map(([kind, text]) => element("span", { class: `series ${kind}` }, text)));
  }

  private choices(card: ModelCard, x: string, y: string): void {
    const key = [card.name, x, y].join();
    if (this.phaseChoices.dataset["key"] === key) return;
    this.phaseChoices.dataset["key"] = key;
    const names = card.state.map((name) => ({ value: name, text: name }));
    this.phaseChoices.replaceChildren(
      choice("vertical axis of the phase portrait", names, y, (name) => this.choose("y", name)), " over ",
      choice("horizontal axis of the phase portrait", names, x, (name) => this.choose("x", name)),
    );
  }
}
