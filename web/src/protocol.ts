// What the page and its workers say to one another, and what the engine's objects hold (web/engine/*.hpp).

/** A model with values: a built-in name or the text of a model file; the start is empty for the model's own. */
export interface Model {
  source: string;
  set: Record<string, number>;
  start: number[];
}

export interface Parameter {
  name: string;
  value: number;
  unit: string;
  meaning: string;
  expression: string;
  range: string;
  min: number | string;
  max: number | string;
  minOpen: boolean;
  maxOpen: boolean;
}

/** Two coordinates by number; -1 is the ground. */
export interface Link {
  a: number;
  b: number;
  /** It acts on ratio[0] x_a - ratio[1] x_b; absent: on x_a - x_b. */
  ratio?: [number, number];
}

export interface Mechanism {
  coordinates: { name: string; mass: number; unit: string }[];
  forces: { on: number; harmonic: number; amplitude: number; constant: boolean }[];
  springs: (Link & { stiffness: number })[];
  /** Springs and dampers in series. */
  maxwells: (Link & { stiffness: number })[];
  couplings: Link[];
  dampers: (Link & { coefficient: number })[];
  stops: (Link & { name: string; clearance: number })[];
  frictions: (Link & { name: string; belt: number })[];
  compliant: (Link & { name: string; clearance: number })[];
  characteristics: (Link & { name: string; damps: boolean; slides: boolean })[];
}

export interface Quantity {
  name: string;
  unit: string;
  kind: string;
  meaning: string;
  atImpacts: boolean;
}

export interface ModelCard {
  name: string;
  summary: string;
  notes: string;
  text: string;
  parameters: Parameter[];
  groups: { name: string; members: string[] }[];
  mechanism: Mechanism;
  quantities: Quantity[];
  contacts: { kind: "stop" | "friction" | "compliant" | "characteristic" | "signal"; name: string }[];
  state: string[];
  start: number[];
  period: number;
  forced: boolean;
  periodic: boolean;
}

export interface EngineError {
  kind: "input" | "numerics" | "bug";
  /** "line:12: " of a model's text, or nothing. */
  place: string;
  message: string;
}

export interface MotionWish {
  transient: number;
  periods: number;
  samples: number;
  of: string;
}

export interface DiagramWish {
  parameter: string;
  from: number;
  to: number;
  count: number;
  transient: number;
  points: number;
  down: boolean;
  shown: string;
  at: string;
}

export interface SectionWish {
  at: string;
  transient: number;
  points: number;
  phase: number;
}

export interface ChartWish {
  x: string;
  y: string;
  xFrom: number;
  xTo: number;
  yFrom: number;
  yTo: number;
  columns: number;
  rows: number;
  /** Row by row. */
  pixels: number[];
  periods: number;
}

export interface BranchWish {
  parameter: string;
  from: number;
  to: number;
  shown: string;
  at: string;
}

export interface CurveWish {
  second: string;
  from: number;
  to: number;
  secondFrom: number;
  secondTo: number;
}

/** The kinds of EventKind, in its order (flow/motion.hpp). */
export const eventKinds = [
  "impact", "slip+", "slip-", "stick", "release", "graze", "chatter", "engage", "disengage", "separate", "corner",
  "unload", "load", "knot",
] as const;

/** Jobs come in parts, questions have one answer. */
export type Request =
  | { verb: "motion"; model: Model; wish: MotionWish }
  | { verb: "goOn" }
  | { verb: "diagram"; model: Model; wish: DiagramWish }
  | { verb: "section"; model: Model; wish: SectionWish }
  | { verb: "chart"; model: Model; wish: ChartWish }
  | { verb: "card"; model: Model }
  | { verb: "models" }
  | { verb: "blank"; name: string }
  | { verb: "classify"; model: Model; periods: number }
  | { verb: "spectrum"; model: Model; quantity: string; highestOrder: number }
  | { verb: "branch"; model: Model; wish: BranchWish }
  | { verb: "born"; branch: number; special: number }
  | { verb: "curve"; branch: number; special: number; wish: CurveWish }
  | { verb: "bits" };

/** A newer request of a worker cancels the older one; `cancel` alone leaves nothing to do. */
export type ToWorker = { load: WebAssembly.Module } | { id: number; request: Request } | { cancel: number };

/** Rows of numbers, flat; `width` numbers a row. */
export interface Part {
  rows: Float64Array;
  width: number;
  events: Float64Array;
  eventWidth: number;
}

export type FromWorker =
  | { ready: true }
  | { id: number; part: Part }
  /** Points of a branch or curve so far. */
  | { id: number; points: number }
  | { id: number; done: true; failure: string }
  | { id: number; answer: unknown }
  | { id: number; error: EngineError };

export interface Classification {
  label: string;
  attractor: string;
  n: number;
  p: number;
  chatter: string;
  sticking: boolean;
  exponent: number;
}

export interface Spectrum {
  kind: "lines" | "density";
  label: string;
  order: number[];
  height: number[];
}

export interface SpecialPoint {
  type: string;
  value: number;
  what: string;
  becomes: string;
  /** Other branches begin or cross here. */
  begins: boolean;
  /** One of many changes that gather at the onset of a chatter, for which the onset stands. */
  inCascade: boolean;
  state: number[];
  shown: number[];
}

export interface Branch {
  points: { value: number; stable: boolean; label: string; shown: number[]; state: number[] }[];
  special: SpecialPoint[];
  /** It ends at the ends of the range. */
  whole: boolean;
  ended: string;
}

/** Where a special point is when a second parameter varies too. */
export interface Curve {
  type: string;
  first: number[];
  second: number[];
  /** Is the point an orbit that moves so? 1 or 0. */
  motion: number[];
  met: { type: string; what: string; values: number[] }[];
  whole: boolean;
  ended: string;
}
