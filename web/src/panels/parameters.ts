// A slider and a number for every parameter, with its range, unit and meaning.
import { element } from "../dom.ts";
import { short, sliderRange, symbol } from "../numbers.ts";
import type { ModelCard, Parameter } from "../protocol.ts";
import type { Settings } from "../settings.ts";

interface Row {
  name: string;
  slider: HTMLInputElement;
  number: HTMLInputElement;
  reset: HTMLButtonElement;
  from: number;
  to: number;
  host: HTMLElement;
}

/** Positions of a slider: fine enough for a drag, and for arrow keys. */
const positions = 2000;

function bound(value: number | string): number {
  return typeof value === "number" ? value : value === "-inf" ? -Infinity : Infinity;
}

export class ParametersPanel {
  readonly host = element("div", { class: "parameters" });
  private rows = new Map<string, Row>();
  private key = "";

  /** @param set  a new value, or undefined for the model's own; @param choose  the diagram runs over it */
  constructor(private readonly set: (name: string, value: number | undefined) => void, private readonly choose: (name: string, from: number, to: number) => void) {}

  show(card: ModelCard, settings: Settings): void {
    const swept = settings.diagram.parameter;
    const key = JSON.stringify([settings.source, swept, settings.diagram.from, settings.diagram.to]);
    if (key !== this.key) {
      this.key = key;
      this.build(card, settings);
    }
    for (const row of this.rows.values()) this.refresh(row, this.valueOf(row.name, card), settings.set[row.name] !== undefined);
  }

  /** A value that cannot be used is marked with the engine's words. */
  blame(message: string): void {
    for (const row of this.rows.values()) {
      const guilty = message !== "" && new RegExp(`\\b${row.name}\\b`).test(message);
      row.number.setAttribute("aria-invalid", String(guilty));
    }
  }

  /** The ends of a parameter's slider. */
  range(name: string): [number, number] | undefined {
    const row = this.rows.get(name);
    return row && [row.from, row.to];
  }

  focusFirst(): void {
    this.host.querySelector<HTMLInputElement>("input[type=range]")?.focus();
  }

  private build(card: ModelCard, settings: Settings): void {
    this.rows = new Map();
    const grouped = card.groups.map((group): Parameter => {
      const member = card.parameters.find(({ name }) => name === group.members[0]) as Parameter;
      return { ...member, name: group.name, expression: "", meaning: `sets ${group.members.join(" and ")} together`, value: this.valueOf(group.name, card) };
    });
    const all = [...card.parameters, ...grouped];
    all.sort((a, b) => Number(b.name === settings.diagram.parameter) - Number(a.name === settings.diagram.parameter));
    this.host.replaceChildren(...all.map((parameter) => this.row(parameter, settings)));
  }

  private row(parameter: Parameter, settings: Settings): HTMLElement {
    const { name, meaning, unit } = parameter;
    const swept = settings.diagram.parameter === name;
    const [from, to] = sliderRange(parameter.value, bound(parameter.min), bound(parameter.max), swept ? [settings.diagram.from, settings.diagram.to] : undefined);
    const id = `parameter-${name}`;
    const slider = element("input", { type: "range", min: 0, max: positions, step: 1, "aria-label": `${name}, slider`, id });
    const number = element("input", { type: "text", inputmode: "decimal", "aria-label": `${name}, number`, spellcheck: "false", autocomplete: "off" });
    const reset = element("button", { type: "button", class: "plain", title: `the model's own value of ${name}`, "aria-label": `reset ${name}`, click: () => this.set(name, undefined) }, "↺");
    const sweep = element("button", {
      type: "button", class: swept ? "plain chosen" : "plain", title: `the diagram runs over ${name}`, "aria-label": `diagram over ${name}`, "aria-pressed": String(swept),
      click: () => this.choose(name, from, to),
    }, "⟷");
    const host = element("div", { class: "parameter", title: `${meaning}${parameter.expression ? `; follows ${parameter.expression} until it is set` : ""}. Range ${parameter.range}` },
      element("label", { for: id }, symbol(name)), number, reset, sweep,
      element("span", { class: "meaning" }, `${meaning.split(";")[0] ?? ""}${unit ? `  (${unit})` : ""}`), slider);
    const row: Row = { name, slider, number, reset, from, to, host };
    slider.addEventListener("input", () => this.set(name, this.clipped(row.from + (Number(slider.value) / positions) * (row.to - row.from), parameter)));
    number.addEventListener("change", () => {
      const value = Number(number.value.replace("−", "-").replace(",", "."));
      if (number.value.trim() !== "" && Number.isFinite(value)) this.set(name, value);
      else number.setAttribute("aria-invalid", "true");
    });
    this.rows.set(name, row);
    return host;
  }

  /** Sliders give round numbers: a step is the power of ten below a position. */
  private clipped(value: number, parameter: Parameter): number {
    const row = this.rows.get(parameter.name) as Row;
    const step = 10 ** Math.floor(Math.log10((row.to - row.from) / positions) + 0.31);
    const rounded = Number((Math.round(value / step) * step).toPrecision(12));
    const least = bound(parameter.min), most = bound(parameter.max);
    if (rounded <= least) return parameter.minOpen ? least + step : least;
    return rounded >= most ? (parameter.maxOpen ? most - step : most) : rounded;
  }

  private refresh(row: Row, value: number, own: boolean): void {
    if (value < row.from || value > row.to) [row.from, row.to] = [Math.min(row.from, value), Math.max(row.to, value)];
    const position = String(Math.round(((value - row.from) / (row.to - row.from)) * positions));
    if (document.activeElement !== row.slider && row.slider.value !== position) row.slider.value = position;
    row.slider.setAttribute("aria-valuetext", short(value, 6));
    if (document.activeElement !== row.number) row.number.value = String(value);
    row.reset.style.visibility = own ? "visible" : "hidden";
    row.host.classList.toggle("own", own);
  }

  /** Of a group: that of its first member. */
  private valueOf(name: string, card: ModelCard): number {
    const group = card.groups.find((one) => one.name === name);
    return card.parameters.find((one) => one.name === (group ? group.members[0] : name))?.value ?? 0;
  }
}
