// The command lines and the Python lines that the page gives are run, and have the numbers that the page shows.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { explorer, motionOf, shared } from "../browser.mjs";

/** Where ./dev python has installed the package. */
const python = process.env.SLAPSTICK_PYTHON ?? new URL("../../../build/python/tools/bin/python", import.meta.url).pathname;
const page = (changes) => `&page=${encodeURIComponent(JSON.stringify(changes))}`;
const states = [
  ["the paper's system with another restitution", `#model=vibro-impact&restitution=0.7&omega=4.65${page({ diagram: { count: 60, from: 4, to: 5, direction: "up" } })}`],
  ["a start of one's own", `#model=vibro-impact&omega=5.5${page({ start: [-0.2, 0.1, 0, 0], motion: { transient: 30 }, diagram: { count: 40, points: 20 } })}`],
  ["a mass on a belt", `#model=belt${page({ diagram: { count: 60, points: 20 } })}`],
  ["friction and no stop", `#model=coulomb-oscillator${page({ diagram: { count: 60, points: 20 } })}`],
  ["a model of one's own", "own"],
];
/** What Python's motion and diagram are, for comparison. */
const told = `
import json
impacts = [i for i, kind in enumerate(motion.events.kind) if kind == "impact"]
print(json.dumps({"t": motion.events.t.tolist(), "w": [float(motion.events.w[i]) for i in impacts], "diagram": diagram.w.tolist() if "diagram" in globals() else []}))
`;

const held = shared();

/** The page at a state, the lines that it gives, and what it shows. */
async function shown(hash) {
  const opened = await explorer(held.browser, held.server.url, hash === "own" ? "#model=impact-oscillator" : hash);
  if (hash === "own") {
    await opened.page.evaluate(() => {
      const app = window.explorer;
      app.open(app.card.text.replace('name = "impact-oscillator"', 'name = "of my own"'));
    });
    await opened.page.waitForFunction(() => window.explorer.card.name === "of my own");
    await opened.page.evaluate(() => window.explorer.change("diagram", (draft) => { Object.assign(draft.diagram, { count: 40, points: 20, direction: "up" }); draft.motion.transient = 100; }));
    await opened.page.waitForFunction(() => window.explorer.player.window && window.explorer.idle);
  }
  await opened.page.keyboard.press("s");
  const lines = (name) => opened.page.getByRole("region", { name }).innerText();
  const result = {
    commands: (await lines("Command line")).trim().split("\n"), python: await lines("Python"), label: await opened.page.locator("#class").innerText(), motion: await motionOf(opened.page),
    diagram: (await opened.page.evaluate(() => window.explorer.diagram.plot.csv())).trim().split("\n").slice(1).map((row) => row.split(",")),
    ...(await opened.page.evaluate(() => ({ begin: window.explorer.history.now.motion.transient, period: window.explorer.card.period, source: window.explorer.history.now.source, shown: window.explorer.history.now.diagram.shown }))),
  };
  assert.deepEqual(opened.faults, []);
  await opened.page.close();
  return result;
}

/** The last events are those of the page's window, at the same times but for rounding, and the impacts have the same speeds. */
function sameMotion(seen, times, speeds) {
  const { events } = seen.motion, impacts = events.filter(({ kind }) => kind === "impact").map(({ w }) => w);
  assert.ok(events.length > 0);
  times.slice(-events.length).forEach((time, i) => assert.ok(Math.abs(time / seen.period - seen.begin - events[i].time) < 1e-9 * (1 + seen.begin), `event ${i} at ${time}`));
  assert.deepEqual(speeds.slice(speeds.length - impacts.length), impacts);
}

function sameDiagram(seen, rows) {
  for (const direction of ["up", "down"])
    assert.deepEqual(rows.filter(([way]) => way === direction).map(([, value]) => value),
      seen.diagram.filter(([series]) => series === `"going ${direction}"`).map((row) => Number(row[2])), direction);
}

for (const [name, hash] of states)
  test(`${name}: the lines that are given have the numbers that are shown`, async (t) => {
    const seen = await shown(hash), place = mkdtempSync(join(tmpdir(), "explorer-")), [classify, simulate, diagram] = seen.commands;
    if (seen.source.includes("\n")) writeFileSync(join(place, /classify (\S+)/.exec(classify)[1]), seen.source);
    const run = (line) => execFileSync("bash", ["-c", line.replace(/^slapstick/, '"$SLAPSTICK"').replace(/ --plot \S+/, "")], { cwd: place, encoding: "utf8" });
    const table = (file) => {
      const [head, ...rows] = readFileSync(join(place, file), "utf8").trim().split("\n").map((row) => row.split(","));
      return { rows, column: (of) => head.indexOf(of) };
    };
    assert.equal(JSON.parse(run(classify)).class, seen.label);
    run(simulate);
    const events = table("events.csv"), [time, kind, w] = ["time", "kind", "w"].map(events.column);
    sameMotion(seen, events.rows.map((row) => Number(row[time])), events.rows.filter((row) => row[kind] === "impact").map((row) => Number(row[w])));
    run(diagram);
    const { rows, column } = table("diagram.csv");
    sameDiagram(seen, rows.map((row) => [row[column("direction")], Number(row[column(seen.shown)])]));
    if (!existsSync(python)) {
      t.diagnostic(`the Python lines were not run: ${python} is not there (./dev python)`);
      return;
    }
    writeFileSync(join(place, "lines.py"), seen.python + told);
    const [first, last] = execFileSync(python, ["lines.py"], { cwd: place, encoding: "utf8" }).trim().split("\n");
    assert.equal(/class ([^,>]+)/.exec(first)?.[1] ?? first, seen.label);
    const found = JSON.parse(last);
    sameMotion(seen, found.t, found.w);
    if (found.diagram.length > 0) assert.deepEqual(found.diagram, seen.diagram.map((row) => Number(row[2])));
    else assert.match(seen.python, /^# Python has diagrams of impacts/m);
  });
