// The command line and the Python lines that give what the page shows.
import type { ModelCard } from "./protocol.ts";
import { isText, type Settings } from "./settings.ts";

/** What every table of a diagram has. */
const ofImpacts = ["w", "flight", "sliding", "phase"];

/** A word for a POSIX shell. */
function word(text: string): string {
  return /^[A-Za-z0-9_.,:=+-]+$/.test(text) ? text : `'${text.replaceAll("'", "'\\''")}'`;
}

/** The file of an own model, as Share saves it. */
export function fileOf(card: ModelCard): string {
  return `${card.name.replaceAll(/[^A-Za-z0-9_-]/g, "-")}.toml`;
}

function namesOf(settings: Settings, card: ModelCard): { model: string; start: [string, number][] } {
  return {
    model: isText(settings.source) ? fileOf(card) : settings.source,
    start: settings.start.length > 0 ? card.state.map((name, i): [string, number] => [name, settings.start[i] ?? 0]) : [],
  };
}

function setsOf(settings: Settings, without: readonly string[] = []): [string, number][] {
  return Object.entries(settings.set).filter(([name]) => !without.includes(name));
}

export function commandLine(settings: Settings, card: ModelCard): string {
  const { model, start } = namesOf(settings, card), { motion, diagram } = settings;
  const words = (sets: [string, number][]): string => sets.map(([name, value]) => ` --set ${word(`${name}=${value}`)}`).join("");
  const state = start.length > 0 ? ` --state ${word(start.map(([name, value]) => `${name}=${value}`).join(","))}` : "";
  const lines = [
    `slapstick classify ${word(model)}${words(setsOf(settings))}${state}`,
    `slapstick simulate ${word(model)}${words(setsOf(settings))}${state} --${card.forced ? "periods" : "time"} ${motion.transient + motion.periods} --events events.csv --trajectory motion.csv`,
  ];
  const shown = ofImpacts.includes(diagram.shown) ? "" : ` --y ${word(diagram.shown)} --at ${word(diagram.at.replace(/^(impact|period)s$/, "$1"))}`;
  lines.push(`slapstick diagram ${word(model)}${words(setsOf(settings, [diagram.parameter]))} --sweep ${word(`${diagram.parameter}=${diagram.from}:${diagram.to}:${diagram.count}`)}`
    + ` --direction ${diagram.direction} --transient ${diagram.transient} --impacts ${diagram.points} --most-periods ${10 * diagram.points}${shown} --out diagram.csv --plot diagram.png`);
  return `${lines.join("\n")}\n`;
}

export function pythonLines(settings: Settings, card: ModelCard): string {
  const { model, start } = namesOf(settings, card), { motion, diagram } = settings;
  const dict = (pairs: [string, number][]): string => `{${pairs.map(([name, value]) => `${JSON.stringify(name)}: ${value}`).join(", ")}}`;
  const parameters = (sets: [string, number][]): string => (sets.length > 0 ? `, parameters=${dict(sets)}` : "");
  const from = start.length > 0 ? `, start=${dict(start)}` : "";
  const sets = parameters(setsOf(settings, [diagram.parameter])), sweep = `${diagram.parameter}=(${diagram.from}, ${diagram.to}, ${diagram.count})`;
  const sweeps = ofImpacts.includes(diagram.shown)
    ? [`diagram = slapstick.diagram(model${sets}, ${sweep},`, `                            direction="${diagram.direction}", transient=${diagram.transient}, impacts=${diagram.points}, most_periods=${10 * diagram.points})`]
    : ["# Python has diagrams of impacts and of statistics; the command line has this one too."];
  return [
    "import slapstick", "",
    `model = slapstick.load(${JSON.stringify(model)})`,
    `print(slapstick.classify(model${parameters(setsOf(settings))}${from}))`,
    `motion = slapstick.simulate(model, ${card.forced ? "periods" : "time"}=${motion.transient + motion.periods}${parameters(setsOf(settings))}${from})`,
    ...sweeps, "",
  ].join("\n");
}
