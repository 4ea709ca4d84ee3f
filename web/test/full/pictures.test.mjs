// Every view looks as it did when somebody looked at it: web/test/full/pictures holds what was seen.
// EXPLORER_PICTURES=renew writes the pictures anew; look at each before it is committed.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import test from "node:test";
import { drawn, explorer, shared } from "../browser.mjs";

const folder = new URL("pictures/", import.meta.url).pathname;
/** Share of pixels that may differ: letters and edges are drawn a little differently by every version of a browser. */
const tolerance = 0.015;
const small = (changes) => `&page=${encodeURIComponent(JSON.stringify({ diagram: { count: 300 }, ...changes }))}`;
const views = [
  ["mechanism", `#model=vibro-impact&omega=1.5${small({})}`, "#mechanism"],
  ["belt", `#model=belt${small({})}`, "#mechanism"],
  ["time", `#model=vibro-impact&omega=1.5${small({})}`, "#time"],
  ["phase", `#model=vibro-impact&omega=1.5${small({})}`, "#phase"],
  ["diagram", `#model=vibro-impact&omega=1.5${small({})}`, "#diagram"],
  ["section", `#model=impact-oscillator&omega=2.95${small({})}`, "#view"],
  ["spectrum", `#model=vibro-impact&omega=1.5${small({ view: "spectrum" })}`, "#view"],
  ["forces", `#model=stick-slip-impact${small({ view: "forces" })}`, "#view"],
];

const held = shared();

/** Share of pixels in which two PNG files differ by more than a fifth of a channel. */
async function difference(page, first, second) {
  return page.evaluate(async (files) => {
    const [a, b] = await Promise.all(files.map(async (file) => {
      const image = new Image();
      image.src = `data:image/png;base64,${file}`;
      await image.decode();
      const canvas = new OffscreenCanvas(image.width, image.height), context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, image.width, image.height);
    }));
    if (a.width !== b.width || a.height !== b.height) return 1;
    let count = 0;
    for (let i = 0; i < a.data.length; i += 4) count += [0, 1, 2].some((k) => Math.abs(a.data[i + k] - b.data[i + k]) > 51);
    return (4 * count) / a.data.length;
  }, [first.toString("base64"), second.toString("base64")]);
}

async function picture(hash, selector) {
  const { page, faults } = await explorer(held.browser, held.server.url, hash);
  await drawn(page);
  const shot = await page.locator(selector).screenshot();
  assert.deepEqual(faults, []);
  return { page, shot };
}

for (const [name, hash, selector] of views)
  test(`${name} looks as it did`, async () => {
    const { page, shot } = await picture(hash, selector);
    if (process.env.EXPLORER_PICTURES === "renew") writeFileSync(`${folder}${name}.png`, shot);
    const share = await difference(page, shot, readFileSync(`${folder}${name}.png`));
    assert.ok(share < tolerance, `${(100 * share).toFixed(2)} % of the pixels differ`);
    await page.close();
  });

test("another motion would be noticed", async () => {
  const { page, shot } = await picture(`#model=vibro-impact&omega=1.6${small({})}`, "#time");
  const share = await difference(page, shot, readFileSync(`${folder}time.png`));
  assert.ok(share > 1.5 * tolerance, `only ${(100 * share).toFixed(2)} % of the pixels differ`);
  await page.close();
});
