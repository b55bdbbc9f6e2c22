// Act 1: plain averaging, and one liar who drags everybody away.

import { change } from "../model/scenario";
import type { Simulator } from "../model/simulator";
import { Stage } from "../model/stage";
import { part, type Table } from "../model/toml";
import { agreement, type Said } from "../view/banner";
import { Board } from "../view/board";
import { VALUES } from "../view/charts";
import { slider } from "../view/dom";
import { words } from "../view/words";
import { watch } from "../view/tasks";

/** Plain averaging is W-MSR that is prepared for nobody. Robots hear only their nearest, so that agreeing takes some rounds. */
export const ONE: Table = {
  name: "act 1: plain averages",
  duration_s: 60,
  seed: 3,
  team: { robots: 11, faults: 0, malicious: [] },
  link: { radius_m: 0.9 },
  controller: { kind: "none" },
  clock: { tau_1_s: 0.02, tau_2_s: 0.2 },
  motion: { kind: "hold" },
  attack: { value: { kind: "constant", value: 500 } },
};

/** The value that liars tell. */
function lie(table: Table): number {
  const value = part(part(table, "attack"), "value")["value"];
  return typeof value === "number" ? value : 0;
}

export function mount(section: HTMLElement, simulator: Simulator): [Stage, Board<Stage>] {
  const stage = new Stage(simulator, ONE);
  const board = new Board(stage, {
    look: () => ({ values: [-500, 500], marksShort: false, marksSets: false, half_m: 1 }),
    banner,
    charts: [VALUES],
    moves: false,
    label: "Eleven robots that average their values with their neighbours",
  });
  const told = slider("What a liar says", { min: -500, max: 500, step: 10, value: 500 }, words, (value) => {
    stage.touch((table) => change(table, "attack", { value: { kind: "constant", value } }));
  });
  board.controls.append(told.element);
  stage.store.subscribe(() => told.show(lie(stage.table)));
  // Where the honest last agreed without a liar, and with one.
  let fair: number | null = null;
  let first: number | null = null;
  watch(section, stage, {
    agree: ({ moment }) => {
      const agreed = moment.liars.size === 0 && moment.spread() < 10;
      if (agreed) fair = moment.mean();
      return agreed;
    },
    lie: ({ moment }) => {
      const dragged = moment.liars.size > 0 && Math.abs(moment.mean() - lie(moment.table)) < 40;
      if (dragged && (fair === null || Math.abs(moment.mean() - fair) > 100)) first ??= lie(moment.table);
      return first !== null;
    },
    steer: ({ moment }) => {
      const follows = moment.liars.size > 0 && Math.abs(moment.mean() - lie(moment.table)) < 40;
      return first !== null && follows && Math.abs(lie(moment.table) - first) > 300;
    },
  });
  return [stage, board];
}

function banner(stage: Stage): Said {
  const { moment } = stage;
  const liars = moment.liars.size;
  const state = agreement(moment);
  if (liars === 0) {
    return { main: `Nobody lies, and ${state}.`, why: ["Each robot becomes the average of itself and the robots it is linked to, five times a second."], tone: "good" };
  }
  const who = liars === 1 ? `Robot ${[...moment.liars][0]} lies` : `${liars} robots lie`;
  const gap = Math.abs(moment.mean() - lie(moment.table));
  const dragged = gap < 40 ? "it has dragged everybody to its own value" : "watch where the others go";
  return { main: `${who}, always saying ${words(lie(moment.table))}; ${gap < 40 && liars > 1 ? "they have dragged everybody to their value" : dragged}.`, why: [], tone: gap < 40 ? "bad" : "warn" };
}
