// The team, drawn on a canvas: links below, robots above. Robots are buttons too (hands.ts); here is only what is seen.

import type { Moment } from "../model/moment";
import { obstaclesOf } from "../model/obstacles";
import type { State } from "../model/scene";
import { INK, LIAR, LINE, LINK, SHORT, SOFT, STONE, valueColour } from "./colours";

export const RADIUS_PX = 15;

/** Where the plane lies on the canvas. */
export interface Frame {
  x_m: number;
  y_m: number;
  pixels_per_m: number;
  width: number;
  height: number;
}

export interface Look {
  /** Interval of values that colours stand for. */
  values: [number, number];
  /** Whether robots that are short of neighbours are marked. */
  marksShort: boolean;
  /** Whether two sets of robots that would never agree are marked. */
  marksSets: boolean;
  /** Half the height of the part of the plane that is always seen, m. */
  half_m: number;
}

/** The frame that holds the whole team. It follows `before` slowly, so that the eye can follow. */
export function framed(moment: Moment, look: Look, width: number, height: number, before: Frame | null, still: boolean): Frame {
  const xs = moment.all().map((robot) => moment.x(robot));
  const ys = moment.all().map((robot) => moment.y(robot));
  const [left, right, low, high] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const margin = 2 * (RADIUS_PX + 6);
  const half = look.half_m;
  const fits = Math.min(
    Math.max(width - margin, 40) / Math.max(right - left, 2 * half),
    Math.max(height - margin, 40) / Math.max(high - low, 2 * half),
  );
  const goal = { x_m: (left + right) / 2, y_m: (low + high) / 2, pixels_per_m: fits, width, height };
  if (!before || before.width !== width || before.height !== height) return goal;
  if (still) return before;
  // A team that grows must not leave the picture.
  const share = goal.pixels_per_m < 0.97 * before.pixels_per_m ? 0.5 : 0.15;
  const mix = (from: number, to: number) => (Math.abs(to - from) < 1e-4 ? to : from + share * (to - from));
  return {
    x_m: mix(before.x_m, goal.x_m),
    y_m: mix(before.y_m, goal.y_m),
    pixels_per_m: mix(before.pixels_per_m, goal.pixels_per_m),
    width,
    height,
  };
}

export function toPixels(frame: Frame, x_m: number, y_m: number): [number, number] {
  const { pixels_per_m, width, height } = frame;
  return [width / 2 + (x_m - frame.x_m) * pixels_per_m, height / 2 - (y_m - frame.y_m) * pixels_per_m];
}

export function toMetres(frame: Frame, x: number, y: number): [number, number] {
  const { pixels_per_m, width, height } = frame;
  return [frame.x_m + (x - width / 2) / pixels_per_m, frame.y_m - (y - height / 2) / pixels_per_m];
}

/** Teams of more robots have more links than a processor draws sixty times a second. */
export const CROWD = 20;

/** Draws what lies under the robots of a moment: obstacles, who is linked, and how far the chosen one reaches. */
export function drawLinks(context: CanvasRenderingContext2D, frame: Frame, moment: Moment, state: State): void {
  context.clearRect(0, 0, frame.width, frame.height);
  obstacles(context, frame, moment);
  range(context, frame, moment, state.chosen);
  links(context, frame, moment, state.chosen);
}

/** Draws the robots of a moment. */
export function drawRobots(context: CanvasRenderingContext2D, frame: Frame, moment: Moment, state: State, look: Look): void {
  context.clearRect(0, 0, frame.width, frame.height);
  if (state.hand) thread(context, frame, moment, state.hand);
  const sets = look.marksSets && state.network?.robust === false ? state.network.sets : null;
  const size = robotSize(frame, moment);
  for (const robot of moment.all()) {
    const letter = sets?.[0].includes(robot) ? "A" : sets?.[1].includes(robot) ? "B" : "";
    body(context, frame, moment, robot, look, letter, size);
  }
}

/** Radius of a robot, px: smaller where many stand close together. */
export function robotSize(frame: Frame, moment: Moment): number {
  return Math.max(7, Math.min(RADIUS_PX, 0.22 * frame.pixels_per_m, 120 / Math.sqrt(moment.robots)));
}

function obstacles(context: CanvasRenderingContext2D, frame: Frame, moment: Moment): void {
  const { discs, walls } = obstaclesOf(moment.table);
  context.fillStyle = STONE;
  context.strokeStyle = STONE;
  context.lineWidth = 4;
  context.beginPath();
  for (const [x_m, y_m, radius_m] of discs) {
    const [x, y] = toPixels(frame, x_m, y_m);
    const radius = radius_m * frame.pixels_per_m;
    context.moveTo(x + radius, y);
    context.arc(x, y, radius, 0, 2 * Math.PI);
  }
  context.fill();
  context.beginPath();
  for (const [x_m, y_m, to_x_m, to_y_m] of walls) {
    context.moveTo(...toPixels(frame, x_m, y_m));
    context.lineTo(...toPixels(frame, to_x_m, to_y_m));
  }
  context.stroke();
}

function range(context: CanvasRenderingContext2D, frame: Frame, moment: Moment, robot: number): void {
  const [x, y] = toPixels(frame, moment.x(robot), moment.y(robot));
  context.beginPath();
  context.arc(x, y, moment.facts.radius_m * frame.pixels_per_m, 0, 2 * Math.PI);
  context.setLineDash([3, 5]);
  context.strokeStyle = LINE;
  context.lineWidth = 1;
  context.stroke();
  context.setLineDash([]);
}

function links(context: CanvasRenderingContext2D, frame: Frame, moment: Moment, chosen: number): void {
  const points = moment.all().map((robot) => toPixels(frame, moment.x(robot), moment.y(robot)));
  const reach = moment.facts.radius_m;
  const crowded = moment.robots > CROWD;
  for (const mine of [false, true]) {
    context.strokeStyle = mine ? INK : LINK;
    context.globalAlpha = mine ? 0.55 : crowded ? 0.25 : 0.6;
    context.lineWidth = mine ? 1.5 : 1;
    points.forEach(([x, y], one) => {
      for (let other = 0; other < one; other += 1) {
        if ((one + 1 === chosen || other + 1 === chosen) !== mine) continue;
        const to = points[other];
        if (!to || moment.distance(one + 1, other + 1) > reach) continue;
        // One path of many lines that cross costs several times as much where a processor draws it.
        context.beginPath();
        context.moveTo(x, y);
        context.lineTo(to[0], to[1]);
        context.stroke();
      }
    });
  }
  context.globalAlpha = 1;
}

/** The thread between a robot and the hand that draws it. */
function thread(context: CanvasRenderingContext2D, frame: Frame, moment: Moment, hand: { robot: number; x_m: number; y_m: number }): void {
  const [x, y] = toPixels(frame, moment.x(hand.robot), moment.y(hand.robot));
  const [to, below] = toPixels(frame, hand.x_m, hand.y_m);
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(to, below);
  context.setLineDash([2, 4]);
  context.strokeStyle = INK;
  context.lineWidth = 2;
  context.stroke();
  context.setLineDash([]);
}

function body(
  context: CanvasRenderingContext2D,
  frame: Frame,
  moment: Moment,
  robot: number,
  look: Look,
  letter: string,
  size: number,
): void {
  const [x, y] = toPixels(frame, moment.x(robot), moment.y(robot));
  const liar = moment.isLiar(robot);
  const { fill, ink } = valueColour(moment.value(robot), look.values[0], look.values[1]);
  context.beginPath();
  if (liar) context.rect(x - size, y - size, 2 * size, 2 * size);
  else context.arc(x, y, size, 0, 2 * Math.PI);
  context.fillStyle = fill;
  context.fill();
  context.lineWidth = liar ? 4 : 2;
  context.strokeStyle = liar ? LIAR : "#ffffff";
  context.stroke();
  const short = look.marksShort && !liar && moment.degree(robot) < moment.required(robot);
  if (short) ring(context, x, y, size + 4);
  context.fillStyle = ink;
  context.font = `600 ${Math.round(0.85 * size)}px system-ui, sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(String(robot), x, y + 0.5);
  const note = `${short ? moment.degree(robot) : ""} ${letter}`.trim();
  if (note) {
    context.font = "600 12px system-ui, sans-serif";
    context.fillStyle = short ? SHORT : SOFT;
    context.fillText(note, x + size + 9, y - size - 1);
  }
}

/** Marks a robot that is short of neighbours: a broken ring. */
function ring(context: CanvasRenderingContext2D, x: number, y: number, size: number): void {
  context.beginPath();
  context.arc(x, y, size, 0, 2 * Math.PI);
  context.setLineDash([5, 3]);
  context.strokeStyle = SHORT;
  context.lineWidth = 2.5;
  context.stroke();
  context.setLineDash([]);
}
