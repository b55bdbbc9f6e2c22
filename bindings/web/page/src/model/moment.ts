// One moment of a run, as it is drawn: the numbers of the simulator's last tick with their names.

import type { Facts } from "./simulator";
import type { Table } from "./toml";

export const OUTCOMES = ["free", "active", "infeasible", "recovering"] as const;

export class Moment {
  /** Robots that lie. */
  readonly liars: ReadonlySet<number>;

  constructor(
    /** Time since the page began to show this team, s. */
    readonly time_s: number,
    readonly numbers: Float64Array,
    readonly facts: Facts,
    /** The scenario that was run. */
    readonly table: Table,
  ) {
    this.liars = new Set(facts.malicious);
  }

  get robots(): number {
    return this.facts.robots;
  }

  /** Ticks since the last touch. */
  get tick(): number {
    return (this.numbers[0] ?? 1) - 1;
  }

  x(robot: number): number {
    return this.of(robot, 0);
  }

  y(robot: number): number {
    return this.of(robot, 1);
  }

  /** Neighbours that count for a robot: all without ranks, those of lower rank with them. */
  degree(robot: number): number {
    return this.of(robot, 4);
  }

  /** How many of them it needs. */
  required(robot: number): number {
    return this.facts.needs?.[robot - 1] ?? this.facts.required;
  }

  /** Its rank; null without ranks. */
  rank(robot: number): number | null {
    return this.facts.ranks?.[robot - 1] ?? null;
  }

  /** Most liars that are in range of one robot that does not lie. */
  liarsAroundOne(): number {
    const around = (robot: number) => [...this.liars].filter((liar) => this.distance(robot, liar) <= this.facts.radius_m).length;
    return Math.max(0, ...this.normal().map(around));
  }

  h(robot: number): number {
    return this.of(robot, 7);
  }

  value(robot: number): number {
    return this.of(robot, 8);
  }

  outcome(robot: number): (typeof OUTCOMES)[number] {
    return OUTCOMES[this.of(robot, 9)] ?? "free";
  }

  isLiar(robot: number): boolean {
    return this.liars.has(robot);
  }

  distance(one: number, other: number): number {
    return Math.hypot(this.x(one) - this.x(other), this.y(one) - this.y(other));
  }

  /** Robot numbers, from 1. */
  all(): number[] {
    return Array.from({ length: this.robots }, (_, index) => index + 1);
  }

  /** Robots that do not lie. */
  normal(): number[] {
    return this.all().filter((robot) => !this.isLiar(robot));
  }

  /** Least number of neighbours of a robot that does not lie. */
  degreeMin(): number {
    return Math.min(...this.normal().map((robot) => this.degree(robot)));
  }

  /** Greatest minus least value of robots that do not lie. */
  spread(): number {
    const values = this.normal().map((robot) => this.value(robot));
    return values.length > 0 ? Math.max(...values) - Math.min(...values) : 0;
  }

  /** Mean value of robots that do not lie. */
  mean(): number {
    const values = this.normal().map((robot) => this.value(robot));
    return values.reduce((sum, value) => sum + value, 0) / Math.max(values.length, 1);
  }

  private of(robot: number, field: number): number {
    const { head, fields } = this.facts;
    return this.numbers[head + fields * (robot - 1) + field] ?? Number.NaN;
  }
}
