// A chart of two parameters: what the motion is at each pixel, coarse at once and then finer, on all workers.
import { choice, element } from "../dom.ts";
import { Lane } from "../lane.ts";
import { short, symbol } from "../numbers.ts";
import type { Layer } from "../plot/layers.ts";
import { isDark } from "../plot/palette.ts";
import { Plot } from "../plot/plot.ts";
import type { Model, ModelCard, Part } from "../protocol.ts";
import type { Settings } from "../settings.ts";

type Cells = Extract<Layer, { kind: "cells" }>;

/** Coarse to fine: every so many pixels. */
const strides = [8, 4, 2, 1];
/** Of a pixel. */
const periods = 300;

/** The class of a row: an attractor's number (attractor/classify.hpp), n, p, sticking. */
export function classOf(kind: number, n: number, p: number, sticking: boolean): string {
  if (kind === 0) return `${n}-${p < 0 ? "∞" : p}-${sticking ? "II" : "I"}`;
  return ["", "quasi-periodic", "chaotic", "one of a family", "no short cycle", "rest"][kind] ?? "failed";
}

/** A colour for a class: hue by the periods, lightness by the impacts, stripes of their own for stick. */
export function colourOf(name: string, dark: boolean): string {
  const found = /^(\d+)-(\d+|∞)-(I+)$/.exec(name);
  if (!found) return name === "no short cycle" || name === "chaotic" ? (dark ? "#06090c" : "#2a2f36") : name === "failed" ? "#8884" : dark ? "#56616c" : "#aab4be";
  const n = Number(found[1]), p = found[2] === "∞" ? 8 : Number(found[2]), sticks = found[3] === "II";
  const hue = (205 + 137.5 * (n - 1) + (sticks ? 28 : 0)) % 360;
  const light = dark ? 34 + 6 * Math.min(p, 5) : 80 - 7 * Math.min(p, 6);
  return `hsl(${hue} ${sticks ? 72 : 48}% ${light}%)`;
}

export class ChartView {
  readonly plot: Plot;
  readonly choices = document.createElement("span");
  readonly legend = element("div", { class: "legend" });
  private readonly lanes = Array.from({ length: Math.max(1, Math.min(4, navigator.hardwareConcurrency - 1)) }, () => new Lane());
  private cells: Cells | undefined;
  private classes: string[] = [];
  private wish: Settings["chart"] | undefined;
  private run_ = 0;

  /** @param go  a click: both values */
  constructor(private readonly go: (x: number, y: number) => void, private readonly edit: (change: (chart: Settings["chart"]) => void) => void) {
    this.plot = new Plot({
      name: "chart of two parameters", xLabel: "", yLabel: "",
      pick: (x, y) => {
        const wish = this.wish;
        if (wish && x >= wish.xFrom && x <= wish.xTo && y >= wish.yFrom && y <= wish.yTo) this.go(x, y);
      },
      read: (x, y) => `${symbol(this.wish?.x ?? "")} = ${short(x)}, ${symbol(this.wish?.y ?? "")} = ${short(y)}: ${this.classAt(x, y)}`,
    });
  }

  run(model: Model, card: ModelCard, settings: Settings): void {
    const wish = settings.chart;
    this.wish = wish;
    this.offer(card, wish);
    this.plot.xLabel = symbol(wish.x);
    this.plot.yLabel = symbol(wish.y);
    this.plot.note = "";
    const count = wish.size * wish.size;
    this.classes = Array<string>(count).fill("");
    this.cells = {
      kind: "cells", name: "chart", columns: wish.size, rows: wish.size,
      box: { x0: wish.xFrom, x1: wish.xTo, y0: wish.yFrom, y1: wish.yTo },
      colours: Array<string | undefined>(count).fill(undefined), sizes: new Uint8Array(count),
    };
    this.plot.set([this.cells]);
    const set = Object.fromEntries(Object.entries(model.set).filter(([name]) => name !== wish.x && name !== wish.y));
    this.pass({ ...model, set, start: [] }, 0, ++this.run_);
  }

  stop(): void {
    ++this.run_;
    for (const lane of this.lanes) lane.cancel();
  }

  /** One pass over the chart, on all lanes; then the next finer one. */
  private pass(model: Model, k: number, run: number): void {
    const stride = strides[k], wish = this.wish;
    if (stride === undefined || !wish) return;
    let open = this.lanes.length;
    this.lanes.forEach((lane, i) => {
      lane.ask({
        verb: "chart", model, wish: {
          x: wish.x, y: wish.y, xFrom: wish.xFrom, xTo: wish.xTo, yFrom: wish.yFrom, yTo: wish.yTo, columns: wish.size, rows: wish.size,
          first: i, step: this.lanes.length, stride, coarser: strides[k - 1] ?? 0, periods,
        },
      }, {
        part: (part) => this.take(part, stride),
        done: () => {
          if (--open === 0 && run === this.run_) this.pass(model, k + 1, run);
        },
        error: (error) => {
          this.plot.note = error.message;
          this.plot.redraw();
        },
      });
    });
  }

  private take({ rows, width }: Part, stride: number): void {
    const cells = this.cells;
    if (!cells) return;
    for (let i = 0; i < rows.length; i += width) {
      const at = (rows[i + 1] as number) * cells.columns + (rows[i] as number);
      const name = classOf(rows[i + 2] as number, rows[i + 3] as number, rows[i + 4] as number, rows[i + 5] === 1);
      this.classes[at] = name;
      cells.colours[at] = colourOf(name, isDark());
      cells.sizes[at] = stride;
    }
    if (stride < 8) for (let at = 0; at < cells.sizes.length; ++at) if ((cells.sizes[at] as number) > stride && this.isPassed(at, stride)) cells.sizes[at] = stride;
    this.explain();
    this.plot.redraw();
  }

  /** Are the finer pixels beside a coarse one there, so that it need not stand for them? */
  private isPassed(at: number, stride: number): boolean {
    const columns = this.cells?.columns ?? 1, column = at % columns, row = Math.floor(at / columns);
    const known = (x: number, y: number): boolean => x >= columns || y >= columns || this.classes[y * columns + x] !== "";
    return known(column + stride, row) && known(column, row + stride) && known(column + stride, row + stride);
  }

  recolour(): void {
    this.classes.forEach((name, at) => {
      if (name !== "" && this.cells) this.cells.colours[at] = colourOf(name, isDark());
    });
    this.explain();
    this.plot.redraw();
  }

  /** The commonest classes with their colours. */
  private explain(): void {
    const counts = new Map<string, number>();
    for (const name of this.classes) if (name !== "") counts.set(name, (counts.get(name) ?? 0) + 1);
    const first = [...counts].sort((a, b) => b[1] - a[1]).slice(0, 9);
    this.legend.replaceChildren(...first.map(([name]) => {
      const item = element("span", { class: "swatch" }, name);
      item.style.setProperty("--swatch", colourOf(name, isDark()));
      return item;
    }));
  }

  /** How many pixels are known. */
  known(): number {
    return this.classes.filter((name) => name !== "").length;
  }

  classAt(x: number, y: number): string {
    const wish = this.wish;
    if (!wish) return "";
    const column = Math.round(((x - wish.xFrom) / (wish.xTo - wish.xFrom)) * (wish.size - 1));
    const row = Math.round(((y - wish.yFrom) / (wish.yTo - wish.yFrom)) * (wish.size - 1));
    for (const stride of [1, 2, 4, 8]) {
      const found = this.classes[(row - (row % stride)) * wish.size + column - (column % stride)];
      if (found) return found;
    }
    return "not yet known";
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
