// Colours that people with any colour vision can tell apart, and values as colours. Shape says the same: liars are squares.

export const INK = "#1a1a1a";
export const SOFT = "#595959";
export const LINE = "#c9ced3";
export const LINK = "#9aa7b3";
export const LIAR = "#d55e00";
export const SHORT = "#a3005c";
export const STONE = "#7d7468";
export const TEAM = "#0072b2";

/** From low to high: dark blue, grey, yellow (as in the map cividis, which is read alike with any colour vision). */
const STOPS: [number, number, number][] = [
  [0, 45, 108],
  [58, 79, 122],
  [124, 123, 120],
  [187, 170, 100],
  [254, 226, 70],
];

/** The colour of a value between `low` and `high`, and the ink that can be read on it. */
export function valueColour(value: number, low: number, high: number): { fill: string; ink: string } {
  const share = high > low ? Math.min(1, Math.max(0, (value - low) / (high - low))) : 0.5;
  const place = share * (STOPS.length - 1);
  const index = Math.min(Math.floor(place), STOPS.length - 2);
  const [from, to] = [STOPS[index], STOPS[index + 1]];
  if (!from || !to || !Number.isFinite(value)) return { fill: "#ffffff", ink: INK };
  const mixed = from.map((part, axis) => Math.round(part + (place - index) * ((to[axis] ?? 0) - part)));
  return { fill: `rgb(${mixed.join(",")})`, ink: share < 0.6 ? "#ffffff" : INK };
}
