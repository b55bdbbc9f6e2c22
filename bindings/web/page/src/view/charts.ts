// What robots held over time: one line a robot, those of liars broken.

import uPlot from "uplot";
import type { Moment } from "../model/moment";
import { h } from "./dom";
import { INK, LIAR, LINE, SHORT, SOFT, TEAM } from "./colours";

/** Points of a line at most, and of all lines together. */
const POINTS_MAX = 400;
const ALL_POINTS_MAX = 6000;

export interface Drawn {
  title: string;
  /** What is drawn of a robot. */
  of: (moment: Moment, robot: number) => number;
  /** The least interval that is seen. */
  range: (moments: Moment[]) => [number, number];
  /** A line that nobody honest may cross from above, if there is one. */
  floor?: number;
  /** Whether liars are drawn. */
  liars: boolean;
}

export class Chart {
  readonly element: HTMLElement;
  private plot: uPlot | null = null;
  private robots = 0;
  private readonly body = h("div", { class: "plot", "aria-hidden": "true" });
  private interval: [number, number] = [0, 1];
  private liars: ReadonlySet<number> = new Set();
  /** Time of the moment that is marked, s. */
  private marked = 0;
  /** Each point of a line stands for so many moments. */
  private every = 1;

  constructor(
    private readonly drawn: Drawn,
    private readonly pick: (index: number) => void,
  ) {
    this.element = h("figure", { class: "chart" }, h("figcaption", {}, drawn.title), this.body);
  }

  /** Shows moments; the one of `cursor` is marked. */
  show(moments: Moment[], cursor: number): void {
    const last = moments[moments.length - 1];
    if (!last) return;
    const every = Math.max(1, Math.ceil(moments.length / Math.min(POINTS_MAX, ALL_POINTS_MAX / last.robots)));
    const some = moments.filter((_, index) => index % every === 0 || index === moments.length - 1);
    this.interval = this.drawn.range(some);
    if (!this.plot || this.robots !== last.robots) this.make(last);
    this.liars = last.liars;
    this.marked = moments[cursor]?.time_s ?? 0;
    this.every = every;
    const lines = last.all().map((robot) => some.map((moment) => this.number(moment, robot)));
    const times = some.map((moment) => moment.time_s);
    const end = Math.max(2, last.time_s, times[0] ?? 0);
    this.plot?.setData([times, ...lines] as uPlot.AlignedData, false);
    this.plot?.setScale("x", { min: times[0] ?? 0, max: end });
  }

  private number(moment: Moment, robot: number): number | null {
    if (robot > moment.robots || (!this.drawn.liars && moment.isLiar(robot))) return null;
    const number = this.drawn.of(moment, robot);
    if (!Number.isFinite(number)) return null;
    const [low, high] = this.interval;
    return Math.max(low - 10 * (high - low), Math.min(high + 10 * (high - low), number));
  }

  private make(moment: Moment): void {
    this.plot?.destroy();
    this.robots = moment.robots;
    const axis = { stroke: SOFT, grid: { stroke: "#e6e8ea", width: 1 }, ticks: { show: false }, font: "12px system-ui, sans-serif" };
    const line = (robot: number): uPlot.Series => ({
      stroke: () => (this.liars.has(robot) ? LIAR : TEAM),
      width: 1.5,
      points: { show: false },
      spanGaps: false,
      label: String(robot),
    });
    const options: uPlot.Options = {
      width: Math.max(this.body.clientWidth, 200),
      height: 150,
      legend: { show: false },
      cursor: { y: false, points: { show: false }, drag: { x: false, y: false } },
      scales: { x: { time: false }, y: { range: () => this.interval } },
      axes: [
        { ...axis, size: 26, values: (_, splits) => splits.map((split) => `${split} s`) },
        { ...axis, size: 48 },
      ],
      series: [{}, ...moment.all().map(line)],
      hooks: { draw: [(plot) => this.marks(plot)] },
    };
    this.plot = new uPlot(options, undefined, this.body);
    this.plot.over.addEventListener("click", () => {
      const index = this.plot?.cursor.idx;
      if (typeof index === "number") this.pick(index * this.every);
    });
    new ResizeObserver(() => {
      const width = this.body.clientWidth;
      if (width > 0 && this.plot && this.plot.width !== width) this.plot.setSize({ width, height: 150 });
    }).observe(this.body);
  }

  /** The moment that is shown, and the floor. */
  private marks(plot: uPlot): void {
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.beginPath();
    const x = plot.valToPos(this.marked, "x", true);
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.strokeStyle = INK;
    ctx.lineWidth = devicePixelRatio;
    ctx.stroke();
    if (this.drawn.floor !== undefined) {
      const y = plot.valToPos(this.drawn.floor, "y", true);
      ctx.beginPath();
      ctx.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
      ctx.moveTo(bbox.left, y);
      ctx.lineTo(bbox.left + bbox.width, y);
      ctx.strokeStyle = SHORT;
      ctx.lineWidth = 2 * devicePixelRatio;
      ctx.stroke();
    }
    ctx.strokeStyle = LINE;
    ctx.restore();
  }
}

/** The values of robots: liars are seen as far as they stay near the others. */
export const VALUES: Drawn = {
  title: "The value of each robot (orange: liars)",
  of: (moment, robot) => moment.value(robot),
  range: (moments) => {
    const values = moments.flatMap((moment) => moment.normal().map((robot) => moment.value(robot)));
    const [low, high] = [Math.min(-500, ...least(values)), Math.max(500, ...most(values))];
    return [low - 40, high + 40];
  },
  liars: true,
};

/** h_i, what each robot can spare. */
export const MARGINS: Drawn = {
  title: "What each honest robot can spare, hᵢ: below 0 the promise is void",
  of: (moment, robot) => moment.h(robot),
  range: (moments) => {
    const hs = moments.flatMap((moment) => moment.normal().map((robot) => moment.h(robot)));
    return [Math.max(-8, Math.min(-1, ...least(hs))) - 0.3, Math.max(3, ...most(hs)) + 0.3];
  },
  floor: 0,
  liars: false,
};

function least(values: number[]): number[] {
  return [values.reduce((one, other) => Math.min(one, other), Infinity)];
}

function most(values: number[]): number[] {
  return [values.reduce((one, other) => Math.max(one, other), -Infinity)];
}
