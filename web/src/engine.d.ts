// The engine as Emscripten gives it (web/engine/bindings.cpp).
declare module "slapstick-engine" {
  import type { BranchWish, ChartWish, CurveWish, DiagramWish, Model, MotionWish, SectionWish } from "./protocol.ts";

  export interface Session {
    card(model: Model): string;
    models(): string;
    blank(name: string): string;
    classify(model: Model, periods: number): string;
    spectrum(model: Model, quantity: string, highestOrder: number): string;
    branch(model: Model, wish: BranchWish): string;
    born(branch: number, special: number): string;
    curve(branch: number, special: number, wish: CurveWish): string;
    bits(): string;
    beginMotion(model: Model, wish: MotionWish): string;
    beginDiagram(model: Model, wish: DiagramWish): string;
    beginSection(model: Model, wish: SectionWish): string;
    beginChart(model: Model, wish: ChartWish): string;
    advance(milliseconds: number): boolean;
    /** Views of the module's memory: valid until the next call. */
    rows(): Float64Array;
    events(): Float64Array;
    width(): number;
    eventWidth(): number;
    failure(): string;
    goOn(): void;
  }

  export interface Engine {
    Session: new () => Session;
  }

  export interface Options {
    instantiateWasm?(
      imports: WebAssembly.Imports,
      receive: (instance: WebAssembly.Instance, module: WebAssembly.Module) => void,
    ): object;
    wasmBinary?: ArrayBufferView;
  }

  export default function create(options?: Options): Promise<Engine>;
}
