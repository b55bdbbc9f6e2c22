// The page in a real browser: node --test test/page.test.mjs, with the program built (cargo build).

import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { browser, closeranks, middle, opened, run, see, text, ticked, view } from "./browser.mjs";

const folder = mkdtempSync(join(tmpdir(), "closeranks-page-"));
let chrome;
let served;

before(async () => {
  chrome = await browser();
  served = await view();
});

after(async () => {
  served?.end();
  await chrome?.close();
  rmSync(folder, { recursive: true, force: true });
});

/** Opens the page, and demands at the end that nothing went wrong. */
async function on(options, work, address = served.address) {
  const { page, wrong } = await opened(chrome, address, options);
  try {
    await work(page);
    assert.deepEqual(wrong, []);
  } finally {
    await page.close();
  }
}

test("the keyboard alone gets through act 1", () =>
  on({}, async (page) => {
    await see(page, "#act-1");
    await page.$eval("#act-1 .robot", (first) => first.focus());
    const tab = async (selector) => {
      for (let presses = 0; presses < 20; presses += 1) {
        await page.keyboard.press("Tab");
        if (await page.evaluate((wanted) => document.activeElement.matches(wanted), selector)) return;
      }
      assert.fail(`Tab does not reach ${selector}`);
    };
    await tab("#act-1 .play");
    await page.keyboard.press("Enter");
    await ticked(page, "#act-1", "agree");
    await page.keyboard.down("Shift");
    await page.keyboard.press("Tab");
    await page.keyboard.up("Shift");
    assert.equal(await page.evaluate(() => document.activeElement.className), "robot");
    await page.keyboard.press("PageDown");
    await page.keyboard.press("l");
    await page.waitForSelector('#act-1 .robot:focus[aria-pressed="true"]');
    await ticked(page, "#act-1", "lie");
    await tab("#act-1 .controls input");
    await page.keyboard.press("Home");
    await ticked(page, "#act-1", "steer");
    assert.equal(await page.$eval("#act-1 .answer", (answer) => answer.open), true);
  }));

test("act 2: seven neighbours agree, six do not", () =>
  on({}, async (page) => {
    await see(page, "#act-2");
    const { x, y } = await middle(page, "#act-2", 8);
    await page.mouse.click(x, y);
    await page.click("#act-2 .play");
    await ticked(page, "#act-2", "ignore");
    const again = await middle(page, "#act-2", 8);
    await page.mouse.click(again.x, again.y);
    const gap = (metres) =>
      page.$eval("#act-2 .controls input", (input, value) => {
        input.value = value;
        input.dispatchEvent(new Event("input"));
      }, metres);
    await gap("2.94");
    await ticked(page, "#act-2", "tear");
    await gap("2.8");
    await ticked(page, "#act-2", "find");
  }));

test("act 3: a filter that no lie breaks is found, and a lie that breaks one", () =>
  on({}, async (page) => {
    await see(page, "#act-3");
    const rows = await page.$$eval("#act-3 .log th[scope=row]", (heads) => heads.map((head) => head.textContent));
    const tries = async (name) => {
      const row = rows.indexOf(name) + 2;
      for (let column = 2; column <= 6; column += 1) {
        const button = `#act-3 .log tr:nth-of-type(${row}) td:nth-child(${column}) button`;
        await page.$eval(button, (element) => element.click());
        await page.waitForFunction((selector) => document.querySelector(selector).textContent !== "try", {}, button);
      }
      return page.$$eval(`#act-3 .log tr:nth-of-type(${row}) td`, (cells) => cells.map((cell) => cell.textContent[0]).join(""));
    };
    assert.deepEqual(rows.filter((name) => ["budget", "composed", "none"].includes(name)), ["budget", "composed", "none"]);
    assert.equal(await tries("budget"), "✓✓✓✓✓");
    assert.match(await tries("composed"), /^✓✓✓✗✗$/);
    assert.match(await tries("none"), /^✗✗✗✗✗$/);
    for (const task of ["apart", "hold", "breaks", "lies"]) await ticked(page, "#act-3", task);
  }));

test("act 4: a click makes a liar, a drag draws a robot, charts move, and time goes back", () =>
  on({}, async (page) => {
    await see(page, "#act-4");
    const { x, y } = await middle(page, "#act-4", 4);
    await page.mouse.click(x, y);
    await page.waitForSelector('#act-4 .robot:nth-child(4)[aria-pressed="true"]');
    await ticked(page, "#act-4", "lie");
    const picture = () => page.$$eval("#act-4 .plot canvas", (all) => all.map((canvas) => canvas.toDataURL()).join());
    const before = await picture();
    await page.click("#act-4 .play");
    const from = await middle(page, "#act-4", 7);
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x + 120, from.y - 160, { steps: 10 });
    await text(page, "#act-4 .digest", /a hand is in it/);
    await page.mouse.up();
    await ticked(page, "#act-4", "drag");
    await text(page, "#act-4 .digest", /^[0-9a-f]{16} after/);
    await text(page, "#act-4 .clock", /^[1-9]/);
    assert.notEqual(await picture(), before);
    await page.$eval("#act-4 .transport input", (input) => {
      input.value = "3";
      input.dispatchEvent(new Event("input"));
    });
    await text(page, "#act-4 .clock", /^0\./);
    assert.equal(await page.$eval("#act-4 .play", (button) => button.textContent), "Play");
  }));

test("the sandbox: ranks and another rule of consensus are chosen, shown and said", () =>
  on({}, async (page) => {
    await see(page, "#act-4");
    await more(page);
    const select = (label, value) => choose(page, label, value);
    const disabled = () => page.$$eval("#act-4 .more select", (all) => all.map((one) => one.disabled));
    await select("In the way", "discs");
    await select("Filter", "orca");
    assert.deepEqual(await disabled(), [true, false, true], "orca counts nobody, and takes no obstacles");
    assert.equal(await page.$eval("#act-4 .more .field:nth-of-type(5) select", (menu) => menu.value), "none");
    await select("Filter", "links");
    assert.deepEqual(await disabled(), [false, false, false]);
    await page.$eval("#act-4 .more .field input", (input) => {
      input.value = "40";
      input.dispatchEvent(new Event("input"));
    });
    await select("Who counts", "ranks");
    await page.waitForFunction(() => document.querySelector("#act-4 .robot:nth-child(40)")?.getAttribute("aria-label").includes("neighbours that count, rank"));
    await text(page, "#act-4 .banner-why", /Proved by ranks: this network survives any 2 liars around each robot/);
    await select("Robots agree by", "median");
    await text(page, "#act-4 .banner-why", /Robots agree by median, which needs/);
    assert.match(await page.$eval("#act-4 .digest", (digest) => digest.textContent), /^[0-9a-f]{16} after/);
  }));

test("where time stands still labels are right in the next frame, however fast touches follow each other", () =>
  on({}, async (page) => {
    await see(page, "#act-4");
    const labels = await page.$eval("#act-4 .robot", async (first) => {
      const frame = () => new Promise(requestAnimationFrame);
      const said = [];
      first.focus();
      for (let presses = 0; presses < 4; presses += 1) {
        first.dispatchEvent(new KeyboardEvent("keydown", { key: "l", bubbles: true }));
        await frame();
        await frame();
        said.push(first.getAttribute("aria-label").match(/liar|honest/)[0]);
      }
      return said;
    });
    assert.deepEqual(labels, ["honest", "liar", "honest", "liar"], "the first robot lies at the start");
  }));

test("what is to be read aloud is read, if later: the banner that stands at the end", () =>
  on({}, async (page) => {
    await see(page, "#act-4");
    await page.$eval("#act-4 .robot", (first) => first.focus());
    for (let presses = 0; presses < 2; presses += 1) {
      await page.keyboard.press("l");
      await page.keyboard.press("PageDown");
    }
    const last = await page.$eval("#act-4 .banner-main", (banner) => banner.textContent);
    await page.waitForFunction((last) => document.querySelector("#act-4 .unseen").textContent === last, { polling: 100 }, last);
  }));

test("a link restores the state, to the bit", () =>
  on({}, async (page) => {
    await see(page, "#act-4");
    const { x, y } = await middle(page, "#act-4", 5);
    await page.mouse.click(x, y);
    await page.click("#act-4 .play");
    await text(page, "#act-4 .clock", /^[1-9]/);
    await page.click("#act-4 .play");
    await page.click("#act-4 .share");
    await text(page, "#act-4 .note", /address bar/);
    const address = await page.evaluate(() => location.href);
    const [digest] = await text(page, "#act-4 .digest", /^[0-9a-f]{16} after \d+ /);
    await on({}, async (other) => assert.deepEqual(await text(other, "#act-4 .digest", new RegExp(`^${digest}`)), [digest]), address);
  }));

test("a broken link says so, and the page works all the same", async () => {
  const { page } = await opened(chrome, `${served.address}#s=AAAA`).catch(() => ({ page: null }));
  assert.ok(page, "the page lives");
  await text(page, "#act-4 .banner-main", /link/);
  await page.close();
});

const SCENARIOS = {
  "composed, understated": 'duration_s = 1.0\n[attack]\nlevel = { kind = "bias", bias = -2.5 }\n',
  "budget, many faces, lost messages":
    'duration_s = 1.5\nseed = 9\n[controller]\nkind = "budget"\n[attack]\nlevel = { kind = "faces" }\nvalue = { kind = "faces" }\n[network]\nloss = 0.4\ndelay_max_s = 0.02\n',
  "budget, twenty that wander": 'duration_s = 1.0\nseed = 5\n[team]\nrobots = 20\n[controller]\nkind = "budget"\n[motion]\nkind = "wander"\n',
  "orca, all to the middle": 'duration_s = 1.0\n[controller]\nkind = "orca"\n[motion]\nkind = "gather"\n',
};
for (const [name, scenario] of Object.entries(SCENARIOS)) {
  test(`the digest is that of the command line: ${name}`, async () => {
    const file = join(folder, "scenario.toml");
    writeFileSync(file, scenario);
    const { address, end } = await view(file);
    try {
      await on({}, async (page) => {
        await see(page, "#act-4");
        await page.click("#act-4 .play");
        const [, digest, ticks, all] = await text(page, "#act-4 .digest", /^([0-9a-f]{16}) after (\d+) of (\2) ticks/);
        const said = run(scenario);
        assert.equal(digest, said.digest);
        assert.equal(Number(ticks), said.ticks);
        assert.equal(ticks, all);
      }, address);
    } finally {
      end();
    }
  });
}

/** Saves the scenario of the sandbox, lets it end, and gives its text and the digest that the page shows. */
async function savedAndEnded(page) {
  const downloads = mkdtempSync(join(folder, "saved-"));
  const client = await page.createCDPSession();
  await client.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: downloads });
  await page.click("#act-4 .save");
  await text(page, "#act-4 .note", /^Saved as/);
  for (let waits = 0; !readdirSync(downloads).includes("page.toml") && waits < 100; waits += 1) {
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  const saved = readFileSync(join(downloads, "page.toml"), "utf8");
  await page.$eval("#act-4 .more .field:last-child input", (input) => {
    input.value = "4";
    input.dispatchEvent(new Event("input"));
  });
  if ((await page.$eval("#act-4 .play", (button) => button.textContent)) === "Play") await page.click("#act-4 .play");
  const [, digest] = await text(page, "#act-4 .digest", /^([0-9a-f]{16}) after (\d+) of (\2) ticks/);
  return { saved, digest };
}

/** Opens what the sandbox hides at first. */
const more = (page) =>
  page.$eval("#act-4 .more", (more) => {
    more.open = true;
  });

/** Chooses in the menu of the sandbox with that label. */
async function choose(page, label, value) {
  const found = await page.$$eval("#act-4 .field", (fields, label) => fields.findIndex((field) => field.querySelector("span").textContent === label), label);
  const menu = (await page.$$("#act-4 .field"))[found];
  await (await menu.$("select")).select(value);
}

test("a scenario that was saved after touches runs on the command line with the same digest", () =>
  on({}, async (page) => {
    await see(page, "#act-4");
    await page.click("#act-4 .play");
    await text(page, "#act-4 .clock", /^[1-9]/);
    const { x, y } = await middle(page, "#act-4", 9);
    await page.mouse.click(x, y);
    await more(page);
    await page.select("#act-4 .controls select", "composed");
    const { saved, digest } = await savedAndEnded(page);
    assert.equal(run(saved).digest, digest);
  }));

test("the sandbox: a team in a room stays in it, through touches, as on the command line", () =>
  on({}, async (page) => {
    await see(page, "#act-4");
    await more(page);
    await choose(page, "In the way", "room");
    await choose(page, "Robots want to", "outward");
    await page.click("#act-4 .play");
    await text(page, "#act-4 .clock", /^[3-9]/);
    const { x, y } = await middle(page, "#act-4", 9);
    await page.mouse.click(x, y);
    await page.waitForSelector('#act-4 .robot:nth-child(9)[aria-pressed="true"]');
    const { saved, digest } = await savedAndEnded(page);
    const { violations, ...rest } = run(saved);
    assert.equal(rest.digest, digest);
    assert.match(saved, /\[obstacles\]\nclearance_m = 0.15\nwalls = /);
    assert.equal(violations, 0);
  }));

test("without scripts it is an article", () =>
  on({ script: false }, async (page) => {
    const shown = await page.$$eval(".still svg", (pictures) => pictures.length);
    assert.ok(shown >= 9, `${shown} pictures`);
    assert.equal((await page.$$("details.answer")).length, 4);
  }));

test("a phone shows everything in its width", () =>
  on({ width: 360, height: 740 }, async (page) => {
    for (const act of ["#act-1", "#act-2", "#act-3", "#act-4"]) {
      await see(page, act);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
      assert.equal(wide, 0, act);
    }
  }));

/** Records a short run both ways; gives the files and what the lines of JSON of the Parquet file say. */
function recorded() {
  const file = join(folder, "recorded.toml");
  writeFileSync(file, 'name = "recorded"\nduration_s = 1.0\n[team]\nmalicious = [2]\n[attack]\nlevel = { kind = "bias", bias = 3.0 }\n');
  const [out, mcap, site] = ["recorded-out", "recorded.mcap", "recorded-site"].map((name) => join(folder, name));
  closeranks("run", file, "-q", "-o", out, "--record", mcap, "--overwrite");
  closeranks("view", join(out, "run.parquet"), "--export", site, "--overwrite");
  const lines = readFileSync(join(site, "moments.jsonl"), "utf8").trimEnd().split("\n");
  return { parquet: join(out, "run.parquet"), mcap, lines };
}

const clock = (page) => page.$eval("#recorded .clock", (time) => time.textContent);

/** The moment that the board of the recorded run shows, in words, and the label of a robot. */
async function shown(page) {
  return [await clock(page), await page.$eval("#recorded .robot:nth-child(2)", (robot) => robot.getAttribute("aria-label"))];
}

test("a recorded run is looked at and not touched, from Parquet and from MCAP alike", async () => {
  const { parquet, mcap, lines } = recorded();
  const last = JSON.parse(lines.at(-1));
  const seen = [];
  for (const file of [parquet, mcap]) {
    const one = await view(file);
    await on({}, async (page) => {
      await page.waitForFunction(() => document.querySelector("#recorded .note")?.textContent?.includes("201 moments; that is all of it"));
      await see(page, "#recorded");
      await page.waitForSelector("#recorded .robot:nth-child(11)");
      assert.equal(await clock(page), "0.00 s");
      await page.focus('#recorded input[type="range"]');
      await page.keyboard.press("End");
      await page.waitForFunction(() => document.querySelector("#recorded .clock").textContent === "1.00 s");
      await page.waitForFunction((degree) => document.querySelector("#recorded .robot:nth-child(2)").getAttribute("aria-label").includes(`liar, ${degree} neighbours`), {}, last.degree[1]);
      const before = await shown(page);
      // Neither a click nor a key changes anything.
      await page.focus("#recorded .robot:nth-child(3)");
      await page.keyboard.press("l");
      await page.keyboard.press("ArrowLeft");
      assert.equal(await page.$$eval('#recorded .robot[aria-pressed="true"]', (liars) => liars.length), 1);
      assert.deepEqual(await shown(page), before);
      // It plays from the beginning and stops at its end.
      await page.click("#recorded .play");
      await page.waitForFunction(() => document.querySelector("#recorded .play").textContent === "Play" && document.querySelector("#recorded .clock").textContent === "1.00 s");
      // The sandbox has its scenario.
      await text(page, "#act-4 .digest", /of 200 ticks$/);
      seen.push(before);
    }, one.address).finally(one.end);
  }
  assert.deepEqual(seen[0], seen[1]);
});

test("a live source is followed while it goes on, through lines of JSON", async () => {
  const { lines } = recorded();
  const one = await view("--live", { input: true });
  one.write(lines.slice(0, 3).join("\n") + "\n");
  const address = await one.address.catch((error) => assert.fail(error));
  await on({}, async (page) => {
    const says = (words) => page.waitForFunction((words) => document.querySelector("#recorded .note")?.textContent?.includes(words), {}, words);
    await says("2 moments; more may come");
    await see(page, "#recorded");
    await page.click("#recorded .play");
    one.write(lines.slice(3).join("\n") + "\n");
    await says("201 moments; more may come");
    await page.waitForFunction(() => document.querySelector("#recorded .clock").textContent === "1.00 s");
    one.close();
    await says("201 moments; that is all of it");
  }, address).finally(one.end);
});

test("labels and contrast: axe finds nothing", () =>
  on({ motion: "reduce" }, async (page) => {
    for (const act of ["#act-1", "#act-2", "#act-3", "#act-4"]) await see(page, act);
    await page.$$eval("details", (all) => all.forEach((one) => (one.open = true)));
    // The page allows no scripts but its own, so axe comes in by the debugger.
    await page.evaluate(readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8"));
    const found = await page.evaluate(() => window.axe.run(document));
    assert.deepEqual(found.violations.map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.html).slice(0, 3).join(" ")}`), []);
  }));
