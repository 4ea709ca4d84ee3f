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
let failed = 0;
for (const file of chosen) {  // one after another: each has a browser
  const { status } = spawnSync(process.execPath, ["--test", file], { stdio: "inherit", env: { ...process.env, EXPLORER_PAGE: resolve(page), SLAPSTICK: program } });
  failed += status === 0 ? 0 : 1;
}
console.log(failed === 0 ? `explorer: ${chosen.length} files of tests passed` : `explorer: ${failed} of ${chosen.length} files failed`);
process.exit(failed === 0 ? 0 : 1);
