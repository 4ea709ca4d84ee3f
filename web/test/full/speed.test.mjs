// WebAssembly beside the program's scalar kernel, by processor time: other programs may have the machine too.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import test from "node:test";
import { folder } from "../browser.mjs";

const root = new URL("../../..", import.meta.url).pathname;

/** Seconds of the program for so many periods. */
function native(omega, periods) {
  const line = `TIMEFORMAT=%U; time "$SLAPSTICK" simulate vibro-impact --set omega=${omega} --periods ${periods} 2>/dev/null >/dev/null`;
  return Number(execFileSync("bash", ["-c", `{ ${line}; } 2>&1`], { encoding: "utf8", env: { ...process.env, SLAPSTICK_TARGET: "scalar" } }));
}

test("a period costs no more than 2.5 times that of the program", async (t) => {
  globalThis.self = globalThis;  // the module is made for workers
  globalThis.location = { href: "file:///" };
  const { default: create } = await import(join(root, "build-wasm/engine.mjs"));
  const engine = new (await create({ wasmBinary: readFileSync(join(folder, "engine.wasm")) })).Session();
  for (const [omega, periods] of [[2.2, 300000], [0.552, 20000]]) {
    const ratios = [1, 2, 3].map(() => {
      engine.beginMotion({ source: "vibro-impact", set: { omega }, start: [] }, { transient: periods, periods: 1, samples: 1, of: "" });
      const begun = process.cpuUsage().user;
      while (!engine.advance(100));
      return (process.cpuUsage().user - begun) / 1e6 / native(omega, periods);
    });
    t.diagnostic(`omega = ${omega}: ${ratios.map((ratio) => ratio.toFixed(2)).join(", ")}`);
    assert.ok(Math.min(...ratios) < 2.5, `omega = ${omega}: ${ratios}`);
  }
});
