// The page in a headless browser: views, drags, links, files, errors at their line, accessibility.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import test, { after, before } from "node:test";
import { explorer, idle, launch, motionOf, moving, serve } from "../browser.mjs";

const axePath = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
let server, browser;
before(async () => {
  server = await serve();
  browser = await launch();
});
after(async () => {
  await browser.close();
  server.close();
});

/** How many different colours a canvas has: an empty one has one. */
const colours = (page, selector) => page.locator(`${selector} canvas`).first().evaluate((canvas) => {
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height), seen = new Set();
  for (let i = 0; i < data.length; i += 4) seen.add((data[i] << 16) + (data[i + 1] << 8) + data[i + 2]);
  return seen.size;
});

async function accessible(page) {
  await page.evaluate(readFileSync(axePath, "utf8"));  // the page's own rules allow no script from elsewhere
  const { violations } = await page.evaluate(() => window.axe.run({ runOnly: ["wcag2a", "wcag2aa", "wcag21aa", "best-practice"] }));
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target.join(" ")).join(", ")}`);
}

test("every view shows the paper's motion, and nothing is fetched from elsewhere", async () => {
  const { page, faults } = await explorer(browser, server.url, "#model=vibro-impact&omega=1.5");
  assert.equal(await page.locator("#class").innerText(), "1-1-II");
  const points = await page.evaluate(() => {
    const { motion, section, diagram } = window.explorer;
    return { time: motion.time.points, phase: motion.phase.points, section: section.plot.points, diagram: diagram.plot.points };
  });
  assert.ok(points.time > 1600 && points.phase > 800, JSON.stringify(points));
  assert.equal(points.section, 3000);
  assert.ok(points.diagram > 60000, JSON.stringify(points));
  for (const view of ["#mechanism", "#time", "#phase", "#view", "#diagram"]) assert.ok((await colours(page, view)) > 5, view);
  await page.click("#tab-spectrum");
  await idle(page);
  assert.equal(await page.evaluate(() => window.explorer.spectrum.plot.points), 13);
  await page.click("#tab-forces");
  await idle(page);
  assert.ok((await page.evaluate(() => window.explorer.forces.plot.points)) > 800);
  assert.deepEqual(faults, []);
  await page.close();
});

test("a drag never blocks the page, and ends with the motion of its last value", async () => {
  const { page, faults } = await explorer(browser, server.url, "#model=vibro-impact", { until: moving });
  const slider = page.locator("#parameter-omega");
  const [still, waits] = await slider.evaluate(async (input) => {
    const beats = async (body) => {
      const gaps = [];
      let last = performance.now(), going = true;
      const beat = () => {
        gaps.push(performance.now() - last);
        last = performance.now();
        if (going) setTimeout(beat, 0);
      };
      beat();
      for (let i = 0; i < 120; ++i) {
        body(i);
        await new Promise((resolve) => setTimeout(resolve, 8));
      }
      going = false;
      return gaps.sort((a, b) => a - b)[Math.floor(gaps.length * 0.9)];
    };
    const idle_ = await beats(() => undefined);
    return [idle_, await beats((i) => {  // low frequencies too: their periods take ten times as long
      input.value = String(20 + 7 * i);
      input.dispatchEvent(new Event("input", { bubbles: true }));
    })];
  });
  await page.waitForFunction(() => !window.explorer.movesOn);
  const dragged = await motionOf(page), omega = await page.evaluate(() => window.explorer.history.now.set.omega);
  const fresh = await explorer(browser, server.url, `#model=vibro-impact&omega=${omega}`, { until: moving });
  assert.deepEqual(dragged, await motionOf(fresh.page));
  // Drawing takes time, and other programs may take the processor; a page that waits for its engine stands still at every move.
  assert.ok(waits < 60 + 5 * still, `nine of ten beats within ${waits} ms, at rest within ${still} ms`);
  await page.keyboard.press("Control+z");
  assert.equal(await page.evaluate(() => window.explorer.history.now.set.omega), undefined, "a drag is one step of undo");
  await page.keyboard.press("Control+y");
  assert.equal(await page.evaluate(() => window.explorer.history.now.set.omega), omega);
  assert.deepEqual([...faults, ...fresh.faults], []);
  await page.close();
  await fresh.page.close();
});

test("a newer diagram ends the one that is running", async () => {
  const { page, faults } = await explorer(browser, server.url, "#model=impact-oscillator");
  await page.evaluate(() => {
    const app = window.explorer;
    app.change("diagram", (draft) => { draft.diagram.count = 1800; });
  });
  await page.waitForFunction(() => window.explorer.diagram.busy);
  await page.evaluate(() => window.explorer.change("diagram", (draft) => { draft.diagram.count = 150; draft.diagram.direction = "up"; }));
  await idle(page);
  const seen = await page.evaluate(() => window.explorer.diagram.plot.csv().split("\n").slice(1, -1).map((row) => Number(row.split(",")[1])));
  assert.equal(new Set(seen).size, 150);
  assert.deepEqual(faults, []);
  await page.close();
});

test("the command line that is shown gives the numbers that are shown", async () => {
  const { page, faults } = await explorer(browser, server.url, `#model=vibro-impact&restitution=0.7&omega=4.65&page=${encodeURIComponent('{"diagram":{"count":150,"from":4,"to":5,"direction":"up"}}')}`);
  await page.keyboard.press("s");
  const command = await page.getByRole("region", { name: "Command line" }).innerText();
  const place = mkdtempSync(join(tmpdir(), "explorer-")), [classify, simulate, diagram] = command.trim().split("\n");
  const run = (line) => execFileSync("bash", ["-c", line.replace(/^slapstick/, '"$SLAPSTICK"').replace(/ --plot \S+/, "")], { cwd: place, encoding: "utf8" });
  assert.equal(JSON.parse(run(classify)).class, await page.locator("#class").innerText());
  run(diagram);
  const numbers = (text, column) => text.trim().split("\n").slice(1).map((row) => Number(row.split(",")[column]));
  const shown = await page.evaluate(() => window.explorer.diagram.plot.csv());
  const header = readFileSync(join(place, "diagram.csv"), "utf8").split("\n")[0].split(",");
  assert.deepEqual(numbers(shown, 2), numbers(readFileSync(join(place, "diagram.csv"), "utf8"), header.indexOf("w")));
  run(simulate);
  const motion = await motionOf(page), table = readFileSync(join(place, "events.csv"), "utf8").trim().split("\n");
  const names = table[0].split(","), period = (2 * Math.PI) / 4.65;
  const impacts = table.slice(1).map((row) => row.split(",")).filter((row) => row[names.indexOf("kind")] === "impact" && Number(row[0]) > 500 * period);
  assert.deepEqual(impacts.map((row) => Number(row[names.indexOf("w")])), motion.events.filter(({ kind }) => kind === "impact").map(({ w }) => w));
  assert.deepEqual(faults, []);
  await page.close();
});

test("diagrams of models without stops are the command line's too", async () => {
  const changes = { diagram: { count: 150, points: 20 } };
  for (const name of ["coulomb-oscillator", "belt"]) {
    const { page, faults } = await explorer(browser, server.url, `#model=${name}&page=${encodeURIComponent(JSON.stringify(changes))}`);
    await page.keyboard.press("s");
    const line = (await page.getByRole("region", { name: "Command line" }).innerText()).trim().split("\n").at(-1);
    const table = execFileSync("bash", ["-c", line.replace(/^slapstick/, '"$SLAPSTICK"').replace(/ --(plot|out) \S+/g, "")], { encoding: "utf8" });
    const header = table.split("\n")[0].split(","), rows = table.trim().split("\n").slice(1).map((row) => row.split(","));
    const shown = (await page.evaluate(() => window.explorer.diagram.plot.csv())).trim().split("\n").slice(1).map((row) => row.split(","));
    assert.ok(shown.length > 1000);
    for (const [direction, word] of [["going up", "up"], ["going down", "down"]])
      assert.deepEqual(shown.filter(([series]) => series === `"${direction}"`).map((row) => Number(row[2])),
        rows.filter((row) => row[header.indexOf("direction")] === word).map((row) => Number(row[header.indexOf("x")])), `${name} ${word}`);
    assert.deepEqual(faults, []);
    await page.close();
  }
});

test("a broken model is told at its line and changes nothing; a sound one is shown", async () => {
  const { page, faults } = await explorer(browser, server.url, "#model=belt", { until: moving });
  await page.getByRole("button", { name: "edit the model" }).click();
  const text = page.getByLabel("model file");
  const sound = await text.inputValue();
  await text.fill(sound.replace("mass = 1", "mass = one"));
  await page.waitForSelector(".message.wrong");
  const line = sound.split("\n").findIndex((row) => row === "mass = 1") + 1;
  assert.match(await page.locator(".message").innerText(), new RegExp(`^line ${line}: `));
  assert.equal((await page.locator(".numbers .wrong").innerText()).trim(), String(line));
  assert.ok(await page.getByRole("button", { name: "use this model" }).isDisabled());
  await text.fill(sound.replace('name = "belt"', 'name = "my belt"').replace("mass = 1", "mass = 2"));
  await page.waitForFunction(() => !document.querySelector(".message.wrong"));
  await page.getByRole("button", { name: "use this model" }).click();
  await page.waitForFunction(() => window.explorer.card.name === "my belt");
  await idle(page);
  assert.equal(await page.evaluate(() => window.explorer.card.mechanism.coordinates[0].mass), 2);
  const link = await page.evaluate(() => location.hash), motion = await motionOf(page);
  const other = await explorer(browser, server.url, link, { until: moving });
  assert.equal(await other.page.evaluate(() => window.explorer.card.name), "my belt");
  assert.deepEqual(await motionOf(other.page), motion);
  assert.deepEqual([...faults, ...other.faults], []);
  await page.close();
  await other.page.close();
});

test("a value that the model does not admit is told, and the next one works", async () => {
  const { page, faults } = await explorer(browser, server.url, "#model=vibro-impact", { until: moving });
  const number = page.getByLabel("restitution, number");
  await number.fill("1.5");
  await number.press("Enter");
  await page.waitForSelector("#failure:not([hidden])");
  assert.match(await page.locator("#failure").innerText(), /restitution.*1\.5/);
  assert.equal(await number.getAttribute("aria-invalid"), "true");
  await number.fill("0.5");
  await number.press("Enter");
  await page.waitForSelector("#failure", { state: "hidden" });
  assert.equal(await page.evaluate(() => window.explorer.history.now.set.restitution), 0.5);
  assert.deepEqual(faults, []);
  await page.close();
});

test("damaged links open the page all the same", async () => {
  for (const hash of ["#model=vibro-impact&page=%7Bbroken", "#text=!!!", "#model=vibro-impact&omega=abc"]) {
    const { page } = await explorer(browser, server.url, hash, { until: moving });
    assert.equal(await page.evaluate(() => window.explorer.card.name), "vibro-impact", hash);
    await page.close();
  }
});

test("a click in the diagram goes to that motion, play moves it, a step stands at an event", async () => {
  const { page, faults } = await explorer(browser, server.url, "#model=vibro-impact");
  const box = await page.locator("#diagram .plot").boundingBox();
  await page.locator("#diagram").scrollIntoViewIfNeeded();
  await page.locator("#diagram .plot").click({ position: { x: box.width * 0.5, y: box.height * 0.7 } });
  await idle(page);
  const settings = await page.evaluate(() => window.explorer.history.now);
  assert.ok(settings.set.omega > 4 && settings.set.omega < 6 && settings.start.length === 4, JSON.stringify(settings.set));
  await page.keyboard.press("Escape");
  await page.evaluate(() => document.activeElement.blur());
  await page.keyboard.press(".");
  const [time, events] = await page.evaluate(() => [window.explorer.player.time, window.explorer.player.window.events.map(({ time: at }) => at)]);
  assert.ok(events.includes(time));
  await page.keyboard.press(" ");
  await page.waitForFunction((from) => window.explorer.player.time > from + 0.2, time);
  await page.keyboard.press(" ");
  assert.equal(await page.evaluate(() => window.explorer.player.playing), false);
  assert.deepEqual(faults, []);
  await page.close();
});

test("people who do not see, or use no mouse, or a phone, can use it", async () => {
  for (const options of [{}, { colorScheme: "dark" }, { viewport: { width: 390, height: 844 }, hasTouch: true }]) {
    const { page, faults } = await explorer(browser, server.url, "#model=vibro-impact&omega=1.5", options);
    assert.deepEqual(await accessible(page), [], JSON.stringify(options));
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0, "the page is wider than the screen");
    await page.getByRole("button", { name: /^link, pictures/ }).click();
    assert.deepEqual(await accessible(page), [], "share");
    await page.keyboard.press("Escape");
    await page.getByRole("button", { name: "edit the model" }).click();
    await page.waitForTimeout(400);
    assert.deepEqual(await accessible(page), [], "editor");
    assert.deepEqual(faults, []);
    await page.close();
  }
});

test("saved files hold what is shown", async () => {
  const { page, faults } = await explorer(browser, server.url, "#model=belt");
  const files = await page.evaluate(async () => {
    const { explorer: app } = window, list = [];
    for (const { name, svg, png, csv } of app.saved()) {
      const parsed = new DOMParser().parseFromString(svg(), "image/svg+xml");
      list.push({ name, shapes: parsed.querySelectorAll("path, rect, polygon, circle").length, wrong: parsed.querySelectorAll("parsererror").length,
        png: png ? (await png()).size : 0, rows: csv ? csv().split("\n").length - 2 : 0 });
    }
    return list;
  });
  assert.deepEqual(files.map(({ name }) => name), ["mechanism", "time series", "phase portrait", "section", "diagram"]);
  for (const { name, shapes, wrong, png, rows } of files) {
    assert.ok(shapes > 5 && wrong === 0, name);
    if (name !== "mechanism") assert.ok(png > 3000 && rows > 50, `${name}: ${png} bytes, ${rows} rows`);
  }
  assert.deepEqual(faults, []);
  await page.close();
});
