// Act 4: the sandbox. Everything that the page knows, for one team, to share as a link or as a scenario file.

import { pack } from "../model/link";
import { LAYOUTS, obstaclesOf, withObstacles } from "../model/obstacles";
import { change, lieOf, LIES, replace, withRanks, withRobots } from "../model/scenario";
import type { Simulator } from "../model/simulator";
import { Stage } from "../model/stage";
import { part, write, type Table, type Value } from "../model/toml";
import { safety } from "../view/banner";
import { Board } from "../view/board";
import { MARGINS, VALUES } from "../view/charts";
import { h, menu, say, slider } from "../view/dom";
import { watch } from "../view/tasks";

export const FOUR: Table = {
  name: "sandbox",
  duration_s: 20,
  team: { robots: 11, faults: 2, malicious: [1] },
  controller: { kind: "budget" },
  clock: { tau_1_s: 0.02 },
  motion: { kind: "hold" },
};

const MOTIONS: [string, string][] = [
  ["hold", "stay"],
  ["paper", "pull four ways"],
  ["gather", "all to the middle"],
  ["outward", "go outwards"],
  ["wander", "wander"],
  ["goals", "where they were dragged"],
];

const STARTS: [string, string][] = [
  ["inside", "eleven, inside the safe set"],
  ["published", "eleven, from the paper's figure"],
  ["hexagon", "a patch of hexagons"],
  ["random", "by chance"],
  ["listed", "as it was now, at the last touch"],
];

const RANKS: [string, string][] = [
  ["all", "everybody for everybody, as in the paper"],
  ["ranks", "ranks: those nearer to the start's middle"],
];

/** The team with another F. Ranks, if it has them, go by it. */
function prepared(table: Table, faults: number): Table {
  const changed = change(table, "team", { faults });
  return part(table, "team")["ranks"] === undefined ? changed : withRanks(changed, true);
}

/** The number of a field, or what stands for it. */
function number(value: Value | undefined, otherwise: number): number {
  return typeof value === "number" ? value : otherwise;
}

export function mount(section: HTMLElement, simulator: Simulator): [Stage, Board<Stage>] {
  const stage = new Stage(simulator, FOUR);
  const board = new Board(stage, {
    look: (moment) => {
      const values = part(moment.table, "values");
      const range: [number, number] = [number(values["min"], -500), number(values["max"], 500)];
      return { values: range, marksShort: true, marksSets: true, half_m: 1.4 };
    },
    banner: ({ moment, store }) => safety(moment, store.state.report, store.state.network),
    charts: [MARGINS, VALUES],
    moves: true,
    label: "A team to play with",
  });
  board.controls.append(...choices(stage, simulator), sharing(stage));
  const before = { kinds: new Set<string>(), shared: false };
  watch(section, stage, {
    drag: ({ moment }) => part(moment.table, "motion")["kind"] === "goals",
    lie: ({ moment, store }) => store.state.touches > 0 && moment.liars.size === moment.facts.faults,
    kinds: ({ moment }) => {
      const kind = lieOf(moment.table)?.id;
      if (kind && moment.liars.size > 0) before.kinds.add(kind);
      return before.kinds.size >= 3;
    },
  });
  return [stage, board];
}

/** Menus and sliders that change the scenario, and follow it. */
function choices(stage: Stage, simulator: Simulator): HTMLElement[] {
  const of = (table: Table, name: string, field: string, otherwise: number) => number(part(table, name)[field], otherwise);
  const set = (name: string, field: string) => (value: number) => void stage.touch((table) => change(table, name, { [field]: value }));
  const controller = menu("Filter", simulator.controllers.map((one) => [one.name, `${one.name}: ${one.about}`]), "budget", (kind) => {
    const row = simulator.controllers.find((one) => one.name === kind);
    stage.touch((table, moment) => {
      const counted = row?.ranks ? table : withRanks(table, false);
      return change(row?.obstacles ? counted : withObstacles(counted, moment, "none"), "controller", { kind });
    });
  });
  const lie = menu("Liars tell", LIES.map((one) => [one.id, `${one.name}: ${one.about}`]), "value", (id) => {
    const attack = LIES.find((one) => one.id === id)?.attack ?? {};
    stage.touch((table) => replace(table, "attack", attack));
  });
  const motion = menu("Robots want to", MOTIONS, "hold", (kind) => {
    stage.touch((table) => (kind === "goals" ? replace(table, "motion", { kind: "hold" }) : replace(table, "motion", { kind })));
  });
  const start = menu("Start", STARTS, "inside", (kind) => {
    if (kind === "listed") stage.touch((table) => table);
    else stage.touch(({ values: _values, ...table }) => replace(table, "start", { kind }), true);
  });
  const robots = slider("Robots", { min: 5, max: 50, step: 1, value: 11 }, String, (count) => stage.touch((table) => withRobots(table, count), true));
  const faults = slider("Prepared for F liars", { min: 0, max: 5, step: 1, value: 2 }, String, (count) => stage.touch((table) => prepared(table, count)));
  const rule = menu("Robots agree by", simulator.rules.map((one) => [one.name, `${one.name}: ${one.condition}`]), "w-msr", (name) => stage.touch((table) => change(table, "consensus", { rule: name })));
  const ranks = menu("Who counts", RANKS, "all", (kind) => stage.touch((table) => withRanks(table, kind === "ranks")));
  const obstacles = menu("In the way", LAYOUTS, "none", (layout) => stage.touch((table, moment) => withObstacles(table, moment, layout)));
  const loss = slider("Messages lost", { min: 0, max: 0.95, step: 0.05, value: 0 }, (share) => `${Math.round(100 * share)} %`, set("network", "loss"));
  const delay = slider("Messages late by up to", { min: 0, max: 0.3, step: 0.02, value: 0 }, (time) => `${time.toFixed(2)} s`, set("network", "delay_max_s"));
  const gain = slider("Gain α of composed", { min: 0.05, max: 2, step: 0.05, value: 0.1 }, (alpha) => `${alpha.toFixed(2)} /s`, set("controller", "alpha"));
  const speed = slider("Speed", { min: 0.1, max: 4, step: 0.1, value: 1 }, (times) => `${times.toFixed(1)} ×`, (times) => stage.store.set({ speed: times }));
  const fresh = h("button", { type: "button", onclick: () => stage.touch((table) => replace({ ...table, seed: number(table["seed"], 1) + 1 }, "values", { kind: "random" })) }, "Fresh values");
  stage.store.subscribe(({ speed: times }) => {
    const { moment, table } = stage;
    controller.select.value = moment.facts.controller.name;
    lie.select.value = lieOf(table)?.id ?? "";
    motion.select.value = String(part(table, "motion")["kind"] ?? "paper");
    start.select.value = String(part(table, "start")["kind"] ?? (moment.robots === 11 ? "inside" : "hexagon"));
    rule.select.value = String(part(table, "consensus")["rule"] ?? "w-msr");
    ranks.select.value = moment.facts.ranks ? "ranks" : "all";
    ranks.select.disabled = !moment.facts.controller.ranks;
    obstacles.select.disabled = !moment.facts.controller.obstacles;
    robots.show(moment.robots);
    faults.input.max = String(Math.min(10, Math.floor((moment.robots - 1) / 2)));
    faults.show(moment.facts.faults);
    const { discs, walls } = obstaclesOf(table);
    obstacles.select.value = discs.length > 0 ? "discs" : walls.length > 2 ? "room" : walls.length > 0 ? "gap" : "none";
    loss.show(of(table, "network", "loss", 0));
    delay.show(of(table, "network", "delay_max_s", 0));
    gain.show(of(table, "controller", "alpha", 0.1));
    speed.show(times);
  });
  const more = h("details", { class: "more" }, h("summary", {}, "More: team, ranks, agreement, obstacles, network, gain, speed"), robots.element, faults.element, ranks.element, rule.element, obstacles.element, loss.element, delay.element, gain.element, speed.element);
  return [controller.element, lie.element, motion.element, start.element, fresh, more];
}

/** The link, the file, and the digest that the command line must give too. */
function sharing(stage: Stage): HTMLElement {
  const digest = h("code", { class: "digest" });
  const note = h("p", { class: "note", "aria-live": "polite" });
  const link = async () => {
    const { moment } = stage;
    const time_s = moment.tick * moment.facts.tick_s;
    history.replaceState(null, "", await pack({ text: write(moment.table), time_s }));
    try {
      await navigator.clipboard.writeText(location.href);
      say(note, "The link is in the clipboard and in the address bar.");
    } catch {
      say(note, "The link is in the address bar.");
    }
  };
  const file = () => {
    const text = `# closeranks run ${FILE}\n${write(stage.table)}`;
    const address = URL.createObjectURL(new Blob([text], { type: "application/toml" }));
    h("a", { href: address, download: FILE }).click();
    setTimeout(() => URL.revokeObjectURL(address), 10_000);
    say(note, `Saved as ${FILE}: closeranks run ${FILE} repeats it, and must end with the same digest.`);
  };
  const buttons = h("div", { class: "buttons" }, h("button", { type: "button", class: "share", onclick: () => void link() }, "Copy a link"), h("button", { type: "button", class: "save", onclick: file }, "Save the scenario"));
  stage.store.subscribe(() => {
    const { moment } = stage;
    const known = stage.digest;
    if (stage.store.state.inHand) say(digest, "none: a hand is in it, let go");
    else if (known) say(digest, `${known} after ${moment.tick} of ${moment.facts.ticks} ticks`);
  });
  return h("div", { class: "sharing" }, buttons, note, h("p", { class: "note" }, "Digest: ", digest));
}

const FILE = "page.toml";
