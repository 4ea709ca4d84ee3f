// A plot that a person reads and moves about in: axes, layers, zoom, pan, values under the pointer, saving.
import { element } from "../dom.ts";
import { short, tickTexts, ticks } from "../numbers.ts";
import { type Box, cellAt, drawLabels, drawLayer, extentOf, type Frame, type Hit, type Label, type Layer, nearest, toX, toY } from "./layers.ts";
import { light, type Palette, palette } from "./palette.ts";
import { CanvasPen, type Pen, SvgPen } from "./pen.ts";

export interface PlotOptions {
  /** Read by programs for people who do not see. */
  name: string;
  xLabel: string;
  yLabel: string;
  /** A click or Enter at a place, with the nearest point. */
  pick?(x: number, y: number, hit: Hit | undefined): void;
  /** What stands under the pointer in words. */
  read?(x: number, y: number, hit: Hit | undefined): string;
  /** The view of x was moved, or is the whole again. */
  moved?(view: Box | undefined): void;
}

const margin = { left: 58, right: 14, top: 12, bottom: 40 };

/** Ends of an axis with some room; values that are one but for rounding stand in the middle. */
function padded(from: number, to: number, share: number): [number, number] {
  const size = Math.max(Math.abs(from), Math.abs(to)), span = to - from;
  const room = span > size * 1e-9 ? share * span : Math.max(size * 0.05, 1e-12);
  return [from - room, to + room];
}

export class Plot {
  readonly host: HTMLElement;
  xLabel: string;
  yLabel: string;
  /** A line that moves with time, and a dot on a path. */
  cursorX: number | undefined;
  dot: { x: number; y: number } | undefined;
  /** A message in place of data. */
  note = "";
  /** Ends of an axis that do not follow the data. */
  fixedX: [number, number] | undefined;

  private layers: Layer[] = [];
  private view: Box | undefined;
  private extent: Box = { x0: 0, x1: 1, y0: 0, y1: 1 };
  private hasData = false;
  private readonly base = element("canvas", { "aria-hidden": "true" });
  private readonly top = element("canvas", { "aria-hidden": "true" });
  private readonly tip = element("div", { class: "tip", role: "status" });
  private readonly drawn = new Map<Layer, number>();
  private pending: "all" | "more" | undefined;
  private pointer: { x: number; y: number } | undefined;
  private size = { width: 0, height: 0 };

  constructor(private readonly options: PlotOptions) {
    this.xLabel = options.xLabel;
    this.yLabel = options.yLabel;
    this.host = element("div", { class: "plot", tabindex: 0, role: "img", "aria-label": options.name }, this.base, this.top, this.tip);
    new ResizeObserver(() => this.redraw()).observe(this.host);
    this.listen();
  }

  set(layers: Layer[]): void {
    this.layers = layers;
    this.grow();
    this.redraw();
  }

  /** Layers have more points than before. */
  more(): void {
    if (this.grow()) this.redraw();
    else if (!this.pending) this.schedule("more");
  }

  redraw(): void {
    this.schedule("all");
  }

  /** All points are there: the axes fit them, however they came. */
  settle(): void {
    this.hasData = false;
    this.grow();
    this.redraw();
  }

  /** The cursor, the dot and what is under the pointer, over what is drawn. */
  overlay(): void {
    const pen = this.pen(this.top), colours = palette(), frame = this.frame();
    pen.clipped(frame.left, frame.top, frame.width, frame.height, () => {
      if (this.cursorX !== undefined) {
        const x = toX(frame, this.cursorX);
        pen.line([x, frame.top, x, frame.top + frame.height], { colour: colours.cursor, width: 1.2 });
      }
      if (this.dot) pen.circle(toX(frame, this.dot.x), toY(frame, this.dot.y), 5, colours.impact, { colour: colours.ground, width: 1.5 });
    });
    const hit = this.pointer && nearest(frame, this.layers, this.pointer.x, this.pointer.y, 24);
    if (hit) pen.circle(toX(frame, hit.x), toY(frame, hit.y), 5, undefined, { colour: colours.ink, width: 1.5 });
    this.showTip(hit, frame);
  }

  reset(): void {
    this.view = undefined;
    this.options.moved?.(undefined);
    this.redraw();
  }

  /** The picture as a file, in the colours of print. */
  svg(title: string): string {
    const pen = new SvgPen();
    const { width, height } = this.size;
    pen.rect(0, 0, width, height, light.ground);
    this.draw(pen, light);
    return pen.file(width, height, title);
  }

  png(): Promise<Blob> {
    const canvas = element("canvas", { width: this.size.width * 3, height: this.size.height * 3 });
    const context = canvas.getContext("2d") as CanvasRenderingContext2D;
    context.scale(3, 3);
    const pen = new CanvasPen(context);
    pen.rect(0, 0, this.size.width, this.size.height, light.ground);
    this.draw(pen, light);
    return new Promise((resolve, reject) => canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("no picture"))), "image/png"));
  }

  /** The numbers of lines and dots, with a column that names them. */
  csv(): string {
    const rows = [`series,${JSON.stringify(this.xLabel)},${JSON.stringify(this.yLabel)}${this.layers.some(({ kind }) => kind === "cells") ? ",class" : ""}`];
    for (const layer of this.layers) {
      if (layer.kind === "line" || layer.kind === "stems" || layer.kind === "marks")
        for (let i = 0; i < layer.x.length; ++i) rows.push(`${JSON.stringify(layer.name)},${String(layer.x[i])},${String(layer.y[i])}`);
      else if (layer.kind === "dots")
        for (let i = 0; i < layer.x.length; ++i) rows.push(`${JSON.stringify(layer.name)},${String(layer.x.at(i))},${String(layer.y.at(i))}`);
      else if (layer.kind === "cells")
        layer.names.forEach((name, i) => {
          if (name !== "") rows.push([JSON.stringify(layer.name), ...cellAt(layer, i).map(String), name].join(","));
        });
    }
    return `${rows.join("\n")}\n`;
  }

  /** How many points are shown: for tests. */
  get points(): number {
    return this.layers.reduce((sum, layer) => sum + ("x" in layer ? layer.x.length : 0), 0);
  }

  frame(): Frame {
    const { width, height } = this.size;
    return {
      left: margin.left, top: margin.top,
      width: Math.max(width - margin.left - margin.right, 10), height: Math.max(height - margin.top - margin.bottom, 10),
      view: this.view ?? this.extent,
    };
  }

  /** @returns whether the data's extent has changed in sight */
  private grow(): boolean {
    const found = extentOf(this.layers);
    const { extent: before, hasData } = this;
    const grows = this.layers.some((layer) => layer.kind === "dots" && this.drawn.has(layer));
    if (found && hasData && grows && before.x0 <= found.x0 && before.x1 >= found.x1 && before.y0 <= found.y0 && before.y1 >= found.y1) return false;
    this.hasData = found !== undefined;
    const { x0, x1, y0, y1 } = found ?? { x0: 0, x1: 1, y0: 0, y1: 1 };
    const [bottom, top] = padded(y0, y1, 0.06);
    const [left, right] = this.fixedX ?? padded(x0, x1, 0.05);
    this.extent = { x0: left, x1: right, y0: bottom, y1: top };
    return this.view === undefined;
  }

  private schedule(what: "all" | "more"): void {
    if (this.pending === undefined) requestAnimationFrame(() => {
      const wanted = this.pending;
      this.pending = undefined;
      if (wanted === "more") this.drawMore();
      else this.drawAll();
    });
    if (this.pending !== "all") this.pending = what;
  }

  private drawAll(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.size = { width, height };
    const scale = window.devicePixelRatio;
    for (const canvas of [this.base, this.top]) {
      if (canvas.width === Math.round(width * scale) && canvas.height === Math.round(height * scale)) continue;
      canvas.width = Math.round(width * scale);
      canvas.height = Math.round(height * scale);
    }
    this.draw(this.pen(this.base), palette());
    for (const layer of this.layers) if (layer.kind === "dots") this.drawn.set(layer, layer.x.length);
    for (const layer of this.drawn.keys()) if (!this.layers.includes(layer)) this.drawn.delete(layer);
    this.overlay();
  }

  private drawMore(): void {
    const context = this.base.getContext("2d") as CanvasRenderingContext2D;
    const pen = new CanvasPen(context), frame = this.frame();
    pen.clipped(frame.left, frame.top, frame.width, frame.height, () => {
      for (const layer of this.layers) {
        if (layer.kind !== "dots") continue;
        drawLayer(pen, frame, layer, palette(), this.drawn.get(layer) ?? 0);
        this.drawn.set(layer, layer.x.length);
      }
    });
    this.overlay();
  }

  /** A canvas cleared and scaled to CSS pixels. */
  private pen(canvas: HTMLCanvasElement): Pen {
    const context = canvas.getContext("2d") as CanvasRenderingContext2D;
    const scale = window.devicePixelRatio;
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, this.size.width, this.size.height);
    return new CanvasPen(context);
  }

  private draw(pen: Pen, colours: Palette): void {
    const frame = this.frame();
    this.drawAxes(pen, frame, colours);
    pen.clipped(frame.left, frame.top, frame.width, frame.height, () => {
      const labels: Label[] = [];
      for (const layer of this.layers) drawLayer(pen, frame, layer, colours, 0, labels);
      drawLabels(pen, labels);
    });
    pen.line([frame.left, frame.top, frame.left, frame.top + frame.height, frame.left + frame.width, frame.top + frame.height],
      { colour: colours.faint, width: 1 });
    if (this.note) this.drawNote(pen, frame, colours);
  }

  private drawNote(pen: Pen, frame: Frame, colours: Palette): void {
    const letters = Math.max(Math.floor(frame.width / 7), 10);
    const lines = this.note.match(new RegExp(`.{1,${letters}}(\\s|$)`, "g"))?.slice(0, 6) ?? [];
    lines.forEach((line, i) => pen.text(frame.left + frame.width / 2, frame.top + frame.height / 2 + 18 * (i - (lines.length - 1) / 2), line.trim(),
      { colour: colours.faint, anchor: "middle", size: 13 }));
  }

  private drawAxes(pen: Pen, frame: Frame, colours: Palette): void {
    const { view } = frame;
    const xs = ticks(view.x0, view.x1, frame.width / 90), ys = ticks(view.y0, view.y1, frame.height / 48);
    const bottom = frame.top + frame.height;
    const xTexts = tickTexts(xs), yTexts = tickTexts(ys);
    xs.forEach((value, i) => {
      const x = toX(frame, value);
      pen.line([x, frame.top, x, bottom], { colour: colours.grid, width: 1 });
      pen.text(x, bottom + 7, xTexts[i] ?? "", { colour: colours.faint, anchor: "middle", baseline: "top", size: 11.5 });
    });
    ys.forEach((value, i) => {
      const y = toY(frame, value);
      pen.line([frame.left, y, frame.left + frame.width, y], { colour: colours.grid, width: 1 });
      pen.text(frame.left - 7, y, yTexts[i] ?? "", { colour: colours.faint, anchor: "end", size: 11.5 });
    });
    pen.text(frame.left + frame.width / 2, bottom + 23, this.xLabel, { colour: colours.ink, anchor: "middle", baseline: "top", size: 12.5 });
    pen.text(13, frame.top + frame.height / 2, this.yLabel, { colour: colours.ink, anchor: "middle", turned: true, size: 12.5 });
  }

  private showTip(hit: Hit | undefined, frame: Frame): void {
    const inside = this.pointer && this.pointer.x >= frame.left && this.pointer.x <= frame.left + frame.width
      && this.pointer.y >= frame.top && this.pointer.y <= frame.top + frame.height;
    this.tip.hidden = !inside;
    if (!inside || !this.pointer) return;
    const [x, y] = hit ? [hit.x, hit.y] : this.numbersAt(this.pointer);
    this.tip.textContent = this.options.read?.(x, y, hit)
      ?? `${hit ? `${hit.layer.name}: ` : ""}${this.xLabel.split("  ")[0] ?? ""} ${short(x, 6)}, ${short(y, 6)}`;
    const right = this.pointer.x > frame.left + frame.width * 0.6;
    this.tip.style.left = right ? "" : `${this.pointer.x + 14}px`;
    this.tip.style.right = right ? `${this.size.width - this.pointer.x + 14}px` : "";
    this.tip.style.top = `${Math.max(this.pointer.y - 30, 2)}px`;
  }

  private numbersAt(at: { x: number; y: number }): [number, number] {
    const frame = this.frame(), { view } = frame;
    return [
      view.x0 + ((at.x - frame.left) / frame.width) * (view.x1 - view.x0),
      view.y0 + ((frame.top + frame.height - at.y) / frame.height) * (view.y1 - view.y0),
    ];
  }

  private setView(view: Box): void {
    if (!(view.x1 - view.x0 > Math.abs(view.x0) * 1e-13) || !(view.y1 - view.y0 > Math.abs(view.y0) * 1e-13)) return;
    this.view = view;
    this.options.moved?.(view);
    this.redraw();
  }

  private zoom(at: { x: number; y: number }, factorX: number, factorY: number): void {
    const [x, y] = this.numbersAt(at), { view } = this.frame();
    this.setView({
      x0: x - (x - view.x0) * factorX, x1: x + (view.x1 - x) * factorX,
      y0: y - (y - view.y0) * factorY, y1: y + (view.y1 - y) * factorY,
    });
  }

  private pan(dx: number, dy: number): void {
    const frame = this.frame(), { view } = frame;
    const x = (dx / frame.width) * (view.x1 - view.x0), y = (dy / frame.height) * (view.y1 - view.y0);
    this.setView({ x0: view.x0 - x, x1: view.x1 - x, y0: view.y0 + y, y1: view.y1 + y });
  }

  private pickAt(at: { x: number; y: number }): void {
    const [x, y] = this.numbersAt(at);
    this.options.pick?.(x, y, nearest(this.frame(), this.layers, at.x, at.y, 14));
  }

  private listen(): void {
    const place = (event: MouseEvent): { x: number; y: number } => {
      const box = this.host.getBoundingClientRect();
      return { x: event.clientX - box.left, y: event.clientY - box.top };
    };
    this.host.addEventListener("wheel", (event) => {
      if (!event.ctrlKey && !event.shiftKey && !event.altKey && document.activeElement !== this.host) {
        this.tip.textContent = "Ctrl + wheel zooms, Shift only across; drag moves; a double click shows all";
        return;
      }
      event.preventDefault();
      const factor = Math.exp(Math.sign(event.deltaY || event.deltaX) * 0.18);
      this.zoom(place(event), factor, event.shiftKey ? 1 : factor);
    }, { passive: false });
    this.host.addEventListener("dblclick", () => this.reset());
    this.host.addEventListener("pointerleave", () => {
      this.pointer = undefined;
      this.overlay();
    });
    this.listenToFingers(place);
    this.host.addEventListener("keydown", (event) => this.key(event));
  }

  /** One finger or the mouse moves the view, two zoom, a short press picks. */
  private listenToFingers(place: (event: MouseEvent) => { x: number; y: number }): void {
    const fingers = new Map<number, { x: number; y: number }>();
    let moved = 0;
    this.host.addEventListener("pointerdown", (event) => {
      fingers.set(event.pointerId, place(event));
      this.host.setPointerCapture(event.pointerId);
      moved = 0;
    });
    this.host.addEventListener("pointermove", (event) => {
      const now = place(event), before = fingers.get(event.pointerId);
      this.pointer = now;
      if (!before) {
        this.overlay();
        return;
      }
      const others = [...fingers].filter(([id]) => id !== event.pointerId).map(([, at]) => at);
      moved += Math.hypot(now.x - before.x, now.y - before.y);
      const other = others[0];
      if (other) {
        const ratio = (a: number, b: number): number => (Math.abs(b) > 20 && Math.abs(a) > 20 ? Math.abs(a) / Math.abs(b) : 1);
        this.zoom({ x: (now.x + other.x) / 2, y: (now.y + other.y) / 2 }, ratio(before.x - other.x, now.x - other.x), ratio(before.y - other.y, now.y - other.y));
      } else if (moved > 5) this.pan(now.x - before.x, now.y - before.y);
      fingers.set(event.pointerId, now);
    });
    const end = (event: PointerEvent): void => {
      if (!fingers.delete(event.pointerId) || moved > 5 || event.type !== "pointerup") return;
      this.pickAt(place(event));
      this.pointer = undefined;  // what was picked is said elsewhere: the tip goes until the pointer moves again
      this.overlay();
    };
    this.host.addEventListener("pointerup", end);
    this.host.addEventListener("pointercancel", end);
  }

  private key(event: KeyboardEvent): void {
    const frame = this.frame(), middle = { x: frame.left + frame.width / 2, y: frame.top + frame.height / 2 };
    const moves: Record<string, () => void> = {
      ArrowLeft: () => this.pan(40, 0), ArrowRight: () => this.pan(-40, 0), ArrowUp: () => this.pan(0, 40), ArrowDown: () => this.pan(0, -40),
      "+": () => this.zoom(middle, 0.8, 0.8), "-": () => this.zoom(middle, 1.25, 1.25), "0": () => this.reset(),
      Enter: () => this.pickAt(this.pointer ?? middle),
    };
    const move = moves[event.key];
    if (!move || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    move();
  }
}
