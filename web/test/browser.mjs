// A plain file server and a headless browser for the tests; what goes wrong in the page fails the test.
import { createReadStream, existsSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { after, before } from "node:test";
import { chromium } from "playwright-core";

/** A guard against what hangs, in milliseconds; no test says with it how fast something is. */
export const hangs = 600000;
/** The built page. */
export const folder = process.env.EXPLORER_PAGE ?? new URL("../../build/web", import.meta.url).pathname;
const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json", ".svg": "image/svg+xml" };

/** Serves the page as the plainest server would: .wasm has no type of its own. */
export function serve() {
  const server = createServer((request, response) => {
    const { pathname } = new URL(request.url, "http://localhost");
    const path = join(folder, pathname.endsWith("/") ? "index.html" : pathname);
    if (!path.startsWith(folder) || !existsSync(path)) {
      response.writeHead(404).end();
      return;
    }
    response.writeHead(200, { "content-type": types[extname(path)] ?? "application/octet-stream" });
    createReadStream(path).pipe(response);
  });
  return new Promise((resolve) => server.listen(0, "127.0.0.1", () => resolve({ url: `http://127.0.0.1:${server.address().port}`, close: () => server.close() })));
}

export function launch() {
  const executablePath = process.env.CHROMIUM ?? "/usr/bin/chromium";
  return chromium.launch({ executablePath, args: ["--no-sandbox", "--disable-gpu", "--force-color-profile=srgb", "--font-render-hinting=none"] });
}

/** The server and the browser of a file of tests, from its first test to its last. */
export function shared() {
  const both = {};
  before(async () => {
    both.server = await serve();
    both.browser = await launch();
  });
  after(async () => {
    await both.browser.close();
    both.server.close();
  });
  return both;
}

/** A page that notes what no page of ours may have: errors, requests to other hosts. */
export async function open(browser, url, options = {}) {
  const page = await browser.newPage({ viewport: { width: 1440, height: 1000 }, colorScheme: "light", reducedMotion: "reduce", ...options });
  page.setDefaultTimeout(hangs);
  const faults = [];
  page.on("pageerror", (error) => faults.push(`error: ${error.message}`));
  page.on("console", (message) => {
    // The page asks whether a model was opened with it (opened.toml); a file server says that there is none.
    if (message.type() === "error" && !message.location().url.endsWith("opened.toml")) faults.push(`console: ${message.text()}`);
  });
  page.on("request", (request) => {
    if (!request.url().startsWith(new URL(url).origin) && !/^(data|blob):/.test(request.url())) faults.push(`fetched from elsewhere: ${request.url()}`);
  });
  await page.goto(url);
  return { page, faults };
}

/** Waits until a motion is shown and nothing is computed. */
export async function idle(page) {
  await page.waitForFunction(() => window.explorer?.player.window && window.explorer.idle);
}

/** Waits until a motion is shown; sections and diagrams may still grow. */
export async function moving(page) {
  await page.waitForFunction(() => window.explorer?.player.window);
}

/** Waits until the page has drawn what it has. */
export function drawn(page) {
  return page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(() => requestAnimationFrame(resolve)))));
}

/** The explorer, open and at rest, or as soon as a motion is shown. */
export async function explorer(browser, url, hash = "", { until = idle, ...options } = {}) {
  const opened = await open(browser, `${url}/index.html${hash}`, options);
  await until(opened.page);
  return opened;
}

/** The motion that is shown, all numbers. */
export function motionOf(page) {
  return page.evaluate(() => {
    const { window: shown } = window.explorer.player, { card } = window.explorer;
    return { time: [...shown.time], state: card.state.map((name) => [...shown.column(name)]), events: shown.events };
  });
}
