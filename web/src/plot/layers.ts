// What a plot shows, as data, and how each kind is drawn.
import type { Palette } from "./palette.ts";
import type { Pen } from "./pen.ts";

/** A list of numbers that grows. */
export class Numbers {
  private held = new Float64Array(1024);
  length = 0;

  push(value: number): void {
    if (this.length === this.held.length) {
      const larger = new Float64Array(2 * this.length);
      larger.set(this.held);
      this.held = larger;
    }
    this.held[this.length++] = value;
  }

  at(i: number): number {
    return this.held[i] as number;
  }
}

export type Colour = (palette: Palette) => string;

export type Layer =
  | { kind: "line"; name: string; x: ArrayLike<number>; y: ArrayLike<number>; colour: Colour; width?: number; dash?: readonly number[] }
  | { kind: "dots"; name: string; x: Numbers; y: Numbers; colour: Colour; size: number; opacity: number }
  /** Spans of x over the whole height, or its lowest part. */
  | { kind: "spans"; name: string; from: number[]; to: number[]; colour: Colour; opacity: number; strip?: [row: number, rows: number] }
  | { kind: "marks"; name: string; x: number[]; y: number[]; texts: string[]; colour: Colour; shape: "diamond" | "tick" }
  | { kind: "stems"; name: string; x: ArrayLike<number>; y: ArrayLike<number>; colour: Colour }
  /** A chart: a picture with a pixel for each cell, the lowest row last; what the cells are, row by row from the lowest. */
  | { kind: "cells"; name: string; columns: number; rows: number; box: Box; picture: HTMLCanvasElement; names: readonly string[] };

export interface Box {
  x0: number;
  x1: number;
  y0: number;
  y1: number;
}

/** Both parameters of a cell. */
export function cellAt({ box, columns, rows }: Extract<Layer, { kind: "cells" }>, i: number): [number, number] {
  const share = (k: number, count: number): number => k / Math.max(count - 1, 1);
  return [box.x0 + share(i % columns, columns) * (box.x1 - box.x0), box.y0 + share(Math.floor(i / columns), rows) * (box.y1 - box.y0)];
}

/** From numbers to pixels. */
export interface Frame {
  left: number;
  top: number;
  width: number;
  height: number;
  view: Box;
}

export const toX = (frame: Frame, x: number): number => frame.left + ((x - frame.view.x0) / (frame.view.x1 - frame.view.x0)) * frame.width;
export const toY = (frame: Frame, y: number): number => frame.top + frame.height - ((y - frame.view.y0) / (frame.view.y1 - frame.view.y0)) * frame.height;

/** The least box that holds a layer; empty layers have none. */
export function extentOf(layers: readonly Layer[]): Box | undefined {
  let x0 = Infinity, x1 = -Infinity, y0 = Infinity, y1 = -Infinity;
  const add = (x: number, y: number): void => {
    if (!Number.isFinite(x) || !Number.isFinite(y)) return;
    x0 = Math.min(x0, x), x1 = Math.max(x1, x), y0 = Math.min(y0, y), y1 = Math.max(y1, y);
  };
  for (const layer of layers) {
    if (layer.kind === "line" || layer.kind === "stems") for (let i = 0; i < layer.x.length; ++i) add(layer.x[i] as number, layer.y[i] as number);
    else if (layer.kind === "dots") for (let i = 0; i < layer.x.length; ++i) add(layer.x.at(i), layer.y.at(i));
    else if (layer.kind === "cells") add(layer.box.x0, layer.box.y0), add(layer.box.x1, layer.box.y1);
    if (layer.kind === "stems" && layer.x.length > 0) add(layer.x[0] as number, 0);
  }
  return x0 <= x1 ? { x0, x1, y0, y1 } : undefined;
}

function pixels(frame: Frame, count: number, x: (i: number) => number, y: (i: number) => number): Float64Array {
  const points = new Float64Array(2 * count);
  for (let i = 0; i < count; ++i) {
    points[2 * i] = toX(frame, x(i));
    points[2 * i + 1] = toY(frame, y(i));
  }
  return points;
}

function drawMark(pen: Pen, shape: "diamond" | "tick", x: number, y: number, colour: string, ground: string): void {
  if (shape === "diamond") {
    pen.fill([x, y - 6, x + 6, y, x, y + 6, x - 6, y], ground);
    pen.fill([x, y - 5, x + 5, y, x, y + 5, x - 5, y], colour);
  } else pen.fill([x - 3.5, y - 7, x + 3.5, y - 7, x, y], colour);
}

/** The text of a mark. */
export interface Label {
  x: number;
  y: number;
  text: string;
  colour: string;
}

/** Labels stand over all layers. */
export function drawLabels(pen: Pen, labels: readonly Label[]): void {
  for (const { x, y, text, colour } of labels) pen.text(x, y - 9, text, { colour, size: 11, anchor: "middle", baseline: "bottom", weight: 600 });
}

/**
 * @param from    dots before this one are drawn already
 * @param labels  gets those of marks; one that would cover another is left out
 */
export function drawLayer(pen: Pen, frame: Frame, layer: Layer, palette: Palette, from = 0, labels: Label[] = []): void {
  switch (layer.kind) {
    case "line":
      pen.line(pixels(frame, layer.x.length, (i) => layer.x[i] as number, (i) => layer.y[i] as number), {
        colour: layer.colour(palette), width: layer.width ?? 1.7, ...(layer.dash ? { dash: layer.dash } : {}),
      });
      break;
    case "dots":
      pen.dots(pixels(frame, layer.x.length - from, (i) => layer.x.at(from + i), (i) => layer.y.at(from + i)),
        layer.colour(palette), layer.size, layer.opacity);
      break;
    case "spans":
      layer.from.forEach((begin, i) => {
        const x = toX(frame, begin), width = Math.max(toX(frame, layer.to[i] as number) - x, 0.5);
        const [row, rows] = layer.strip ?? [0, 0];
        if (rows === 0) pen.rect(x, frame.top, width, frame.height, layer.colour(palette), layer.opacity);
        else pen.rect(x, frame.top + frame.height - 5 * (rows - row), width, 4, layer.colour(palette), layer.opacity);
      });
      break;
    case "marks":
      layer.x.forEach((value, i) => {
        const x = toX(frame, value), y = layer.shape === "tick" ? frame.top + 8 : toY(frame, layer.y[i] as number);
        drawMark(pen, layer.shape, x, y, layer.colour(palette), palette.ground);
        const text = layer.texts[i];
        if (text && layer.shape === "diamond" && !labels.some((other) => Math.abs(other.x - x) < 24 && Math.abs(other.y - y) < 14))
          labels.push({ x, y, text, colour: layer.colour(palette) });
      });
      break;
    case "stems":
      for (let i = 0; i < layer.x.length; ++i) {
        const x = toX(frame, layer.x[i] as number);
        pen.line([x, toY(frame, 0), x, toY(frame, layer.y[i] as number)], { colour: layer.colour(palette), width: 2.5 });
      }
      break;
    case "cells": {
      const { box, columns, rows } = layer;
      const dx = (box.x1 - box.x0) / (columns - 1), dy = (box.y1 - box.y0) / (rows - 1);
      const x = toX(frame, box.x0 - dx / 2), y = toY(frame, box.y1 + dy / 2);
      pen.image(layer.picture, x, y, toX(frame, box.x1 + dx / 2) - x, toY(frame, box.y0 - dy / 2) - y);
    }
  }
}

/** What is nearest to a place, within some pixels. */
export interface Hit {
  layer: Layer;
  index: number;
  x: number;
  y: number;
  distance: number;
}

export function nearest(frame: Frame, layers: readonly Layer[], px: number, py: number, within: number): Hit | undefined {
  let best: Hit | undefined;
  for (const layer of layers) {
    if (layer.kind === "spans" || layer.kind === "cells" || (layer.kind === "marks" && layer.shape === "tick")) continue;
    const read = (list: ArrayLike<number> | Numbers, i: number): number => (list instanceof Numbers ? list.at(i) : (list[i] as number));
    for (let i = 0; i < layer.x.length; ++i) {
      const x = read(layer.x, i), y = read(layer.y, i);
      const distance = Math.hypot(toX(frame, x) - px, toY(frame, y) - py) - (layer.kind === "marks" ? 6 : 0);
      if (distance < (best?.distance ?? within)) best = { layer, index: i, x, y, distance };
    }
  }
  return best;
}
