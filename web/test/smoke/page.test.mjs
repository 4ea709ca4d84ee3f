// The page in a headless browser: views, drags, links, files, errors at their line, accessibility.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import test from "node:test";
import { explorer, idle, motionOf, moving, shared } from "../browser.mjs";

const axePath = createRequire(import.meta.url).resolve("axe-core/axe.min.js");
const held = shared();

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
  const { page, faults } = await explorer(held.browser, held.server.url, "#model=vibro-impact&omega=1.5");
  assert.equal(await page.locator("#class").innerText(), "1-1-II");
  assert.equal(await page.locator("#class-here").innerText(), "1-1-II");
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
  const { page, faults } = await explorer(held.browser, held.server.url, "#model=vibro-impact", { until: moving });
  // A motion of a thousand million periods: the page goes on living beside it, and the next move ends it.
  const beats = await page.evaluate(async () => {
    const app = window.explorer;
    app.change("after", (draft) => { draft.set.omega = 0.552; draft.motion.transient = 1e9; });
    let count = 0;
    while (app.movesOn && count < 50) {
      await new Promise((resolve) => requestAnimationFrame(resolve));
      ++count;
    }
    app.change("after", (draft) => { draft.motion.transient = 500; });
    return count;
  });
  assert.equal(beats, 50, "frames that the page draws while its engine computes");
  await page.waitForFunction(() => !window.explorer.movesOn);
  await page.locator("#parameter-omega").evaluate(async (input) => {
    for (let i = 0; i < 120; ++i) {  // low frequencies too: their periods take ten times as long
      input.value = String(20 + 7 * i);
      input.dispatchEvent(new Event("input", { bubbles: true }));
      await new Promise((resolve) => setTimeout(resolve, 8));
    }
  });
  await page.waitForFunction(() => !window.explorer.movesOn);
  const dragged = await motionOf(page), omega = await page.evaluate(() => window.explorer.history.now.set.omega);
  const fresh = await explorer(held.browser, held.server.url, `#model=vibro-impact&omega=${omega}`, { until: moving });
  assert.deepEqual(dragged, await motionOf(fresh.page));
  await page.keyboard.press("Control+z");
  assert.equal(await page.evaluate(() => window.explorer.history.now.set.omega), 0.552, "a drag is one step of undo");
  await page.keyboard.press("Control+y");
  assert.equal(await page.evaluate(() => window.explorer.history.now.set.omega), omega);
  assert.deepEqual([...faults, ...fresh.faults], []);
  await page.close();
  await fresh.page.close();
});

test("a newer diagram ends the one that is running", async () => {
  const { page, faults } = await explorer(held.browser, held.server.url, "#model=impact-oscillator");
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

test("a broken model is told at its line and changes nothing; a sound one is shown", async () => {
  const { page, faults } = await explorer(held.browser, held.server.url, "#model=belt", { until: moving });
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
  const other = await explorer(held.browser, held.server.url, link, { until: moving });
  assert.equal(await other.page.evaluate(() => window.explorer.card.name), "my belt");
  assert.deepEqual(await motionOf(other.page), motion);
  assert.deepEqual([...faults, ...other.faults], []);
  await page.close();
  await other.page.close();
});

test("a value that the model does not admit is told, and the next one works", async () => {
  const { page, faults } = await explorer(held.browser, held.server.url, "#model=vibro-impact", { until: moving });
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
    const { page } = await explorer(held.browser, held.server.url, hash, { until: moving });
    assert.equal(await page.evaluate(() => window.explorer.card.name), "vibro-impact", hash);
    await page.close();
  }
});

test("a click in the diagram goes to that motion, play moves it, a step stands at an event", async () => {
  const { page, faults } = await explorer(held.browser, held.server.url, "#model=vibro-impact");
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

test("a click on a special point starts its branch, and a button its curve over the chart", async () => {
  // x'' = -g + a g sin t on a table with r: one bounce a period doubles at a^2 = (pi (1-r)/(1+r))^2 + (2 (1+r^2)/(1+r)^2)^2.
  const doubling = (r) => Math.hypot((Math.PI * (1 - r)) / (1 + r), (2 * (1 + r * r)) / (1 + r) ** 2);
  const state = { diagram: { from: 1.1, to: 1.8, count: 150 }, chart: { size: 60, xFrom: 1, xTo: 2, yFrom: 0.3, yTo: 0.7 } };
  const { page, faults } = await explorer(held.browser, held.server.url, `#model=shaken-table&acceleration=1.3&page=${encodeURIComponent(JSON.stringify(state))}`);
  await page.locator("#branch").click();
  await page.waitForFunction(() => window.explorer.diagram.hasBranch && window.explorer.idle);
  const place = await page.evaluate(() => {
    const { diagram } = window.explorer, { left, top, width, height, view } = diagram.plot.frame(), { value, shown: [w] } = diagram.branches[0].special[0];
    return { value, x: left + ((value - view.x0) / (view.x1 - view.x0)) * width, y: top + height - ((w - view.y0) / (view.y1 - view.y0)) * height };
  });
  assert.ok(Math.abs(place.value - doubling(0.5)) < 1e-9, `${place.value}`);
  await page.locator("#diagram .plot").hover({ position: place });
  assert.match(await page.locator("#diagram .tip").innerText(), /^PD at acceleration = 1\.5268237: period doubling/);
  await page.mouse.wheel(0, 100);
  assert.match(await page.locator("#diagram .tip").innerText(), /^Ctrl \+ wheel zooms/);
  await page.locator("#diagram .plot").click({ position: place });
  assert.ok(await page.locator("#diagram .tip").isHidden());
  await page.waitForFunction(() => window.explorer.diagram.branches.length === 2 && window.explorer.idle);
  const born = await page.evaluate(() => window.explorer.diagram.branches[1].points.map(({ label, value }) => [label, value]));
  assert.ok(born.length > 10 && born.every(([label, value]) => label === "2-2-I" && value > place.value - 1e-9), JSON.stringify(born.slice(0, 3)));
  await page.getByRole("button", { name: "follow this point when a second parameter varies" }).click();
  await page.waitForFunction(() => window.explorer.chart.curves.length === 1);
  const { first, second } = await page.evaluate(() => window.explorer.chart.curves[0].curve);
  assert.ok(first.length > 20 && Math.min(...second) < 0.35 && Math.max(...second) > 0.65);
  first.forEach((a, i) => assert.ok(Math.abs(a - doubling(second[i])) < 1e-8, `${a} at r = ${second[i]}`));
  await page.waitForFunction(() => window.explorer.chart.finished);
  assert.equal(await page.evaluate(() => window.explorer.chart.classAt(1.3, 0.5)), "1-1-I");
  await page.locator("#branch").click();
  await page.waitForFunction(() => !window.explorer.diagram.hasBranch);
  assert.deepEqual(faults, []);
  await page.close();
});

test("the button says whether the motion plays, also after a mass was dragged", async () => {
  const { page, faults } = await explorer(held.browser, held.server.url, "#model=vibro-impact&omega=1.5", { until: moving });
  const play = page.locator("#transport .main"), box = await page.locator("#mechanism").boundingBox();
  await page.evaluate(() => { window.explorer.player.speed = 0; });  // it plays, and the masses stay where they are
  await play.click();
  assert.equal(await play.getAttribute("aria-label"), "pause (space)");
  const body = await page.evaluate(() => {  // where the cursor says that there is a mass
    const host = document.querySelector(".mechanism"), { left, top, width, height } = host.getBoundingClientRect();
    for (let x = 0; x < width; x += 5) {
      host.dispatchEvent(new PointerEvent("pointermove", { clientX: left + x, clientY: top + height / 2 }));
      if (host.style.cursor === "grab") return x + 20;
    }
    return -1;
  });
  assert.ok(body > 0);
  await page.mouse.move(box.x + body, box.y + box.height / 2);
  await page.mouse.down();
  assert.equal(await play.getAttribute("aria-label"), "play (space)", "a mass that is held stands still");
  await page.mouse.move(box.x + body - 30, box.y + box.height / 2, { steps: 3 });
  await page.mouse.up();
  assert.equal(await play.getAttribute("aria-label"), "pause (space)", "a mass that is let go moves");
  assert.equal(await page.evaluate(() => window.explorer.player.playing), true);
  assert.equal(await page.evaluate(() => window.explorer.history.now.start.length), 4);
  assert.deepEqual(faults, []);
  await page.close();
});

test("people who do not see, or use no mouse, or a phone, can use it", async () => {
  for (const options of [{}, { colorScheme: "dark" }, { viewport: { width: 390, height: 844 }, hasTouch: true }]) {
    const { page, faults } = await explorer(held.browser, held.server.url, "#model=vibro-impact&omega=1.5", options);
    assert.deepEqual(await accessible(page), [], JSON.stringify(options));
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth - innerWidth)) <= 0, "the page is wider than the screen");
    await page.getByRole("button", { name: /^link, pictures/ }).click();
    assert.deepEqual(await accessible(page), [], "share");
    await page.keyboard.press("Escape");
    await page.getByRole("button", { name: "edit the model" }).click();
    await page.waitForFunction(() => document.querySelector(".editor .message").textContent !== "");
    assert.deepEqual(await accessible(page), [], "editor");
    assert.deepEqual(faults, []);
    await page.close();
  }
});

test("saved files hold what is shown", async () => {
  const { page, faults } = await explorer(held.browser, held.server.url, "#model=belt");
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
