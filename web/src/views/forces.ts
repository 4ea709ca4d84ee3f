// Forces, powers and energies along the motion: what the engine measures, chosen by name.
import { choice } from "../dom.ts";
import type { Layer } from "../plot/layers.ts";
import { Plot } from "../plot/plot.ts";
import type { ModelCard } from "../protocol.ts";
import type { Settings } from "../settings.ts";
import type { MotionWindow } from "../window.ts";
import { eventLayers } from "./motion.ts";

/** The quantities that are shown: the chosen ones, or the forces of friction contacts and stops. */
export function forcesOf(card: ModelCard, settings: Settings): string[] {
  const known = settings.forces.filter((name) => card.quantities.some((one) => one.name === name));
  if (known.length > 0) return known;
  // A rigid stop has no force but where it is closed: what it takes is impulses.
  const rigid = new Set(card.contacts.filter(({ kind }) => kind === "stop").map((contact) => `F_${contact.name}`));
  const forces = card.quantities.filter((one) => one.kind === "force" && !rigid.has(one.name)).map(({ name }) => name);
  return forces.length > 0 ? forces.slice(0, 3) : ["kinetic_energy", "potential_energy"];
}

export class ForcesView {
  readonly plot: Plot;
  readonly choices = document.createElement("span");

  constructor(seek: (time: number) => void, private readonly pick: (names: string[]) => void) {
    this.plot = new Plot({ name: "forces and powers over time", xLabel: "time / period", yLabel: "force", pick: (x) => seek(x) });
  }

  show(window: MotionWindow, card: ModelCard, names: readonly string[]): void {
    this.plot.xLabel = card.forced ? "time / forcing period" : "time";
    this.plot.yLabel = names.length <= 2 ? names.join(", ") : "several quantities";
    this.plot.fixedX = [0, window.periods];
    const lines = names.map((name, i): Layer => ({ kind: "line", name, x: window.time, y: window.column(name), colour: (colours) => colours.series[i % colours.series.length] as string }));
    this.plot.set([...eventLayers(window, card), ...lines]);
    this.offer(card, names);
  }

  private offer(card: ModelCard, names: readonly string[]): void {
    const key = [card.name, ...names].join();
    if (this.choices.dataset["key"] === key) return;
    this.choices.dataset["key"] = key;
    const chips = names.map((name, i) => {
      const chip = document.createElement("button");
      chip.type = "button";
      chip.className = `chip series series${i}`;
      chip.textContent = `${name} ×`;
      chip.title = `remove ${name}`;
      chip.addEventListener("click", () => this.pick(names.filter((one) => one !== name)));
      return chip;
    });
    const others = card.quantities.filter(({ atImpacts, name }) => !atImpacts && !names.includes(name));
    this.choices.replaceChildren(...chips, choice("add a quantity", [
      { value: "", text: "add …" }, ...others.map(({ name, meaning }) => ({ value: name, text: `${name}  ${meaning}` })),
    ], "", (name) => {
      if (name) this.pick([...names, name].slice(-6));
    }));
  }
}
