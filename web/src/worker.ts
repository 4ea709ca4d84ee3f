// A worker: one engine, one request at a time. A newer request, or `cancel`, ends the running job between two slices.
import create, { type Session } from "slapstick-engine";
import type { EngineError, FromWorker, Request, ToWorker } from "./protocol.ts";

/** Work between two looks at the messages, in milliseconds. */
const slice = 8;

let session: Session | undefined;
let current = 0;
const channel = new MessageChannel();
let resume: (() => void) | undefined;
channel.port1.onmessage = () => resume?.();

/** What the engine calls on its way along a branch or curve. */
Object.assign(globalThis, { followed: (points: number) => { if (points % 10 === 0) send({ id: current, points }); } });

/** Lets messages that have come be handled; a timer would wait 4 ms. */
function breathe(): Promise<void> {
  return new Promise((resolve) => {
    resume = resolve;
    channel.port2.postMessage(0);
  });
}

function send(message: FromWorker, transfer: Transferable[] = []): void {
  postMessage(message, { transfer });
}

/** The object in the engine's answer. @throws EngineError */
function read(text: string): unknown {
  const answer = JSON.parse(text) as { error?: EngineError };
  if (answer.error) throw answer.error;
  return answer;
}

function answerOf(engine: Session, request: Request): unknown {
  switch (request.verb) {
    case "card": return read(engine.card(request.model));
    case "models": return read(engine.models());
    case "blank": return read(engine.blank(request.name));
    case "classify": return read(engine.classify(request.model, request.periods));
    case "spectrum": return read(engine.spectrum(request.model, request.quantity, request.highestOrder));
    case "branch": return read(engine.branch(request.model, request.wish));
    case "born": return read(engine.born(request.branch, request.special));
    case "curve": return read(engine.curve(request.branch, request.special, request.wish));
    case "bits": return read(engine.bits());
    default: return undefined;
  }
}

/** Begins a job. @returns false if the request is a question. @throws EngineError */
function begin(engine: Session, request: Request): boolean {
  switch (request.verb) {
    case "motion": read(engine.beginMotion(request.model, request.wish)); return true;
    case "diagram": read(engine.beginDiagram(request.model, request.wish)); return true;
    case "section": read(engine.beginSection(request.model, request.wish)); return true;
    case "chart": read(engine.beginChart(request.model, request.wish)); return true;
    case "goOn": engine.goOn(); return true;
    default: return false;
  }
}

function sendPart(engine: Session, id: number): void {
  const rows = engine.rows().slice(), events = engine.events().slice();
  const part = { rows, events, width: engine.width(), eventWidth: engine.eventWidth() };
  if (rows.length + events.length > 0) send({ id, part }, [rows.buffer, events.buffer]);
}

/** A motion is sent whole, so that no half of it is drawn; other jobs as they grow. */
async function run(engine: Session, id: number, request: Request): Promise<void> {
  const whole = request.verb === "motion" || request.verb === "goOn";
  try {
    if (!begin(engine, request)) {
      send({ id, answer: answerOf(engine, request) });
      return;
    }
    for (let done = false; !done; ) {
      done = engine.advance(slice);
      if (done || !whole) sendPart(engine, id);
      if (!done) await breathe();
      if (current !== id) return;
    }
    send({ id, done: true, failure: engine.failure() });
  } catch (error) {
    const known = error as Partial<EngineError>;
    send({ id, error: { kind: known.kind ?? "bug", place: known.place ?? "", message: known.message ?? String(error) } });
  }
}

/** Jobs follow one another: the next begins when the one before has seen that it is over. */
let last = Promise.resolve();

onmessage = async ({ data }: MessageEvent<ToWorker>) => {
  if ("load" in data) {
    const engine = await create({
      instantiateWasm(imports, receive) {
        void WebAssembly.instantiate(data.load, imports).then((instance) => receive(instance, data.load));
        return {};
      },
    });
    session = new engine.Session();
    send({ ready: true });
  } else if ("cancel" in data) {
    if (current === data.cancel) current = 0;
  } else if (session) {
    const engine = session;
    current = data.id;
    last = last.then(() => (current === data.id ? run(engine, data.id, data.request) : undefined));
  }
};
