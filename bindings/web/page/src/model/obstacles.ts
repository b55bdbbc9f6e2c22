// What stands in the way of a team: read from a scenario, and some layouts that the sandbox puts around the robots.

import type { Moment } from "./moment";
import { part, type Table, type Value } from "./toml";

export interface Obstacles {
  /** Middle and radius of each disc, m. */
  discs: [number, number, number][];
  /** Both ends of each wall, m. */
  walls: [number, number, number, number][];
}

/** How near to an obstacle the robots of the sandbox may come, m. */
const CLEARANCE_M = 0.15;
/** Free space between the outermost robot and a new obstacle, m: more than a robot keeps. */
const SPACE_M = 0.6;
/** How far walls go, m. */
const LONG_M = 8;

export const LAYOUTS: [string, string][] = [
  ["none", "none"],
  ["discs", "five discs around the team"],
  ["gap", "a wall with a gap to the right"],
  ["room", "a room"],
];

/** The obstacles that a scenario lists. */
export function obstaclesOf(table: Table): Obstacles {
  const listed = part(table, "obstacles");
  const rows = (value: Value | undefined, columns: number) =>
    (Array.isArray(value) ? value : []).filter((row): row is number[] => Array.isArray(row) && row.length === columns);
  return {
    discs: rows(listed["discs"], 3) as Obstacles["discs"],
    walls: rows(listed["walls"], 4) as Obstacles["walls"],
  };
}

/** The scenario of a moment with a layout in place of its obstacles, none of which is near a robot. */
export function withObstacles(table: Table, moment: Moment, layout: string): Table {
  const { obstacles: _obstacles, ...free } = table;
  const placed = layouts(moment)[layout];
  return placed ? { ...free, obstacles: { clearance_m: CLEARANCE_M, ...placed } } : free;
}

function layouts(moment: Moment): Record<string, Table> {
  const mean = (of: (robot: number) => number) => moment.all().reduce((sum, robot) => sum + of(robot), 0) / moment.robots;
  const [x_m, y_m] = [mean((robot) => moment.x(robot)), mean((robot) => moment.y(robot))];
  const far = (robot: number) => Math.hypot(moment.x(robot) - x_m, moment.y(robot) - y_m);
  const free_m = Math.max(...moment.all().map(far)) + SPACE_M;
  const at = (right: number, up: number) => [tenth(x_m + right), tenth(y_m + up)];
  const around = (index: number) => (2 * Math.PI * index) / 5;
  const disc = (index: number) => [...at((free_m + 0.4) * Math.cos(around(index)), (free_m + 0.4) * Math.sin(around(index))), 0.4];
  const wall = (from: [number, number], to: [number, number]) => [...at(...from), ...at(...to)];
  const side_m = free_m + 0.4;
  return {
    discs: { discs: [0, 1, 2, 3, 4].map(disc) },
    gap: { walls: [wall([free_m, 0.5], [free_m, LONG_M]), wall([free_m, -LONG_M], [free_m, -0.5])] },
    room: {
      walls: [
        wall([-side_m, -side_m], [side_m, -side_m]),
        wall([side_m, -side_m], [side_m, side_m]),
        wall([side_m, side_m], [-side_m, side_m]),
        wall([-side_m, side_m], [-side_m, -side_m]),
      ],
    },
  };
}

/** Rounded to a tenth, so that a saved file can be read. */
function tenth(length_m: number): number {
  return Math.round(10 * length_m) / 10;
}
