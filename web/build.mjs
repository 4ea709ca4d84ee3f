// Bundles the page: node web/build.mjs ENGINE_FOLDER OUT. ENGINE_FOLDER has engine.mjs and engine.wasm (./dev web).
import { build } from "esbuild";
import { cp, mkdir, readdir, readFile, rm, stat } from "node:fs/promises";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";

const here = dirname(fileURLToPath(import.meta.url));
const [engine, out] = process.argv.slice(2).map((path) => resolve(path));
if (!engine || !out) throw new Error("usage: node web/build.mjs ENGINE_FOLDER OUT");

await rm(out, { recursive: true, force: true });
await mkdir(out, { recursive: true });
await build({
  entryPoints: ["main", "bench", "worker"].map((name) => join(here, "src", `${name}.ts`)),
  outdir: out, bundle: true, format: "esm", target: "es2022", minify: true, legalComments: "none", logLevel: "warning",
  alias: { "slapstick-engine": join(engine, "engine.mjs") },
});
for (const name of await readdir(join(here, "page"))) await cp(join(here, "page", name), join(out, name));
await cp(join(engine, "engine.wasm"), join(out, "engine.wasm"));
await cp(join(here, "..", "models", "model.schema.json"), join(out, "model.schema.json"));

let all = 0, packed = 0;
for (const name of await readdir(out)) {
  const bytes = await readFile(join(out, name)), small = gzipSync(bytes, { level: 9 }).length;
  all += (await stat(join(out, name))).size;
  if (!name.startsWith("bench")) packed += small;
  console.log(`${name.padEnd(20)} ${String(bytes.length).padStart(9)} bytes, ${String(small).padStart(8)} compressed`);
}
console.log(`all                  ${String(all).padStart(9)} bytes; what the explorer loads first, compressed: ${packed} bytes`);
// A page of more than 1 MB is not what was promised.
if (packed > 1_000_000) throw new Error("the page is larger than 1 MB compressed");
