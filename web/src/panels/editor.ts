// The text of a model, with its line numbers, the engine's error at the line, and the keys that may stand there.
import { button, element } from "../dom.ts";
import type { Lane } from "../lane.ts";
import type { EngineError, ModelCard } from "../protocol.ts";

/** Keys of each part of a model file; from the schema that the editors use (models/model.schema.json). */
export type SchemaKeys = Map<string, { key: string; description: string }[]>;

interface SchemaNode {
  description?: string;
  properties?: Record<string, SchemaNode>;
  items?: SchemaNode;
  anyOf?: SchemaNode[];
}

export function keysOf(schema: SchemaNode): SchemaKeys {
  const keys: SchemaKeys = new Map();
  const list = (node: SchemaNode): { key: string; description: string }[] =>
    Object.entries(node.properties ?? {}).map(([key, { description }]) => ({ key, description: description ?? "" }));
  keys.set("", list(schema));
  for (const [key, node] of Object.entries(schema.properties ?? {})) {
    const inner = node.items ?? node;
    if (inner.properties) keys.set(key, list(inner));
  }
  return keys;
}

export class Editor {
  readonly host: HTMLDialogElement;
  private readonly text = element("textarea", { spellcheck: "false", "aria-label": "model file", wrap: "off", autocapitalize: "off", autocomplete: "off" });
  private readonly numbers = element("pre", { "aria-hidden": "true", class: "numbers" });
  private readonly message = element("p", { class: "message", role: "status" });
  private readonly hints = element("div", { class: "hints", role: "listbox", "aria-label": "keys that may stand here" });
  private readonly use: HTMLButtonElement;
  private keys: SchemaKeys = new Map();
  private timer = 0;

  /** @param take  the text is a sound model and is wanted */
  constructor(private readonly lane: Lane, private readonly take: (text: string) => void) {
    this.use = button("Use this model", "use this model", () => this.accept(), { class: "main" });
    this.host = element("dialog", { class: "editor", "aria-label": "edit the model" },
      element("header", {}, element("h2", {}, "Model file"), button("×", "close", () => this.host.close(), { class: "plain" })),
      element("div", { class: "pages" }, this.numbers, this.text),
      this.hints, this.message,
      element("footer", {}, this.use, button("New model", "a commented file to start from", () => this.blank()),
        element("label", { class: "file" }, "Open a file", element("input", { type: "file", accept: ".toml,text/plain", change: (event: Event) => void this.open(event) }))));
    this.text.addEventListener("input", () => this.changed());
    this.text.addEventListener("scroll", () => { this.numbers.scrollTop = this.text.scrollTop; });
    this.text.addEventListener("keyup", () => this.hint());
    this.text.addEventListener("click", () => this.hint());
  }

  show(text: string): void {
    this.text.value = text;
    this.host.showModal();
    this.changed();
    this.text.focus();
    if (this.keys.size === 0)
      void fetch("model.schema.json").then((response) => response.json()).then((schema: SchemaNode) => { this.keys = keysOf(schema); });
  }

  private blank(): void {
    void this.lane.question<{ text: string }>({ verb: "blank", name: "my-oscillator" }).then(({ text }) => {
      this.text.value = text;
      this.changed();
    });
  }

  private async open(event: Event): Promise<void> {
    const file = (event.target as HTMLInputElement).files?.[0];
    if (!file) return;
    this.text.value = await file.text();
    this.changed();
  }

  private changed(): void {
    clearTimeout(this.timer);
    this.number(0);
    this.timer = window.setTimeout(() => this.check(), 200);
  }

  private check(): void {
    const source = this.source();
    this.lane.question<ModelCard>({ verb: "card", model: { source, set: {}, start: [] } }).then((card) => {
      this.message.textContent = `${card.name}: ${card.state.length / 2} coordinates, ${card.contacts.length} contacts, ${card.parameters.length} parameters`;
      this.message.classList.remove("wrong");
      this.use.disabled = false;
      this.number(0);
    }, (error: EngineError) => {
      const found = /^line:(\d+): (.*)$/s.exec(error.place + error.message);
      this.message.textContent = found ? `line ${found[1]}: ${found[2]}` : error.message;
      this.message.classList.add("wrong");
      this.use.disabled = true;
      this.number(found ? Number(found[1]) : 0);
    });
  }

  /** A text is told from a name by its lines. */
  private source(): string {
    return this.text.value.endsWith("\n") ? this.text.value : `${this.text.value}\n`;
  }

  private accept(): void {
    if (this.use.disabled) return;
    this.host.close();
    this.take(this.source());
  }

  private number(wrong: number): void {
    const count = this.text.value.split("\n").length;
    this.numbers.replaceChildren(...Array.from({ length: count }, (_, i) => element("span", { class: i + 1 === wrong ? "wrong" : "" }, `${i + 1}\n`)));
    this.text.setAttribute("aria-invalid", String(wrong > 0));
    this.numbers.scrollTop = this.text.scrollTop;
  }

  /** What is being typed: the table it stands in, and the beginning of a key. */
  private hint(): void {
    const before = this.text.value.slice(0, this.text.selectionStart), line = before.slice(before.lastIndexOf("\n") + 1);
    const typed = /^\s*([a-z_]*)$/.exec(line)?.[1];
    if (typed === undefined) {
      this.hints.replaceChildren();
      return;
    }
    const table = [...before.matchAll(/^\s*\[\[?\s*([a-z_]+)/gm)].at(-1)?.[1] ?? "";
    const fitting = (this.keys.get(table) ?? []).filter(({ key }) => key.startsWith(typed) && key !== typed).slice(0, 12);
    this.hints.replaceChildren(...fitting.map(({ key, description }) =>
      button(key, description, () => this.insert(key.slice(typed.length)), { role: "option", class: "chip" })));
  }

  private insert(rest: string): void {
    this.text.focus();
    this.text.setRangeText(`${rest} = `, this.text.selectionStart, this.text.selectionEnd, "end");
    this.changed();
    this.hint();
  }
}
