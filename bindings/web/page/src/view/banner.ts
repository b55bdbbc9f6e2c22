// What holds and what does not, and why, in words. Pure: a moment and what the simulator says of it become sentences.

import type { Moment } from "../model/moment";
import type { Network, Report } from "../model/simulator";
import { capital, named, words } from "./words";

export interface Said {
  /** One sentence for everybody, also read aloud. */
  main: string;
  /** Sentences that say why. */
  why: string[];
  tone: "good" | "warn" | "bad";
}

/** Whether the honest agree, in a sentence. */
export function agreement(moment: Moment): string {
  const spread = moment.spread();
  if (spread < 1) return `the honest agree on ${words(moment.mean())}`;
  return `the honest are still ${spread < 10 ? spread.toFixed(1) : spread.toFixed(0)} apart`;
}

/** The banner of a team that must keep its neighbours. */
export function safety(moment: Moment, report: Report | null, network: Network | null): Said {
  const { required, faults, controller, distance_min_m } = moment.facts;
  const short = moment.normal().filter((robot) => moment.degree(robot) < required);
  const edge = moment.normal().filter((robot) => moment.degree(robot) === required);
  const close = closest(moment);
  const why: string[] = [];
  const tooMany = moment.liars.size > faults;
  if (tooMany) {
    why.push(`${moment.liars.size} robots lie, and the team is prepared for ${faults}: nothing is promised.`);
  }
  const collides = close.distance_m < distance_min_m - 1e-9;
  const collision = `${named(close.robots)} are ${close.distance_m.toFixed(3)} m apart, and ${distance_min_m} m is the least that is safe`;
  why.push(survival(network, faults));
  const broken = report?.laws.filter((law) => law.promised && law.broken > 0 && law.name !== "distance" && law.name !== "degree") ?? [];
  for (const law of broken.slice(0, 2)) {
    why.push(`Since the last touch this was broken: ${law.demand}${where(law.first, moment)}.`);
  }
  const main = (text: string) => capital(`${text}; ${agreement(moment)}.`);
  if (short.length === 0 && collides) return { main: main(collision), why, tone: "bad" };
  if (short.length > 0) {
    if (collides) why.unshift(`${capital(collision)}.`);
    const worst = Math.min(...short.map((robot) => moment.degree(robot)));
    const robots = short.filter((robot) => moment.degree(robot) === worst);
    const has = robots.length === 1 ? "has" : "have";
    return { main: main(`${named(robots)} ${has} only ${worst} neighbours and ${robots.length === 1 ? "needs" : "need"} ${required}`), why, tone: "bad" };
  }
  if (edge.length > 0) {
    const is = edge.length === 1 ? "is" : "are";
    const rest = controller.keeps_degrees ? "nobody near may leave" : "nothing keeps them there";
    return { main: main(`${named(edge)} ${is} down to ${required} neighbours: ${rest}`), why, tone: tooMany ? "bad" : "warn" };
  }
  const good = `everybody honest has the ${required} neighbours that F = ${faults} asks for, or more`;
  return { main: main(good), why, tone: tooMany ? "bad" : "good" };
}

function survival(network: Network | null, faults: number): string {
  if (!network) return "";
  const { f_least, f_most, robust } = network;
  if (faults === 0 && robust) return "The network is in one piece: it agrees if nobody lies.";
  const survives = f_least === f_most ? `exactly ${count(f_least)}` : `at least ${count(f_least)}`;
  if (f_least < 0 && f_most < 0) return "The network is torn: it need not agree even if nobody lies.";
  if (robust === false) {
    return `Searched exactly, this network survives ${survives}, not ${faults}: the robots marked A and B might never agree.`;
  }
  if (robust === null) return `This network is proved to survive ${survives}; the search for more was cut short.`;
  return `Searched exactly, this network survives any ${count(faults)}.`;
}

function count(liars: number): string {
  if (liars <= 0) return "no liar";
  return liars === 1 ? "1 liar" : `${liars} liars`;
}

function where(first: { tick: number; robots: number[] } | null, moment: Moment): string {
  if (!first) return "";
  const who = first.robots.length > 0 ? `, ${named(first.robots)}` : "";
  return `, first ${(first.tick * moment.facts.tick_s).toFixed(2)} s after it${who}`;
}

/** The two robots that are closest to each other. */
export function closest(moment: Moment): { robots: number[]; distance_m: number } {
  let found = { robots: [1, 2], distance_m: Number.POSITIVE_INFINITY };
  for (let one = 1; one <= moment.robots; one += 1) {
    for (let other = 1; other < one; other += 1) {
      const distance_m = moment.distance(one, other);
      if (distance_m < found.distance_m) found = { robots: [other, one], distance_m };
    }
  }
  return found;
}
