// Before the acts, where the page was opened with a run: that run, to be looked at.

import { lines, Replay } from "../model/replay";
import type { Simulator } from "../model/simulator";
import { part } from "../model/toml";
import { safety } from "../view/banner";
import { Board } from "../view/board";
import { MARGINS, VALUES } from "../view/charts";
import { h, say } from "../view/dom";

export async function mount(section: HTMLElement, simulator: Simulator, response: Response): Promise<[Replay, Board<Replay>]> {
  const note = h("p", { class: "note", "aria-live": "polite" });
  let why: string | null = null;
  const replay = await Replay.of(simulator, lines(response), (reason) => {
    why = reason;
    count();
  });
  const count = () => {
    const { moments } = replay.store.state;
    const ends = why === null ? "that is all of it" : `it broke off: ${why}`;
    say(note, `${replay.facts.name}: ${moments.length} moments; ${replay.over ? ends : "more may come"}.`);
  };
  const board = new Board(replay, {
    look: (moment) => {
      const values = part(moment.table, "values");
      const number = (name: string, otherwise: number) => (typeof values[name] === "number" ? values[name] : otherwise);
      return { values: [number("min", -500), number("max", 500)], marksShort: true, marksSets: false, half_m: 1.4 };
    },
    banner: ({ moment }) => safety(moment, null, null),
    charts: [MARGINS, VALUES],
    moves: false,
    label: "A run that was recorded or goes on elsewhere",
  });
  board.controls.append(note);
  replay.store.subscribe(count);
  section.hidden = false;
  return [replay, board];
}
