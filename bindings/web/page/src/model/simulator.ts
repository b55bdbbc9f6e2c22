// The simulator: closeranks' own, compiled to WebAssembly. This file alone knows how its functions are called.

import type { Table } from "./toml";

export interface Problem {
  line: number;
  message: string;
}

export interface Controller {
  name: string;
  about: string;
  local: boolean;
  guarantees: boolean;
  keeps_degrees: boolean;
  /** Whether a team of it may have ranks. */
  ranks: boolean;
  /** Whether it is run where there are obstacles. */
  obstacles: boolean;
  promises: string[];
}

/** A rule of consensus, and the graphs on which it agrees. */
export interface Rule {
  name: string;
  condition: string;
  /** Whether what is promised of agreement is about it. */
  proved: boolean;
}

/** What does not change while a scenario is run. */
export interface Facts {
  name: string;
  robots: number;
  faults: number;
  /** Neighbours that every robot needs, without ranks. */
  required: number;
  /** The rank of each robot, and how many neighbours that count for it it needs; null without ranks. */
  ranks: number[] | null;
  needs: number[] | null;
  malicious: number[];
  radius_m: number;
  distance_min_m: number;
  tick_s: number;
  ticks: number;
  ticks_per_round: number;
  rule: Rule;
  controller: Controller;
  obedient: boolean;
  one_voice: boolean;
  head: number;
  fields: number;
}

export interface Verdict {
  name: string;
  demand: string;
  promised: boolean;
  broken: number;
  covered: number;
  first: { tick: number; robots: number[]; seen: number | null; demanded: number | null } | null;
}

/** Least and greatest so far, and what became of the laws. */
export interface Report {
  degree_min: number | null;
  h_min: number | null;
  distance_min_m: number | null;
  spread: number | null;
  laws: Verdict[];
}

/** How many liars the network of a moment survives, as far as it is proved. */
export interface Network {
  f_least: number;
  f_most: number;
  robust: boolean | null;
  sets: [number[], number[]] | null;
}

/** A scenario that the simulator refuses, with its reasons. */
export class Refused extends Error {
  constructor(readonly problems: Problem[]) {
    super(problems.map((problem) => `line ${problem.line}: ${problem.message}`).join("\n"));
  }
}

interface Exports {
  memory: WebAssembly.Memory;
  input(length: number): number;
  output(): number;
  about(): number;
  table(length: number): number;
  open(length: number): number;
  close(handle: number): void;
  step(handle: number, ticks: number): number;
  pull(handle: number, ticks: number, robot: number, x_m: number, y_m: number): number;
  frame(handle: number): number;
  report(handle: number): number;
  network(handle: number, nodes: number): number;
  digest(handle: number): bigint;
}

export class Simulator {
  readonly version: string;
  readonly controllers: Controller[];
  readonly rules: Rule[];

  private constructor(private readonly module: Exports) {
    const about = this.answer<{ version: string; controllers: Controller[]; rules: Rule[] }>(module.about());
    this.version = about.version;
    this.controllers = about.controllers;
    this.rules = about.rules;
  }

  static async of(bytes: BufferSource): Promise<Simulator> {
    const { instance } = await WebAssembly.instantiate(bytes, {});
    return new Simulator(instance.exports as unknown as Exports);
  }

  /** The TOML text as a table. */
  table(text: string): Table {
    const read = this.answer<{ table?: Table; problems?: Problem[] }>(this.module.table(this.write(text)));
    if (read.table) return read.table;
    throw new Refused(read.problems ?? []);
  }

  /** A world for a scenario, with its first tick computed. It must be closed. */
  open(text: string): World {
    type Opened = { handle?: number; facts?: Facts; problems?: Problem[] };
    const opened = this.answer<Opened>(this.module.open(this.write(text)));
    if (opened.handle === undefined || !opened.facts) throw new Refused(opened.problems ?? []);
    return new World(this, this.module, opened.handle, opened.facts);
  }

  /** The answer of so many bytes that the last call left. */
  answer<Answer>(length: number): Answer {
    const bytes = new Uint8Array(this.module.memory.buffer, this.module.output(), length);
    return JSON.parse(new TextDecoder().decode(bytes)) as Answer;
  }

  private write(text: string): number {
    const bytes = new TextEncoder().encode(text);
    const address = this.module.input(bytes.length);
    if (address === 0) {
      throw new Refused([{ line: 1, message: `a scenario of ${bytes.length} bytes is too long` }]);
    }
    new Uint8Array(this.module.memory.buffer, address, bytes.length).set(bytes);
    return bytes.length;
  }
}

export class World {
  constructor(
    private readonly simulator: Simulator,
    private readonly module: Exports,
    private readonly handle: number,
    readonly facts: Facts,
  ) {}

  /** Computes up to so many ticks more; gives how many were computed since the start. */
  step(ticks: number): number {
    return this.module.step(this.handle, ticks);
  }

  /** The same while one robot is drawn towards a point. */
  pull(ticks: number, robot: number, x_m: number, y_m: number): number {
    return this.module.pull(this.handle, ticks, robot, x_m, y_m);
  }

  /** A copy of the last tick. */
  frame(): Float64Array {
    const { head, fields, robots } = this.facts;
    const address = this.module.frame(this.handle);
    return new Float64Array(this.module.memory.buffer, address, head + fields * robots).slice();
  }

  report(): Report {
    return this.simulator.answer(this.module.report(this.handle));
  }

  /** What a search of so many nodes finds; null for teams that are too large for it. */
  network(nodes: number): Network | null {
    return this.simulator.answer(this.module.network(this.handle, nodes));
  }

  digest(): string {
    return BigInt.asUintN(64, this.module.digest(this.handle)).toString(16).padStart(16, "0");
  }

  close(): void {
    this.module.close(this.handle);
  }
}
