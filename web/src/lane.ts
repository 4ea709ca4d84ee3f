// A lane is a worker of the page, for one purpose: its newest request is the one that counts.
import type { EngineError, FromWorker, Part, Request } from "./protocol.ts";

let compiled: Promise<WebAssembly.Module> | undefined;

/** The engine's code, compiled once for all workers. */
function engineModule(): Promise<WebAssembly.Module> {
  const url = new URL("engine.wasm", import.meta.url);
  // Plain file servers may not know the type of .wasm, which streaming asks for.
  compiled ??= fetch(url).then(async (response) => {
    if (!response.ok) throw new Error(`${url.pathname}: ${response.status}`);
    return WebAssembly.compile(await response.arrayBuffer());
  });
  return compiled;
}

export interface Listener {
  part?(part: Part): void;
  points?(count: number): void;
  done?(failure: string): void;
  answer?(answer: never): void;
  error?(error: EngineError): void;
}

export class Lane {
  private worker: Worker | undefined;
  private ready: Promise<void> = Promise.resolve();
  private id = 0;
  private listener: Listener = {};
  private busy = false;

  /** @param ends  a newer request ends the worker: for questions, which cannot be cut short */
  constructor(private readonly ends = false) {}

  /** Cancels what runs, and asks for this. Only the newest request is answered. */
  ask(request: Request, listener: Listener): void {
    this.cancel();
    const id = ++this.id;
    this.listener = listener;
    this.busy = true;
    const worker = this.open();
    void this.ready.then(() => {
      if (this.id === id && this.worker === worker) worker.postMessage({ id, request });
    });
  }

  cancel(): void {
    if (!this.busy) return;
    this.busy = false;
    if (this.ends) this.close();
    else this.worker?.postMessage({ cancel: this.id });
    this.id += 1;
    this.listener = {};
  }

  /** The answer of a question. @throws EngineError; never settles if a newer request comes first */
  question<Answer>(request: Request, points?: (count: number) => void): Promise<Answer> {
    return new Promise((resolve, reject) => {
      this.ask(request, { answer: (answer) => resolve(answer as Answer), error: reject, ...(points ? { points } : {}) });
    });
  }

  get isBusy(): boolean {
    return this.busy;
  }

  close(): void {
    this.worker?.terminate();
    this.worker = undefined;
  }

  private open(): Worker {
    if (this.worker) return this.worker;
    const worker = new Worker(new URL("worker.js", import.meta.url), { type: "module" });
    this.worker = worker;
    this.ready = new Promise((resolve, reject) => {
      worker.onmessage = ({ data }: MessageEvent<FromWorker>) => {
        if ("ready" in data) resolve();
        else this.hear(data);
      };
      worker.onerror = (event) => {
        reject(new Error(event.message));
        this.listener.error?.({ kind: "bug", place: "", message: event.message || "the engine could not be loaded" });
      };
      engineModule().then((load) => worker.postMessage({ load }), (error: unknown) => {
        this.listener.error?.({ kind: "bug", place: "", message: `the engine could not be loaded: ${String(error)}` });
      });
    });
    this.ready.catch(() => undefined);
    return worker;
  }

  private hear(data: Exclude<FromWorker, { ready: true }>): void {
    if (data.id !== this.id) return;
    const listener = this.listener;
    if ("part" in data) {
      listener.part?.(data.part);
      return;
    }
    if ("points" in data) {
      listener.points?.(data.points);
      return;
    }
    this.busy = false;
    if ("done" in data) listener.done?.(data.failure);
    else if ("answer" in data) listener.answer?.(data.answer as never);
    else listener.error?.(data.error);
  }
}
