// Lines of a cycle's spectrum, or the power density of a motion that has no cycle.
import { choice } from "../dom.ts";
import type { Lane } from "../lane.ts";
import { Plot } from "../plot/plot.ts";
import type { Model, ModelCard, Spectrum } from "../protocol.ts";
import type { Settings } from "../settings.ts";

const highestOrder = 12;

export class SpectrumView {
  readonly plot = new Plot({ name: "spectrum", xLabel: "frequency / forcing frequency", yLabel: "amplitude" });
  readonly choices = document.createElement("span");

  constructor(private readonly lane: Lane, private readonly pick: (quantity: string) => void) {}

  run(model: Model, card: ModelCard, settings: Settings): void {
    const quantity = settings.spectrum || (card.state[0] ?? "");
    this.show(card, quantity);
    this.plot.note = "computing the cycle and its lines";
    this.plot.redraw();
    this.lane.question<Spectrum>({ verb: "spectrum", model, quantity, highestOrder }).then(({ kind, label, order, height }) => {
      this.plot.note = "";
      this.plot.xLabel = card.forced ? "frequency / forcing frequency" : kind === "lines" ? "frequency / frequency of the cycle" : "frequency";
      this.plot.yLabel = kind === "lines" ? `amplitude of ${quantity}` : `log10 of the power density of ${quantity}`;
      if (!height.some((one) => Number.isFinite(one))) this.plot.note = "the engine has no number for this spectrum";
      const name = kind === "lines" ? `line of the cycle ${label}` : "density";
      if (kind === "lines") this.plot.set([{ kind: "stems", name, x: order, y: height, colour: (colours) => colours.series[0] as string }]);
      else this.plot.set([{ kind: "line", name, x: order, y: height.map((one) => (one > 0 ? Math.log10(one) : NaN)), colour: (colours) => colours.series[0] as string }]);
    }, (error: { message: string }) => {
      this.plot.note = error.message;
      this.plot.set([]);
    });
  }

  private show(card: ModelCard, quantity: string): void {
    const key = [card.name, quantity].join();
    if (this.choices.dataset["key"] === key) return;
    this.choices.dataset["key"] = key;
    const names = card.quantities.filter(({ atImpacts }) => !atImpacts).map(({ name, meaning }) => ({ value: name, text: `${name}  ${meaning}` }));
    this.choices.replaceChildren("of ", choice("quantity of the spectrum", names, quantity, this.pick));
  }
}
