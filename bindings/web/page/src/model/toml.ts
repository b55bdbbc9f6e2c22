// Scenarios as plain values, and the TOML text that says them. Reading is the simulator's business; here is only the way back.

export type Value = string | number | boolean | Value[] | Table;
export interface Table {
  [key: string]: Value;
}

export function isTable(value: Value | undefined): value is Table {
  return typeof value === "object" && !Array.isArray(value);
}

/** The table of that name, or an empty one. */
export function part(table: Table, key: string): Table {
  const value = table[key];
  return isTable(value) ? value : {};
}

/** The TOML text of a table: its own fields first, then each table in it under its head. Numbers keep every bit. */
export function write(table: Table): string {
  const own = Object.entries(table).filter(([, value]) => !isTable(value));
  const tables = Object.entries(table).filter((entry): entry is [string, Table] => isTable(entry[1]));
  const lines = own.map(field);
  for (const [name, inner] of tables) {
    lines.push("", `[${key(name)}]`, ...Object.entries(inner).map(field));
  }
  return `${lines.join("\n").trim()}\n`;
}

function field([name, value]: [string, Value]): string {
  return `${key(name)} = ${inline(value)}`;
}

function key(name: string): string {
  return /^[A-Za-z0-9_-]+$/.test(name) ? name : JSON.stringify(name);
}

function inline(value: Value): string {
  if (typeof value === "number") return number(value);
  if (Array.isArray(value)) return `[${value.map(inline).join(", ")}]`;
  if (isTable(value)) return `{ ${Object.entries(value).map(field).join(", ")} }`;
  return JSON.stringify(value);
}

function number(value: number): string {
  if (!Number.isFinite(value)) throw new RangeError(`${value} cannot stand in a scenario`);
  return Object.is(value, -0) ? "-0.0" : String(value);
}
