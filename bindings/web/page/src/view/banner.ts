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
  const { faults, controller, distance_min_m } = moment.facts;
  const short = moment.normal().filter((robot) => moment.degree(robot) < moment.required(robot));
  const edge = moment.normal().filter((robot) => moment.degree(robot) === moment.required(robot));
  const close = closest(moment);
  const why: string[] = [];
  const tooMany = liarsThatCount(moment) > faults;
  if (tooMany) why.push(unprepared(moment));
  const collides = close.distance_m < distance_min_m - 1e-9;
  const collision = `${named(close.robots)} are ${close.distance_m.toFixed(3)} m apart, and ${distance_min_m} m is the least that is safe`;
  why.push(agreeing(moment, network, short.length === 0));
  const broken = report?.laws.filter((law) => law.promised && law.broken > 0 && law.name !== "distance" && law.name !== "degree") ?? [];
  for (const law of broken.slice(0, 2)) {
    why.push(`Since the last touch this was broken: ${law.demand}${where(law.first, moment)}.`);
  }
  const main = (text: string) => capital(`${text}; ${agreement(moment)}.`);
  if (short.length === 0 && collides) return { main: main(collision), why, tone: "bad" };
  if (short.length > 0) {
    if (collides) why.unshift(`${capital(collision)}.`);
    return { main: main(shortage(moment, short)), why, tone: "bad" };
  }
  if (edge.length > 0) {
    const is = edge.length === 1 ? "is" : "are";
    const rest = controller.keeps_degrees ? "nobody near may leave" : "nothing keeps them there";
    return { main: main(`${named(edge)} ${is} down to ${moment.facts.ranks ? "as few neighbours as ranks allow" : `${moment.facts.required} neighbours`}: ${rest}`), why, tone: tooMany ? "bad" : "warn" };
  }
  const good = `everybody honest has the ${moment.facts.ranks ? "neighbours of lower rank" : `${moment.facts.required} neighbours`} that F = ${faults} asks for, or more`;
  return { main: main(good), why, tone: tooMany ? "bad" : "good" };
}

/** How many liars there are of those that the team must be prepared for: all of them, or under ranks those around one robot. */
function liarsThatCount(moment: Moment): number {
  return moment.facts.ranks ? moment.liarsAroundOne() : moment.liars.size;
}

function unprepared(moment: Moment): string {
  const liars = liarsThatCount(moment);
  const where = moment.facts.ranks ? " in range of one robot" : "";
  return `${liars} robots${where} lie, and the team is prepared for ${moment.facts.faults}: nothing is promised.`;
}

/** Who lacks most neighbours, and how many it has. */
function shortage(moment: Moment, short: number[]): string {
  const lack = (robot: number) => moment.required(robot) - moment.degree(robot);
  const most = Math.max(...short.map(lack));
  const [first = 1, ...others] = short.filter((robot) => lack(robot) === most);
  const alike = [first, ...others.filter((robot) => moment.required(robot) === moment.required(first))];
  const [has, needs] = alike.length === 1 ? ["has", "needs"] : ["have", "need"];
  const counting = moment.facts.ranks ? "neighbours that count for it" : "neighbours";
  const words = alike.length === 1 ? counting : counting.replace("it", "them");
  return `${named(alike)} ${has} only ${moment.degree(first)} ${words} and ${needs} ${moment.required(first)}`;
}

/** What the network is worth for agreement. */
function agreeing(moment: Moment, network: Network | null, enough: boolean): string {
  const { rule, ranks, faults } = moment.facts;
  if (!rule.proved) return `Robots agree by ${rule.name}, which needs ${rule.condition}: what is promised here is about W-MSR alone.`;
  return ranks ? survivalByRanks(moment, enough) : survival(network, faults);
}

function survivalByRanks(moment: Moment, enough: boolean): string {
  if (!enough) return "";
  return `Proved by ranks: this network survives any ${count(moment.facts.faults)} around each robot, however many there are in all.`;
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
