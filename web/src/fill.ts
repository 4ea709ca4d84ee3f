// What settings leave open is filled in by what the model has.
import { sliderRange } from "./numbers.ts";
import type { ModelCard } from "./protocol.ts";
import type { Settings } from "./settings.ts";
import { instantsOf } from "./views/section.ts";

export function fill(draft: Settings, card: ModelCard): void {
  const { motion, section, diagram, chart } = draft;
  const known = (name: string, other: string): string => (card.state.includes(name) ? name : other);
  const at = instantsOf(card)[0]?.value ?? "impacts";
  motion.x = known(motion.x, card.state[0] ?? "");
  motion.y = known(motion.y, card.state[1] ?? "");
  section.at ||= at;
  const ofImpacts = section.at === "impacts";
  if (!section.x) section.x = ofImpacts && card.forced ? "phase" : card.state[0] ?? "";
  if (!section.y) section.y = ofImpacts ? "w" : card.state[1] ?? "";
  const first = card.parameters.find(({ name }) => name === "omega") ?? card.parameters[0];
  if (!diagram.parameter && first) {
    const [from, to] = sliderRange(first.value, Number(first.min), Number(first.max));
    Object.assign(diagram, { parameter: first.name, from: first.minOpen && from === first.min ? to / 100 : from, to });
  }
  diagram.at ||= at;
  diagram.shown ||= diagram.at === "impacts" ? "w" : card.state[0] ?? "";
  if (!chart.x) Object.assign(chart, { x: diagram.parameter, xFrom: diagram.from, xTo: diagram.to });
  const second = card.parameters.find(({ name, expression }) => name !== chart.x && !expression);
  if (!chart.y && second) {
    const [yFrom, yTo] = sliderRange(second.value, Number(second.min), Number(second.max));
    Object.assign(chart, { y: second.name, yFrom: second.minOpen && yFrom === second.min ? yTo / 100 : yFrom, yTo });
  }
}
