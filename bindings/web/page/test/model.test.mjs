// What needs no browser: scenarios, sentences, links. node --test test/model.test.mjs

import assert from "node:assert/strict";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { build } from "esbuild";

const source = join(dirname(fileURLToPath(import.meta.url)), "../src");
const folder = mkdtempSync(join(tmpdir(), "closeranks-model-"));
const modules = ["model/toml", "model/scenario", "model/moment", "model/obstacles", "model/link", "view/banner", "view/words"];
await build({
  stdin: { contents: modules.map((name) => `export * from "./${name}";`).join("\n"), resolveDir: source, loader: "ts" },
  bundle: true,
  format: "esm",
  outfile: join(folder, "model.mjs"),
  logLevel: "warning",
});
const model = await import(pathToFileURL(join(folder, "model.mjs")).href);
after(() => rmSync(folder, { recursive: true, force: true }));

const W_MSR = { name: "w-msr", condition: "an (F+1,F+1)-robust graph", proved: true };

/** A moment of robots at `places`, with neighbours within 3 m and a value of 0 each. */
function moment(places, { malicious = [], tick = 0, table = {}, faults = 1, keeps_degrees = true, ranks = null, needs = null, rule = W_MSR } = {}) {
  const facts = {
    robots: places.length, faults, required: faults + Math.floor(places.length / 2), malicious, radius_m: 3, distance_min_m: 0.3,
    tick_s: 0.1, ticks: 100, ticks_per_round: 2, controller: { name: "budget", keeps_degrees }, ranks, needs, rule, head: 2, fields: 12,
  };
  const degree = ([x, y]) => places.filter(([u, v]) => Math.hypot(x - u, y - v) <= 3).length - 1;
  const robots = places.flatMap((place) => [...place, 0, 0, degree(place), 0, 0, 0, 0, 0, 0, 0]);
  return new model.Moment(7, Float64Array.of(tick + 1, 0, ...robots), facts, table);
}

const LINE = [[0, 0], [1, 0], [2, 0], [3, 0], [4.5, 0]];

test("a table is written as TOML, every bit of its numbers", () => {
  const table = { name: 'a "b"', seed: 7, team: { malicious: [1, 2] }, attack: { level: { kind: "bias", bias: -0.1 } }, x: { y: [[0.1 + 0.2, -0]] } };
  const lines = [
    'name = "a \\"b\\""', "seed = 7", "", "[team]", "malicious = [1, 2]", "", "[attack]", 'level = { kind = "bias", bias = -0.1 }', "", "[x]",
    "y = [[0.30000000000000004, -0.0]]", "",
  ];
  assert.equal(model.write(table), lines.join("\n"));
  assert.throws(() => model.write({ a: Number.NaN }), RangeError);
});

test("the present becomes a start: places, values, and what is left of a timetable", () => {
  const rows = [[1, 0, 1, 0], [1, 2, 0, 1], [1, 9, 5, 5], [2, 8, 1, 1]];
  const table = { seed: 3, motion: { kind: "velocities", velocities: rows } };
  const start = model.present(moment(LINE, { tick: 30, table }));
  assert.deepEqual(start.start, { kind: "listed", positions_m: LINE });
  assert.deepEqual(start.values, { kind: "listed", values: [0, 0, 0, 0, 0] });
  assert.deepEqual(start.motion.velocities, [[1, 0, 0, 1], [1, 6, 5, 5], [2, 5, 1, 1]]);
  assert.equal(start.seed, 3);
});

test("a robot that is sent somewhere leaves the others to their way", () => {
  const { facts } = moment(LINE);
  const goals = (motion) => model.sentTo({ motion }, facts, 2, 8, 9).motion.goals;
  assert.deepEqual(goals({ kind: "hold" }), [[2, 8, 9]]);
  assert.deepEqual(goals({ kind: "goals", goals: [[2, 0, 0], [4, 1, 1]] }), [[4, 1, 1], [2, 8, 9]]);
  assert.deepEqual(goals({ kind: "paper" }), [[1, -1000, 0], [3, 0, -1000], [4, 0, 1000], [5, 0, -1000], [2, 8, 9]]);
});

test("another number of robots forgets what was listed for those who are gone", () => {
  const table = { team: { robots: 11, faults: 5, malicious: [1, 9] }, values: { kind: "listed", values: [] }, motion: { kind: "goals", goals: [[9, 0, 0], [2, 1, 1]] } };
  const changed = model.withRobots(table, 7);
  assert.deepEqual(changed.team, { robots: 7, faults: 3, malicious: [1] });
  assert.deepEqual(changed.motion.goals, [[2, 1, 1]]);
  assert.equal(changed.values, undefined);
});

test("obstacles are put around the robots, near none of them, and taken away", () => {
  const now = moment(LINE);
  const robots = LINE.map(([x, y]) => ({ x, y }));
  for (const [layout] of model.LAYOUTS) {
    const table = model.withObstacles({ seed: 1, obstacles: { discs: [[0, 0, 9]] } }, now, layout);
    const { discs, walls } = model.obstaclesOf(table);
    assert.equal(discs.length + walls.length > 0, layout !== "none", layout);
    for (const { x, y } of robots) {
      for (const [u, v, radius] of discs) assert.ok(Math.hypot(u - x, v - y) - radius > 0.3);
      for (const wall of walls) assert.ok(toWall(x, y, wall) > 0.3, `${layout}: ${wall}`);
    }
  }
  assert.deepEqual(model.withObstacles({ seed: 1, obstacles: {} }, now, "none"), { seed: 1 });
});

function toWall(x, y, [u, v, p, q]) {
  const along = ((x - u) * (p - u) + (y - v) * (q - v)) / ((p - u) ** 2 + (q - v) ** 2);
  const share = Math.min(1, Math.max(0, along));
  return Math.hypot(x - u - share * (p - u), y - v - share * (q - v));
}

test("lies are known by what they do", () => {
  for (const lie of model.LIES) assert.equal(model.lieOf({ attack: lie.attack })?.id, lie.id);
  assert.equal(model.lieOf({})?.id, "value");
  assert.equal(model.lieOf({ attack: { level: { kind: "bias", bias: 9 } } }), undefined);
});

test("the banner names who is short, at the edge, too close, or outvoted", () => {
  const said = (places, options) => model.safety(moment(places, options), null, null);
  const short = said(LINE);
  assert.match(short.main, /^Robot 5 has only 2 neighbours and needs 3; /);
  assert.equal(short.tone, "bad");
  const edge = said([[0, 0], [1, 0], [2, 0], [3, 0], [4, 0]]);
  assert.match(edge.main, /^Robots 1 and 5 are down to 3 neighbours: nobody near may leave; /);
  assert.match(said([[0, 0], [1, 0], [2, 0], [3, 0], [4, 0]], { keeps_degrees: false }).main, /nothing keeps them there/);
  const near = [[0, 0], [1, 0], [0, 1], [1, 1], [1, 1.2]];
  assert.match(said(near).main, /^Robots 4 and 5 are 0.200 m apart, and 0.3 m is the least that is safe; /);
  const many = said([[0, 0], [1, 0], [0, 1], [1, 1], [2, 2]], { malicious: [1, 2] });
  assert.equal(many.why[0], "2 robots lie, and the team is prepared for 1: nothing is promised.");
  assert.equal(many.tone, "bad");
  assert.equal(said([[0, 0], [1, 0], [0, 1], [1, 1], [2, 2]]).tone, "good");
});

test("under ranks the banner goes by who counts, and by the liars around one robot", () => {
  // Robots 1 to 4 are the core; each needs 3. The fifth has the rank 1, and needs 3 of them.
  const ranks = { ranks: [0, 0, 0, 0, 1], needs: [3, 3, 3, 3, 3] };
  const said = (places, options) => model.safety(moment(places, { ...ranks, ...options }), null, null);
  assert.match(said(LINE).main, /^Robot 5 has only 2 neighbours that count for it and needs 3; /);
  const whole = [[0, 0], [1, 0], [0, 1], [1, 1], [2, 2]];
  assert.equal(said(whole).why[0], "Proved by ranks: this network survives any 1 liar around each robot, however many there are in all.");
  assert.match(said(whole, { malicious: [1, 2] }).why[0], /^2 robots in range of one robot lie, and the team is prepared for 1: /);
  // Two liars, and no robot has both in range.
  assert.doesNotMatch(said([[0, 0], [1, 0], [2, 0], [9, 9], [19, 9]], { malicious: [1, 4] }).why.join(), /nothing is promised/);
});

test("the banner promises nothing of other rules than W-MSR", () => {
  const linear = { name: "linear", condition: "no liars at all, and a connected graph", proved: false };
  const said = model.safety(moment([[0, 0], [1, 0], [0, 1], [1, 1], [2, 2]], { rule: linear }), null, { f_least: 2, f_most: 2, robust: true, sets: null });
  assert.equal(said.why.join(), "Robots agree by linear, which needs no liars at all, and a connected graph: what is promised here is about W-MSR alone.");
});

test("ranks that a start gave stay with the robots, and follow n and F", () => {
  const table = { team: { robots: 5, faults: 1, ranks: { core: 4 } } };
  assert.deepEqual(model.present(moment(LINE, { table, ranks: [0, 0, 0, 0, 1], needs: [3, 3, 3, 3, 3] })).team.ranks, [0, 0, 0, 0, 1]);
  assert.deepEqual(model.withRanks({ team: { robots: 11, faults: 2 } }, true).team.ranks, { core: 7 });
  assert.deepEqual(model.withRobots(table, 20).team, { robots: 20, faults: 1, malicious: [], ranks: { core: 4 } });
  assert.equal(model.withRanks(table, false).team.ranks, undefined);
});

test("the banner says what the search found", () => {
  const why = (network) => model.safety(moment([[0, 0], [1, 0], [0, 1], [1, 1], [2, 2]]), null, network).why.at(-1);
  assert.equal(why({ f_least: 2, f_most: 2, robust: true, sets: null }), "Searched exactly, this network survives any 1 liar.");
  assert.match(why({ f_least: 0, f_most: 0, robust: false, sets: [[1], [2]] }), /survives exactly no liar, not 1: the robots marked A and B/);
  assert.match(why({ f_least: 0, f_most: 3, robust: null, sets: null }), /at least no liar; the search for more was cut short/);
  assert.match(why({ f_least: -1, f_most: -1, robust: false, sets: null }), /^The network is torn/);
});

test("a link holds a text and a time, and broken ones are refused", async () => {
  const shared = { text: `name = "ünder"\n${"x = 0.30000000000000004\n".repeat(500)}`, time_s: 1.25 };
  const hash = await model.pack(shared);
  assert.ok(hash.length < 400, `${hash.length}`);
  assert.deepEqual(await model.unpack(hash), shared);
  assert.equal(await model.unpack("#act-4"), null);
  await assert.rejects(() => model.unpack("#s=AAAA"));
  await assert.rejects(() => model.unpack("#s=***"));
  await assert.rejects(async () => model.unpack(await model.pack({ text: "a".repeat(3 << 20), time_s: 0 })), /too long/);
});

test("robots in a sentence", () => {
  assert.equal(model.named([4]), "robot 4");
  assert.equal(model.named([4, 7]), "robots 4 and 7");
  assert.equal(model.named([1, 2, 3, 4]), "robots 1, 2, 3 and 4");
  assert.equal(model.named([1, 2, 3, 4, 5, 6]), "robots 1, 2, 3, 4 and 2 more");
  assert.equal(model.words(-0.4), "0");
  assert.equal(model.words(-12.6), "−13");
});
