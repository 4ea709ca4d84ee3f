// A chart of two parameters: what the motion is at each pixel; curves of special points lie over it.
import { choice, element } from "../dom.ts";
import { Lane } from "../lane.ts";
import { short, symbol } from "../numbers.ts";
import { Pixels } from "../pixels.ts";
import type { Hit, Layer } from "../plot/layers.ts";
import { isDark } from "../plot/palette.ts";
import { Plot } from "../plot/plot.ts";
import type { Curve, Model, ModelCard } from "../protocol.ts";
import type { Settings } from "../settings.ts";

type Cells = Extract<Layer, { kind: "cells" }>;

/** A colour for a class: hue by the periods, lightness by the impacts, stripes of their own for stick. */
export function colourOf(name: string, dark: boolean): string {
  const found = /^(\d+)-(\d+|∞)-(I+)$/.exec(name);
  if (name === "failed") return dark ? "#39424b" : "#d8dde2";
  if (!found) return name === "no short cycle" || name === "chaotic" ? (dark ? "#06090c" : "#2a2f36") : dark ? "#56616c" : "#aab4be";
  const n = Number(found[1]), p = found[2] === "∞" ? 8 : Number(found[2]), sticks = found[3] === "II";
  const hue = (205 + 137.5 * (n - 1) + (sticks ? 28 : 0)) % 360;
  const light = dark ? 34 + 6 * Math.min(p, 5) : 80 - 7 * Math.min(p, 6);
  return `hsl(${hue} ${sticks ? 72 : 48}% ${light}%)`;
}

/** A curve between two parameters, by their names. */
interface Drawn {
  key: string;
  curve: Curve;
  first: string;
  second: string;
}

export class ChartView {
  readonly plot: Plot;
  readonly choices = document.createElement("span");
  readonly legend = element("div", { class: "legend" });
  private readonly lanes = Array.from({ length: Math.max(1, Math.min(8, navigator.hardwareConcurrency)) }, () => new Lane());
  private readonly picture = element("canvas");
  private cells: Cells | undefined;
  private pixels: Pixels | undefined;
  /** For how many columns and rows each pixel was drawn. */
  private sizes = new Uint8Array();
  private wish: Settings["chart"] | undefined;
  private curves: Drawn[] = [];
  private key = "";
  private readonly counts = new Map<string, number>();
  private shown: string[] = [];
  private waits = false;

  /** @param go  a click: both values */
  constructor(private readonly go: (x: number, y: number) => void, private readonly edit: (change: (chart: Settings["chart"]) => void) => void) {
    this.plot = new Plot({
      name: "chart of two parameters", xLabel: "", yLabel: "",
      pick: (x, y) => {
        const wish = this.wish;
        if (wish && x >= wish.xFrom && x <= wish.xTo && y >= wish.yFrom && y <= wish.yTo) this.go(x, y);
      },
      read: (x, y, hit) => `${symbol(this.wish?.x ?? "")} = ${short(x)}, ${symbol(this.wish?.y ?? "")} = ${short(y)}: ${this.curveAt(hit) || this.classAt(x, y)}`,
    });
  }

  run(model: Model, card: ModelCard, settings: Settings): void {
    const wish = settings.chart, { size } = wish;
    this.stop();
    this.wish = wish;
    this.offer(card, wish);
    this.plot.xLabel = symbol(wish.x);
    this.plot.yLabel = symbol(wish.y);
    this.plot.note = "";
    const set = Object.fromEntries(Object.entries(model.set).filter(([name]) => name !== wish.x && name !== wish.y));
    this.key = keyOf(model, wish.x, wish.y);
    this.picture.width = this.picture.height = size;
    this.sizes = new Uint8Array(size * size);
    this.counts.clear();
    this.shown = Array<string>(size * size).fill("");
    const pixels = new Pixels(this.lanes, { ...model, set, start: [] }, wish, (pixel, of) => this.take(pixel, of), () => this.later());
    this.pixels = pixels;
    this.cells = {
      kind: "cells", name: "chart", columns: size, rows: size, box: { x0: wish.xFrom, x1: wish.xTo, y0: wish.yFrom, y1: wish.yTo },
      picture: this.picture, names: pixels.names,
    };
    this.layers();
    pixels.run().catch((error: { message: string }) => {
      this.plot.note = error.message;
      this.plot.redraw();
    });
  }

  stop(): void {
    this.pixels?.stop();
  }

  /** Draws a curve of a special point over the chart. */
  add(model: Model, curve: Curve, first: string, second: string): void {
    this.curves.push({ key: keyOf(model, first, second), curve, first, second });
    this.layers();
  }

  private layers(): void {
    this.curves = this.curves.filter(({ key }) => key === this.key || this.key === "");
    if (this.cells) this.plot.set([this.cells, ...this.curves.flatMap((one) => curveLayers(one, this.wish?.x ?? ""))]);
  }

  private curveAt(hit: Hit | undefined): string {
    const met = this.curves.flatMap(({ curve }) => curve.met);
    return hit?.layer.kind === "marks" ? met.find(({ type, values }) => type === hit.layer.name && values.includes(hit.x))?.what ?? "" : hit?.layer.name ?? "";
  }

  private take(pixel: number, size: number): void {
    const before = this.shown[pixel] ?? "", name = this.pixels?.names[pixel] ?? "";
    if (before !== "") this.counts.set(before, (this.counts.get(before) ?? 1) - 1);
    this.counts.set(name, (this.counts.get(name) ?? 0) + 1);
    this.shown[pixel] = name;
    this.sizes[pixel] = size;
    this.paint(pixel);
    this.later();
  }

  private paint(pixel: number): void {
    const context = this.picture.getContext("2d"), rows = this.picture.height, size = this.sizes[pixel] as number;
    if (!context) return;
    context.fillStyle = colourOf(this.shown[pixel] ?? "", isDark());
    const column = pixel % rows, row = (pixel - column) / rows;
    context.fillRect(column, rows - row - size, size, size);
  }

  /** Pixels come by the thousand: they are shown once a frame. */
  private later(): void {
    if (this.waits) return;
    this.waits = true;
    requestAnimationFrame(() => {
      this.waits = false;
      this.explain();
      this.plot.redraw();
    });
  }

  recolour(): void {
    for (const size of [8, 4, 2, 1]) this.sizes.forEach((of, pixel) => { if (of === size) this.paint(pixel); });
    this.later();
  }

  /** The commonest classes with their colours, and how far the chart is. */
  private explain(): void {
    const first = [...this.counts].filter(([, count]) => count > 0).sort((a, b) => b[1] - a[1]).slice(0, 9);
    const items = first.map(([name]) => {
      const item = element("span", { class: "swatch" }, name);
      item.style.setProperty("--swatch", colourOf(name, isDark()));
      return item;
    });
    const share = this.known() / Math.max(this.shown.length, 1);
    this.legend.replaceChildren(...items, share < 1 ? element("span", { class: "share-known" }, `${Math.floor(100 * share)} % computed`) : "");
  }

  /** How many pixels are known. */
  known(): number {
    return this.pixels?.known ?? 0;
  }

  /** Nothing is left to compute. */
  get finished(): boolean {
    return this.pixels?.finished ?? false;
  }

  classAt(x: number, y: number): string {
    const { wish, pixels } = this;
    if (!wish || !pixels) return "";
    const near = (value: number, from: number, to: number): number => Math.min(Math.max(Math.round(((value - from) / (to - from)) * (wish.size - 1)), 0), wish.size - 1);
    const column = near(x, wish.xFrom, wish.xTo), row = near(y, wish.yFrom, wish.yTo), pixel = row * wish.size + column;
    if (pixels.names[pixel]) return pixels.names[pixel];
    const coarse = pixels.at(pixel) || pixels.at((row - (row % 8)) * wish.size + column - (column % 8));
    return coarse ? `${coarse}, as its neighbours` : "not yet known";
  }

  private offer(card: ModelCard, wish: Settings["chart"]): void {
    const key = [card.name, wish.x, wish.y, wish.size].join();
    if (this.choices.dataset["key"] === key) return;
    this.choices.dataset["key"] = key;
    const names = [...card.parameters.map(({ name }) => name), ...card.groups.map(({ name }) => name)].map((name) => ({ value: name, text: symbol(name) }));
    this.choices.replaceChildren(
      choice("vertical parameter of the chart", names, wish.y, (name) => this.edit((chart) => { chart.y = name; })), " over ",
      choice("horizontal parameter of the chart", names, wish.x, (name) => this.edit((chart) => { chart.x = name; })), " ",
      choice("pixels of the chart", [60, 120, 200, 300].map((size) => ({ value: String(size), text: `${size} × ${size}` })), String(wish.size),
        (size) => this.edit((chart) => { chart.size = Number(size); })),
    );
  }
}

/** What a curve holds for: all values but those of its two parameters. */
function keyOf(model: Model, ...names: string[]): string {
  const others = Object.entries(model.set).filter(([name]) => !names.includes(name));
  return JSON.stringify([model.source, others, [...names].sort()]);
}

/** A curve, broken where its orbits are no motions, its type and its points of codimension two. */
function curveLayers({ curve, first }: Drawn, across: string): Layer[] {
  const turned = first !== across, of = (a: number, b: number): [number, number] => (turned ? [b, a] : [a, b]);
  const points = curve.first.map((value, i) => (curve.motion[i] === 1 ? of(value, curve.second[i] as number) : [NaN, NaN] as [number, number]));
  const x = points.map(([value]) => value), y = points.map(([, value]) => value);
  const known = points.map((_, i) => i).filter((i) => curve.motion[i] === 1), middle = known[Math.floor(known.length / 2)];
  const line = (width: number, colour: "ground" | "ink"): Layer => ({ kind: "line", name: `curve of ${curve.type}`, x, y, width, colour: (colours) => colours[colour] });
  const marks = curve.met.map(({ type, values: [a = 0, b = 0] }): Layer => {
    const [u, v] = of(a, b);
    return { kind: "marks", name: type, x: [u], y: [v], texts: [type], shape: "diamond", colour: (colours) => colours.impact };
  });
  const named: Layer[] = middle === undefined ? [] : [{
    kind: "marks", name: `curve of ${curve.type}`, x: [x[middle] as number], y: [y[middle] as number], texts: [curve.type], shape: "diamond", colour: (colours) => colours.impact,
  }];
  return [line(4.5, "ground"), line(2, "ink"), ...marks, ...named];
}
