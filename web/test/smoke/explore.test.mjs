// `slapstick explore`: the page on the loopback, and nothing else to nobody else.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, symlinkSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { connect } from "node:net";
import { networkInterfaces, tmpdir } from "node:os";
import { join } from "node:path";
import test from "node:test";
import { explorer, folder, hangs, launch } from "../browser.mjs";

const program = process.env.SLAPSTICK, place = mkdtempSync(join(tmpdir(), "explore-")), page = join(place, "page");
cpSync(folder, page, { recursive: true });
writeFileSync(join(place, "secret.txt"), "secret");
symlinkSync("../secret.txt", join(page, "link.txt"));

async function started(t, ...more) {
  const child = spawn(program, ["explore", ...more, "--page", page, "--no-browser"], { stdio: ["ignore", "pipe", "pipe"] });
  const address = await new Promise((resolve, reject) => {
    child.stdout.once("data", (bytes) => resolve(String(bytes).trim()));
    child.once("exit", (status) => reject(new Error(`status ${status}`)));
  });
  t.after(() => child.kill("SIGKILL"));
  return { child, address, port: Number(new URL(address).port) };
}

/** A request as it is written, without the tidying of URLs. */
function get(port, path, { host = `127.0.0.1:${port}`, method = "GET" } = {}) {
  return new Promise((resolve, reject) => {
    const asked = request({ port, path, method, host: "127.0.0.1", headers: { host } }, (response) => {
      let body = "";
      response.on("data", (bytes) => { body += bytes; }).on("end", () => resolve({ status: response.statusCode, type: response.headers["content-type"], body }));
    });
    asked.on("error", reject).end();
  });
}

/** Bytes as they are, and what comes back. */
function raw(port, bytes) {
  return new Promise((resolve, reject) => {
    let answer = "";
    connect(port, "127.0.0.1").on("data", (more) => { answer += more; }).on("end", () => resolve(answer)).on("error", reject).write(bytes);
  });
}

test("serves the page, and refuses other hosts, other paths and other methods", async (t) => {
  const { child, port } = await started(t);
  assert.deepEqual([(await get(port, "/")).status, (await get(port, "/engine.wasm")).type], [200, "application/wasm"]);
  assert.equal((await get(port, "/", { host: `localhost:${port}` })).status, 200);
  for (const host of ["evil.example", `evil.example:${port}`, "127.0.0.1", `127.0.0.1.evil.example:${port}`])
    assert.equal((await get(port, "/", { host })).status, 403, host);
  assert.match(await raw(port, "GET / HTTP/1.0\r\n\r\n"), /^HTTP\/1\.. 403/, "a request that names no host");
  for (const path of ["/../secret.txt", "/%2e%2e/secret.txt", "/..%2fsecret.txt", "/a/../../secret.txt", "/link.txt", "/./../secret.txt", "//etc/passwd", "/%00", "/opened.toml"]) {
    const { status, body } = await get(port, path);
    assert.ok(status >= 400 && !body.includes("secret"), `${path}: ${status}`);
  }
  assert.notEqual((await get(port, "/", { method: "POST" })).status, 200);
  for (const { address } of Object.values(networkInterfaces()).flat().filter(({ internal, family }) => !internal && family === "IPv4"))
    await assert.rejects(new Promise((resolve, reject) => connect(port, address, resolve).on("error", reject)), `${address} is listened to`);
  const second = spawnSync(program, ["explore", "--port", String(port), "--page", page, "--no-browser"], { timeout: hangs });
  assert.equal(second.status, 4, "a port that another explorer has");
  child.kill("SIGINT");
  assert.equal(await new Promise((resolve) => child.on("exit", resolve)), 0, "Ctrl-C is its end");
});

test("opens a model file in the page", async (t) => {
  const model = join(place, "mine.toml"), browser = await launch();
  t.after(() => browser.close());
  writeFileSync(model, spawnSync(program, ["show", "belt"], { encoding: "utf8" }).stdout.replace('name = "belt"', 'name = "mine"'));
  const { address } = await started(t, model);
  const opened = await explorer(browser, address.replace(/\/$/, ""));
  assert.equal(await opened.page.evaluate(() => window.explorer.card.name), "mine");
  assert.deepEqual(opened.faults, []);
});

test("says in one line what is wrong", () => {
  const run = (...words) => spawnSync(program, ["explore", ...words], { encoding: "utf8" });
  const unknown = run("vibro-impct", "--page", page), lost = run("--page", join(place, "nowhere")), port = run("--port", "70000", "--page", page);
  assert.deepEqual([unknown.status, lost.status, port.status], [2, 4, 2]);
  assert.match(unknown.stderr, /vibro-impact/);
  assert.match(lost.stderr, /dev web/);
  for (const { stderr } of [unknown, lost, port]) assert.equal(stderr.trim().split("\n").length, 1);
});
