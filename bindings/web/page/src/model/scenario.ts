// Changes of a scenario. The page keeps no other truth: what it shows is a scenario, run for a while.

import type { Moment } from "./moment";
import type { Facts } from "./simulator";
import { isTable, part, type Table, type Value } from "./toml";

/** The greatest number that a robot's value is kept at when the present becomes a start. */
const VALUE_MAX = 1e6;
/** Where the paper's motion points, m: so far that it is a direction. */
const FAR_M = 1000;

/** The table with some fields of one of its parts changed. */
export function change(table: Table, name: string, fields: Table): Table {
  return { ...table, [name]: { ...part(table, name), ...fields } };
}

/** The table with one of its parts replaced. */
export function replace(table: Table, name: string, fields: Table): Table {
  return { ...table, [name]: fields };
}

/** The scenario that starts with what is now: positions and values are listed, and lists of times begin anew. */
export function present(moment: Moment): Table {
  const { table } = moment;
  const robots = moment.all();
  const value = (robot: number) => Math.max(-VALUE_MAX, Math.min(VALUE_MAX, moment.value(robot)));
  const started = replace(
    replace(table, "start", { kind: "listed", positions_m: robots.map((robot) => [moment.x(robot), moment.y(robot)]) }),
    "values",
    { kind: "listed", values: robots.map(value) },
  );
  return later(ranked(started, moment.facts), moment.tick * moment.facts.tick_s);
}

/** The scenario with the ranks that its start gave, so that they stay those of the robots wherever they are now. */
function ranked(table: Table, { ranks }: Facts): Table {
  const told = part(table, "team")["ranks"];
  // A list has no words beside it.
  const more = isTable(told) && told["listen"] !== undefined;
  return ranks && !more ? change(table, "team", { ranks }) : table;
}

/** The scenario with ranks, a core of 3F + 1 chosen from the start, or without. */
export function withRanks(table: Table, on: boolean): Table {
  const { ranks: _ranks, ...team } = part(table, "team");
  const core = Math.min(3 * Number(team["faults"] ?? 2) + 1, Number(team["robots"] ?? 11));
  return replace(table, "team", on ? { ...team, ranks: { core } } : team);
}

/** The scenario in which robots that are listed with times are as far on their way as after `elapsed_s`. */
function later(table: Table, elapsed_s: number): Table {
  const motion = part(table, "motion");
  const kind = motion["kind"];
  const rows = typeof kind === "string" ? motion[kind] : undefined;
  if ((kind !== "waypoints" && kind !== "velocities") || !Array.isArray(rows)) return table;
  const shifted = rows.map((row) => {
    const [robot = 1, time = 0, ...vector] = row as number[];
    return [robot, time - elapsed_s, ...vector];
  });
  // Of the rows that are past only the last one of each robot still counts: it is held, or just reached.
  const past = (row: Value[], index: number) =>
    shifted.some((next, place) => place > index && next[0] === row[0] && (next[1] as number) <= 0);
  const left = shifted.filter((row, index) => !past(row, index));
  const now = left.map(([robot = 1, time = 0, ...vector]) => [robot, Math.max(0, time as number), ...vector]);
  return change(table, "motion", { [kind]: now });
}

/** The positions of robots, some of them moved. */
export function placed(moment: Moment, robot: number, x_m: number, y_m: number): Table {
  const positions = moment.all().map((other) => (other === robot ? [x_m, y_m] : [moment.x(other), moment.y(other)]));
  return change(present(moment), "start", { positions_m: positions });
}

/** The scenario in which one robot goes to a point, and the others go on as they did. */
export function sentTo(table: Table, facts: Facts, robot: number, x_m: number, y_m: number): Table {
  const goals = goalsOf(table, facts).filter(([other]) => other !== robot);
  return replace(table, "motion", { kind: "goals", goals: [...goals, [robot, x_m, y_m]], speed_m_s: 1 });
}

/** Where robots go, as goals. Who wanders or has a timetable stays. */
function goalsOf(table: Table, facts: Facts): number[][] {
  const motion = part(table, "motion");
  const goals = motion["goals"];
  const robots = Array.from({ length: facts.robots }, (_, index) => index + 1);
  switch (motion["kind"] ?? "paper") {
    case "goals":
      return Array.isArray(goals) ? (goals as number[][]) : [];
    case "gather":
      return robots.map((robot) => [robot, 0, 0]);
    case "paper":
      return robots.map((robot) => {
        const far = robot % 2 === 0 ? FAR_M : -FAR_M;
        return robot > Math.floor(facts.robots / 2) ? [robot, 0, far] : [robot, far, 0];
      });
    default:
      return [];
  }
}

/** The scenario in which other robots lie. */
export function withLiars(table: Table, malicious: number[]): Table {
  return change(table, "team", { malicious: [...malicious].sort((one, other) => one - other) });
}

/** Another team: it starts anew, as teams of its size do. */
export function withRobots(table: Table, robots: number): Table {
  const team = part(table, "team");
  const faults = Math.min(Number(team["faults"] ?? 2), Math.floor((robots - 1) / 2));
  const listed = team["malicious"];
  const malicious = Array.isArray(listed) ? (listed as number[]).filter((robot) => robot <= robots) : [];
  const { values: _values, link: _link, ...rest } = table;
  const goals = part(table, "motion")["goals"];
  const left = Array.isArray(goals) ? (goals as number[][]).filter(([robot = 1]) => robot <= robots) : [];
  const moved = goals === undefined ? rest : left.length > 0 ? change(rest, "motion", { goals: left }) : replace(rest, "motion", { kind: "hold" });
  const named = change(moved, "team", { robots, faults, malicious });
  const changed = team["ranks"] === undefined ? named : withRanks(named, true);
  return replace(changed, "start", { kind: "hexagon", spacing_m: 0.6 });
}

/** A lie as readers know it. */
export interface Lie {
  id: string;
  name: string;
  about: string;
  attack: Table;
}

const anything: Table = { kind: "random", min: -500, max: 500 };

/** Lies of the sandbox. Each also lies about values. */
export const LIES: Lie[] = [
  { id: "value", name: "about values only", about: "any number as its value, a new one in every round", attack: { level: { kind: "none" }, value: anything } },
  { id: "constant", name: "always 500", about: "500 as its value, again and again", attack: { level: { kind: "none" }, value: { kind: "constant", value: 500 } } },
  { id: "understate", name: "understates", about: "that it has too few neighbours, 2.5 less than it has", attack: { level: { kind: "bias", bias: -2.5 }, value: anything } },
  { id: "overstate", name: "overstates", about: "that it has neighbours to spare, 3.5 more than it has", attack: { level: { kind: "bias", bias: 3.5 }, value: anything } },
  { id: "swing", name: "swings", about: "now too many neighbours, now too few", attack: { level: { kind: "sine", amplitude: 5, period_s: 0.9 }, value: anything } },
  { id: "faces", name: "has many faces", about: "something else to every neighbour, of its level and of its value", attack: { level: { kind: "faces", min: -20, max: 20 }, value: { kind: "faces", min: -500, max: 500 } } },
  { id: "silent", name: "says nothing", about: "nothing at all", attack: { level: { kind: "silent" }, value: { kind: "silent" } } },
  { id: "flees", name: "runs away", about: "any value, while it runs away as fast as it can", attack: { level: { kind: "none" }, value: anything, motion: "flee" } },
];

/** The lie of a scenario, if it is one of the list. */
export function lieOf(table: Table): Lie | undefined {
  const attack = part(table, "attack");
  const plain = JSON.stringify(sorted({ level: { kind: "none" }, value: anything, ...attack }));
  return LIES.find((lie) => JSON.stringify(sorted(lie.attack)) === plain);
}

function sorted(value: Value): Value {
  if (Array.isArray(value)) return value.map(sorted);
  if (!isTable(value)) return value;
  const entries = Object.entries(value).sort(([one], [other]) => (one < other ? -1 : 1));
  return Object.fromEntries(entries.map(([key, inner]) => [key, sorted(inner)]));
}
