// The page comes alive: the simulator is loaded, each act gets its board, and whoever is in sight plays.

import "uplot/dist/uPlot.min.css";
import "./page.css";
import * as four from "./acts/four";
import * as one from "./acts/one";
import * as recorded from "./acts/recorded";
import * as three from "./acts/three";
import * as two from "./acts/two";
import { unpack } from "./model/link";
import { Refused, Simulator } from "./model/simulator";
import type { Scene } from "./model/scene";
import type { Stage } from "./model/stage";
import { h } from "./view/dom";
import type { Board } from "./view/board";

/** How far into a run a link may lead, s. */
const LINK_S = 600;

type Mount = (section: HTMLElement, simulator: Simulator) => [Stage, Board<Stage>];

/** A board that the browser draws while it is in sight. */
interface Shown<Seen extends Scene = Scene> {
  stage: Seen;
  board: { element: HTMLElement; render: (now_ms: number) => void };
  inSight: boolean;
}

/** The file that `closeranks view` lays beside the page under this name, if there is one. */
function told(name: "scenario" | "moments"): string | null {
  return document.querySelector<HTMLMetaElement>(`meta[name="closeranks-${name}"]`)?.content ?? null;
}

async function fetched(name: string): Promise<Response> {
  const response = await fetch(name);
  if (!response.ok) throw new Error(`cannot fetch ${name}: ${response.status}`);
  return response;
}

/** Opens what the link or the command line asks for in the sandbox; false if nothing is asked for. */
async function restore(simulator: Simulator, stage: Stage): Promise<boolean> {
  const beside = told("scenario");
  try {
    const shared = await unpack(location.hash);
    if (shared) {
      if (stage.begin(simulator.table(shared.text))) stage.run(Math.min(shared.time_s, LINK_S));
      return true;
    }
    if (beside === null) return false;
    stage.begin(simulator.table(await (await fetched(beside)).text()));
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    stage.store.set({ refused: `what this link or file says cannot be read: ${reason}` });
  }
  return true;
}

/** A section of the article, and the place in it for a board. */
function place(name: string): [HTMLElement, HTMLElement] {
  const section = document.getElementById(name);
  const inside = section?.querySelector<HTMLElement>(".stage");
  if (!section || !inside) throw new Error(`the article has no stage ${name}`);
  return [section, inside];
}

function mounted(name: string, mount: Mount, simulator: Simulator): Shown<Stage> {
  const [section, inside] = place(name);
  return inPlace(inside, ...mount(section, simulator));
}

/** The run that the page was opened with, if there is one. */
async function replayed(simulator: Simulator): Promise<Shown | null> {
  const moments = told("moments");
  if (moments === null) return null;
  const [section, inside] = place("recorded");
  return inPlace(inside, ...(await recorded.mount(section, simulator, await fetched(moments))));
}

function inPlace<Seen extends Scene>(inside: HTMLElement, stage: Seen, board: Board<Seen>): Shown<Seen> {
  inside.replaceChildren(board.element);
  const shown = { stage, board, inSight: false };
  new IntersectionObserver(([entry]) => {
    shown.inSight = entry?.isIntersecting ?? false;
  }).observe(inside);
  return shown;
}

async function start(): Promise<void> {
  const module = await fetched("closeranks.wasm");
  const simulator = await Simulator.of(await module.arrayBuffer());
  const acts: [string, Mount][] = [
    ["act-1", one.mount],
    ["act-2", two.mount],
    ["act-3", three.mount],
    ["act-4", four.mount],
  ];
  const all = acts.map(([name, mount]) => mounted(name, mount, simulator));
  const sandbox = all[3];
  const asked = sandbox !== undefined && (await restore(simulator, sandbox.stage));
  const replay = await replayed(simulator);
  if (replay) document.getElementById("recorded")?.scrollIntoView();
  else if (asked) document.getElementById("act-4")?.scrollIntoView();
  const boards: Shown[] = replay ? [replay, ...all] : all;
  let last = performance.now();
  const turn = (now: number) => {
    for (const { stage, board, inSight } of boards) {
      if (!inSight) continue;
      stage.advance((now - last) / 1000);
      board.render(now);
    }
    last = now;
    requestAnimationFrame(turn);
  };
  requestAnimationFrame(turn);
  document.documentElement.classList.add("alive");
}

start().catch((error: unknown) => {
  const reason = error instanceof Refused || error instanceof Error ? error.message : String(error);
  document.querySelector("main")?.prepend(h("p", { class: "failed", role: "alert" }, `The pictures could not be brought to life: ${reason}`));
});
