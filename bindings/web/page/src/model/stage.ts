// A team on its stage: a scenario that is run, what was seen of it, and what a reader does to it.
//
// One rule makes every run repeatable: a touch turns the present into the start of a new scenario. So what is shown is always a
// scenario, run for so many ticks, and its digest is that of the command line. Only while a hand holds a moving robot is it not.

import { Moment } from "./moment";
import type { Scene, State } from "./scene";
import { placed, present, sentTo } from "./scenario";
import { Refused, type Simulator, type World } from "./simulator";
import { write, type Table } from "./toml";
import { Store } from "./store";

/** Moments that are kept to scrub back through. */
export const MOMENTS_MAX = 3000;
/** Time between two of them, s. */
const BETWEEN_S = 0.02;
/** Moments of a run that is computed at once. */
const RUN_MOMENTS = 500;
/** Nodes that the search for robustness may visit at a time. */
const NODES = 3000;

/** The state before there is anything to see. */
export function resting(speed: number): State {
  return {
    moments: [],
    cursor: 0,
    playing: false,
    speed,
    chosen: 1,
    hand: null,
    inHand: false,
    report: null,
    network: null,
    refused: "",
    touches: 0,
  };
}

export class Stage implements Scene {
  readonly store: Store<State>;
  private world: World | null = null;
  /** Page time at which the present scenario began, s. */
  private began_s = 0;
  private due_s = 0;
  private searched = "";
  /** The moment that was looked at last; null if it was one of the past. */
  private looked: Moment | null = null;

  constructor(
    readonly simulator: Simulator,
    private initial: Table,
    speed = 1,
  ) {
    this.store = new Store<State>(resting(speed));
    this.restart();
  }

  /** The moment that is shown. */
  get moment(): Moment {
    const { moments, cursor } = this.store.state;
    const moment = moments[Math.min(cursor, moments.length - 1)];
    if (!moment) throw new Error("a stage has a moment from its beginning on");
    return moment;
  }

  get table(): Table {
    return this.moment.table;
  }

  /** True if what is shown is the newest moment. */
  get isLive(): boolean {
    return this.store.state.cursor >= this.store.state.moments.length - 1;
  }

  /** True if the scenario has no more ticks. */
  get isOver(): boolean {
    return this.isLive && this.moment.tick >= this.moment.facts.ticks;
  }

  /** The digest of what was run, if some scenario has this run. */
  get digest(): string | null {
    return this.store.state.inHand || !this.isLive ? null : (this.world?.digest() ?? null);
  }

  /** Back to the scenario that the stage began with. */
  restart(): void {
    this.began_s = 0;
    this.store.set({ moments: [], cursor: 0 });
    this.open(this.initial);
  }

  /** Begins with another scenario; true if it can be run. */
  begin(table: Table): boolean {
    const before = this.store.state.moments;
    this.began_s = 0;
    this.store.set({ moments: [], cursor: 0 });
    if (!this.open(table)) {
      this.store.set({ moments: before, cursor: before.length - 1 });
      return false;
    }
    this.initial = table;
    return true;
  }

  /**
   * Changes the scenario from the moment that is shown on. What was seen after it is forgotten. With `fresh` the changed scenario
   * starts where it says; without, it starts with what is now.
   */
  touch(change: (table: Table, moment: Moment) => Table, fresh = false): boolean {
    const { moment, store } = this;
    const untouched = moment.tick === 0 && !store.state.inHand;
    const table = change(fresh || untouched ? moment.table : present(moment), moment);
    store.set({ moments: store.state.moments.slice(0, store.state.cursor + 1), touches: store.state.touches + 1 });
    this.began_s = moment.time_s;
    return this.open(table);
  }

  /** Takes a robot: it is moved if time stands still, and drawn if it goes on. */
  hold(robot: number, x_m: number, y_m: number): void {
    if (this.store.state.playing) {
      const atOnce = this.isLive || this.touch((table) => table);
      if (atOnce) this.store.set({ hand: { robot, x_m, y_m } });
      return;
    }
    this.touch((_, moment) => placed(moment, robot, x_m, y_m));
  }

  /** Lets go: the robot then goes where it was drawn to. */
  release(): void {
    const { hand } = this.store.state;
    if (!hand) return;
    this.store.set({ hand: null });
    this.touch((table, moment) => sentTo(table, moment.facts, hand.robot, hand.x_m, hand.y_m));
  }

  play(playing = !this.store.state.playing): void {
    if (playing && this.isOver) {
      // A run that nobody touched is seen again; one that was goes on.
      if (this.table === this.initial) this.restart();
      else this.touch((table) => table);
    }
    this.due_s = 0;
    this.store.set({ playing });
  }

  /** Shows a moment of the past. */
  seek(cursor: number): void {
    this.store.set({ cursor: Math.max(0, Math.min(cursor, this.store.state.moments.length - 1)), playing: false });
  }

  /** One tick, or one moment of the past. */
  step(): void {
    this.store.set({ playing: false });
    if (!this.isLive) this.seek(this.store.state.cursor + 1);
    else this.compute(1);
  }

  /** Runs the scenario for some time at once, with moments to scrub back through. */
  run(time_s: number): void {
    let left = Math.round(time_s / this.moment.facts.tick_s);
    const some = Math.max(1, Math.round(Math.max(BETWEEN_S, time_s / RUN_MOMENTS) / this.moment.facts.tick_s));
    for (; left > 0; left -= some) this.compute(Math.min(some, left));
  }

  /** Goes on by a time of the reader's, s. */
  advance(elapsed_s: number): void {
    const { playing, speed, cursor, moments } = this.store.state;
    if (!playing) return;
    this.due_s += Math.min(elapsed_s, 0.1) * speed;
    if (!this.isLive) {
      const until = this.moment.time_s + this.due_s;
      let next = cursor;
      while (next < moments.length - 1 && (moments[next + 1]?.time_s ?? 0) <= until) next += 1;
      if (next > cursor) {
        this.due_s = Math.max(0, until - (moments[next]?.time_s ?? 0));
        this.store.set({ cursor: next });
      }
      return;
    }
    const { tick_s } = this.moment.facts;
    if (this.due_s < Math.max(BETWEEN_S * Math.min(1, speed), tick_s)) return;
    const ticks = Math.floor(this.due_s / tick_s);
    this.due_s -= ticks * tick_s;
    this.compute(ticks);
    if (this.isOver) this.store.set({ playing: false });
  }

  /** Looks at the network and the laws; several times a second is enough. */
  look(): void {
    const seen = this.isLive ? this.moment : null;
    if (seen === this.looked) return;
    this.looked = seen;
    if (!this.world || !this.isLive) {
      this.store.set({ network: null, report: null });
      return;
    }
    const { moment } = this;
    const links = `${moment.facts.malicious.join()}|${[...pairs(moment)].join("")}`;
    const network = links === this.searched ? this.store.state.network : this.world.network(NODES);
    this.searched = links;
    this.store.set({ report: this.world.report(), network });
  }

  private open(table: Table): boolean {
    try {
      const world = this.simulator.open(write(table));
      this.world?.close();
      this.world = world;
      this.searched = "";
      this.due_s = 0;
      const { chosen } = this.store.state;
      this.store.set({ inHand: false, hand: null, refused: "", chosen: Math.min(chosen, world.facts.robots) });
      this.show(table);
      this.look();
      return true;
    } catch (error) {
      if (!(error instanceof Refused) && !(error instanceof RangeError)) throw error;
      this.store.set({ refused: error.message, playing: false, hand: null });
      return false;
    }
  }

  private compute(ticks: number): void {
    if (!this.world || ticks < 1) return;
    const { hand } = this.store.state;
    if (hand) {
      this.store.set({ inHand: true });
      this.world.pull(ticks, hand.robot, hand.x_m, hand.y_m);
    } else {
      this.world.step(ticks);
    }
    this.show(this.table);
  }

  private show(table: Table): void {
    if (!this.world) return;
    const { facts } = this.world;
    const numbers = this.world.frame();
    const time_s = this.began_s + ((numbers[0] ?? 1) - 1) * facts.tick_s;
    const moments = [...this.store.state.moments, new Moment(time_s, numbers, facts, table)].slice(-MOMENTS_MAX);
    this.store.set({ moments, cursor: moments.length - 1 });
  }
}

/** One letter for each pair of robots: whether they are linked. */
function* pairs(moment: Moment): Generator<string> {
  for (let one = 1; one <= moment.robots; one += 1) {
    for (let other = 1; other < one; other += 1) {
      yield moment.distance(one, other) <= moment.facts.radius_m ? "1" : "0";
    }
  }
}
