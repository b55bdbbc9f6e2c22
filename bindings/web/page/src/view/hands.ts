// Robots as buttons over the canvas: hands, mice and keyboards take them. A click makes a robot lie, or tell the truth again.

import { withLiars } from "../model/scenario";
import type { Scene } from "../model/scene";
import type { Stage } from "../model/stage";
import { h } from "./dom";
import { words } from "./words";
import { robotSize, toMetres, toPixels, type Frame } from "./picture";

/** A pointer that moved less is a click, px. */
const CLICK_PX = 5;
/** How far an arrow key moves a robot, m. */
const ARROW_M = 0.1;
/** How far ahead of a robot an arrow key draws it while time goes on, m. */
const DRAWN_M = 0.5;

/** How often buttons follow their robots while time goes on, ms. */
const PLACE_MS = 80;
/** How often labels follow while time goes on, ms. */
const LABEL_MS = 400;

const ARROWS: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

/** Makes robot `robot` lie, or tell the truth again. */
export function toggleLiar(stage: Stage, robot: number): void {
  const { liars } = stage.moment;
  const malicious = liars.has(robot) ? [...liars].filter((other) => other !== robot) : [...liars, robot];
  stage.touch((table) => withLiars(table, malicious));
}

export class Hands {
  readonly element = h("div", { class: "hands", role: "group", "aria-label": "Robots" });
  private buttons: HTMLButtonElement[] = [];
  private frame: Frame | null = null;
  private down: { robot: number; x: number; y: number; moved: boolean } | null = null;
  private labelled = 0;
  private placed = 0;

  constructor(
    private readonly scene: Scene,
    /** The same where it can be touched. */
    private readonly stage: Stage | null,
    /** Whether robots may be moved. */
    private readonly moves: boolean,
  ) {
    this.element.addEventListener("keydown", (event) => this.key(event));
  }

  /** True while a hand holds a robot: then the frame stands still. */
  get isHeld(): boolean {
    return this.down?.moved === true;
  }

  /** Puts the buttons where the robots are. */
  place(frame: Frame, now_ms: number): void {
    this.frame = frame;
    const { moment, store } = this.scene;
    while (this.buttons.length < moment.robots) this.add(this.buttons.length + 1);
    while (this.buttons.length > moment.robots) this.buttons.pop()?.remove();
    // Nothing draws a picture again that stands still, so its labels are right at once.
    const labels = !store.state.playing || now_ms - this.labelled > LABEL_MS;
    if (labels) this.labelled = now_ms;
    // While time goes on buttons follow a little later: nobody sees them, and a layout in every frame costs.
    const places = !store.state.playing || this.isHeld || now_ms - this.placed > PLACE_MS;
    if (places) this.placed = now_ms;
    const size = Math.max(2 * robotSize(frame, moment) + 6, 24);
    this.buttons.forEach((button, index) => {
      const robot = index + 1;
      if (!places && robot !== store.state.chosen) return;
      const [x, y] = toPixels(frame, moment.x(robot), moment.y(robot));
      button.style.transform = `translate(${(x - size / 2).toFixed(1)}px, ${(y - size / 2).toFixed(1)}px)`;
      button.style.width = button.style.height = `${size.toFixed(0)}px`;
      button.tabIndex = robot === store.state.chosen ? 0 : -1;
      button.setAttribute("aria-pressed", String(moment.isLiar(robot)));
      if (labels) button.setAttribute("aria-label", this.label(robot));
    });
  }

  private label(robot: number): string {
    const { moment } = this.scene;
    const kind = moment.isLiar(robot) ? "liar" : "honest";
    const rank = moment.rank(robot);
    const neighbours = rank === null ? "neighbours" : `neighbours that count, rank ${rank}`;
    return `Robot ${robot}, ${kind}, ${moment.degree(robot)} ${neighbours}, value ${words(moment.value(robot))}`;
  }

  private add(robot: number): void {
    const button = h("button", { class: "robot", type: "button", "aria-pressed": "false", "aria-label": this.label(robot) });
    button.addEventListener("pointerdown", (event) => this.take(event, robot));
    button.addEventListener("pointermove", (event) => this.drag(event));
    button.addEventListener("pointerup", () => this.drop());
    button.addEventListener("pointercancel", () => this.drop());
    button.addEventListener("focus", () => this.scene.store.set({ chosen: robot }));
    // A click of a mouse has been a pointer; one of a keyboard or of a reader of screens has not.
    button.addEventListener("click", (event) => {
      if (event.detail === 0) this.press(robot);
    });
    this.buttons.push(button);
    this.element.append(button);
  }

  private press(robot: number): void {
    if (this.stage) toggleLiar(this.stage, robot);
  }

  private take(event: PointerEvent, robot: number): void {
    if (event.button !== 0) return;
    this.buttons[robot - 1]?.setPointerCapture(event.pointerId);
    this.down = { robot, x: event.clientX, y: event.clientY, moved: false };
    this.scene.store.set({ chosen: robot });
  }

  private drag(event: PointerEvent): void {
    const { down, frame } = this;
    if (!down || !frame || !this.moves) return;
    down.moved ||= Math.hypot(event.clientX - down.x, event.clientY - down.y) > CLICK_PX;
    if (!down.moved) return;
    const box = this.element.getBoundingClientRect();
    const [x_m, y_m] = toMetres(frame, event.clientX - box.left, event.clientY - box.top);
    this.stage?.hold(down.robot, x_m, y_m);
  }

  private drop(): void {
    const { down } = this;
    this.down = null;
    if (!down) return;
    if (down.moved) this.stage?.release();
    else this.press(down.robot);
  }

  private key(event: KeyboardEvent): void {
    const { scene, stage } = this;
    const { chosen, playing } = scene.store.state;
    const way = ARROWS[event.key];
    const next = { PageDown: chosen + 1, PageUp: chosen - 1, Home: 1, End: scene.moment.robots }[event.key];
    if (next !== undefined) this.buttons[Math.max(1, Math.min(next, scene.moment.robots)) - 1]?.focus();
    else if (event.key === "l" || event.key === "L") this.press(chosen);
    else if (way && this.moves && stage) {
      const by = playing ? DRAWN_M : ARROW_M;
      stage.hold(chosen, stage.moment.x(chosen) + by * way[0], stage.moment.y(chosen) + by * way[1]);
      stage.release();
    } else return;
    event.preventDefault();
  }
}

