// Pictures of every act at three widths, and how smoothly fifty robots move: node test/pictures.mjs FOLDER

import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { browser, middle, opened, see, text, view } from "./browser.mjs";

const folder = process.argv[2] ?? "pictures";
mkdirSync(folder, { recursive: true });
const chrome = await browser();
const served = process.env["ADDRESS"] ? { address: process.env["ADDRESS"], end: () => undefined } : await view();

const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** Something to see in each act. */
const PLAYS = {
  "#act-1": async (page) => {
    const { x, y } = await middle(page, "#act-1", 3);
    await page.mouse.click(x, y);
    await page.click("#act-1 .play");
    await text(page, "#act-1 .clock", /^[3-9]/);
  },
  "#act-2": async (page) => {
    await page.$eval("#act-2 .controls input", (input) => {
      input.value = "2.94";
      input.dispatchEvent(new Event("input"));
    });
    await text(page, "#act-2 .log", /stuck/);
  },
  "#act-3": async (page) => {
    await page.select("#act-3 .controls select", "composed");
    await page.select("#act-3 .controls label:nth-child(2) select", "swing");
    await text(page, "#act-3 .clock", /^([4-9]|10)/);
  },
  "#act-4": async (page) => {
    await page.click("#act-4 .play");
    const { x, y } = await middle(page, "#act-4", 7);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 150, y - 120, { steps: 5 });
    await pause(1500);
    await page.mouse.up();
  },
};

for (const width of [360, 800, 1280]) {
  const { page, wrong } = await opened(chrome, served.address, { width, height: 860 });
  await page.screenshot({ path: join(folder, `top-${width}.png`) });
  for (const [act, play] of Object.entries(PLAYS)) {
    await see(page, act);
    await play(page);
    await pause(400);
    const section = await page.$(act);
    await section?.screenshot({ path: join(folder, `${act.slice(1)}-${width}.png`) });
    await page.$$eval(`${act} .play`, (buttons) => buttons.forEach((button) => button.textContent === "Pause" && button.click()));
  }
  if (wrong.length > 0) console.error(width, wrong);
  await page.close();
}
const still = await opened(chrome, served.address, { width: 1280, script: false });
await still.page.screenshot({ path: join(folder, "without-scripts.png"), fullPage: true });
await still.page.close();

await chrome.close();
served.end();
