// Plays a motion: the playhead runs through the window, the next window follows where this one ends.
import type { MotionEvent, MotionWindow } from "./window.ts";

export interface Flash {
  contact: number;
  glow: number;
}

/** How long a flash is seen, seconds; and how long the way to the next impact takes in slow motion. */
const flashTime = 0.3, slowGap = 0.35;

export class Player {
  time = 0;
  /** Windows a person sees in ten seconds, more or less. */
  speed = 1;
  slow = false;
  playing = false;
  /** Time that has passed before this window, in periods. */
  elapsed = 0;
  window: MotionWindow | undefined;

  private next: MotionWindow | undefined;
  private last = 0;
  private readonly lit = new Map<number, { since: number; size: number }>();

  /**
   * @param frame  called for every frame while it plays, and after a change
   * @param wants  called when the next window is needed soon
   * @param swapped  called when a window has been taken
   * @param turned  called when it begins or ends to play
   */
  constructor(
    private readonly frame: () => void, private readonly wants: () => void, private readonly swapped: () => void, private readonly turned: () => void,
  ) {}

  /** A new motion: the playhead stays at its share of the window. */
  show(window: MotionWindow): void {
    const share = this.window ? this.time / this.window.periods : 0;
    this.window = window;
    this.next = undefined;
    this.elapsed = 0;
    this.time = Math.min(share * window.periods, window.periods);
    this.lit.clear();
    this.frame();
  }

  /** The window that follows. */
  follow(window: MotionWindow): void {
    this.next = window;
  }

  play(): void {
    if (this.playing) return;
    this.playing = true;
    this.turned();
    this.last = performance.now();
    if (!this.next) this.wants();
    requestAnimationFrame((now) => this.tick(now));
  }

  pause(): void {
    this.playing = false;
    this.turned();
    this.frame();
  }

  toBegin(): void {
    this.time = 0;
    this.lit.clear();
    this.frame();
  }

  /** To the next event; from the last one to the window that follows. */
  step(): void {
    this.playing = false;
    this.turned();
    const event = this.window?.events.find(({ time }) => time > this.time + 1e-12);
    if (event) {
      this.time = event.time;
      this.light(event, performance.now());
    } else if (this.next) this.swap();
    else this.wants();
    this.frame();
    setTimeout(() => this.frame(), flashTime * 1000 + 50);
  }

  seek(time: number): void {
    if (!this.window) return;
    this.time = Math.min(Math.max(time, 0), this.window.periods);
    this.frame();
  }

  flashes(): Flash[] {
    const now = performance.now(), list: Flash[] = [];
    for (const [contact, { since, size }] of this.lit) {
      const glow = (1 - (now - since) / (flashTime * 1000)) * size;
      if (glow > 0) list.push({ contact, glow });
    }
    return list;
  }

  private light(event: MotionEvent, now: number): void {
    if (event.kind !== "impact" && event.kind !== "engage" && event.kind !== "chatter") return;
    const hardest = Math.max(...(this.window?.events ?? []).map(({ w }) => Math.abs(w)), 1e-300);
    const size = event.kind === "chatter" ? 0.6 : 0.35 + (0.65 * Math.abs(event.w)) / hardest;
    this.lit.set(event.contact, { since: now, size });
  }

  /** Periods a second, now: in slow motion impacts that lie close are taken one by one. */
  private rate(): number {
    const window = this.window;
    if (!window) return 0;
    const plain = (window.periods / 10) * this.speed;
    if (!this.slow) return plain;
    const hits = window.events.filter(({ kind }) => kind === "impact" || kind === "engage");
    const after = hits.findIndex(({ time }) => time > this.time);
    const before = hits[after - 1], next = hits[after];
    if (!before || !next) return plain;
    return Math.min(plain, Math.max((next.time - before.time) / slowGap, plain / 100));
  }

  private swap(): void {
    if (!this.next || !this.window) return;
    this.elapsed += this.window.periods;
    this.window = this.next;
    this.next = undefined;
    this.time = 0;
    this.swapped();
    this.wants();
  }

  private tick(now: number): void {
    if (!this.playing || !this.window) return;
    const passed = Math.min((now - this.last) / 1000, 0.1);
    this.last = now;
    const before = this.time;
    this.time += passed * this.rate();
    for (const event of this.window.events) if (event.time > before && event.time <= this.time) this.light(event, now);
    if (this.time >= this.window.periods) {
      const rest = this.time - this.window.periods;
      this.time = this.window.periods;
      if (this.next) {
        this.swap();
        this.time = Math.min(rest, this.window.periods);
      }
    }
    this.frame();
    requestAnimationFrame((then) => this.tick(then));
  }
}
