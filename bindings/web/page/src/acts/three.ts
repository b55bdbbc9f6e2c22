// Act 3: the filter. The same pull and every lie, under every controller that robots can run by themselves.

import { LIES, lieOf, replace, type Lie } from "../model/scenario";
import type { Controller, Simulator } from "../model/simulator";
import { Stage } from "../model/stage";
import { part, type Table } from "../model/toml";
import { closest, safety } from "../view/banner";
import { Board } from "../view/board";
import { MARGINS, VALUES } from "../view/charts";
import { h, menu, say, scrolling } from "../view/dom";
import { watch } from "../view/tasks";

/** Lies that this act shows, in its order. */
const SHOWN = ["value", "understate", "overstate", "swing", "faces"];

export const THREE: Table = {
  name: "act 3: the filter",
  duration_s: 10,
  team: { robots: 11, faults: 2, malicious: [1, 2] },
  controller: { kind: "none" },
  attack: LIES[0]?.attack ?? {},
};

/** What a run to its end came to. */
interface Result {
  degree: number;
  distance_m: number;
  agreed: boolean;
}

/** True if ranks held: neighbours, distances and values. */
function held(result: Result | undefined, required: number, distance_m: number): boolean {
  return result !== undefined && result.degree >= required && result.distance_m >= distance_m - 1e-9 && result.agreed;
}

export function mount(section: HTMLElement, simulator: Simulator): [Stage, Board<Stage>] {
  const stage = new Stage(simulator, THREE);
  const board = new Board(stage, {
    look: () => ({ values: [-500, 500], marksShort: true, marksSets: true, half_m: 1.7 }),
    banner: ({ moment, store }) => safety(moment, store.state.report, store.state.network),
    charts: [MARGINS, VALUES],
    moves: true,
    label: "Eleven robots that pull four ways; robots 1 and 2 lie",
  });
  const controllers = simulator.controllers.filter((controller) => controller.local);
  const lies = LIES.filter((lie) => SHOWN.includes(lie.id));
  const start = (fields: { controller?: string; lie?: Lie }, atOnce = false) => {
    const kind = fields.controller ?? part(stage.table, "controller")["kind"] ?? "composed";
    const attack = fields.lie?.attack ?? part(stage.table, "attack");
    stage.begin(replace(replace(THREE, "controller", { kind }), "attack", attack));
    if (atOnce) stage.run(stage.moment.facts.ticks * stage.moment.facts.tick_s);
    else stage.play(true);
  };
  const filter = menu("Filter", controllers.map((one) => [one.name, `${one.name}: ${one.about}`]), "none", (name) => start({ controller: name }));
  const lie = menu("The two liars lie", lies.map((one) => [one.id, one.name]), "value", (id) => start({ ...found(id) }));
  const results = new Map<string, Result>();
  const grid = new Grid(controllers, lies, (controller, one) => start({ controller: controller.name, lie: one }, true));
  board.controls.append(filter.element, lie.element, grid.element);
  stage.store.subscribe(() => {
    const { moment } = stage;
    filter.select.value = moment.facts.controller.name;
    lie.select.value = lieOf(moment.table)?.id ?? "";
    const key = `${moment.facts.controller.name} ${lie.select.value}`;
    if (stage.isOver && !stage.store.state.inHand && part(moment.table, "start")["kind"] === undefined && !results.has(key)) {
      stage.look();
      const { report } = stage.store.state;
      const degree = report?.degree_min ?? moment.degreeMin();
      const distance_m = report?.distance_min_m ?? closest(moment).distance_m;
      results.set(key, { degree, distance_m, agreed: moment.spread() < 1 });
    }
    grid.show(results, key, moment.facts.required, moment.facts.distance_min_m);
  });
  const is = (controller: (row: Controller) => boolean, ids: string[]) =>
    controllers.filter(controller).some((row) => ids.every((id) => held(results.get(`${row.name} ${id}`), 7, 0.3)));
  watch(section, stage, {
    apart: () => results.has("none value") && !held(results.get("none value"), 7, 0.3),
    hold: () => is((row) => row.keeps_degrees, ["value"]),
    lies: () => is((row) => row.guarantees, SHOWN),
    breaks: () => [...results].some(([key, result]) => !key.startsWith("none") && !held(result, 7, 0.3)),
  });
  return [stage, board];
}

function found(id: string): { lie?: Lie } {
  const lie = LIES.find((one) => one.id === id);
  return lie ? { lie } : {};
}

/** A table that fills while readers try: one row a controller, one column a lie. */
class Grid {
  readonly element: HTMLElement;
  private readonly cells = new Map<string, { cell: HTMLTableCellElement; button: HTMLButtonElement }>();

  constructor(controllers: Controller[], lies: Lie[], run: (controller: Controller, lie: Lie) => void) {
    const head = h("tr", {}, h("th", { scope: "col" }, "filter"), ...lies.map((lie) => h("th", { scope: "col" }, lie.name)));
    const rows = controllers.map((controller) => {
      const cells = lies.map((lie) => {
        const button = h("button", { type: "button", onclick: () => run(controller, lie) }, "try");
        const cell = h("td", {}, button);
        this.cells.set(`${controller.name} ${lie.id}`, { cell, button });
        return cell;
      });
      return h("tr", {}, h("th", { scope: "row" }, controller.name), ...cells);
    });
    const caption = h("caption", {}, "Least neighbours and least distance over ten seconds; ✓ if ranks held");
    this.element = scrolling("What came of every lie", h("table", { class: "log" }, caption, head, ...rows));
  }

  show(results: Map<string, Result>, now: string, required: number, distance_m: number): void {
    for (const [key, { cell, button }] of this.cells) {
      const result = results.get(key);
      const good = held(result, required, distance_m);
      const mark = good ? "✓" : "✗";
      say(button, result ? `${mark} ${result.degree}, ${result.distance_m.toFixed(2)} m` : "try");
      cell.className = `${result ? (good ? "agreed" : "stuck") : ""} ${key === now ? "now" : ""}`.trim();
    }
  }
}

