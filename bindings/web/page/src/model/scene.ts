// What a board shows: moments to go through. A stage computes them, a replay is told them.

import type { Moment } from "./moment";
import type { Network, Report } from "./simulator";
import type { Store } from "./store";

export interface State {
  /** Everything that was seen, oldest first. */
  moments: Moment[];
  /** Which of them is shown. */
  cursor: number;
  playing: boolean;
  /** Simulated seconds in a second. */
  speed: number;
  /** The robot that is chosen, from 1. */
  chosen: number;
  /** The robot that is held, and where to. */
  hand: { robot: number; x_m: number; y_m: number } | null;
  /** True from when a hand held a moving robot until the next touch: no scenario has this run. */
  inHand: boolean;
  report: Report | null;
  network: Network | null;
  /** Why the last change was refused. */
  refused: string;
  /** How often the reader changed something. */
  touches: number;
}

export interface Scene {
  readonly store: Store<State>;
  /** The moment that is shown. */
  readonly moment: Moment;
  /** True if what is shown is the newest moment. */
  readonly isLive: boolean;
  /** Back to the beginning. */
  restart(): void;
  play(playing?: boolean): void;
  /** Shows a moment of the past. */
  seek(cursor: number): void;
  /** One moment on. */
  step(): void;
  /** Goes on by a time of the reader's, s. */
  advance(elapsed_s: number): void;
  /** Looks at the network and the laws, as far as they can be known. */
  look(): void;
}
