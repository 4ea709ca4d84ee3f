// The bifurcation diagram: both directions fill in live; a click goes to the motion; branches lie over it, and a click on
// one of their special points goes on from there.
import { announce, button, element } from "../dom.ts";
import { Lane } from "../lane.ts";
import { short, symbol } from "../numbers.ts";
import { type Hit, type Layer, Numbers } from "../plot/layers.ts";
import { Plot } from "../plot/plot.ts";
import type { Branch, Model, ModelCard, Part, SpecialPoint } from "../protocol.ts";
import type { Settings } from "../settings.ts";

interface Sweep {
  down: boolean;
  layer: Extract<Layer, { kind: "dots" }>;
  /** The value's number of each dot, and the state that each value's recording starts from. */
  index: Numbers;
  states: Map<number, number[]>;
}

/** What a click means. */
export interface DiagramActs {
  /** @param unstable  motions beside it leave it */
  go(value: number, state: number[], unstable: boolean): void;
  /** The branches that begin at a special point. */
  born(branch: number, special: number): void;
  /** The curve of a special point when a second parameter varies too. */
  curve(branch: number, special: number): void;
}

/** A point of a branch that a layer shows. */
interface Shown {
  branch: number;
  /** Of each point of the layer: which of the branch's. */
  index: number[];
}

export class DiagramView {
  readonly plot: Plot;
  /** The special point that was clicked, in words, and what can be done with it. */
  readonly chosen = element("div", { class: "special", "aria-live": "polite", hidden: true });
  readonly progress = document.createElement("span");
  private readonly lanes = { up: new Lane(), down: new Lane() };
  private sweeps: Sweep[] = [];
  private branches: Branch[] = [];
  private readonly shown = new Map<Layer, Shown>();
  private settings: Settings["diagram"] | undefined;

  constructor(private readonly acts: DiagramActs) {
    this.plot = new Plot({
      name: "bifurcation diagram", xLabel: "", yLabel: "",
      pick: (x, _y, hit) => this.pick(x, hit),
      read: (x, y, hit) => this.read(x, y, hit),
    });
  }

  run(model: Model, card: ModelCard, settings: Settings): void {
    const wish = settings.diagram;
    this.settings = wish;
    this.branches = [];
    this.chosen.hidden = true;
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

  /** Branches that lie over the diagram, beside those that do; none takes all away. */
  showBranches(more: readonly Branch[]): void {
    this.branches = more.length > 0 ? [...this.branches, ...more] : [];
    if (more.length === 0) this.chosen.hidden = true;
    this.layers();
  }

  /** So many points of a branch or curve are followed; 0: none any more. */
  following(points: number): void {
    this.progress.textContent = points > 0 ? `following: ${points} points` : "";
  }

  get hasBranch(): boolean {
    return this.branches.length > 0;
  }

  get busy(): boolean {
    return this.lanes.up.isBusy || this.lanes.down.isBusy;
  }

  private layers(): void {
    this.shown.clear();
    const lines: Layer[] = [], marks: Layer[] = [];
    this.branches.forEach((branch, k) => {
      for (const { layer, index } of branchLayers(branch)) {
        this.shown.set(layer, { branch: k, index });
        (layer.kind === "marks" ? marks : lines).push(layer);
      }
    });
    this.plot.set([...this.sweeps.map(({ layer }) => layer), ...lines, ...marks]);
  }

  private pick(x: number, hit: Hit | undefined): void {
    const wish = this.settings, over = hit && this.shown.get(hit.layer);
    if (!wish) return;
    if (hit && over) {
      const which = over.index[hit.index] ?? 0;
      if (hit.layer.kind === "marks") this.special(over.branch, which);
      else {
        const point = this.branches[over.branch]?.points[which];
        if (point) this.acts.go(point.value, point.state, !point.stable);
      }
      return;
    }
    const wanted = this.sweeps.find(({ layer }) => layer === hit?.layer) ?? this.sweeps[0];
    const index = Math.min(Math.max(Math.round(((x - wish.from) / (wish.to - wish.from)) * (wish.count - 1)), 0), wish.count - 1);
    const found = hit && wanted && hit.layer === wanted.layer ? wanted.index.at(hit.index) : index;
    const value = hit ? hit.x : wish.from + (index / Math.max(wish.count - 1, 1)) * (wish.to - wish.from);
    this.acts.go(value, wanted?.states.get(found) ?? [], false);
  }

  /** Goes on from a special point: with the branch that begins there, else with its curve. */
  private special(branch: number, which: number): void {
    const point = this.branches[branch]?.special[which];
    if (!point) return;
    this.chosen.hidden = false;
    this.chosen.replaceChildren(
      element("span", {}, this.words(point)),
      ...(point.begins ? [button("Branch from here", "follow the branches that begin at this point", () => this.acts.born(branch, which))] : []),
      button("Curve", "follow this point when a second parameter varies too, over the chart", () => this.acts.curve(branch, which)),
      button("Motion", "the motion of the orbit at this point", () => this.acts.go(point.value, point.state, true)),
      button("×", "leave this point", () => { this.chosen.hidden = true; }, { class: "plain" }),
    );
    if (point.begins) this.acts.born(branch, which);
    else this.acts.curve(branch, which);
  }

  private words({ type, value, what, becomes }: SpecialPoint): string {
    return `${type} at ${symbol(this.settings?.parameter ?? "x")} = ${short(value, 8)}: ${what}${becomes ? `, ${becomes}` : ""}`;
  }

  private read(x: number, y: number, hit: Hit | undefined): string {
    const name = symbol(this.settings?.parameter ?? "x"), over = hit && this.shown.get(hit.layer);
    const branch = over && this.branches[over.branch], which = over?.index[hit?.index ?? 0] ?? 0;
    const special = hit?.layer.kind === "marks" ? branch?.special[which] : undefined;
    if (special) return `${this.words(special)}. Click: ${special.begins ? "what begins here" : "its curve"}`;
    const label = branch?.points[which]?.label;
    return `${name} = ${short(x, 6)}, ${short(y, 6)}${hit ? ` (${hit.layer.name}${label ? ` ${label}` : ""})` : ""}`;
  }
}

/** Stable parts of a branch are whole lines, unstable ones dashed; a line for each impact of the cycle. */
export function branchLayers(branch: Branch): { layer: Layer; index: number[] }[] {
  const found: { layer: Layer; index: number[] }[] = [];
  for (const stable of [true, false]) {
    const most = Math.max(0, ...branch.points.map(({ shown }) => shown.length));
    for (let k = 0; k < most; ++k) {
      const x: number[] = [], y: number[] = [], index: number[] = [];
      branch.points.forEach((point, i) => {
        const beside = branch.points[i + 1]?.stable === stable || branch.points[i - 1]?.stable === stable;
        const is = point.stable === stable || (stable && beside);
        const before = branch.points[i - 1];
        if (before && before.shown.length !== point.shown.length) x.push(NaN), y.push(NaN), index.push(i);
        x.push(is ? point.value : NaN);
        y.push(is ? point.shown[k] ?? NaN : NaN);
        index.push(i);
      });
      if (x.some((value) => !Number.isNaN(value)))
        found.push({ index, layer: { kind: "line", name: stable ? "stable orbit" : "unstable orbit", x, y, width: 2, colour: (colours) => (stable ? colours.stable : colours.unstable), ...(stable ? {} : { dash: [6, 4] }) } });
    }
  }
  const x: number[] = [], y: number[] = [], texts: string[] = [], index: number[] = [];
  // A cycle of many impacts would have as many marks: the first stands for all.
  branch.special.forEach(({ type, value, shown, inCascade }, which) => shown.slice(0, inCascade ? 0 : shown.length > 3 ? 1 : 3).forEach((height, i) => {
    x.push(value), y.push(height), texts.push(i === 0 ? type : ""), index.push(which);
  }));
  return [...found, { index, layer: { kind: "marks", name: "special point", shape: "diamond", x, y, texts, colour: (colours) => colours.impact } }];
}
