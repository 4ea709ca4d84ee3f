// The bifurcation diagram: both directions fill in live; a click goes to the motion; a branch lies over it.
import { announce } from "../dom.ts";
import { Lane } from "../lane.ts";
import { short, symbol } from "../numbers.ts";
import { type Hit, type Layer, Numbers } from "../plot/layers.ts";
import { Plot } from "../plot/plot.ts";
import type { Branch, Model, ModelCard, Part } from "../protocol.ts";
import type { Settings } from "../settings.ts";

interface Sweep {
  down: boolean;
  layer: Extract<Layer, { kind: "dots" }>;
  /** The value's number of each dot, and the state that each value's recording starts from. */
  index: Numbers;
  states: Map<number, number[]>;
}

export class DiagramView {
  readonly plot: Plot;
  readonly progress = document.createElement("span");
  private readonly lanes = { up: new Lane(), down: new Lane() };
  private sweeps: Sweep[] = [];
  private branch: Branch | undefined;
  private settings: Settings["diagram"] | undefined;

  /** @param go  a click: the parameter's value, and the state of the attractor there */
  constructor(private readonly go: (value: number, state: number[]) => void) {
    this.plot = new Plot({
      name: "bifurcation diagram", xLabel: "", yLabel: "",
      pick: (x, _y, hit) => this.pick(x, hit),
      read: (x, y, hit) => this.read(x, y, hit),
    });
  }

  run(model: Model, card: ModelCard, settings: Settings): void {
    const wish = settings.diagram;
    this.settings = wish;
    this.branch = undefined;
    const meaning = card.parameters.find(({ name }) => name === wish.parameter);
    this.plot.xLabel = `${symbol(wish.parameter)}${meaning?.meaning ? `  ${meaning.meaning.split(";")[0] ?? ""}` : ""}${meaning?.unit ? `  (${meaning.unit})` : ""}`;
    this.plot.yLabel = wish.shown === "w" ? "impact speed w" : wish.shown === "flight" ? "flight / period" : `${wish.shown} ${wish.at === "periods" ? "once a period" : `at ${wish.at}`}`;
    this.plot.fixedX = [wish.from, wish.to];
    this.plot.note = "";
    this.lanes.up.cancel();
    this.lanes.down.cancel();
    const both = wish.direction === "both";
    const directions = both ? [false, true] : [wish.direction === "down"];
    this.sweeps = directions.map((down) => ({
      down, index: new Numbers(), states: new Map(),
      layer: {
        kind: "dots", name: down ? "going down" : "going up", x: new Numbers(), y: new Numbers(),
        colour: (colours) => (down ? colours.down : colours.up), size: both && !down ? 1.9 : 1.3, opacity: both && !down ? 0.65 : 0.8,
      },
    }));
    this.layers();
    for (const sweep of this.sweeps) this.start(sweep, model);
  }

  private start(sweep: Sweep, model: Model): void {
    const { direction: _direction, ...wish } = this.settings as Settings["diagram"];
    const { start: _start, ...plain } = model;
    const set = Object.fromEntries(Object.entries(model.set).filter(([name]) => name !== wish.parameter));
    this.lanes[sweep.down ? "down" : "up"].ask({ verb: "diagram", model: { ...plain, set, start: [] }, wish: { ...wish, down: sweep.down } }, {
      part: (part) => {
        this.take(sweep, part);
      },
      done: (failure) => {
        this.told();
        if (failure) this.plot.note = sweep.layer.x.length === 0 ? failure : "";
        if (failure && sweep.layer.x.length > 0) announce(`some values failed, first ${failure}`);
        this.plot.settle();
      },
      error: (error) => {
        this.plot.note = error.message;
        this.plot.redraw();
      },
    });
  }

  private take(sweep: Sweep, { rows, width, events, eventWidth }: Part): void {
    for (let i = 0; i < rows.length; i += width) {
      sweep.index.push(rows[i] as number);
      sweep.layer.x.push(rows[i + 1] as number);
      sweep.layer.y.push(rows[i + 2] as number);
    }
    for (let i = 0; i < events.length; i += eventWidth)
      sweep.states.set(events[i] as number, [...events.slice(i + 1, i + eventWidth)]);
    this.plot.more();
    this.told();
  }

  private told(): void {
    const count = this.settings?.count ?? 0;
    const done = this.sweeps.reduce((sum, { states }) => sum + states.size, 0), all = count * this.sweeps.length;
    const busy = this.lanes.up.isBusy || this.lanes.down.isBusy;
    this.progress.textContent = busy ? `${Math.round((100 * done) / Math.max(all, 1))} %` : "";
  }

  /** The values of the parameter are those of the model now. */
  mark(value: number): void {
    if (this.plot.cursorX === value) return;
    this.plot.cursorX = value;
    this.plot.overlay();
  }

  showBranch(branch: Branch | undefined): void {
    this.branch = branch;
    this.layers();
  }

  get hasBranch(): boolean {
    return this.branch !== undefined;
  }

  get busy(): boolean {
    return this.lanes.up.isBusy || this.lanes.down.isBusy;
  }

  private layers(): void {
    this.plot.set([...this.sweeps.map(({ layer }) => layer), ...(this.branch ? branchLayers(this.branch) : [])]);
  }

  private pick(x: number, hit: Hit | undefined): void {
    const wish = this.settings;
    if (!wish) return;
    const wanted = this.sweeps.find(({ layer }) => layer === hit?.layer) ?? this.sweeps[0];
    const index = Math.min(Math.max(Math.round(((x - wish.from) / (wish.to - wish.from)) * (wish.count - 1)), 0), wish.count - 1);
    const found = hit && wanted && hit.layer === wanted.layer ? wanted.index.at(hit.index) : index;
    const state = wanted?.states.get(found);
    const value = hit ? hit.x : wish.from + (index / Math.max(wish.count - 1, 1)) * (wish.to - wish.from);
    this.go(value, state ?? []);
  }

  private read(x: number, y: number, hit: Hit | undefined): string {
    const name = symbol(this.settings?.parameter ?? "x");
    if (hit?.layer.kind === "marks") {
      const special = this.branch?.special[this.owner(hit)];
      if (special) return `${special.type} at ${name} = ${short(special.value, 8)}: ${special.what}${special.becomes ? `, ${special.becomes}` : ""}`;
    }
    return `${name} = ${short(x, 6)}, ${short(y, 6)}${hit ? ` (${hit.layer.name})` : ""}`;
  }

  private owner(hit: Hit): number {
    let rest = hit.index;
    return this.branch?.special.findIndex(({ shown }) => (rest -= shown.length) < 0) ?? -1;
  }
}

/** Stable parts of a branch are whole lines, unstable ones dashed; a line for each impact of the cycle. */
export function branchLayers(branch: Branch): Layer[] {
  const lines: Layer[] = [];
  for (const stable of [true, false]) {
    const most = Math.max(0, ...branch.points.map(({ shown }) => shown.length));
    for (let k = 0; k < most; ++k) {
      const x: number[] = [], y: number[] = [];
      branch.points.forEach((point, i) => {
        const beside = branch.points[i + 1]?.stable === stable || branch.points[i - 1]?.stable === stable;
        const is = point.stable === stable || (stable && beside);
        const before = branch.points[i - 1];
        if (before && before.shown.length !== point.shown.length) x.push(NaN), y.push(NaN);
        x.push(is ? point.value : NaN);
        y.push(is ? point.shown[k] ?? NaN : NaN);
      });
      if (x.some((value) => !Number.isNaN(value)))
        lines.push({ kind: "line", name: stable ? "stable orbit" : "unstable orbit", x, y, width: 2, colour: (colours) => (stable ? colours.stable : colours.unstable), ...(stable ? {} : { dash: [6, 4] }) });
    }
  }
  const x: number[] = [], y: number[] = [], texts: string[] = [];
  for (const { type, value, shown } of branch.special) shown.forEach((height, i) => {
    x.push(value), y.push(height), texts.push(i === 0 ? type : "");
  });
  return [...lines, { kind: "marks", name: "special point", shape: "diamond", x, y, texts, colour: (colours) => colours.impact }];
}
