// A window of a motion as the engine sent it: columns by name, events, states at an instant between the rows.
import { eventKinds, type ModelCard, type Part } from "./protocol.ts";

export interface MotionEvent {
  time: number;
  kind: (typeof eventKinds)[number];
  contact: number;
  w: number;
}

export class MotionWindow {
  readonly time: Float64Array;
  readonly events: MotionEvent[] = [];
  /** Columns: the state, contacts at rest, the quantities that were asked for. */
  private readonly columns = new Map<string, Float64Array>();

  constructor(part: Part, card: ModelCard, of: readonly string[], readonly periods: number) {
    const count = part.rows.length / part.width;
    const column = (k: number): Float64Array => Float64Array.from({ length: count }, (_, i) => part.rows[i * part.width + k] as number);
    this.time = column(0);
    ["", ...card.state, "at rest", ...of].forEach((name, k) => {
      if (k > 0) this.columns.set(name, column(k));
    });
    for (let i = 0; i < part.events.length; i += part.eventWidth)
      this.events.push({
        time: part.events[i] as number, kind: eventKinds[part.events[i + 1] as number] ?? "impact",
        contact: part.events[i + 2] as number, w: part.events[i + 3] as number,
      });
  }

  column(name: string): Float64Array {
    return this.columns.get(name) ?? new Float64Array(this.time.length);
  }

  /** The last row at or before an instant. */
  row(time: number): number {
    let low = 0, high = this.time.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if ((this.time[middle] as number) <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /** A column at an instant, on the straight line between two rows: what a picture shows. */
  at(name: string, time: number): number {
    const list = this.column(name), i = this.row(time), next = Math.min(i + 1, list.length - 1);
    const t0 = this.time[i] as number, t1 = this.time[next] as number;
    const share = t1 > t0 ? Math.min(Math.max((time - t0) / (t1 - t0), 0), 1) : 0;
    return (list[i] as number) + share * ((list[next] as number) - (list[i] as number));
  }

  atRest(time: number): number {
    return this.column("at rest")[this.row(time)] ?? 0;
  }

  /** Spans of time in which a contact rests. */
  rests(contact: number): { from: number[]; to: number[] } {
    const bits = this.column("at rest"), from: number[] = [], to: number[] = [];
    let begun: number | undefined;
    for (let i = 0; i < bits.length; ++i) {
      const rests = Math.floor((bits[i] as number) / 2 ** contact) % 2 === 1;
      if (rests && begun === undefined) begun = this.time[i];
      if (begun !== undefined && (!rests || i === bits.length - 1)) {
        if ((this.time[i] as number) > begun) from.push(begun), to.push(this.time[i] as number);
        begun = undefined;
      }
    }
    return { from, to };
  }

  /** The state at an instant, as a start. */
  state(card: ModelCard, time: number): number[] {
    return card.state.map((name) => this.at(name, time));
  }
}
