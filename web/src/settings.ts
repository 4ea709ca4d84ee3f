// The page's settings: all that a link holds, and their history.
import { presetOf } from "./presets.ts";

export type Direction = "up" | "down" | "both";
export type Drawn = "motion" | "section" | "spectrum" | "forces" | "chart";

export interface Settings {
  /** The name of a built-in model, or the text of a model file. */
  source: string;
  set: Record<string, number>;
  /** Empty: the model's own start. */
  start: number[];
  motion: { transient: number; periods: number; x: string; y: string };
  section: { at: string; x: string; y: string; points: number };
  diagram: {
    parameter: string; from: number; to: number; count: number; transient: number; points: number;
    direction: Direction; shown: string; at: string;
  };
  /** Quantities of the view of forces; empty: the contacts' forces. */
  forces: string[];
  /** Quantity of the spectrum; "": the first displacement. */
  spectrum: string;
  chart: { x: string; y: string; xFrom: number; xTo: number; yFrom: number; yTo: number; size: number };
  /** Which view stands beside the motion. */
  view: "section" | "spectrum" | "forces" | "chart";
}

export function isText(source: string): boolean {
  return source.includes("\n");
}

/** The settings that a built-in model opens with. */
export function settingsOf(name: string): Settings {
  return structuredClone(presetOf(name));
}

type Json = string | number | boolean | null | Json[] | { [key: string]: Json };

function isObject(value: unknown): value is Record<string, Json> {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** What of `value` differs from `base`; undefined if nothing does. */
function difference(value: unknown, base: unknown): Json | undefined {
  if (isObject(value) && isObject(base)) {
    const changed: Record<string, Json> = {};
    for (const [key, item] of Object.entries(value)) {
      const other = difference(item, base[key]);
      if (other !== undefined) changed[key] = other;
    }
    return Object.keys(changed).length > 0 ? changed : undefined;
  }
  return JSON.stringify(value) === JSON.stringify(base) ? undefined : (value as Json);
}

/** `base` with what `changes` has of the same kind; keys and kinds that it does not have are left out. */
function merged<Any>(base: Any, changes: unknown): Any {
  if (isObject(base)) {
    if (!isObject(changes)) return base;
    const open = Object.keys(base).length === 0;  // `set`: any name, numbers only
    const result: Record<string, unknown> = { ...base };
    for (const [key, item] of Object.entries(changes)) {
      if (open ? typeof item === "number" && Number.isFinite(item) : key in base)
        result[key] = open ? item : merged((base as Record<string, unknown>)[key], item);
    }
    return result as Any;
  }
  if (Array.isArray(base)) return (Array.isArray(changes) ? changes : base) as Any;
  const fits = typeof changes === typeof base && (typeof changes !== "number" || Number.isFinite(changes));
  return (fits ? changes : base) as Any;
}

function toBase64(bytes: Uint8Array): string {
  let text = "";
  for (const byte of bytes) text += String.fromCharCode(byte);
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

function fromBase64(text: string): Uint8Array<ArrayBuffer> {
  return Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
}

async function squeezed(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream): Promise<Uint8Array<ArrayBuffer>> {
  const read = new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer();
  return new Uint8Array(await read);
}

/**
 * The part of an address behind `#`: readable for a built-in model, packed for a text.
 * @param base  what the model opens with: only what differs is written
 */
export async function toHash(settings: Settings, base: Settings): Promise<string> {
  const { source, set, ...others } = settings;
  const words: string[] = [];
  if (isText(source)) {
    const packed = await squeezed(new TextEncoder().encode(source), new CompressionStream("deflate-raw"));
    words.push(`text=${toBase64(packed)}`);
  } else {
    words.push(`model=${encodeURIComponent(source)}`);
  }
  for (const [name, value] of Object.entries(set)) words.push(`${encodeURIComponent(name)}=${String(value)}`);
  const { source: _source, set: _set, ...known } = base;
  const changed = difference(others, known);
  if (changed !== undefined) words.push(`page=${encodeURIComponent(JSON.stringify(changed))}`);
  return words.join("&");
}

/** @throws Error for an address that holds no settings */
export async function fromHash(hash: string): Promise<Settings | undefined> {
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  const text = words.get("text"), model = words.get("model");
  if (text === null && model === null) return undefined;
  const source = text === null
    ? model ?? ""
    : new TextDecoder().decode(await squeezed(fromBase64(text), new DecompressionStream("deflate-raw")));
  const changes: unknown = JSON.parse(words.get("page") ?? "{}");
  const base = settingsOf(text === null ? source : "");
  const set: Record<string, number> = {};
  for (const [name, value] of words)
    if (!["text", "model", "page", "story", "step", "embed"].includes(name) && Number.isFinite(Number(value))) set[name] = Number(value);
  return { ...merged(base, changes), source, set };
}

/** Settings with undo: changes in quick succession, as of a drag, are one step. */
export class History {
  private past: Settings[] = [];
  private future: Settings[] = [];
  private last = { key: "", time: 0 };
  private readonly listeners: ((now: Settings, before: Settings) => void)[] = [];

  constructor(private present: Settings) {}

  get now(): Settings {
    return this.present;
  }

  onChange(listener: (now: Settings, before: Settings) => void): void {
    this.listeners.push(listener);
  }

  /** @param key  what is changed: the same key within a second is the same step */
  change(key: string, edit: (draft: Settings) => void): void {
    const draft = structuredClone(this.present);
    edit(draft);
    if (JSON.stringify(draft) === JSON.stringify(this.present)) return;
    const time = performance.now();
    if (key !== this.last.key || time - this.last.time > 1000) this.past.push(this.present);
    if (this.past.length > 200) this.past.shift();
    this.last = { key, time };
    this.future = [];
    this.set(draft);
  }

  undo(): void {
    this.step(this.past, this.future);
  }

  redo(): void {
    this.step(this.future, this.past);
  }

  get canUndo(): boolean {
    return this.past.length > 0;
  }

  get canRedo(): boolean {
    return this.future.length > 0;
  }

  private step(from: Settings[], to: Settings[]): void {
    const next = from.pop();
    if (!next) return;
    to.push(this.present);
    this.last = { key: "", time: 0 };
    this.set(next);
  }

  private set(next: Settings): void {
    const before = this.present;
    this.present = next;
    for (const listener of this.listeners) listener(next, before);
  }
}
