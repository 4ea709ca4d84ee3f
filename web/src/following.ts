// Branches over the diagram, what begins at their special points, and the curves of these points over the chart.
import { announce } from "./dom.ts";
import type { Lane } from "./lane.ts";
import type { Branch, Curve, EngineError, Model, Request } from "./protocol.ts";
import type { History } from "./settings.ts";
import type { ChartView } from "./views/chart.ts";
import type { DiagramView } from "./views/diagram.ts";

export class Following {
  /** @param lane  its worker keeps the branches that are shown: it is ended only with them */
  constructor(private readonly lane: Lane, private readonly history: History, private readonly diagram: DiagramView, private readonly chart: ChartView) {}

  /** The branch of the present orbit over the diagram, or none again. */
  branch(model: Model): void {
    if (this.diagram.hasBranch || this.lane.isBusy) {
      this.lane.cancel();
      this.diagram.showBranches([]);
      this.diagram.following(0);
      announce("no branch");
      return;
    }
    const { parameter, from, to, shown, at } = this.history.now.diagram;
    this.ask({ verb: "branch", model, wish: { parameter, from, to, shown, at } }, "following the orbit through the parameter …");
  }

  /** Branches that begin at a special point of one that is shown. */
  born(branch: number, special: number): void {
    this.ask({ verb: "born", branch, special }, "following what begins here …");
  }

  private ask(request: Request, text: string): void {
    if (this.isFollowing()) return;
    announce(text);
    this.lane.question<{ branches: Branch[] }>(request, (count) => this.diagram.following(count)).then(({ branches }) => {
      this.diagram.following(0);
      if (branches.length > 0) this.diagram.showBranches(branches);
      const count = (pick: (branch: Branch) => unknown[]): number => branches.reduce((sum, branch) => sum + pick(branch).length, 0);
      announce(branches.length === 0 ? "what begins here is shown already"
        : `${count(({ points }) => points)} orbits and ${count(({ special }) => special)} special points. ${branches.filter(({ whole }) => !whole).map(({ ended }) => ended).join("; ")}`);
    }, (error: EngineError) => this.failed(error));
  }

  /** The curve of a special point in the plane of the chart, which shows the diagram's parameter and another one. */
  curve(branch: number, special: number, model: Model): void {
    if (this.isFollowing()) return;
    const { diagram } = this.history.now;
    this.history.change("curve", (draft) => {
      draft.view = "chart";
      if (draft.chart.x === diagram.parameter || draft.chart.y === diagram.parameter) return;
      Object.assign(draft.chart, { x: diagram.parameter, xFrom: diagram.from, xTo: diagram.to });
    });
    const { chart } = this.history.now, turned = chart.x !== diagram.parameter, second = turned ? chart.x : chart.y;
    const [x, y] = [[chart.xFrom, chart.xTo], [chart.yFrom, chart.yTo]] as [[number, number], [number, number]];
    const [[from, to], [secondFrom, secondTo]] = turned ? [y, x] : [x, y];
    const wish = { second, from: Math.min(from, diagram.from), to: Math.max(to, diagram.to), secondFrom, secondTo };
    announce(`following the point while ${second} varies too …`);
    this.lane.question<Curve>({ verb: "curve", branch, special, wish }, (count) => this.diagram.following(count)).then((curve) => {
      this.diagram.following(0);
      this.chart.add(model, curve, diagram.parameter, second);
      announce(`the curve of ${curve.type} has ${curve.first.length} points. ${curve.whole ? "" : curve.ended}`);
    }, (error: EngineError) => this.failed(error));
  }

  private failed(error: EngineError): void {
    this.diagram.following(0);
    announce(error.message);
  }

  private isFollowing(): boolean {
    if (this.lane.isBusy) announce("a branch or curve is being followed: wait, or end it by b");
    return this.lane.isBusy;
  }
}
