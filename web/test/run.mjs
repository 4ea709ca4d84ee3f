// Runs the explorer's tests: node web/test/run.mjs PAGE test|test-all. PAGE is the built page (build/web).
// `test` is the smoke test, `test-all` adds the long ones. The program that the page is compared with is SLAPSTICK (build/slapstick).
import { spawnSync } from "node:child_process";
import { existsSync, readdirSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const [page = "build/web", mode = "test"] = process.argv.slice(2);
const program = resolve(process.env.SLAPSTICK ?? join(here, "..", "..", "build", "slapstick"));
for (const needed of [join(page, "index.html"), program]) {
  if (existsSync(needed)) continue;
  console.error(`${needed} is not there: build it first (./dev web, ./dev build)`);
  process.exit(2);
}
const files = (folder) => readdirSync(join(here, folder)).filter((name) => name.endsWith(".test.mjs")).map((name) => join(here, folder, name));
const chosen = [...files("smoke"), ...(mode === "test-all" ? files("full") : [])];
const failed = [];
for (const file of chosen) {  // one after another: each has a browser
  const { status } = spawnSync(process.execPath, ["--test", "--test-reporter=spec", file], { stdio: "inherit", env: { ...process.env, EXPLORER_PAGE: resolve(page), SLAPSTICK: program } });
  if (status !== 0) failed.push(file);
}
console.log(failed.length === 0 ? `explorer: ${chosen.length} files of tests passed` : `explorer: ${failed.length} of ${chosen.length} files failed, each with its reasons above: ${failed.join(", ")}`);
process.exit(failed.length === 0 ? 0 : 1);
