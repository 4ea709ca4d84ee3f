// Draws a mechanism at an instant: bodies, springs, dampers, stops, friction contacts; impacts flash, stuck contacts
// are marked. A stop's plate touches its body exactly when the gap is zero: positions are those of the motion, times
// one scale for all.
import type { Palette } from "../plot/palette.ts";
import type { Pen } from "../plot/pen.ts";
import { ground, type Layout, type Part } from "./layout.ts";

/** What is drawn of an instant. */
export interface Instant {
  /** Displacements of the bodies. */
  x: readonly number[];
  /** Contacts at rest, bit by bit. */
  atRest: number;
  /** Flashes: contact, and how bright from 1 to 0. */
  flashes: readonly { contact: number; glow: number }[];
  /** Time, for the marks of belts that run. */
  time: number;
}

/** How displacements become pixels; kept while a motion is shown. */
export interface Scale {
  factor: number;
  /** Displacement of each body that is drawn at the body's place. */
  rest: readonly number[];
}

export interface Stage {
  layout: Layout;
  names: readonly string[];
  width: number;
  height: number;
  scale: Scale;
}

const bodyHeight = 76, mostBody = 104;

export function bodyWidth(stage: Stage): number {
  return Math.min(mostBody, stage.width / (stage.layout.place.length * 2 + 1.6));
}

/** Middle of a body. */
export function bodyAt(stage: Stage, body: number, x: readonly number[]): number {
  if (stage.layout.upright) return stage.width / 2;
  const { layout, scale } = stage, count = layout.place.length;
  const spread = stage.width / (count + (layout.wallRight ? 0.55 : 0.35) + 0.25);
  const left = layout.wallLeft || !layout.wallRight ? 0.85 : 0.6;
  const home = count === 1 ? stage.width * 0.5 : spread * (left + (layout.place[body] ?? 0));
  return home + scale.factor * ((x[body] ?? 0) - (scale.rest[body] ?? 0));
}

/** The factor for which the largest swing fills the room between bodies. */
export function scaleFor(stage: Omit<Stage, "scale">, least: readonly number[], most: readonly number[]): Scale {
  const rest = least.map((value, i) => (value + (most[i] ?? value)) / 2);
  const swing = Math.max(...least.map((value, i) => ((most[i] ?? value) - value) / 2), 1e-300);
  const room = stage.width / (stage.layout.place.length + 0.8) - bodyWidth({ ...stage, scale: { factor: 1, rest } });
  return { factor: Math.max(room * 0.42, 8) / swing, rest };
}

function springPath(x0: number, x1: number, y: number): number[] {
  const lead = Math.min(9, Math.abs(x1 - x0) * 0.12) * Math.sign(x1 - x0), coils = 7;
  const path = [x0, y, x0 + lead, y];
  const step = (x1 - x0 - 2 * lead) / (2 * coils);
  for (let i = 0; i < 2 * coils; ++i) path.push(x0 + lead + step * (i + 0.5), y + (i % 2 === 0 ? -7 : 7));
  path.push(x1 - lead, y, x1, y);
  return path;
}

function drawDamper(pen: Pen, x0: number, x1: number, y: number, colour: string): void {
  const middle = (x0 + x1) / 2, half = Math.min(14, Math.abs(x1 - x0) * 0.2);
  pen.line([x0, y, middle - half * 0.2, y, NaN, NaN, middle - half * 0.2, y - 5, middle - half * 0.2, y + 5], { colour, width: 1.8 });
  pen.line([middle + half, y - 8, middle - half, y - 8, NaN, NaN, middle - half, y + 8, middle + half, y + 8, middle + half, y - 8, NaN, NaN, middle + half, y, x1, y], { colour, width: 1.8 });
}

function hatch(pen: Pen, x: number, y0: number, y1: number, outward: number, colours: Palette): void {
  const path: number[] = [];
  for (let y = y0; y < y1; y += 8) path.push(x, y + 8, x + outward * 8, y, NaN, NaN);
  pen.line(path, { colour: colours.faint, width: 1 });
  pen.line([x, y0, x, y1], { colour: colours.edge, width: 2 });
}

function hatchFloor(pen: Pen, x0: number, x1: number, y: number, colours: Palette, shift = 0): void {
  const path: number[] = [], first = ((shift % 10) + 10) % 10;
  for (let x = x0 + first; x < x1; x += 10) path.push(x, y, x - 7, y + 7, NaN, NaN);
  pen.clipped(x0, y, x1 - x0, 9, () => pen.line(path, { colour: colours.faint, width: 1 }));
  pen.line([x0, y, x1, y], { colour: colours.edge, width: 2 });
}

/** Links along a pair get a height each. */
function heights(parts: readonly Part[], middle: number): Map<Part, number> {
  const pairs = new Map<string, Part[]>();
  for (const part of parts) {
    if (part.kind === "friction" || part.kind === "stop") continue;
    const key = [Math.min(part.a, part.b), Math.max(part.a, part.b)].join();
    pairs.set(key, [...(pairs.get(key) ?? []), part]);
  }
  const found = new Map<Part, number>();
  for (const list of pairs.values())
    list.forEach((part, i) => found.set(part, middle + 5 + (list.length === 1 ? 0 : (i / (list.length - 1) - 0.5) * (bodyHeight - 42))));
  return found;
}

class Drawing {
  private readonly half: number;
  private readonly middle: number;
  private readonly heights: Map<Part, number>;
  private readonly at: number[];

  constructor(private readonly pen: Pen, private readonly stage: Stage, private readonly instant: Instant, private readonly colours: Palette) {
    this.half = bodyWidth(stage) / 2;
    this.middle = stage.height * 0.46;
    this.heights = heights(stage.layout.parts, this.middle);
    this.at = stage.layout.place.map((_, body) => bodyAt(stage, body, instant.x));
  }

  draw(): void {
    const { parts } = this.stage.layout;
    this.walls();
    for (const part of parts) if (part.kind === "friction") this.friction(part);
    for (const part of parts) if (["spring", "coupling", "damper", "maxwell", "polyline", "jenkins"].includes(part.kind)) this.link(part);
    this.bodies();
    for (const part of parts) if (part.kind === "stop" || part.kind === "compliant") this.stop(part);
    for (const flash of this.instant.flashes) this.flash(flash.contact, flash.glow);
  }

  private get leftWall(): number {
    return 20;
  }

  private get rightWall(): number {
    return this.stage.width - 20;
  }

  private walls(): void {
    const top = this.middle - bodyHeight * 0.75, bottom = this.middle + bodyHeight * 0.75;
    if (this.stage.layout.wallLeft) hatch(this.pen, this.leftWall, top, bottom, -1, this.colours);
    if (this.stage.layout.wallRight) hatch(this.pen, this.rightWall, top, bottom, 1, this.colours);
  }

  private bodies(): void {
    const { pen, colours, half, middle } = this;
    this.at.forEach((x, body) => {
      pen.rect(x - half, middle - bodyHeight / 2, 2 * half, bodyHeight, colours.body);
      pen.line([x - half, middle - bodyHeight / 2, x + half, middle - bodyHeight / 2, x + half, middle + bodyHeight / 2, x - half, middle + bodyHeight / 2, x - half, middle - bodyHeight / 2], { colour: colours.edge, width: 2 });
      pen.text(x, middle, this.stage.names[body] ?? "", { colour: colours.ink, anchor: "middle", size: 15, weight: 600 });
    });
  }

  /** Where a link to the ground ends: at the wall on its side. */
  private wallFor(body: number): number {
    const { layout } = this.stage, last = layout.place.length - 1;
    const right = layout.wallRight && (layout.place[body] ?? 0) === last && last > 0;
    return right ? this.rightWall : this.leftWall;
  }

  private ends(part: Part): [number, number] {
    const { half } = this;
    if (part.a === ground || part.b === ground) {
      const body = part.a === ground ? part.b : part.a, wall = this.wallFor(body), x = this.at[body] ?? 0;
      return wall < x ? [wall, x - half] : [x + half, wall];
    }
    const [left, right] = [this.at[part.a] ?? 0, this.at[part.b] ?? 0].sort((p, q) => p - q) as [number, number];
    return [left + half, right - half];
  }

  private link(part: Part): void {
    const [x0, x1] = this.ends(part), y = this.heights.get(part) ?? this.middle, { pen, colours } = this;
    if (part.kind === "damper") drawDamper(pen, x0, x1, y, colours.edge);
    else if (part.kind === "maxwell") {  // one behind the other
      const middle = (x0 + x1) / 2;
      pen.line(springPath(x0, middle, y), { colour: colours.edge, width: 1.8 });
      drawDamper(pen, middle, x1, y, colours.edge);
    } else if (part.kind === "jenkins") {  // a spring, and a block between two jaws
      const middle = (x0 + x1) / 2, jaw = Math.min(26, (x1 - middle) / 2);
      pen.line(springPath(x0, middle, y), { colour: colours.edge, width: 1.8 });
      pen.rect(middle, y - 4, jaw, 8, colours.edge);
      pen.line([x1, y, x1 - 6, y, NaN, NaN, x1 - 6, y - 7, x1 - 6, y + 7, NaN, NaN, middle, y - 7, x1 - 6, y - 7, NaN, NaN, middle, y + 7, x1 - 6, y + 7], { colour: colours.edge, width: 1.6 });
    } else if (part.kind === "coupling") pen.line([x0, y, x1, y], { colour: colours.edge, width: 1.6, dash: [5, 5] });
    else {
      pen.line(springPath(x0, x1, y), { colour: colours.edge, width: 1.8 });
      if (part.kind === "polyline") {  // an arrow across: its force is no straight line
        const x = (x0 + x1) / 2;
        pen.line([x - 15, y + 13, x + 15, y - 13, NaN, NaN, x + 8, y - 13, x + 15, y - 13, x + 14, y - 6], { colour: colours.faint, width: 1.4 });
      }
    }
  }

  private rests(contact: number): boolean {
    return Math.floor(this.instant.atRest / 2 ** contact) % 2 === 1;
  }

  /** The face of a body that a stop acts on, and the plate that the face meets. */
  stopAt(part: Part): { face: number; plate: number; side: number } {
    const { scale } = this.stage, to = (x: number): number => scale.factor * x;
    const [ofA, ofB] = part.ratio ?? [1, 1], x = (end: number): number => end === ground ? 0 : this.instant.x[end] ?? 0;
    const gap = part.clearance - (ofA * x(part.a) - ofB * x(part.b));
    if (part.a === ground) {
      const face = (this.at[part.b] ?? 0) - this.half;
      return { face, plate: face - to(gap), side: -1 };
    }
    const face = (this.at[part.a] ?? 0) + this.half;
    return { face, plate: face + to(gap), side: 1 };
  }

  private stop(part: Part): void {
    const { pen, colours, middle } = this, { face, plate, side } = this.stopAt(part);
    const colour = this.rests(part.contact) ? colours.contact : colours.edge;
    const top = middle - bodyHeight * 0.42, bottom = middle + bodyHeight * 0.36;
    if (part.kind === "compliant") {  // a plate on a short spring, pushed by what touches it
      const pushed = side > 0 ? Math.max(plate, face) : Math.min(plate, face), foot = plate + side * 34;
      pen.line([pushed, top, pushed, bottom], { colour, width: 4 });
      pen.line(springPath(pushed, foot, middle), { colour, width: 1.6 });
      this.holder(part, foot, side);
      return;
    }
    pen.rect(side > 0 ? plate : plate - 7, top, 7, bottom - top, colour);
    this.holder(part, plate + side * 7, side);
    if (this.rests(part.contact)) pen.circle(face, top - 9, 4, colours.contact);
  }

  /** What a plate is fixed to: the ground below, or the other body by an arm over it. */
  private holder(part: Part, x: number, side: number): void {
    const { pen, colours, middle } = this, top = middle - bodyHeight * 0.42 + 2;
    const owner = part.a === ground ? ground : part.b;
    if (owner === ground) {
      const bottom = middle + bodyHeight * 0.36, floor = middle + bodyHeight * 0.85;
      pen.line([x, bottom - 6, x + side * 14, floor, NaN, NaN, x, bottom - 4, x, floor], { colour: colours.edge, width: 2 });
      hatchFloor(pen, Math.min(x, x + side * 18) - 3, Math.max(x, x + side * 18) + 3, floor, colours);
      return;
    }
    const other = this.at[owner] ?? 0, near = other > x ? other - this.half : other + this.half;
    if ((other - x) * side >= 0) pen.line([x, top, near, top], { colour: colours.edge, width: 4 });
    else {  // the owner stands on the other side: an arm over the body
      const over = middle - bodyHeight * 0.72;
      pen.line([x - side * 4, top, x - side * 4, over, other, over, other, middle - bodyHeight / 2], { colour: colours.edge, width: 4 });
    }
  }

  private friction(part: Part): void {
    const { pen, colours, half, middle } = this;
    const body = part.a === ground ? part.b : part.a, x = this.at[body] ?? 0, y = middle + bodyHeight / 2 + 5;
    const stuck = this.rests(part.contact);
    if (part.a === ground || part.b === ground) {
      const room = this.stage.width / (this.at.length + 0.8) * 0.48, home = bodyAt(this.stage, body, this.stage.scale.rest);
      const shift = part.belt * this.stage.scale.factor * this.instant.time;
      hatchFloor(pen, home - room, home + room, y + 1, colours, shift);
      if (part.belt !== 0) this.belt(home, room, y, part.belt, shift);
    } else {
      const owner = this.at[part.a === body ? part.b : part.a] ?? 0, toward = Math.sign(owner - x);
      const swing = Math.min(half + 26, Math.abs(owner - x) - half, toward > 0 ? x - 4 : this.stage.width - x - 4);
      pen.rect(Math.min(x - toward * swing, owner), y, Math.abs(owner - x) + swing, 8, colours.body);
      pen.line([x - toward * swing, y, owner - toward * half, y, NaN, NaN, x - toward * swing, y, x - toward * swing, y + 8, owner, y + 8, owner, middle + bodyHeight / 2], { colour: colours.edge, width: 2 });
    }
    pen.rect(x - half * 0.8, y - 5, half * 1.6, 5, stuck ? colours.stick : colours.faint, stuck ? 1 : 0.5);
    if (stuck) pen.text(x, middle + bodyHeight / 2 - 9, "stuck", { colour: colours.stick, anchor: "middle", size: 11, weight: 700 });
  }

  private belt(home: number, room: number, y: number, speed: number, shift: number): void {
    const { pen, colours } = this, radius = 11;
    for (const x of [home - room, home + room]) {
      pen.circle(x, y + 1 + radius, radius, colours.ground, { colour: colours.edge, width: 2 });
      const angle = shift / radius;
      pen.line([x, y + 1 + radius, x + radius * Math.cos(angle), y + 1 + radius + radius * Math.sin(angle)], { colour: colours.edge, width: 1.6 });
    }
    pen.line([home - room, y + 1 + 2 * radius, home + room, y + 1 + 2 * radius], { colour: colours.edge, width: 2 });
    const side = Math.sign(speed);
    pen.line([home - side * 18, y + 2 + radius, home + side * 18, y + 2 + radius, NaN, NaN, home + side * 10, y - 3 + radius, home + side * 18, y + 2 + radius, home + side * 10, y + 7 + radius], { colour: colours.faint, width: 1.6 });
  }

  private flash(contact: number, glow: number): void {
    const part = this.stage.layout.parts.find((one) => one.contact === contact && (one.kind === "stop" || one.kind === "compliant"));
    if (!part || glow <= 0) return;
    drawFlash(this.pen, this.stopAt(part).plate, this.middle, glow, this.colours);
  }
}

function drawFlash(pen: Pen, x: number, y: number, glow: number, colours: Palette): void {
  const path: number[] = [];
  for (let i = 0; i < 12; ++i) {
    const angle = (i * Math.PI) / 6, inner = 7, outer = (i % 2 === 0 ? 30 : 20) * (0.4 + 0.6 * glow);
    path.push(x + inner * Math.cos(angle), y + inner * Math.sin(angle), x + outer * Math.cos(angle), y + outer * Math.sin(angle), NaN, NaN);
  }
  pen.line(path, { colour: colours.impact, width: 2.6, opacity: Math.min(1, glow * 1.2) });
}

/** A body that falls on a floor: up is up, and the gap is the first stop's. */
function drawUpright(pen: Pen, stage: Stage, instant: Instant, colours: Palette): void {
  const floor = stage.height - 22, radius = 24, middle = stage.width / 2;
  const stops = stage.layout.parts.filter(({ kind, a }) => kind === "stop" && a === ground);
  const gap = (stops[0]?.clearance ?? 0) + (instant.x[0] ?? 0);
  const lowest = (stops[0]?.clearance ?? 0) + (stage.scale.rest[0] ?? 0);
  const swing = Math.max(lowest, 1e-300) * 2, y = floor - radius - (Math.max(gap, 0) / swing) * (floor - 2 * radius - 12);
  const touching = stops.some(({ contact }) => Math.floor(instant.atRest / 2 ** contact) % 2 === 1);
  hatchFloor(pen, middle - 150, middle + 150, floor, colours);
  pen.circle(middle, y, radius, colours.body, { colour: colours.edge, width: 2 });
  pen.text(middle, y, stage.names[0] ?? "", { colour: colours.ink, anchor: "middle", size: 15, weight: 600 });
  if (touching) pen.rect(middle - 16, floor - 3, 32, 6, colours.contact);
  pen.line([middle - 190, floor, middle - 190, floor - 60, NaN, NaN, middle - 195, floor - 52, middle - 190, floor - 60, middle - 185, floor - 52], { colour: colours.faint, width: 1.4 });
  for (const { glow } of instant.flashes) drawFlash(pen, middle, floor, glow, colours);
}

export function drawMechanism(pen: Pen, stage: Stage, instant: Instant, colours: Palette): void {
  if (stage.layout.upright) drawUpright(pen, stage, instant, colours);
  else new Drawing(pen, stage, instant, colours).draw();
}
