// Guided pages: text beside live views. A story is a list of steps, and a step is a text and settings.
import { button, element } from "./dom.ts";
import { type Settings, settingsOf } from "./settings.ts";

interface Step {
  text: string;
  model: string;
  /** What the text says of the motion's class, held to it by the tests. */
  motion: string;
  edit?(settings: Settings): void;
}

interface Tale {
  key: string;
  title: string;
  steps: Step[];
}

const tales: Tale[] = [
  {
    key: "paper", title: "The paper's figures", steps: [
      { model: "vibro-impact", motion: "1-1-I", text: "Two blocks: block 1 is forced, rubs on block 2 and hits its stop. At ω = 2.2 there is one impact in each forcing period: the motion is called 1-1-I. Press play." },
      { model: "vibro-impact", motion: "1-1-II", text: "At ω = 1.5 the blocks also stick for a part of the period: the strip below the curves shows when. The class is 1-1-II.", edit: (s) => { s.set = { omega: 1.5 }; } },
      { model: "vibro-impact", motion: "chaotic", text: "At ω = 5.067 the diagram has a cloud of points: no period returns, the motion is chaotic. The section at impacts shows what the motion visits.", edit: (s) => { s.set = { omega: 5.067 }; } },
      { model: "vibro-impact", motion: "", text: "The diagram runs over all frequencies, up and down. Click anywhere in it: the other views go to that motion.", edit: (s) => { s.set = { omega: 5.5 }; } },
    ],
  },
  {
    key: "grazing", title: "What grazing does", steps: [
      { model: "impact-oscillator", motion: "1-0-I", text: "One mass and a stop. The clearance is wide: the mass does not touch. Its orbit is an ellipse.", edit: (s) => { s.set = { omega: 2, clearance: 0.4 }; Object.assign(s.diagram, { parameter: "clearance", from: -0.2, to: 0.45 }); } },
      { model: "impact-oscillator", motion: "1-1-I", text: "Drag the clearance down. Where the ellipse first touches the stop, the motion changes at once: the map has a square root there, whose slope is infinite.", edit: (s) => { s.set = { omega: 2, clearance: 0.25 }; Object.assign(s.diagram, { parameter: "clearance", from: -0.2, to: 0.45 }); } },
      { model: "impact-oscillator", motion: "1-1-I", text: "The branch over the diagram (b) marks the graze by GR. A click near it shows the motions on both sides.", edit: (s) => { s.set = { omega: 2, clearance: 0 }; Object.assign(s.diagram, { parameter: "clearance", from: -0.2, to: 0.45 }); } },
    ],
  },
  {
    key: "chatter", title: "Chatter", steps: [
      { model: "bouncing-ball", motion: "equilibrium", text: "A ball bounces infinitely often in a finite time. Each flight is shorter by the coefficient of restitution. Turn on “Slow at impacts” and play.", edit: (s) => { s.view = "forces"; s.forces = ["x"]; } },
      { model: "shaken-table", motion: "1-inf-II", text: "On a shaken table the ball comes to rest by such a chatter, rides along and takes off again, in each period.", edit: (s) => { s.set = { acceleration: 1.2, restitution: 0.3 }; } },
      { model: "vibro-impact", motion: "1-inf-II", text: "The paper's oscillator chatters at low frequencies: infinitely many impacts, then contact, then flight.", edit: (s) => { s.set = { omega: 0.552 }; s.motion.periods = 2; } },
    ],
  },
  {
    key: "stick-slip", title: "Stick-slip", steps: [
      { model: "belt", motion: "free-0-II", text: "A mass on a belt. Friction holds it until the spring wins; it slips back and is caught. The mark “stuck” shows when." },
      { model: "belt", motion: "free-0-II", text: "A faster belt: stick is shorter. The diagram shows where the mass lets go, for each belt speed, until stick-slip ends.", edit: (s) => { s.set = { belt_speed: 0.9 }; } },
      { model: "drill-string", motion: "free-0-II", text: "The same mechanism in a drill string: the bit stands still, winds up the string and spins free." },
      { model: "drill-string", motion: "equilibrium", text: "Above a drive speed the stick-slip is gone. Drag the drive speed to find where.", edit: (s) => { s.set = { drive_speed: 12 }; } },
    ],
  },
  {
    key: "attractors", title: "Two attractors", steps: [
      { model: "bump-stop", motion: "", text: "The two colours of the diagram are two directions. Around ω = 1.3 they differ: two motions exist there, a large and a small one, and the past decides which one is seen.", edit: (s) => { s.set = { omega: 1.3 }; } },
      { model: "bump-stop", motion: "", text: "Click the upper colour at ω = 1.3, then the lower one: the parameter stays, the motion is another one. “carry the motion on” and the slider of ω do the same: come from below, then from above.", edit: (s) => { s.set = { omega: 1.3 }; } },
      { model: "two-sided-rattle", motion: "1-2-I", text: "A mass that rattles between two stops keeps hitting them as the frequency rises. Coming down it does not touch them: the diagram has no orange points there.", edit: (s) => { s.set = { omega: 2 }; } },
      { model: "two-sided-rattle", motion: "1-2-I", text: "Drag the mass close to the middle and let it go: it swings without a touch. From a start near a stop it may go on rattling.", edit: (s) => { s.set = { omega: 2 }; s.motion.transient = 0; s.motion.periods = 30; } },
    ],
  },
  {
    key: "chaos", title: "Routes to chaos", steps: [
      { model: "shaken-table", motion: "1-1-I", text: "One bounce in a period: the section at impacts has one point.", edit: (s) => { s.set = { acceleration: 1.4 }; Object.assign(s.diagram, { from: 1.1, to: 1.8 }); } },
      { model: "shaken-table", motion: "2-2-I", text: "The period has doubled: two points. “Branch” names the doubling PD.", edit: (s) => { s.set = { acceleration: 1.6 }; Object.assign(s.diagram, { from: 1.1, to: 1.8 }); } },
      { model: "shaken-table", motion: "4-4-I", text: "Doubled again: four points.", edit: (s) => { s.set = { acceleration: 1.687 }; Object.assign(s.diagram, { from: 1.1, to: 1.8 }); } },
      { model: "shaken-table", motion: "chaotic", text: "After more doublings the points do not close any more. The exponent beside the class is positive: two near motions part.", edit: (s) => { s.set = { acceleration: 1.713 }; Object.assign(s.diagram, { from: 1.1, to: 1.8 }); } },
    ],
  },
];

export class Story {
  private index = 0;
  private readonly tale: Tale;
  private readonly place = document.querySelector<HTMLElement>("#story") as HTMLElement;

  constructor(key: string, private readonly show: (settings: Settings) => void, private readonly closed: () => void) {
    this.tale = tales.find((tale) => tale.key === key) ?? (tales[0] as Tale);
    this.tell();
  }

  static list(): { key: string; title: string; steps: number }[] {
    return tales.map(({ key, title, steps }) => ({ key, title, steps: steps.length }));
  }

  close(): void {
    this.place.hidden = true;
    this.closed();
  }

  private tell(): void {
    const { title, steps } = this.tale, step = steps[this.index] as Step;
    const settings = settingsOf(step.model);
    step.edit?.(settings);
    this.show(settings);
    const go = (by: number): void => {
      this.index += by;
      this.tell();
    };
    this.place.hidden = false;
    this.place.dataset["motion"] = step.motion;
    this.place.replaceChildren(
      element("h2", {}, title), element("p", {}, step.text),
      element("div", { class: "steps" },
        button("Back", "step before", () => go(-1), { disabled: this.index === 0 }),
        element("span", { id: "story-step" }, `${this.index + 1} of ${steps.length}`),
        this.index + 1 < steps.length ? button("Next", "next step", () => go(1), { class: "main" }) : button("End", "end of the story", () => this.close(), { class: "main" }),
        button("×", "leave the story", () => this.close(), { class: "plain" })),
    );
  }
}
