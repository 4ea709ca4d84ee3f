// What each built-in model opens with: which parameter its diagram runs over, and what the diagram and the section show.
import type { Settings } from "./settings.ts";

interface Preset {
  set?: Record<string, number>;
  over?: [parameter: string, from: number, to: number];
  /** Of the diagram, and when the quantity is read: impacts, periods, or an event. */
  shown?: [quantity: string, at: string];
  section?: [at: string, x: string, y: string];
  /** The window: periods before it, and its length. */
  window?: [transient: number, periods: number];
  /** The motion ends: what happens on the way is all there is. */
  ends?: boolean;
  phase?: [x: string, y: string];
  chart?: [x: string, xFrom: number, xTo: number, y: string, yFrom: number, yTo: number];
}

const strobe: [string, string] = ["x", "periods"];

const presets: Record<string, Preset> = {
  "vibro-impact": { over: ["omega", 0.5, 10], chart: ["omega", 0.5, 10, "friction", 0, 0.4] },
  "impact-oscillator": { over: ["omega", 0.5, 6], phase: ["x", "v"], chart: ["omega", 0.5, 6, "clearance", -0.5, 1] },
  "shaken-table": { over: ["acceleration", 0.5, 6], section: ["impacts", "phase", "w"], chart: ["acceleration", 1, 6, "restitution", 0, 0.9] },
  "coulomb-oscillator": { over: ["omega", 0.2, 1.6], shown: strobe, section: ["periods", "x", "v"] },
  "bilinear-oscillator": { over: ["omega", 0.3, 4], shown: strobe, section: ["periods", "x", "v"] },
  "bump-stop": { over: ["omega", 0.4, 3], shown: strobe, section: ["periods", "x", "v"] },
  "gear-pair": { over: ["omega", 0.3, 2], shown: strobe, section: ["periods", "x", "v"] },
  "buffers": { over: ["omega", 0.5, 4], phase: ["x", "v"] },
  "impact-friction-oscillator": { over: ["omega", 0.6, 6] },
  "friction-rattle": { over: ["amplitude", 0, 2], set: { amplitude: 1 } },
  "impact-absorber": { over: ["omega", 0.8, 2] },
  "impact-pair": { over: ["amplitude", 0.05, 1] },
  "two-sided-rattle": { over: ["omega", 0.4, 4] },
  "stick-slip-impact": { over: ["omega", 0.4, 2] },
  "gear-rattle": { over: ["firing", 30, 150] },
  "spool": { over: ["frequency", 60, 500] },
  "sliding-block": { over: ["amplitude", 0.2, 3], shown: ["v", "periods"], section: ["periods", "v", "v"] },
  "shaken-belt": { over: ["omega", 0.5, 12], shown: strobe, section: ["periods", "x", "v"] },
  "belt": { over: ["belt_speed", 0.05, 2], shown: ["x", "release"], section: ["release", "x", "v"], window: [50, 20] },
  "falling-friction": { over: ["belt_speed", 0.05, 2], shown: ["x", "release"], section: ["release", "x", "v"], window: [200, 25] },
  "two-blocks-on-belt": { over: ["coupling", 0.2, 3], shown: ["x1", "release"], section: ["release", "x1", "x2"], window: [500, 60] },
  "pressed-block": { over: ["belt_speed", 0.05, 1], shown: ["x", "release"], section: ["release", "x", "v"], window: [50, 40] },
  "mode-coupling-brake": { over: ["friction", 0.3, 0.8], shown: ["x", "impacts"], section: ["impacts", "x", "v"], window: [40, 12] },
  "drill-string": { over: ["drive_speed", 2, 16], shown: ["end", "release"], section: ["release", "top", "v_top"], window: [100, 25], phase: ["end", "v_end"] },
  "bouncing-ball": { over: ["restitution", 0.3, 0.95], window: [0, 5], ends: true },
  "colliding-blocks": { over: ["mass_2", 1, 100], window: [0, 12], ends: true },
  "sliding-pair": { over: ["stiffness", 0, 2], shown: ["x1", "stick"], section: ["stick", "x1", "x2"], window: [0, 12], ends: true },
};

const families: Record<string, string[]> = {
  "Impact and friction": ["vibro-impact", "impact-friction-oscillator", "stick-slip-impact", "friction-rattle"],
  "Friction: stick and slip": [
    "belt", "falling-friction", "two-blocks-on-belt", "shaken-belt", "pressed-block", "mode-coupling-brake", "drill-string",
    "coulomb-oscillator", "sliding-block", "sliding-pair",
  ],
  "Impacts": [
    "impact-oscillator", "shaken-table", "two-sided-rattle", "impact-absorber", "impact-pair", "gear-rattle", "spool", "bouncing-ball", "colliding-blocks",
  ],
};

/** Under which head a built-in model stands in the list. */
export function familyOf(name: string): string {
  return Object.keys(families).find((family) => families[family]?.includes(name)) ?? "Springs, dampers and others";
}

export function presetOf(name: string): Settings {
  const { set, over, shown, section, window, phase, chart, ends } = presets[name] ?? {};
  const own = presets[name] !== undefined;
  const sweep = over ?? ["", 0, 1];
  return {
    source: name,
    set: set ?? {},
    start: [],
    motion: { transient: window?.[0] ?? (own ? 500 : 0), periods: window?.[1] ?? 4, x: phase?.[0] ?? "", y: phase?.[1] ?? "" },
    section: { at: section?.[0] ?? (own ? "impacts" : ""), x: section?.[1] ?? "", y: section?.[2] ?? "", points: 3000 },
    diagram: {
      parameter: sweep[0], from: sweep[1], to: sweep[2], count: 600, transient: ends ? 0 : 120, points: 60,
      direction: ends ? "up" : "both", shown: shown?.[0] ?? (own ? "w" : ""), at: shown?.[1] ?? (own ? "impacts" : ""),
    },
    forces: [],
    spectrum: "",
    chart: {
      x: chart?.[0] ?? "", xFrom: chart?.[1] ?? 0, xTo: chart?.[2] ?? 1,
      y: chart?.[3] ?? "", yFrom: chart?.[4] ?? 0, yTo: chart?.[5] ?? 1, size: 120,
    },
    view: "section",
  };
}
