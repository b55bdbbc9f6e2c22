// Pictures of the article for who has no scripts. They are drawn when the page is built, by the same simulator.

import { ONE } from "./acts/one";
import { THREE } from "./acts/three";
import { TWO } from "./acts/two";
import { Moment } from "./model/moment";
import { change, LIES, replace } from "./model/scenario";
import type { Simulator } from "./model/simulator";
import { write, type Table } from "./model/toml";
import { words } from "./view/words";
import { LIAR, LINE, LINK, SHORT, SOFT, TEAM, valueColour } from "./view/colours";

/** Moments of a run that a picture shows. */
const MOMENTS = 60;

function run(simulator: Simulator, table: Table, time_s: number): Moment[] {
  const world = simulator.open(write(table));
  const { tick_s } = world.facts;
  const moments = [new Moment(0, world.frame(), world.facts, table)];
  const every = Math.max(1, Math.round(time_s / tick_s / MOMENTS));
  for (let tick = every; tick * tick_s <= time_s; tick += every) {
    world.step(every);
    moments.push(new Moment(tick * tick_s, world.frame(), world.facts, table));
  }
  world.close();
  return moments;
}

/** The team at a moment. */
function formation(moment: Moment, title: string, half_m: number): string {
  const size = 300;
  const scale = (size - 50) / (2 * half_m);
  const x = (robot: number) => size / 2 + scale * moment.x(robot);
  const y = (robot: number) => size / 2 - scale * moment.y(robot);
  const parts: string[] = [];
  for (const one of moment.all()) {
    for (const other of moment.all()) {
      if (other >= one || moment.distance(one, other) > moment.facts.radius_m) continue;
      parts.push(`<path d="M${at(x(one))} ${at(y(one))}L${at(x(other))} ${at(y(other))}" stroke="${LINK}" stroke-opacity=".6"/>`);
    }
  }
  for (const robot of moment.all()) {
    const { fill, ink } = valueColour(moment.value(robot), -500, 500);
    const [cx, cy] = [x(robot), y(robot)];
    const short = moment.degree(robot) < moment.required(robot) && !moment.isLiar(robot) && moment.facts.faults > 0;
    if (short) parts.push(`<circle cx="${at(cx)}" cy="${at(cy)}" r="17" fill="none" stroke="${SHORT}" stroke-width="2.5" stroke-dasharray="5 3"/>`);
    const edge = `fill="${fill}" stroke="${moment.isLiar(robot) ? LIAR : "#ffffff"}" stroke-width="${moment.isLiar(robot) ? 4 : 2}"`;
    parts.push(
      moment.isLiar(robot)
        ? `<rect x="${at(cx - 12)}" y="${at(cy - 12)}" width="24" height="24" ${edge}/>`
        : `<circle cx="${at(cx)}" cy="${at(cy)}" r="12" ${edge}/>`,
      `<text x="${at(cx)}" y="${at(cy + 4)}" text-anchor="middle" font-size="11" font-weight="600" fill="${ink}">${robot}</text>`,
    );
  }
  return svg(size, size, title, parts);
}

/** The values of all robots over time. */
function values(moments: Moment[], title: string): string {
  const [width, height, left] = [420, 300, 44];
  const end = moments[moments.length - 1]?.time_s ?? 1;
  const x = (time_s: number) => left + ((width - left - 12) * time_s) / end;
  const y = (value: number) => height / 2 - ((height - 60) / 1100) * Math.max(-550, Math.min(550, value));
  const parts = [-500, 0, 500].map(
    (value) => `<path d="M${left} ${at(y(value))}H${width - 12}" stroke="${LINE}"/><text x="${left - 6}" y="${at(y(value) + 4)}" text-anchor="end" font-size="11" fill="${SOFT}">${value}</text>`,
  );
  parts.push(`<text x="${width - 12}" y="${height - 10}" text-anchor="end" font-size="11" fill="${SOFT}">${end.toFixed(0)} s</text>`);
  const robots = moments[0]?.all() ?? [];
  for (const robot of robots) {
    const points = moments.map((moment, index) => `${index === 0 ? "M" : "L"}${at(x(moment.time_s))} ${at(y(moment.value(robot)))}`);
    const liar = moments[0]?.isLiar(robot);
    parts.push(`<path d="${points.join("")}" fill="none" stroke="${liar ? LIAR : TEAM}" stroke-width="1.5"/>`);
  }
  return svg(width, height, title, parts);
}

function at(number: number): string {
  return String(Math.round(10 * number) / 10);
}

function svg(width: number, height: number, title: string, parts: string[]): string {
  const font = `font-family="system-ui, sans-serif"`;
  return `<svg viewBox="0 0 ${width} ${height}" width="${width}" height="${height}" role="img" aria-label="${title}" ${font}>${parts.join("")}</svg>`;
}

function figure(pictures: string[], caption: string): string {
  const pairs = pictures.length === 4 ? ' class="pairs"' : "";
  return `<figure class="still"><div${pairs}>${pictures.join("")}</div><figcaption>${caption}</figcaption></figure>`;
}

function last(moments: Moment[]): Moment {
  const moment = moments[moments.length - 1];
  if (!moment) throw new Error("a run has moments");
  return moment;
}

/** The picture of each act, by its name. */
export function stills(simulator: Simulator): Record<string, string> {
  const lying = run(simulator, change(ONE, "team", { malicious: [3] }), 12);
  const honest = run(simulator, ONE, 12);
  const gap = (metres: number) => {
    const positions = (TWO["start"] as Table)["positions_m"] as number[][];
    const half = metres / 2;
    return run(simulator, replace(TWO, "start", { kind: "listed", positions_m: positions.map(([x = 0, y = 0]) => [Math.sign(x) * half, y]) }), 6);
  };
  const [near, far] = [gap(2.8), gap(2.94)];
  const pull = (kind: string, lie: string) =>
    run(simulator, replace(replace(THREE, "controller", { kind }), "attack", LIES.find((one) => one.id === lie)?.attack ?? {}), 10);
  const [free, kept] = [pull("none", "value"), pull("budget", "faces")];
  const spread = (moments: Moment[]) => last(moments).spread().toFixed(0);
  return {
    "act-1": figure(
      [formation(last(lying), "The team after twelve seconds: robot 3 lies", 1.1), values(honest, "Values if nobody lies: all meet"), values(lying, "Values if robot 3 lies: all follow it")],
      `Left: the team. Middle: if nobody lies, the values meet at ${words(last(honest).mean())}. Right: robot 3 says 500 and nothing else, and after twelve seconds the others stand at ${words(last(lying).mean())} in the mean.`,
    ),
    "act-2": figure(
      [formation(last(near), "Two camps with seven neighbours each", 1.75), values(near, "They agree"), formation(last(far), "Two camps with six neighbours each", 1.75), values(far, "They are stuck")],
      `Above: everybody has ${last(near).degreeMin()} neighbours or more, and they agree. Below: the camps stand a little farther apart, somebody has only ${last(far).degreeMin()}, and they stay ${spread(far)} apart for ever. Nobody lies in either.`,
    ),
    "act-3": figure(
      [formation(last(free), "Without a filter the team is torn apart", 10.5), formation(last(kept), "With the filter the team stays together", 2.6)],
      `Ten seconds of pulling four ways. Left, without a filter: the least number of neighbours is ${last(free).degreeMin()}. Right, with <em>budget</em>, while both liars tell every neighbour something else: it is ${last(kept).degreeMin()}. The scales differ.`,
    ),
    "act-4": figure([formation(kept[0] ?? last(kept), "A team of eleven", 1.3)], "With scripts, this team is yours to play with."),
  };
}
