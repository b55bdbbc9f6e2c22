// The page comes alive: the simulator is loaded, each act gets its board, and whoever is in sight plays.

import "uplot/dist/uPlot.min.css";
import "./page.css";
import * as four from "./acts/four";
import * as one from "./acts/one";
import * as three from "./acts/three";
import * as two from "./acts/two";
import { unpack } from "./model/link";
import { Refused, Simulator } from "./model/simulator";
import type { Stage } from "./model/stage";
import { h } from "./view/dom";
import type { Board } from "./view/board";

/** How far into a run a link may lead, s. */
const LINK_S = 600;

type Mount = (section: HTMLElement, simulator: Simulator) => [Stage, Board];

/** A board that the browser draws while it is in sight. */
interface Shown {
  stage: Stage;
  board: Board;
  inSight: boolean;
}

/** The scenario that `closeranks view FILE` lays beside the page, if there is one. */
function told(): string | null {
  return document.querySelector<HTMLMetaElement>('meta[name="closeranks-scenario"]')?.content ?? null;
}

async function fetched(name: string): Promise<Response> {
  const response = await fetch(name);
  if (!response.ok) throw new Error(`cannot fetch ${name}: ${response.status}`);
  return response;
}

/** Opens what the link or the command line asks for in the sandbox; false if nothing is asked for. */
async function restore(simulator: Simulator, stage: Stage): Promise<boolean> {
  const beside = told();
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

function mounted(name: string, mount: Mount, simulator: Simulator): Shown {
  const section = document.getElementById(name);
  const place = section?.querySelector<HTMLElement>(".stage");
  if (!section || !place) throw new Error(`the article has no stage ${name}`);
  const [stage, board] = mount(section, simulator);
  place.replaceChildren(board.element);
  const shown = { stage, board, inSight: false };
  new IntersectionObserver(([entry]) => {
    shown.inSight = entry?.isIntersecting ?? false;
  }).observe(place);
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
  if (sandbox && (await restore(simulator, sandbox.stage))) {
    document.getElementById("act-4")?.scrollIntoView();
  }
  let last = performance.now();
  const turn = (now: number) => {
    for (const { stage, board, inSight } of all) {
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
