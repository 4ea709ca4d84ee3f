// Long tests of the page: every model, the stories from first to last step, random moves without error or leak, pictures.
import assert from "node:assert/strict";
import test from "node:test";
import { explorer, idle, shared } from "../browser.mjs";

const held = shared();

test("every built-in model is shown: a mechanism, a motion, a class, a diagram", async () => {
  const { page, faults } = await explorer(held.browser, held.server.url, "#model=belt");
  const names = await page.getByLabel("model", { exact: true }).locator("option").evaluateAll((options) => options.map(({ value }) => value).filter(Boolean));
  assert.ok(names.length >= 27);
  for (const name of names) {
    await page.evaluate((source) => window.explorer.open(source), name);
    await page.waitForFunction((wanted) => window.explorer.card?.name === wanted, name);
    await idle(page);
    const seen = await page.evaluate(() => ({
      time: window.explorer.motion.time.points, label: document.querySelector("#class").textContent, diagram: window.explorer.diagram.plot.points,
      failure: document.querySelector("#failure").textContent, note: window.explorer.diagram.plot.note,
    }));
    assert.ok(seen.time > 100 && seen.label && seen.failure === "", `${name}: ${JSON.stringify(seen)}`);
    assert.ok(seen.diagram > 0 || seen.note !== "", `${name}: ${JSON.stringify(seen)}`);
  }
  assert.deepEqual(faults, []);
  await page.close();
});

test("stories go from the first step to the last", async () => {
  const { page, faults } = await explorer(held.browser, held.server.url, "#model=vibro-impact");
  const keys = await page.getByRole("combobox", { name: "guided story" }).locator("option").evaluateAll((options) => options.map(({ value }) => value).filter(Boolean));
  assert.equal(keys.length, 6);
  for (const key of keys) {
    await page.getByRole("combobox", { name: "guided story" }).selectOption("");
    await page.getByRole("combobox", { name: "guided story" }).selectOption(key);
    for (;;) {
      await idle(page);
      assert.equal(await page.evaluate(() => { const told = document.querySelector("#failure"); return !told || told.hidden ? "" : told.innerText; }), "", key);
      const told = await page.locator("#story").getAttribute("data-motion");
      if (told) assert.equal(await page.locator("#class").innerText(), told, `${key}: ${await page.locator("#story-step").innerText()}`);
      const { motion, section, chart, diagram } = await page.evaluate(() => window.explorer.history.now);
      for (const axis of [motion.x, motion.y, section.x, section.y, chart.x, chart.y, diagram.parameter]) assert.notEqual(axis, "", `${key}: an axis without a name`);
      const next = page.locator("#story").getByRole("button", { name: "next step" });
      if (!(await next.isVisible())) break;
      await next.click();
    }
    const [at, all] = (await page.locator("#story-step").innerText()).split(" of ");
    assert.equal(at, all, key);
    await page.locator("#story").getByRole("button", { name: "end of the story" }).click();
  }
  assert.deepEqual(faults, []);
  await page.close();
});

test("200 random moves of random sliders make no error and no leak", async () => {
  const { page, faults } = await explorer(held.browser, held.server.url, "#model=vibro-impact");
  const heap = async () => {
    const session = await page.context().newCDPSession(page);
    await session.send("HeapProfiler.collectGarbage");
    const { usedSize } = await session.send("Runtime.getHeapUsage");
    await session.detach();
    return usedSize;
  };
  const moves = (seed, count) => page.evaluate(async ([from, many]) => {
    let state = from;
    const random = () => (state = (state * 1103515245 + 12345) % 2147483648) / 2147483648;
    const sliders = [...document.querySelectorAll(".parameter input[type=range]")];
    for (let i = 0; i < many; ++i) {
      const slider = sliders[Math.floor(random() * sliders.length)];
      slider.value = String(Math.floor(random() * 2001));
      slider.dispatchEvent(new Event("input", { bubbles: true }));
      await new Promise((resolve) => setTimeout(resolve, random() < 0.2 ? 300 : 20));
    }
  }, [seed, count]);
  await moves(7, 60);
  await page.evaluate(() => window.explorer.open("vibro-impact"));
  await idle(page);
  const before_ = await heap();
  await moves(11, 200);
  await page.evaluate(() => window.explorer.open("vibro-impact"));
  await idle(page);
  const grown = (await heap()) - before_;
  assert.ok(grown < 12e6, `the page's memory has grown by ${(grown / 1e6).toFixed(1)} MB`);
  assert.ok(page.workers().length <= 9, `${page.workers().length} workers`);  // seven lanes and two of the diagram
  assert.deepEqual(faults, []);
  await page.close();
});

test("a chart fills in, coarse and then fine, and agrees with the class of the motion", async () => {
  const page_ = { view: "chart", chart: { size: 60 } };
  const { page, faults } = await explorer(held.browser, held.server.url, `#model=vibro-impact&omega=2.2&page=${encodeURIComponent(JSON.stringify(page_))}`);
  await page.waitForFunction(() => window.explorer.chart.known() === 3600);
  assert.equal(await page.evaluate(() => window.explorer.chart.classAt(2.2, 0.15)), await page.locator("#class").innerText());
  assert.deepEqual(faults, []);
  await page.close();
});
