// Where the parts of a mechanism stand: bodies in a row, joined to each other and to the ground.
//
// The row is the order of the bodies for which links are short, stops push the way they are drawn, and links to the
// ground leave at an end of the row. With few bodies all orders are tried.
import type { Link, Mechanism } from "../protocol.ts";

export const ground = -1;

export type Kind = "spring" | "coupling" | "damper" | "maxwell" | "stop" | "friction" | "compliant" | "polyline" | "jenkins";

export interface Part extends Link {
  kind: Kind;
  name: string;
  /** Number of the contact (System::contact_name), or -1. */
  contact: number;
  clearance: number;
  belt: number;
}

export interface Layout {
  /** Place of each body in the row, from the left. */
  place: number[];
  /** The ground stands at the left and the right end, or below. */
  wallLeft: boolean;
  wallRight: boolean;
  /** Drawn upright: a body that falls on a floor. */
  upright: boolean;
  parts: Part[];
}

export function partsOf(mechanism: Mechanism): Part[] {
  const plain = { name: "", contact: -1, clearance: 0, belt: 0 };
  const { stops, frictions, compliant, characteristics } = mechanism;
  let contact = 0;
  return [
    ...mechanism.springs.filter((one) => one.stiffness !== 0).map((one) => ({ ...plain, ...one, kind: "spring" as const })),
    ...mechanism.couplings.map((one) => ({ ...plain, ...one, kind: "coupling" as const })),
    ...mechanism.dampers.filter((one) => one.coefficient !== 0).map((one) => ({ ...plain, ...one, kind: "damper" as const })),
    ...mechanism.maxwells.map((one) => ({ ...plain, ...one, kind: "maxwell" as const })),
    ...stops.map((one) => ({ ...plain, ...one, kind: "stop" as const, contact: contact++ })),
    ...frictions.map((one) => ({ ...plain, ...one, kind: "friction" as const, contact: contact++ })),
    ...compliant.map((one) => ({ ...plain, ...one, kind: "compliant" as const, contact: contact++ })),
    ...characteristics.map((one) => ({ ...plain, ...one, kind: one.slides ? "jenkins" as const : "polyline" as const, contact: contact++ })),
  ].map(({ a, b, ratio, kind, name, contact: number, clearance, belt }) => ({ a, b, ...(ratio && { ratio }), kind, name, contact: number, clearance, belt }));
}

function* orders(list: readonly number[]): Generator<number[]> {
  if (list.length <= 1) yield [...list];
  for (const [i, first] of list.entries())
    for (const rest of orders([...list.slice(0, i), ...list.slice(i + 1)])) yield [first, ...rest];
}

/** How badly an order of the row suits the parts. */
function cost(order: readonly number[], parts: readonly Part[]): number {
  const place = new Map(order.map((body, i) => [body, i]));
  const last = order.length - 1;
  let sum = 0;
  for (const { a, b, kind } of parts) {
    if (a === ground || b === ground) {
      const body = place.get(a === ground ? b : a) ?? 0;
      if (kind === "spring" || kind === "damper" || kind === "maxwell" || kind === "polyline" || kind === "jenkins") sum += 3 * Math.min(body, last - body) + (body === 0 ? 0 : 0.1);
      // A stop that holds back motion to the right stands at the right.
      if (kind === "stop" || kind === "compliant") sum += a === ground ? body : last - body;
    } else {
      const between = (place.get(b) ?? 0) - (place.get(a) ?? 0);
      sum += 2 * (Math.abs(between) - 1);
      if ((kind === "stop" || kind === "compliant") && between < 0) sum += 2.5;
      if (kind === "friction" && between < 0) sum += 0.2;
    }
  }
  return sum;
}

/** Two-sided contacts push both ways: of opposite stops on a pair only the first has a say. */
function withSay(parts: readonly Part[]): Part[] {
  return parts.filter((part, i) => !(part.kind === "stop" && parts.some((other, j) => j < i && other.kind === "stop" && other.a === part.b && other.b === part.a)));
}

export function layoutOf(mechanism: Mechanism): Layout {
  const parts = partsOf(mechanism), count = mechanism.coordinates.length;
  const names = Array.from({ length: count }, (_, i) => i);
  let best = names;
  if (count <= 6) {
    const say = withSay(parts);
    let least = Infinity;
    for (const order of orders(names)) {
      const now = cost(order, say);
      if (now < least - 1e-9) [least, best] = [now, order];
    }
  }
  const place = names.map((body) => best.indexOf(body));
  const linked = parts.filter(({ kind, a, b }) => (a === ground || b === ground) && kind !== "friction" && kind !== "stop" && kind !== "compliant");
  const bodies = linked.map(({ a, b }) => place[a === ground ? b : a] ?? 0);
  const wallRight = bodies.some((at) => at === count - 1 && count > 1 && at !== 0);
  const falls = mechanism.forces.some((force) => force.constant && force.amplitude < 0);
  const upright = falls && linked.length === 0 && count === 1 && parts.some(({ kind, a }) => kind === "stop" && a === ground);
  return { place, wallLeft: bodies.some((at) => at === 0), wallRight, upright, parts };
}
