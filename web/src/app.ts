// The page: settings in, requests out, views in step. Nothing here computes dynamics.
import { fill } from "./fill.ts";
import { Following } from "./following.ts";
import { Lane } from "./lane.ts";
import { Editor } from "./panels/editor.ts";
import { ParametersPanel } from "./panels/parameters.ts";
import { type Saved, SharePanel } from "./panels/share.ts";
import { Player } from "./player.ts";
import type { Classification, EngineError, Model, ModelCard } from "./protocol.ts";
import { fromHash, History, isText, type Settings, settingsOf, toHash } from "./settings.ts";
import { ChartView } from "./views/chart.ts";
import { DiagramView } from "./views/diagram.ts";
import { ForcesView, forcesOf } from "./views/forces.ts";
import { MechanismView } from "./views/mechanism.ts";
import { MotionViews } from "./views/motion.ts";
import { SectionView } from "./views/section.ts";
import { SpectrumView } from "./views/spectrum.ts";
import { MotionWindow } from "./window.ts";

/** After a change the quick views follow at once, the long ones when the person rests, in milliseconds. */
const rest = 220;

export interface Listeners {
  settings(settings: Settings, card: ModelCard): void;
  played(playing: boolean): void;
  classified(text: string, detail: string): void;
  failed(message: string): void;
}

export class App {
  readonly history: History;
  readonly player: Player;
  readonly mechanism: MechanismView;
  readonly motion: MotionViews;
  readonly section: SectionView;
  readonly diagram: DiagramView;
  readonly spectrum: SpectrumView;
  readonly forces: ForcesView;
  readonly chart: ChartView;
  private readonly following: Following;
  readonly parameters: ParametersPanel;
  readonly editor: Editor;
  readonly share = new SharePanel();
  card: ModelCard | undefined;

  private readonly lanes = {
    motion: new Lane(), section: new Lane(), card: new Lane(), class: new Lane(true), spectrum: new Lane(true), branch: new Lane(true), editor: new Lane(),
  };
  private restTimer = 0;
  private lastState: number[] = [];
  /** What the present model opens with. */
  private base: Settings = settingsOf("");
  /** A drag goes on from where the motion is. */
  carryOn = false;
  private drawnFor = { section: "", spectrum: "", chart: "", diagram: "", class: "" };

  constructor(first: Settings, private readonly listeners: Listeners) {
    this.history = new History(first);
    this.player = new Player(() => this.frame(), () => this.goOn(), () => this.showWindow(), () => this.listeners.played(this.player.playing));
    this.mechanism = new MechanismView(this.player, (state, over) => this.start(state, over));
    this.motion = new MotionViews(this.player, (axis, name) => this.change("phase", (draft) => { draft.motion[axis] = name; }));
    this.section = new SectionView(this.lanes.section, (edit) => this.change("section", (draft) => edit(draft.section)));
    this.diagram = new DiagramView({
      go: (value, state, unstable) => this.goTo(value, state, unstable),
      born: (branch, special) => this.following.born(branch, special),
      curve: (branch, special) => this.following.curve(branch, special, this.model()),
    });
    this.spectrum = new SpectrumView(this.lanes.spectrum, (name) => this.change("spectrum", (draft) => { draft.spectrum = name; }));
    this.forces = new ForcesView((time) => this.player.seek(time), (names) => this.change("forces", (draft) => { draft.forces = names; }));
    this.chart = new ChartView((x, y) => this.change("chart", (draft) => {
      draft.set[draft.chart.x] = x;
      draft.set[draft.chart.y] = y;
    }), (edit) => this.change("chart view", (draft) => {
      const before = { ...draft.chart };
      edit(draft.chart);
      if (draft.chart.x !== before.x) [draft.chart.xFrom, draft.chart.xTo] = this.rangeOf(draft.chart.x);
      if (draft.chart.y !== before.y) [draft.chart.yFrom, draft.chart.yTo] = this.rangeOf(draft.chart.y);
    }));
    this.following = new Following(this.lanes.branch, this.history, this.diagram, this.chart);
    this.parameters = new ParametersPanel((name, value) => this.setParameter(name, value), (name, from, to) => this.change("diagram", (draft) => {
      Object.assign(draft.diagram, { parameter: name, from, to });
    }));
    this.editor = new Editor(this.lanes.editor, (text) => this.open(text));
    this.history.onChange((now, before) => void this.settle(now, before));
  }

  change(key: string, edit: (draft: Settings) => void): void {
    this.history.change(key, edit);
  }

  /** Opens a built-in model by name, or a text. */
  open(source: string): void {
    this.change("model", (draft) => Object.assign(draft, settingsOf(isText(source) ? "" : source), { source }));
  }

  /** The first model. */
  begin(): Promise<void> {
    return this.load(this.history.now);
  }

  async address(): Promise<string> {
    return toHash(this.history.now, this.base);
  }

  async openAddress(hash: string): Promise<boolean> {
    const found = await fromHash(hash);
    if (!found || JSON.stringify(found) === JSON.stringify(this.history.now)) return false;
    this.change("link", (draft) => Object.assign(draft, found));
    return true;
  }

  setParameter(name: string, value: number | undefined): void {
    this.change(`parameter ${name}`, (draft) => {
      if (value === undefined) delete draft.set[name];
      else draft.set[name] = value;
      const group = this.card?.groups.find((one) => one.name === name);
      for (const member of group?.members ?? []) delete draft.set[member];
      for (const one of this.card?.groups ?? []) if (one.members.includes(name) && draft.set[one.name] !== undefined) {
        for (const member of one.members) draft.set[member] ??= draft.set[one.name] as number;
        delete draft.set[one.name];
      }
      if (this.carryOn && this.lastState.length > 0) draft.start = this.lastState;
    });
  }

  /** The motion from a state, without a transient. */
  private start(state: number[], over: boolean): void {
    this.change("start", (draft) => {
      draft.start = state;
      draft.motion.transient = 0;
    });
    this.player.toBegin();
    if (over) this.player.play();
  }

  /** An unstable orbit is seen only as long as nothing has grown beside it. */
  private goTo(value: number, state: number[], unstable: boolean): void {
    this.change("diagram click", (draft) => {
      draft.set[draft.diagram.parameter] = value;
      draft.start = state;
      if (unstable) draft.motion.transient = 0;
      else if (draft.motion.transient === 0 && this.card?.forced) draft.motion.transient = 200;
    });
  }

  /** What is not finished is begun anew when the chart is seen again. */
  leaveChart(): void {
    this.chart.stop();
    if (!this.chart.finished) this.drawnFor.chart = "";
  }

  rangeOf(name: string): [number, number] {
    return this.parameters.range(name) ?? [0, 1];
  }

  /** The branch of the present orbit over the diagram, or none again. */
  followBranch(): void {
    this.following.branch(this.model());
  }

  saved(): Saved[] {
    const plots = [
      ["time series", this.motion.time], ["phase portrait", this.motion.phase], ["section", this.section.plot], ["spectrum", this.spectrum.plot],
      ["forces", this.forces.plot], ["diagram", this.diagram.plot], ["chart", this.chart.plot],
    ] as const;
    return [
      { name: "mechanism", svg: () => this.mechanism.svg(this.card?.name ?? "mechanism") },
      ...plots.filter(([, plot]) => plot.host.clientWidth > 0).map(([name, plot]) => ({
        name, svg: () => plot.svg(`${this.card?.name ?? ""}, ${name}`), png: () => plot.png(), csv: () => plot.csv(),
      })),
    ];
  }

  redraw(): void {
    for (const plot of [this.motion.time, this.motion.phase, this.section.plot, this.diagram.plot, this.spectrum.plot, this.forces.plot]) plot.redraw();
    this.chart.recolour();
    this.mechanism.draw();
  }

  /** The next window; not while a new motion is on its way, which this request would cancel. */
  private goOn(): void {
    if (!this.lanes.motion.isBusy) this.lanes.motion.ask({ verb: "goOn" }, this.hearing(true));
  }

  /** Nothing is being computed: for tests. */
  get idle(): boolean {
    return this.restTimer === 0 && !this.diagram.busy && Object.values(this.lanes).every((lane) => !lane.isBusy);
  }

  /** A motion is being computed: for tests. */
  get movesOn(): boolean {
    return this.lanes.motion.isBusy;
  }

  private model(): Model {
    const { source, set, start } = this.history.now;
    return { source, set, start };
  }

  private async settle(now: Settings, before: Settings): Promise<void> {
    const standard = Object.keys(before.set).some((name) => !(name in now.set));  // a value is the model's own again
    if (now.source !== before.source || standard || !this.card) {
      await this.load(now);
      return;
    }
    fill(now, this.card);
    const motion = (settings: Settings): string => JSON.stringify([settings.set, settings.start, settings.motion.transient, settings.motion.periods, settings.forces, settings.view === "forces"]);
    if (motion(now) !== motion(before)) {
      this.showValues(now);
      this.askMotion();
    } else this.showWindow();
    this.listeners.settings(now, this.card);
    this.later();
  }

  /** A model's card, then all of its views. */
  private async load(settings: Settings): Promise<void> {
    try {
      const card = await this.lanes.card.question<ModelCard>({ verb: "card", model: { ...this.model(), start: [] } });
      if (this.history.now.source !== settings.source) return;
      this.card = card;
      this.base = settingsOf(isText(settings.source) ? "" : settings.source);
      fill(this.base, card);
      fill(this.history.now, card);
      this.player.window = undefined;
      this.player.time = 0;
      this.mechanism.show(card);
      this.parameters.show(card, this.history.now);
      this.listeners.failed("");
      this.listeners.settings(this.history.now, card);
      this.askMotion();
      this.later();
    } catch (error) {
      this.listeners.failed((error as EngineError).message ?? String(error));
    }
  }

  private showValues(now: Settings): void {
    if (!this.card) return;
    for (const parameter of this.card.parameters) {
      const group = this.card.groups.find(({ name, members }) => now.set[name] !== undefined && members.includes(parameter.name));
      const value = now.set[parameter.name] ?? (group && now.set[group.name]);
      if (value !== undefined) parameter.value = value;
    }
    this.parameters.show(this.card, now);
  }

  private askMotion(): void {
    const { card } = this;
    if (!card) return;
    const settings = this.history.now, { transient, periods } = settings.motion;
    const samples = Math.max(20, Math.min(400, Math.round(2400 / periods)));
    this.lanes.motion.ask({ verb: "motion", model: this.model(), wish: { transient, periods, samples, of: this.wanted().join(",") } }, this.hearing(false));
  }

  private wanted(): string[] {
    return this.card && this.history.now.view === "forces" ? forcesOf(this.card, this.history.now) : [];
  }

  private hearing(next: boolean): object {
    const card = this.card, of = this.wanted(), { periods } = this.history.now.motion;
    return {
      part: (part: ConstructorParameters<typeof MotionWindow>[0]) => {
        if (!card || card !== this.card) return;
        const window = new MotionWindow(part, card, of, periods);
        if (next) {
          this.player.follow(window);
          return;
        }
        this.lastState = window.state(card, periods);
        this.player.show(window);
        this.mechanism.fit(window);
        this.showWindow();
      },
      done: (failure: string) => {
        if (!next && this.player.playing) this.goOn();
        this.listeners.failed(failure);
        this.parameters.blame("");
      },
      error: (error: EngineError) => {
        this.listeners.failed(error.message);
        this.parameters.blame(error.message);
      },
    };
  }

  private showWindow(): void {
    const { window } = this.player, { card } = this;
    if (!window || !card) return;
    const { motion, view } = this.history.now;
    this.mechanism.fit(window);
    this.motion.show(window, card, motion.x, motion.y);
    if (view === "forces") this.forces.show(window, card, forcesOf(card, this.history.now));
    this.frame();
  }

  private frame(): void {
    const { motion, view } = this.history.now;
    this.mechanism.draw();
    this.motion.frame(motion.x, motion.y);
    if (view === "forces") {
      this.forces.plot.cursorX = this.player.time;
      this.forces.plot.overlay();
    }
  }

  /** The long views, when the person rests. */
  private later(): void {
    clearTimeout(this.restTimer);
    const { parameter } = this.history.now.diagram, value = this.card?.parameters.find(({ name }) => name === parameter)?.value;
    if (value !== undefined) this.diagram.mark(this.history.now.set[parameter] ?? value);
    const { x, y } = this.history.now.chart, valueOf = (name: string): number | undefined => {
      const group = this.card?.groups.find((one) => one.name === name);
      return this.history.now.set[name] ?? this.card?.parameters.find((one) => one.name === (group?.members[0] ?? name))?.value;
    };
    const [chartX, chartY] = [valueOf(x), valueOf(y)];
    this.chart.plot.dot = chartX === undefined || chartY === undefined ? undefined : { x: chartX, y: chartY };
    this.chart.plot.overlay();
    this.restTimer = window.setTimeout(() => {
      this.restTimer = 0;
      this.runLong();
    }, rest);
  }

  private runLong(): void {
    const { card } = this, now = this.history.now;
    if (!card) return;
    const model = this.model(), { source, set, start } = model;
    const others = (...names: string[]): [string, number][] => Object.entries(set).filter(([name]) => !names.includes(name));
    const due = (view: keyof typeof this.drawnFor, ...of: unknown[]): boolean => {
      const key = JSON.stringify([source, ...of]);
      if (this.drawnFor[view] === key) return false;
      this.drawnFor[view] = key;
      return true;
    };
    if (due("class", set, start)) this.classify(model);
    if (now.view === "section" && due("section", set, start, now.section)) this.section.run(model, card, now);
    if (now.view === "spectrum" && due("spectrum", set, start, now.spectrum)) this.spectrum.run(model, card, now);
    if (now.view === "chart" && due("chart", others(now.chart.x, now.chart.y), now.chart)) this.chart.run(model, card, now);
    if (due("diagram", others(now.diagram.parameter), now.diagram)) {
      this.lanes.branch.cancel();
      this.diagram.run(model, card, now);
    }
    void this.lanes.card.question<ModelCard>({ verb: "card", model: { ...model, start: [] } }).then((fresh) => {
      if (this.card !== card) return;
      fresh.parameters.forEach((parameter, i) => Object.assign(card.parameters[i] ?? {}, { value: parameter.value }));
      this.parameters.show(card, this.history.now);
    }, () => undefined);
  }

  private classify(model: Model): void {
    this.listeners.classified("…", "being classified");
    this.lanes.class.question<Classification>({ verb: "classify", model, periods: 8000 }).then((found) => {
      const parts = found.attractor === found.label ? [] : [found.attractor];
      if (found.attractor === "periodic" && found.n > 0 && this.card?.forced) parts.push(`${found.n} forcing period${found.n > 1 ? "s" : ""}`, found.chatter === "complete" ? "complete chatter" : `${found.p} impact${found.p === 1 ? "" : "s"}`);
      if (found.sticking) parts.push("with stick");
      if (found.attractor === "chaotic") parts.push(`exponent ${found.exponent.toPrecision(3)} per period`);
      this.listeners.classified(found.label, parts.join(", "));
    }, (error: EngineError) => this.listeners.classified("", error.message));
  }
}
