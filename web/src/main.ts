// Puts the page together: header, transport, views, keys, theme, link.
import { App } from "./app.ts";
import { announce, button, choice, element } from "./dom.ts";
import { Lane } from "./lane.ts";
import { familyOf } from "./presets.ts";
import type { ModelCard } from "./protocol.ts";
import { fromHash, isText, type Settings, settingsOf } from "./settings.ts";
import { Story } from "./stories.ts";

const views = [["section", "Section"], ["spectrum", "Spectrum"], ["forces", "Forces, power"], ["chart", "Chart"]] as const;

function at(selector: string): HTMLElement {
  const found = document.querySelector<HTMLElement>(selector);
  if (!found) throw new Error(`the page has no ${selector}`);
  return found;
}

function setTheme(theme: string): void {
  document.documentElement.dataset["theme"] = theme;
  try {
    localStorage.setItem("theme", theme);
  } catch {
    // A page that may store nothing has the theme until it is closed.
  }
}

function firstTheme(): string {
  try {
    const stored = localStorage.getItem("theme");
    if (stored === "dark" || stored === "light") return stored;
  } catch {
    // As above.
  }
  return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

class Page {
  private readonly app: App;
  private readonly modelChoice = element("select", { "aria-label": "model", title: "model", change: () => this.app.open(this.modelChoice.value) });
  private readonly undo = button("↶", "undo (Ctrl Z)", () => this.app.history.undo());
  private readonly redo = button("↷", "redo (Ctrl Y)", () => this.app.history.redo());
  private readonly play = button("▶", "play (space)", () => this.toggle(), { class: "main" });
  private readonly tabs = new Map<string, HTMLButtonElement>();
  private readonly startChip = element("button", { type: "button", class: "chip", hidden: true, title: "the motion starts from a state of yours: back to the model's own", click: () => this.app.change("start", (draft) => { draft.start = []; }) }, "own start ×");
  private lastHash = "";
  private story: Story | undefined;

  constructor(first: Settings) {
    this.app = new App(first, {
      settings: (settings, card) => this.show(settings, card),
      played: (playing) => this.showPlay(playing),
      classified: (label, detail) => {
        for (const place of ["#class", "#class-here"]) at(place).textContent = label;
        at("#class-detail").textContent = detail;
      },
      failed: (message) => {
        const place = at("#failure");
        place.textContent = message;
        place.hidden = message === "";
      },
    });
    (window as unknown as { explorer: App }).explorer = this.app;
    this.header();
    this.transport();
    this.place();
    this.keys();
    window.addEventListener("hashchange", () => {
      if (location.hash !== this.lastHash) void this.app.openAddress(location.hash);
    });
  }

  async begin(): Promise<void> {
    const lane = new Lane(), models = await lane.question<{ name: string; summary: string }[]>({ verb: "models" });
    lane.close();
    const families = [...new Set(models.map(({ name }) => familyOf(name)))];
    this.modelChoice.replaceChildren(...families.map((family) => element("optgroup", { label: family },
      ...models.filter(({ name }) => familyOf(name) === family).map(({ name, summary }) => element("option", { value: name, title: summary }, name)))), element("option", { value: "", hidden: true }, "own model"));
    await this.app.begin();
    const story = new URLSearchParams(location.search).get("story");
    if (story) this.tell(story);
  }

  private header(): void {
    at("#model").append(this.modelChoice, button("Edit", "edit the model, or write one", () => this.app.editor.show(this.app.card?.text ?? "")));
    at("#tools").append(
      choice("guided story", [{ value: "", text: "Stories …" }, ...Story.list().map(({ key, title }) => ({ value: key, text: title }))], "", (key) => { if (key) this.tell(key); }),
      this.undo, this.redo,
      button("Share", "link, pictures, numbers, command line (s)", () => this.share()),
      button("◐", "dark or light (t)", () => this.theme()),
      button("?", "keys and help", () => (at("#help") as HTMLDialogElement).showModal()),
    );
    at("#help button").addEventListener("click", () => (at("#help") as HTMLDialogElement).close());
    document.body.append(this.app.editor.host, this.app.share.host);
  }

  private transport(): void {
    const { app } = this, number = (label: string, text: string, title: string, read: (settings: Settings) => number, write: (settings: Settings, value: number) => void): HTMLElement => {
      const input = element("input", { type: "text", inputmode: "numeric", "aria-label": title, title, "data-setting": label });
      input.addEventListener("change", () => {
        const value = Math.round(Number(input.value));
        if (Number.isFinite(value) && value >= 0 && value <= 1e6) app.change(label, (draft) => write(draft, value));
        input.value = String(read(app.history.now));
      });
      return element("label", { class: "small" }, text, input);
    };
    const slow = element("button", { type: "button", "aria-pressed": "false", title: "slow motion where impacts are close, through a chatter (l)", id: "slow", click: () => this.slow() }, "Slow at impacts");
    at("#transport").append(
      button("❚◀", "to the beginning of the window (,)", () => app.player.toBegin()), this.play,
      button("▶❚", "to the next event (.)", () => this.step()),
      choice("speed", [["0.125", "⅛ speed"], ["0.25", "¼ speed"], ["0.5", "½ speed"], ["1", "speed 1"], ["2", "speed 2"], ["4", "speed 4"]].map(([value, text]) => ({ value: value ?? "", text: text ?? "" })), "1", (value) => { app.player.speed = Number(value); }),
      slow,
      number("window", "periods shown", "length of the window, in periods", ({ motion }) => motion.periods, ({ motion }, value) => { motion.periods = Math.min(Math.max(value, 1), 1000); }),
      number("after", "after", "periods before the window: the transient that is left out", ({ motion }) => motion.transient, ({ motion }, value) => { motion.transient = value; }),
      this.startChip,
    );
  }

  private place(): void {
    const { app } = this;
    at("#mechanism").append(app.mechanism.host);
    at("#time").append(app.motion.time.host);
    at("#phase").append(app.motion.phase.host);
    at("#phase-choices").append(app.motion.phaseChoices);
    at("#diagram").append(app.diagram.plot.host);
    at("#diagram").before(app.diagram.chosen);
    at("#parameters").append(app.parameters.host);
    const carry = element("input", { type: "checkbox", change: () => { app.carryOn = carry.checked; } });
    at("#carry").append(element("label", { title: "a change of a parameter goes on from the present motion, so that an attractor is kept as long as it exists" }, carry, " carry the motion on"));
    for (const [key, name] of views) {
      const tab = element("button", { type: "button", role: "tab", id: `tab-${key}`, "aria-controls": "view", click: () => app.change("view", (draft) => { draft.view = key; }) }, name);
      this.tabs.set(key, tab);
      at("#tabs").append(tab);
    }
    const whole = button("Whole", "the whole range again (double click)", () => app.diagram.plot.reset(), { class: "plain" });
    const zoomed = button("Compute what is seen", "run the diagram over the range that is seen, with finer steps", () => {
      const { view } = app.diagram.plot.frame(), [from, to] = [view.x0, view.x1];
      app.change("diagram", (draft) => Object.assign(draft.diagram, { from: Math.max(from, Math.min(draft.diagram.from, from)), to }));
      app.diagram.plot.reset();
    }, { class: "plain" });
    at("#diagram-tools").append(app.diagram.progress, element("span", { id: "diagram-choices" }), button("Branch", "follow the present orbit through the parameter, with its special points (b)", () => app.followBranch(), { class: "plain", id: "branch" }), zoomed, whole);
  }

  private show(settings: Settings, card: ModelCard): void {
    const { app } = this;
    document.title = `${card.name} · slapstick`;
    this.modelChoice.value = isText(settings.source) ? "" : settings.source;
    at("#summary").textContent = card.summary;
    at("#summary").title = card.notes;
    this.undo.disabled = !app.history.canUndo;
    this.redo.disabled = !app.history.canRedo;
    this.startChip.hidden = settings.start.length === 0;
    app.parameters.show(card, settings);
    for (const input of document.querySelectorAll<HTMLInputElement>("[data-setting]"))
      if (document.activeElement !== input) input.value = String(input.dataset["setting"] === "window" ? settings.motion.periods : settings.motion.transient);
    for (const [key, tab] of this.tabs) tab.setAttribute("aria-selected", String(key === settings.view));
    this.showView(settings);
    this.diagramChoices(settings, card);
    void app.address().then((hash) => {
      this.lastHash = `#${hash}`;
      history.replaceState(null, "", `${location.search}#${hash}`);
    });
  }

  private showView(settings: Settings): void {
    const { app } = this, place = at("#view");
    place.setAttribute("aria-labelledby", `tab-${settings.view}`);
    if (place.dataset["view"] === settings.view) return;
    place.dataset["view"] = settings.view;
    if (settings.view !== "chart") app.leaveChart();
    const parts = {
      section: [app.section.plot.host, app.section.choices], spectrum: [app.spectrum.plot.host, app.spectrum.choices],
      forces: [app.forces.plot.host, app.forces.choices], chart: [app.chart.plot.host, app.chart.choices],
    } as const;
    const [host, choices] = parts[settings.view];
    place.replaceChildren(host, ...(settings.view === "chart" ? [app.chart.legend] : []));
    at("#view-choices").replaceChildren(choices);
  }

  private diagramChoices(settings: Settings, card: ModelCard): void {
    const { diagram } = settings, place = at("#diagram-choices"), key = JSON.stringify([card.name, diagram.shown, diagram.at, diagram.direction, diagram.count]);
    if (place.dataset["key"] === key) return;
    place.dataset["key"] = key;
    const ofImpacts = ["w", "flight", "phase"], atImpacts = diagram.at === "impacts";
    const names = [...(atImpacts ? ofImpacts : []), ...card.state].map((name) => ({ value: name, text: name }));
    const edit = (write: (draft: Settings["diagram"]) => void): void => this.app.change("diagram", (draft) => write(draft.diagram));
    place.replaceChildren(
      choice("what the diagram shows", names, diagram.shown, (value) => edit((draft) => { draft.shown = value; })), " ",
      choice("direction of the diagram", [{ value: "both", text: "both ways" }, { value: "up", text: "going up" }, { value: "down", text: "going down" }], diagram.direction, (value) => edit((draft) => { draft.direction = value as "up"; })), " ",
      choice("values of the diagram", [150, 300, 600, 900, 1800].map((count) => ({ value: String(count), text: `${count} values` })), String(diagram.count), (value) => edit((draft) => { draft.count = Number(value); })),
    );
  }

  private toggle(): void {
    const { player } = this.app;
    if (player.playing) player.pause();
    else player.play();
  }

  private step(): void {
    this.app.player.step();
    const { window: shown, time } = this.app.player, event = shown?.events.find((one) => one.time === time);
    if (event) announce(`${event.kind} at ${this.app.card?.contacts[event.contact]?.name ?? ""}, time ${time.toFixed(4)}`);
  }

  private showPlay(playing: boolean): void {
    this.play.textContent = playing ? "❚❚" : "▶";
    this.play.setAttribute("aria-label", playing ? "pause (space)" : "play (space)");
  }

  private slow(): void {
    const { player } = this.app;
    player.slow = !player.slow;
    at("#slow").setAttribute("aria-pressed", String(player.slow));
  }

  private theme(): void {
    setTheme(document.documentElement.dataset["theme"] === "dark" ? "light" : "dark");
    this.app.redraw();
  }

  private share(): void {
    const { card } = this.app;
    if (card) this.app.share.show(this.app.history.now, card, this.app.saved());
  }

  private tell(key: string): void {
    this.story?.close();
    this.story = new Story(key, (settings) => this.app.change("story", (draft) => Object.assign(draft, settings)), () => { this.story = undefined; });
  }

  private keys(): void {
    const acts: Record<string, () => void> = {
      " ": () => this.toggle(), ".": () => this.step(), ",": () => this.app.player.toBegin(), t: () => this.theme(), s: () => this.share(),
      l: () => this.slow(), b: () => this.app.followBranch(), p: () => this.app.parameters.focusFirst(),
      "?": () => (at("#help") as HTMLDialogElement).showModal(),
      ...Object.fromEntries(views.map(([key], i) => [String(i + 1), () => this.app.change("view", (draft) => { draft.view = key; })])),
    };
    document.addEventListener("keydown", (event) => {
      const target = event.target as HTMLElement;
      if (document.querySelector("dialog[open]") || target.matches("textarea, input[type=text], select")) return;
      if ((event.ctrlKey || event.metaKey) && !event.altKey) {
        const key = event.key.toLowerCase();
        if (key === "z" || key === "y") event.preventDefault();
        if (key === "z" && !event.shiftKey) this.app.history.undo();
        else if (key === "y" || key === "z") this.app.history.redo();
        return;
      }
      const act = event.altKey || (event.key === " " && target.matches("button")) ? undefined : acts[event.key];
      if (!act) return;
      event.preventDefault();
      act();
    });
  }
}

async function open(): Promise<void> {
  setTheme(firstTheme());
  if (new URLSearchParams(location.search).has("embed")) document.documentElement.classList.add("embed");
  let first: Settings | undefined;
  try {
    first = await fromHash(location.hash);
  } catch {
    announce("the link is damaged: the page opens with its first model");
  }
  if (!first) {
    const served = await fetch("opened.toml").then((response) => (response.ok ? response.text() : ""), () => "");
    first = served.includes("\n") ? { ...settingsOf(""), source: served } : settingsOf("vibro-impact");
  }
  await new Page(first).begin();
}

open().catch((error: unknown) => announce(`the page could not be opened: ${String(error)}`));
