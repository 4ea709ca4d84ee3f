// The bench page: times of what a person waits for, and the bits of the engine in this browser.
import { element } from "./dom.ts";
import { Lane } from "./lane.ts";
import { Pixels, type Stage } from "./pixels.ts";
import type { Model, Part } from "./protocol.ts";
import { settingsOf } from "./settings.ts";

/** Frequencies of the paper's motions. */
const frequencies = [0.552, 1.5, 2.2, 2.7, 3.0, 4.1, 4.65, 4.803, 5.5, 9.0];

const results: Record<string, number | string[]> = {};
(window as unknown as { bench: typeof results }).bench = results;

function row(name: string, value: string): void {
  document.querySelector("#speed")?.append(element("tr", {}, element("th", { scope: "row" }, name), element("td", {}, value)));
}

function model(omega: number): Model {
  return { source: "vibro-impact", set: { omega }, start: [] };
}

/** Runs a job. @returns milliseconds until its first part and its end */
function timed(lane: Lane, request: Parameters<Lane["ask"]>[0], use: (part: Part) => void = () => undefined): Promise<{ first: number; all: number }> {
  const begun = performance.now();
  let first = 0;
  return new Promise((resolve, reject) => lane.ask(request, {
    part: (part) => {
      first ||= performance.now() - begun;
      use(part);
    },
    done: () => resolve({ first, all: performance.now() - begun }),
    error: reject,
  }));
}

const median = (list: number[]): number => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)] ?? 0;

async function motions(lane: Lane): Promise<void> {
  const times: number[] = [];
  for (let round = 0; round < 5; ++round)
    for (const omega of frequencies)
      times.push((await timed(lane, { verb: "motion", model: model(omega), wish: { transient: 500, periods: 4, samples: 400, of: "" } })).all);
  results["drag"] = median(times.slice(frequencies.length));
  row("A drag: 504 periods of the motion, ten frequencies, median", `${results["drag"].toFixed(1)} ms`);
  for (const omega of [2.2, 0.552]) {
    const { all } = await timed(lane, { verb: "motion", model: model(omega), wish: { transient: 20000, periods: 1, samples: 1, of: "" } });
    results[`period ${omega}`] = all / 20000;
    row(`A period at ω = ${omega}`, `${((1000 * all) / 20000).toFixed(2)} µs`);
  }
  row("… of the program's scalar kernel, to compare", "time SLAPSTICK_TARGET=scalar slapstick simulate vibro-impact --set omega=2.2 --periods 1000000");
}

async function diagrams(lane: Lane): Promise<void> {
  const wish = { parameter: "omega", from: 0.5, to: 10, count: 900, transient: 100, points: 60, down: false, shown: "w", at: "impacts" };
  const { first, all } = await timed(lane, { verb: "diagram", model: model(2.2), wish });
  Object.assign(results, { "first column": first, diagram: all });
  row("A diagram of 900 values, one direction: first values", `${first.toFixed(0)} ms`);
  row("… complete", `${(all / 1000).toFixed(2)} s`);
}

const stages: Record<Stage, string> = {
  coarse: "every eighth pixel", picture: "all borders of classes", all: "every pixel for itself", more: "… with 300 periods where 100 find no cycle",
};

async function chart(): Promise<void> {
  const lanes = Array.from({ length: Math.max(1, Math.min(8, navigator.hardwareConcurrency)) }, () => new Lane()), begun = performance.now();
  row("A chart of 300 × 300 pixels, 100 periods each", `${lanes.length} workers`);
  const reached = (stage: Stage): void => {
    results[`chart ${stage}`] = performance.now() - begun;
    row(stages[stage], `${((performance.now() - begun) / 1000).toFixed(1)} s`);
  };
  await new Pixels(lanes, model(2.2), { ...settingsOf("vibro-impact").chart, size: 300 }, () => undefined, reached).run();
  lanes.forEach((lane) => lane.close());
}

/** What a first visit loads, compressed as a server would. */
async function size(): Promise<void> {
  let bytes = 0;
  for (const name of ["index.html", "style.css", "main.js", "worker.js", "engine.wasm", "model.schema.json", "icon.svg"]) {
    const { body } = await fetch(name);
    if (body) bytes += (await new Response(body.pipeThrough(new CompressionStream("gzip"))).arrayBuffer()).byteLength;
  }
  results["size"] = bytes;
  row("First load, compressed", `${(bytes / 1000).toFixed(0)} kB`);
}

async function run(): Promise<void> {
  const lane = new Lane(), begun = performance.now();
  await lane.question({ verb: "models" });
  results["load"] = performance.now() - begun;
  row("Loading and compiling the engine", `${results["load"].toFixed(0)} ms`);
  await size();
  await motions(lane);
  await diagrams(lane);
  const { lines } = await lane.question<{ lines: string[] }>({ verb: "bits" });
  results["bits"] = lines;
  const place = document.querySelector("#bits");
  if (place) place.textContent = lines.join("\n");
  if (!new URLSearchParams(location.search).has("short")) await chart();
  results["done"] = 1;
}

run().catch((error: unknown) => row("failed", String((error as { message?: string }).message ?? error)));
