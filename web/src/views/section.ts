// A Poincare section that fills in: at impacts, once a period, or at events of one kind.
import { choice } from "../dom.ts";
import type { Lane } from "../lane.ts";
import { type Layer, Numbers } from "../plot/layers.ts";
import { Plot } from "../plot/plot.ts";
import type { Model, ModelCard } from "../protocol.ts";
import type { Settings } from "../settings.ts";

/** What a section's row holds before the state. */
const fixed = ["phase", "w", "flight", "contact"];

/** When sections and diagrams can be read of a model. */
export function instantsOf(card: ModelCard): { value: string; text: string }[] {
  const list: { value: string; text: string }[] = [];
  const has = (kind: string): boolean => card.contacts.some((contact) => contact.kind === kind);
  if (has("stop") || has("compliant")) list.push({ value: "impacts", text: "at impacts" });
  if (card.forced) list.push({ value: "periods", text: "once a period" });
  if (has("friction")) list.push({ value: "stick", text: "where stick begins" }, { value: "release", text: "where stick ends" });
  if (has("friction") && card.mechanism.compliant.length > 0) list.push({ value: "unload", text: "where the load ends" });
  return list;
}

/** Do the points come back to a few? */
function isFew(x: Numbers, y: Numbers): boolean {
  const seen = new Set<string>();
  for (let i = 0; i < x.length && seen.size <= 40; ++i) seen.add(`${x.at(i).toPrecision(6)} ${y.at(i).toPrecision(6)}`);
  return seen.size <= 40;
}

export class SectionView {
  readonly plot = new Plot({ name: "Poincare section", xLabel: "", yLabel: "" });
  readonly choices = document.createElement("span");

  constructor(private readonly lane: Lane, private readonly edit: (change: (section: Settings["section"]) => void) => void) {}

  run(model: Model, card: ModelCard, settings: Settings): void {
    const { at, x, y, points } = settings.section;
    const names = at === "impacts" ? ["phase", "w", "flight", ...card.state] : card.state;
    this.show(card, settings, names);
    const layer: Extract<Layer, { kind: "dots" }> = { kind: "dots", name: "section", x: new Numbers(), y: new Numbers(), colour: (colours) => colours.series[0] as string, size: 2, opacity: 0.75 };
    const column = (name: string): number => (fixed.includes(name) ? fixed.indexOf(name) : 4 + card.state.indexOf(name));
    const [cx, cy] = [column(x), column(y)];
    this.plot.xLabel = x === "phase" ? "phase of the impact / period" : x;
    this.plot.yLabel = y === "w" ? "impact speed w" : y;
    this.plot.note = "";
    this.plot.set([layer]);
    if (instantsOf(card).length === 0) {
      this.plot.note = "this model has no section: no stop, no forcing, no friction";
      return;
    }
    this.lane.ask({ verb: "section", model, wish: { at, transient: card.forced ? Math.max(settings.motion.transient, 100) : settings.motion.transient, points, phase: 0 } }, {
      part: ({ rows, width }) => {
        for (let i = 0; i < rows.length; i += width) {
          layer.x.push(rows[i + cx] as number);
          layer.y.push(rows[i + cy] as number);
        }
        this.plot.more();
      },
      done: (failure) => {
        if (layer.x.length === 0) this.plot.note = failure || "no point of this section was found";
        if (isFew(layer.x, layer.y)) layer.size = 6;  // a cycle: points that all can be seen
        this.plot.settle();
      },
      error: (error) => {
        this.plot.note = error.message;
        this.plot.redraw();
      },
    });
  }

  private show(card: ModelCard, settings: Settings, names: readonly string[]): void {
    const { at, x, y } = settings.section, key = [card.name, at, x, y].join();
    if (this.choices.dataset["key"] === key) return;
    this.choices.dataset["key"] = key;
    const list = names.map((name) => ({ value: name, text: name }));
    this.choices.replaceChildren(
      choice("vertical axis of the section", list, y, (name) => this.edit((section) => { section.y = name; })), " over ",
      choice("horizontal axis of the section", list, x, (name) => this.edit((section) => { section.x = name; })), " ",
      choice("when the section is read", instantsOf(card), at, (value) => this.edit((section) => {
        section.at = value;
        const known = value === "impacts" ? ["phase", "w", "flight", ...card.state] : card.state;
        if (!known.includes(section.x)) section.x = value === "impacts" ? "phase" : card.state[0] ?? "";
        if (!known.includes(section.y)) section.y = value === "impacts" ? "w" : card.state[1] ?? "";
      })),
    );
  }
}
