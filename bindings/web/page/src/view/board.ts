// A board: the picture of a team with its banner, charts and the means to play. Every act puts its own controls beside it.

import type { Moment } from "../model/moment";
import type { Scene } from "../model/scene";
import { Stage } from "../model/stage";
import type { Said } from "./banner";
import { Chart, type Drawn } from "./charts";
import { h, say } from "./dom";
import { Hands } from "./hands";
import { CROWD, drawLinks, drawRobots, framed, type Frame, type Look } from "./picture";

export interface Setting<Seen extends Scene> {
  look: (moment: Moment) => Look;
  banner: (stage: Seen) => Said;
  charts: Drawn[];
  /** Whether robots may be moved. */
  moves: boolean;
  /** The picture in a sentence, for who does not see it. */
  label: string;
}

/** How often words, charts and searches are renewed, ms. */
const SLOW_MS = 120;
/** How often the banner is read aloud at most, ms. */
const ALOUD_MS = 2500;

export class Board<Seen extends Scene = Scene> {
  readonly element: HTMLElement;
  readonly controls = h("div", { class: "controls" });
  private readonly under = h("canvas", { "aria-hidden": "true" });
  private readonly canvas = h("canvas", { "aria-hidden": "true" });
  private readonly hands: Hands;
  private readonly area: HTMLElement;
  private readonly banner = h("p", { class: "banner-main" });
  private readonly why = h("ul", { class: "banner-why" });
  private readonly aloud = h("p", { class: "unseen", "aria-live": "polite" });
  private readonly box = h("div", { class: "banner" });
  private readonly charts: Chart[];
  private readonly play = h("button", { type: "button", class: "play" }, "Play");
  private readonly time = h("input", { type: "range", min: 0, step: 1, "aria-label": "Time: scrub back" });
  private readonly clock = h("output", { class: "clock" });
  private frame: Frame | null = null;
  /** Frames drawn. */
  private count = 0;
  private slow = 0;
  /** Which of words and charts was renewed last. */
  private turn = 0;
  private spoke = 0;
  private spoken = "";
  private stale = true;
  /** True while the frame still follows the team. */
  private moved = false;

  constructor(
    private readonly stage: Seen,
    private readonly setting: Setting<Seen>,
  ) {
    const touched = stage instanceof Stage ? stage : null;
    this.hands = new Hands(stage, touched, setting.moves);
    this.charts = setting.charts.map((drawn) => new Chart(drawn, (index) => stage.seek(index)));
    this.play.addEventListener("click", () => stage.play());
    this.time.addEventListener("input", () => stage.seek(Number(this.time.value)));
    const buttons = h(
      "div",
      { class: "transport" },
      this.play,
      h("button", { type: "button", onclick: () => stage.step() }, "Step"),
      h("button", { type: "button", onclick: () => stage.restart() }, "Start over"),
      this.time,
      this.clock,
    );
    this.area = h("div", { class: "area", role: "group", "aria-label": setting.label }, this.under, this.canvas, this.hands.element);
    this.box.append(this.banner, this.why);
    const keys = h(
      "details",
      { class: "keys" },
      h("summary", {}, "Keys"),
      h("p", {}, `Tab to a robot. Page Up and Page Down choose another one. ${setting.moves ? "Arrows move it. " : ""}${touched ? "L, or Enter, makes it lie or tell the truth again." : ""}`),
    );
    this.element = h("div", { class: "board" }, h("div", { class: "left" }, this.area, buttons, keys), h("div", { class: "right" }, this.box, this.aloud, this.controls, ...this.charts.map((chart) => chart.element)));
    stage.store.subscribe(() => {
      this.stale = true;
    });
    new ResizeObserver(() => {
      this.stale = true;
    }).observe(this.area);
  }

  /** Draws what changed. To be called in every frame of the browser while the board is in sight. */
  render(now_ms: number): void {
    if (!this.stale && !this.moved) return;
    this.stale = false;
    const { state } = this.stage.store;
    const { moment } = this.stage;
    const look = this.setting.look(moment);
    const { clientWidth: width, clientHeight: height } = this.area;
    if (width === 0) return;
    const still = this.hands.isHeld || matchMedia("(prefers-reduced-motion: reduce)").matches;
    const before = still && !this.hands.isHeld ? null : this.frame;
    this.frame = framed(moment, look, width, height, before, this.hands.isHeld);
    this.moved = before !== null && !sameFrame(before, this.frame);
    this.count += 1;
    const [under, context] = [sized(this.under, width, height), sized(this.canvas, width, height)];
    if (!under || !context) return;
    // While a crowd moves its links follow twenty times a second; their ends stay below the robots.
    if (moment.robots <= CROWD || !state.playing || this.count % 3 === 0) drawLinks(under, this.frame, moment, state);
    drawRobots(context, this.frame, moment, state, look);
    this.hands.place(this.frame, now_ms);
    say(this.play, state.playing ? "Pause" : "Play");
    this.renew(now_ms, state.playing);
  }

  /** Renews words and charts: one of them in a frame while time goes on, so that no frame is late; all of them where it stands still. */
  private renew(now_ms: number, playing: boolean): void {
    const parts = [() => this.words(now_ms), ...this.charts.map((chart) => () => this.show(chart))];
    if (!playing) {
      for (const part of parts) part();
      return;
    }
    this.stale = true;
    if (now_ms - this.slow < SLOW_MS / parts.length) return;
    this.slow = now_ms;
    this.turn = (this.turn + 1) % parts.length;
    parts[this.turn]?.();
  }

  private show(chart: Chart): void {
    const { moments, cursor } = this.stage.store.state;
    chart.show(moments, cursor);
  }

  private words(now_ms: number): void {
    const { stage } = this;
    const { moments, cursor, refused } = stage.store.state;
    stage.look();
    const said: Said = refused ? { main: `This was refused: ${refused}`, why: [], tone: "bad" } : this.setting.banner(stage);
    this.box.dataset["tone"] = said.tone;
    say(this.banner, said.main);
    const why = said.why.filter((line) => line !== "");
    if (why.join("\n") !== [...this.why.children].map((line) => line.textContent).join("\n")) {
      this.why.replaceChildren(...why.map((line) => h("li", {}, line)));
    }
    this.speak(said.main, now_ms);
    this.time.max = String(moments.length - 1);
    this.time.value = String(cursor);
    const time = stage.moment.time_s.toFixed(stage.moment.facts.tick_s < 0.01 ? 2 : 1);
    this.time.setAttribute("aria-valuetext", `${time} seconds`);
    say(this.clock, `${time} s`);
  }

  /** Reads the banner aloud, if it says something else than the last time; where that is too early, a later frame does. */
  private speak(main: string, now_ms: number): void {
    // A number that falls all the time is not worth a sentence each time.
    const spoken = main.replace(/[\d.]+ apart/, "apart");
    if (spoken === this.spoken || this.stage.store.state.touches === 0) return;
    if (now_ms - this.spoke <= ALOUD_MS) {
      this.stale = true;
      return;
    }
    this.spoke = now_ms;
    this.spoken = spoken;
    say(this.aloud, main);
  }
}

/** The context of a canvas that fills so many pixels of the page. A canvas whose size changes is empty afterwards. */
function sized(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D | null {
  const scale = Math.min(devicePixelRatio, 2);
  const [wide, high] = [Math.round(width * scale), Math.round(height * scale)];
  if (canvas.width !== wide || canvas.height !== high) [canvas.width, canvas.height] = [wide, high];
  const context = canvas.getContext("2d");
  context?.setTransform(scale, 0, 0, scale, 0, 0);
  return context;
}

function sameFrame(one: Frame, other: Frame): boolean {
  return one.x_m === other.x_m && one.y_m === other.y_m && Math.abs(one.pixels_per_m - other.pixels_per_m) < 0.05;
}
