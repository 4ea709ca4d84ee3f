// The mechanism itself: it moves, its bodies can be dragged to another start.
import { element } from "../dom.ts";
import { bodyAt, bodyWidth, drawMechanism, type Scale, scaleFor, type Stage } from "../mechanism/draw.ts";
import { type Layout, layoutOf } from "../mechanism/layout.ts";
import { light, palette } from "../plot/palette.ts";
import { CanvasPen, SvgPen } from "../plot/pen.ts";
import type { Player } from "../player.ts";
import type { ModelCard } from "../protocol.ts";
import type { MotionWindow } from "../window.ts";

export class MechanismView {
  readonly host: HTMLElement;
  private readonly canvas = element("canvas", { "aria-hidden": "true" });
  private layout: Layout | undefined;
  private card: ModelCard | undefined;
  private scale: Scale = { factor: 1, rest: [] };
  private ranges: { least: number[]; most: number[] } | undefined;
  private dragged: { body: number; from: number; state: number[] } | undefined;

  /** @param drag  a body was taken to a new place: the state with it at rest there */
  constructor(private readonly player: Player, private readonly drag: (state: number[], over: boolean) => void) {
    this.host = element("div", { class: "mechanism", role: "img", "aria-label": "the mechanism in motion" }, this.canvas);
    new ResizeObserver(() => this.rescale()).observe(this.host);
    this.listen();
  }

  show(card: ModelCard): void {
    this.card = card;
    this.layout = layoutOf(card.mechanism);
    this.ranges = undefined;
    this.host.parentElement?.classList.toggle("upright", this.layout.upright);
    this.host.setAttribute("aria-label", `the mechanism of ${card.name} in motion: ${card.mechanism.coordinates.map(({ name }) => name).join(", ")}`);
  }

  /** The scale follows the motion, but not its small changes. */
  fit(window: MotionWindow): void {
    if (!this.card || this.dragged) return;
    const columns = this.card.mechanism.coordinates.map(({ name }) => window.column(name));
    const least = columns.map((column) => column.reduce((a, b) => Math.min(a, b), Infinity));
    const most = columns.map((column) => column.reduce((a, b) => Math.max(a, b), -Infinity));
    const old = this.ranges;
    const span = (i: number, range: { least: number[]; most: number[] }): number => (range.most[i] ?? 0) - (range.least[i] ?? 0);
    const held = old && least.every((value, i) => {
      const room = 0.1 * span(i, old);
      return value >= (old.least[i] ?? 0) - room && (most[i] ?? 0) <= (old.most[i] ?? 0) + room;
    }) && Math.max(...least.map((_, i) => span(i, { least, most }))) > 0.5 * Math.max(...least.map((_, i) => span(i, old)));
    if (held) return;
    this.ranges = { least, most };
    this.rescale();
  }

  draw(): void {
    const stage = this.stage(), window = this.player.window, context = this.canvas.getContext("2d");
    if (!stage || !window || !context || stage.width === 0) return;
    const ratio = devicePixelRatio, { width, height } = this.host.getBoundingClientRect();
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio);
      this.canvas.height = Math.round(height * ratio);
    }
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    drawMechanism(new CanvasPen(context), stage, this.instant(), palette());
  }

  svg(title: string): string {
    const stage = this.stage(), pen = new SvgPen();
    if (!stage) return "";
    pen.rect(0, 0, stage.width, stage.height, light.ground);
    drawMechanism(pen, stage, this.instant(), light);
    return pen.file(stage.width, stage.height, title);
  }

  private rescale(): void {
    const stage = this.stage();
    if (stage && this.ranges) this.scale = scaleFor(stage, this.ranges.least, this.ranges.most);
    this.draw();
  }

  private stage(): Stage | undefined {
    if (!this.layout || !this.card) return undefined;
    const { width, height } = this.host.getBoundingClientRect();
    return { layout: this.layout, names: this.card.mechanism.coordinates.map(({ name }) => name), width, height, scale: this.scale };
  }

  private instant(): { x: number[]; atRest: number; flashes: { contact: number; glow: number }[]; time: number } {
    const { window, time, elapsed } = this.player;
    const names = this.card?.mechanism.coordinates ?? [];
    return {
      x: names.map(({ name }) => window?.at(name, time) ?? 0), atRest: window?.atRest(time) ?? 0,
      flashes: this.player.flashes(), time: (elapsed + time) * (this.card?.period ?? 1),
    };
  }

  private listen(): void {
    const { host } = this;
    const bodyUnder = (event: PointerEvent): number => {
      const stage = this.stage();
      if (!stage) return -1;
      const x = event.clientX - host.getBoundingClientRect().left, half = bodyWidth(stage) / 2;
      return this.instant().x.findIndex((_, body, all) => Math.abs(bodyAt(stage, body, all) - x) <= half);
    };
    host.addEventListener("pointermove", (event) => {
      if (this.dragged) this.move(event, false);
      else host.style.cursor = bodyUnder(event) >= 0 ? "grab" : "";
    });
    host.addEventListener("pointerdown", (event) => {
      const body = this.layout?.upright ? -1 : bodyUnder(event), { window, time } = this.player;
      if (body < 0 || !window || !this.card) return;
      event.preventDefault();
      host.setPointerCapture(event.pointerId);
      this.player.pause();
      const state = window.state(this.card, time).map((value, i) => (i % 2 === 0 ? value : 0));
      this.dragged = { body, from: event.clientX, state };
    });
    host.addEventListener("pointerup", (event) => {
      if (this.dragged) this.move(event, true);
      this.dragged = undefined;
    });
  }

  private move(event: PointerEvent, over: boolean): void {
    if (!this.dragged || (Math.abs(event.clientX - this.dragged.from) < 3 && !over)) return;
    const { body, from, state } = this.dragged;
    if (event.clientX === from) return;
    const moved = [...state];
    moved[2 * body] = (moved[2 * body] ?? 0) + (event.clientX - from) / this.scale.factor;
    this.drag(moved, over);
  }
}
