// Act 2: W-MSR, and how many neighbours it needs. The reader pulls two camps apart and finds the number.

import { change, replace } from "../model/scenario";
import type { Simulator } from "../model/simulator";
import { Stage } from "../model/stage";
import type { Moment } from "../model/moment";
import type { Table } from "../model/toml";
import { agreement, type Said } from "../view/banner";
import { Board } from "../view/board";
import { VALUES } from "../view/charts";
import { h, say, scrolling, slider } from "../view/dom";
import { watch } from "../view/tasks";

/** Distance of neighbours in a camp, m. */
const SPACING_M = 0.55;
const GAP_M = 2;
/** A trial that has not ended after so many rounds will not end. */
const ROUNDS = 40;

/** Two columns, five robots on the left and six on the right, each between two of the other side. */
function camps(gap_m: number): number[][] {
  const place = (robot: number) =>
    robot <= 5 ? [-gap_m / 2, SPACING_M * (robot - 3)] : [gap_m / 2, SPACING_M * (robot - 8.5)];
  return Array.from({ length: 11 }, (_, index) => place(index + 1));
}

/** Low values on the left, high ones on the right. */
const APART = Array.from({ length: 11 }, (_, index) => (index < 5 ? -400 + 20 * index : 300 + 20 * (index - 5)));

function at(gap_m: number): Table {
  return {
    name: "act 2: W-MSR",
    duration_s: 8,
    team: { robots: 11, faults: 2, malicious: [] },
    controller: { kind: "none" },
    clock: { tau_1_s: 0.02, tau_2_s: 0.1 },
    start: { kind: "listed", positions_m: camps(gap_m) },
    values: { kind: "listed", values: APART },
    motion: { kind: "hold" },
    attack: { value: { kind: "constant", value: 500 } },
  };
}

export const TWO: Table = at(GAP_M);

/** What trials came to, by the least number of neighbours. */
class Log {
  readonly agreed = new Set<number>();
  readonly stuck = new Set<number>();
  /** The scenario of the trial that goes on, and its number of neighbours; none if it does not count. */
  private table: Table | null = null;
  private degree: number | null = null;

  /** Notes what a moment shows. A trial counts if the values were apart when it began and nobody's neighbours changed since. */
  note(moment: Moment): void {
    const degree = moment.degreeMin();
    if (moment.table !== this.table) {
      this.table = moment.table;
      this.degree = moment.spread() > 50 && moment.liars.size <= moment.facts.faults ? degree : null;
    }
    if (degree !== this.degree) this.degree = null;
    if (this.degree === null) return;
    if (moment.spread() < 1) this.agreed.add(degree);
    else if (moment.tick / moment.facts.ticks_per_round >= ROUNDS && moment.spread() > 50) this.stuck.add(degree);
  }
}

export function mount(section: HTMLElement, simulator: Simulator): [Stage, Board<Stage>] {
  const stage = new Stage(simulator, TWO);
  const board = new Board(stage, {
    look: () => ({ values: [-500, 500], marksShort: false, marksSets: false, half_m: 1.7 }),
    banner,
    charts: [VALUES],
    moves: true,
    label: "Eleven robots in two camps that agree by W-MSR",
  });
  const metres = (gap: number) => `${gap.toFixed(2)} m`;
  const gap = slider("Gap between the camps", { min: 1.6, max: 3.2, step: 0.02, value: GAP_M }, metres, (gap_m) => {
    fresh(stage, gap_m);
    stage.play(true);
  });
  const again = h("button", { type: "button", onclick: () => (fresh(stage, Number(gap.input.value)), stage.play(true)) }, "Try again with fresh values");
  const log = new Log();
  const cells = Array.from({ length: 8 }, (_, index) => index + 3).map((degree) => ({ degree, cell: h("td", {}) }));
  const table = h(
    "table",
    { class: "log" },
    h("caption", {}, "Least number of neighbours of an honest robot, and what came of it"),
    h("tr", {}, h("th", { scope: "row" }, "neighbours"), ...cells.map(({ degree }) => h("th", { scope: "col" }, String(degree)))),
    h("tr", {}, h("th", { scope: "row" }, "outcome"), ...cells.map(({ cell }) => cell)),
  );
  board.controls.append(gap.element, again, scrolling("What came of every trial", table));
  stage.store.subscribe(() => {
    log.note(stage.moment);
    for (const { degree, cell } of cells) {
      const words = [log.agreed.has(degree) ? "✓ agree" : "", log.stuck.has(degree) ? "✗ stuck" : ""];
      say(cell, words.filter((word) => word).join(", "));
      cell.className = log.stuck.has(degree) ? "stuck" : log.agreed.has(degree) ? "agreed" : "";
    }
  });
  watch(section, stage, {
    ignore: ({ moment }) => moment.liars.size > 0 && moment.liars.size <= 2 && moment.spread() < 1 && moment.mean() < 400,
    tear: () => log.stuck.size > 0,
    find: () => log.stuck.has(6) && log.agreed.has(7),
  });
  return [stage, board];
}

/** Puts the camps at another distance, and everybody takes a fresh value. */
function fresh(stage: Stage, gap_m: number): void {
  stage.touch((table) => {
    const start = replace(table, "start", { kind: "listed", positions_m: camps(gap_m) });
    return change(replace(start, "values", { kind: "listed", values: APART }), "motion", { kind: "hold" });
  }, true);
}

function banner({ moment, isOver }: Stage): Said {
  const degree = moment.degreeMin();
  const spread = moment.spread();
  const least = `Everybody honest has ${degree} neighbours or more`;
  const liars = moment.liars.size > 2 ? ["More than two lie, and W-MSR is prepared for two here."] : [];
  if (spread < 1) return { main: `${least}; ${agreement(moment)}.`, why: liars, tone: "good" };
  const rounds = moment.tick / moment.facts.ticks_per_round;
  if (rounds >= ROUNDS || isOver) {
    return { main: `${least}; they are stuck ${spread.toFixed(0)} apart.`, why: [...liars, "Each robot throws away its two largest and its two smallest values, and with them all that it hears from the other camp."], tone: "bad" };
  }
  return { main: `${least}; ${agreement(moment)}.`, why: liars, tone: "warn" };
}
