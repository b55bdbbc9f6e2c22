// Numbers and robots in words.

/** A value in a few digits. */
export function words(value: number): string {
  if (!Number.isFinite(value)) return "none";
  const digits = Math.abs(value) < 1e5 ? value.toFixed(0).replace(/^-0$/, "0") : value.toExponential(0);
  return digits.replace("-", "−");
}

/** Robots by number, as in a sentence. */
export function named(robots: number[]): string {
  const numbers = robots.slice(0, 4).join(", ").replace(/, (\d+)$/, robots.length > 4 ? ", $1" : " and $1");
  const rest = robots.length > 4 ? ` and ${robots.length - 4} more` : "";
  return `${robots.length === 1 ? "robot" : "robots"} ${numbers}${rest}`;
}

export function capital(text: string): string {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
