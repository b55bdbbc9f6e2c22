// A run that the page does not compute: moments that come as lines of JSON, all at once from a recording or one by one from a live source.
// It is looked at and not touched.

import { Moment } from "./moment";
import type { Scene, State } from "./scene";
import type { Facts, Simulator } from "./simulator";
import { MOMENTS_MAX, resting } from "./stage";
import { Store } from "./store";
import type { Table } from "./toml";

/** Columns of a line, and their places among the numbers of a robot. */
const COLUMNS = { x_m: 0, y_m: 1, degree: 4, level: 5, h: 7, value: 8 } as const;

export class Replay implements Scene {
  readonly store: Store<State>;
  /** True once no more moments will come. */
  over = false;
  private due_s = 0;

  private constructor(
    readonly facts: Facts,
    readonly table: Table,
    first: Moment,
  ) {
    this.store = new Store<State>({ ...resting(1), moments: [first] });
  }

  /**
   * Reads lines until there is a moment to show; goes on reading after that, and says with `ended` why it stopped, or null at the end.
   */
  static async of(simulator: Simulator, lines: AsyncGenerator<string[]>, ended: (why: string | null) => void): Promise<Replay> {
    const waiting: string[] = [];
    while (waiting.length < 2) {
      const next = await lines.next();
      if (next.done) throw new Error("the run has no moment");
      waiting.push(...next.value);
    }
    const { scenario } = JSON.parse(waiting[0] ?? "") as { scenario: unknown };
    if (typeof scenario !== "string") throw new Error("the run does not say its scenario");
    const world = simulator.open(scenario);
    const { facts } = world;
    world.close();
    const table = simulator.table(scenario);
    const moments = waiting.slice(1).map((line) => read(line, facts, table));
    const [first, ...rest] = moments;
    if (!first) throw new Error("the run has no moment");
    const replay = new Replay(facts, table, first);
    replay.add(rest);
    void replay.follow(lines, ended);
    return replay;
  }

  get moment(): Moment {
    const { moments, cursor } = this.store.state;
    const moment = moments[Math.min(cursor, moments.length - 1)];
    if (!moment) throw new Error("a replay has a moment from its beginning on");
    return moment;
  }

  get isLive(): boolean {
    return this.store.state.cursor >= this.store.state.moments.length - 1;
  }

  restart(): void {
    this.seek(0);
  }

  play(playing = !this.store.state.playing): void {
    if (playing && this.isLive && this.over) this.seek(0);
    this.due_s = 0;
    this.store.set({ playing });
  }

  seek(cursor: number): void {
    this.store.set({ cursor: Math.max(0, Math.min(cursor, this.store.state.moments.length - 1)), playing: false });
  }

  step(): void {
    this.seek(this.store.state.cursor + 1);
  }

  advance(elapsed_s: number): void {
    const { playing, speed, cursor, moments } = this.store.state;
    if (!playing) return;
    this.due_s += Math.min(elapsed_s, 0.1) * speed;
    const until = this.moment.time_s + this.due_s;
    let next = cursor;
    while (next < moments.length - 1 && (moments[next + 1]?.time_s ?? 0) <= until) next += 1;
    if (next > cursor) {
      this.due_s = Math.max(0, until - (moments[next]?.time_s ?? 0));
      this.store.set({ cursor: next });
    }
    if (this.isLive && this.over) this.store.set({ playing: false });
  }

  /** Nothing is searched or judged here: that was done where the run was computed. */
  look(): void {}

  private async follow(lines: AsyncGenerator<string[]>, ended: (why: string | null) => void): Promise<void> {
    let why: string | null = null;
    try {
      for await (const some of lines) this.add(some.map((line) => read(line, this.facts, this.table)));
    } catch (error) {
      why = error instanceof Error ? error.message : String(error);
    }
    this.over = true;
    ended(why);
    this.store.set({});
  }

  /** Adds moments. Who looks at the newest one goes on doing so. */
  private add(more: Moment[]): void {
    if (more.length === 0) return;
    const { moments, cursor, playing } = this.store.state;
    const atEnd = playing && this.isLive && moments.length > 1;
    const all = [...moments, ...more];
    const gone = Math.max(0, all.length - MOMENTS_MAX);
    const kept = all.slice(gone);
    this.store.set({ moments: kept, cursor: atEnd ? kept.length - 1 : Math.max(0, cursor - gone) });
  }
}

/** The moment of a line. */
function read(line: string, facts: Facts, table: Table): Moment {
  const said = JSON.parse(line) as Record<string, unknown>;
  const { head, fields, robots, tick_s } = facts;
  const tick = said["tick"];
  if (typeof tick !== "number") throw new Error("a moment does not say its tick");
  const numbers = new Float64Array(head + fields * robots).fill(Number.NaN);
  numbers[0] = tick + 1;
  for (const [name, place] of Object.entries(COLUMNS)) {
    const column = said[name];
    if (!Array.isArray(column) || column.length !== robots) throw new Error(`a moment lacks ${name} of ${robots} robots`);
    column.forEach((number: unknown, index) => {
      numbers[head + fields * index + place] = typeof number === "number" ? number : Number.NaN;
    });
  }
  return new Moment(tick * tick_s, numbers, facts, table);
}

/** The lines of a response, as many at a time as have come. */
export async function* lines(response: Response): AsyncGenerator<string[]> {
  if (!response.body) return;
  const reader = response.body.getReader();
  const decoder = new TextDecoder();
  let rest = "";
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    const all = (rest + decoder.decode(value, { stream: true })).split("\n");
    rest = all.pop() ?? "";
    if (all.length > 0) yield all.filter((line) => line !== "");
  }
  if (rest !== "") yield [rest];
}
