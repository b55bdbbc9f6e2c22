// What a board shows: moments to go through. A stage computes them, a replay is told them.

import type { Moment } from "./moment";
import type { State } from "./stage";
import type { Store } from "./store";

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
