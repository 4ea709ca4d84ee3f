// Which pixels of a chart are computed when: a coarse picture at once, then where two classes meet, then all others.
// Until its turn comes, a pixel inside a region of one class is taken for one of that class.
import type { Lane } from "./lane.ts";
import type { EngineError, Model, Part } from "./protocol.ts";
import type { Settings } from "./settings.ts";

/** Coarse to fine: every so many pixels. */
const strides = [8, 4, 2, 1];
/** Of a pixel: at first, and again where no cycle was found. */
const periods = 100, morePeriods = 300;

/** coarse: every eighth pixel; picture: all borders are found; all: no pixel stands for another; more: with more periods. */
export type Stage = "coarse" | "picture" | "all" | "more";

/** The class of a row: an attractor's number (attractor/classify.hpp), n, p, sticking. */
export function classOf(kind: number, n: number, p: number, sticking: boolean): string {
  if (kind === 0) return `${n}-${p < 0 ? "∞" : p}-${sticking ? "II" : "I"}`;
  return ["", "quasi-periodic", "chaotic", "one of a family", noCycle, "rest"][kind] ?? "failed";
}

const noCycle = "no short cycle";

export class Pixels {
  /** What each pixel is, row by row; "" where it is not computed. */
  readonly names: string[];
  /** How many are computed. */
  known = 0;
  finished = false;
  private readonly guesses: string[];
  private stopped = false;

  /**
   * @param show  a pixel is known: its number, and for how many columns and rows it stands
   * @param reached  a stage is complete
   */
  constructor(
    private readonly lanes: readonly Lane[], private readonly model: Model, private readonly wish: Settings["chart"],
    private readonly show: (pixel: number, size: number) => void, private readonly reached: (stage: Stage) => void,
  ) {
    this.names = Array<string>(wish.size ** 2).fill("");
    this.guesses = Array<string>(wish.size ** 2).fill("");
  }

  /** All stages. @throws EngineError; never settles if it is stopped */
  async run(): Promise<void> {
    const all = (stride: number): number[] => this.grid(stride).filter((pixel) => this.names[pixel] === "");
    await this.compute(all(strides[0] as number), strides[0] as number, periods);
    this.reached("coarse");
    for (const stride of strides.slice(1)) await this.borders(stride);
    this.reached("picture");
    for (const stride of strides.slice(1)) await this.compute(all(stride), 1, periods);
    this.reached("all");
    await this.compute(this.grid(1).filter((pixel) => this.names[pixel] === noCycle), 1, morePeriods);
    this.finished = true;
    this.reached("more");
  }

  stop(): void {
    this.stopped = true;
    for (const lane of this.lanes) lane.cancel();
  }

  /** The class of a pixel, or of the pixels about it; "" if neither is known. */
  at(pixel: number): string {
    return this.names[pixel] || this.guesses[pixel] || "";
  }

  private grid(stride: number): number[] {
    const { size } = this.wish, list: number[] = [];
    for (let row = 0; row < size; row += stride) for (let column = 0; column < size; column += stride) list.push(row * size + column);
    return list;
  }

  /** The pixels of a finer grid that lie between different classes; where one differs from its neighbours, those too. */
  private async borders(stride: number): Promise<void> {
    const { size } = this.wish, fresh = this.grid(stride).filter((pixel) => this.at(pixel) === "");
    let due: number[] = [];
    for (const pixel of fresh) {
      const [first = "", ...others] = this.around(pixel, 2 * stride).map((corner) => this.at(corner));
      if (others.every((name) => name === first)) this.guesses[pixel] = first;
      else due.push(pixel);
    }
    while (due.length > 0) {
      await this.compute(due, stride, periods);
      const next = new Set<number>();
      for (const pixel of due) {
        const column = pixel % size, row = (pixel - column) / size;
        for (let r = row - stride; r <= row + stride; r += stride)
          for (let c = column - stride; c <= column + stride; c += stride) {
            const beside = r * size + c;
            if (r >= 0 && c >= 0 && r < size && c < size && this.names[beside] === "" && this.guesses[beside] !== this.names[pixel]) next.add(beside);
          }
      }
      due = [...next];
    }
  }

  /** The corners of the cell of a coarser grid in which a pixel lies. */
  private around(pixel: number, stride: number): number[] {
    const { size } = this.wish, column = pixel % size, row = (pixel - column) / size;
    const ends = (k: number): number[] => {
      const low = k - (k % stride), high = low === k ? low : low + stride;
      return high < size ? [low, high] : [low];
    };
    return ends(row).flatMap((r) => ends(column).map((c) => r * size + c));
  }

  /** On all lanes; each gets every so-manieth pixel, since neighbours cost about the same. */
  private async compute(pixels: number[], size: number, of: number): Promise<void> {
    await Promise.all(this.lanes.map((lane, i) => new Promise<void>((resolve, reject) => {
      const share = pixels.filter((_, k) => k % this.lanes.length === i);
      if (this.stopped) return;
      if (share.length === 0) {
        resolve();
        return;
      }
      const { x, y, xFrom, xTo, yFrom, yTo, size: columns } = this.wish;
      lane.ask({ verb: "chart", model: this.model, wish: { x, y, xFrom, xTo, yFrom, yTo, columns, rows: columns, pixels: share, periods: of } }, {
        part: (part: Part) => this.take(part, size), done: () => resolve(), error: (error: EngineError) => reject(error),
      });
    })));
  }

  private take({ rows, width }: Part, size: number): void {
    for (let i = 0; i < rows.length; i += width) {
      const pixel = (rows[i + 1] as number) * this.wish.size + (rows[i] as number);
      if (this.names[pixel] === "") ++this.known;
      this.names[pixel] = classOf(rows[i + 2] as number, rows[i + 3] as number, rows[i + 4] as number, rows[i + 5] === 1);
      this.show(pixel, size);
    }
  }
}
