// The engine's bits under node: those of the program, all of them.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import test from "node:test";
import { folder, launch, open, serve } from "../browser.mjs";

const root = new URL("../../..", import.meta.url).pathname;
const stored = readFileSync(join(root, "test/bits/bits.txt"), "utf8").trim().split("\n");

test("under node twelve motions have the program's bits", async () => {
  globalThis.self = globalThis;  // the module is made for workers
  globalThis.location = { href: "file:///" };
  const { default: create } = await import(join(root, "build-wasm/engine.mjs"));
  const engine = await create({ wasmBinary: readFileSync(join(folder, "engine.wasm")) });
  assert.deepEqual(JSON.parse(new engine.Session().bits()).lines, stored);
});

test("in the browser twelve motions have the program's bits, and the bench page prints them", async (t) => {
  const [server, browser] = [await serve(), await launch()];
  t.after(async () => {
    await browser.close();
    server.close();
  });
  const { page, faults } = await open(browser, `${server.url}/bench.html?short`);
  await page.waitForFunction(() => window.bench.done === 1);
  const bench = await page.evaluate(() => window.bench);
  assert.deepEqual(bench.bits, stored);
  assert.equal((await page.locator("#bits").innerText()).trim(), stored.join("\n"));
  const { bits: _bits, ...times } = bench;
  t.diagnostic(JSON.stringify(times));
  assert.deepEqual(faults, []);
});
