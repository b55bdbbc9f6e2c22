// What a frame costs with fifty robots that wander under budget: node test/frames.mjs [FRAMES]
//
// The page is given a clock that goes on by a sixtieth of a second a frame, so that it does in each frame what it does on an idle machine
// at sixty frames a second, whatever else runs here. What is counted is CPU time of the thread that draws; and, for what it is worth, the
// frames that came in a real second.

import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { browser, opened, view } from "./browser.mjs";

const FRAMES = Number(process.argv[2] ?? 600);
const WARM = 120;

const served = await view();
const chrome = await browser();
const { page, wrong } = await opened(chrome, served.address, { clock: 60 });
await page.$eval("#act-4", (act) => act.scrollIntoView());
await page.$eval("#act-4 .more", (more) => (more.open = true));
await page.$eval("#act-4 .more .field input", (input) => {
  input.value = "50";
  input.dispatchEvent(new Event("input"));
});
await page.select("#act-4 .controls label:nth-child(3) select", "wander");
await page.click("#act-4 .play");

const frames = (count) =>
  page.evaluate(
    (count) =>
      new Promise((resolve) => {
        const start = performance.now();
        const turn = () => ((count -= 1) > 0 ? requestAnimationFrame(turn) : resolve(performance.now() - start));
        requestAnimationFrame(turn);
      }),
    count,
  );
await frames(WARM);
const robots = await page.$$eval("#act-4 .hands button", (buttons) => buttons.length);
const trace = join(await mkdtemp(join(tmpdir(), "closeranks-frames-")), "trace.json");
await page.tracing.start({ path: trace, categories: ["toplevel", "devtools.timeline", "cc"] });
const wall_ms = await frames(FRAMES);
await page.tracing.stop();

/** CPU time of events of these names on the thread that draws, for each frame, ms. */
function spent(events, names) {
  const names_of = events.filter(({ name }) => name === "thread_name");
  const threads = names_of.filter(({ args }) => args.name === "CrRendererMain").map(({ pid, tid }) => `${pid} ${tid}`);
  const mine = events.filter((event) => event.ph === "X" && names.includes(event.name) && threads.includes(`${event.pid} ${event.tid}`));
  return mine.reduce((sum, event) => sum + (event.tdur ?? 0), 0) / 1000 / FRAMES;
}
const { traceEvents } = JSON.parse(await readFile(trace, "utf8"));
await rm(dirname(trace), { recursive: true });
const all = spent(traceEvents, ["ThreadControllerImpl::RunTask"]);
const parts = Object.entries({ scripts: ["FireAnimationFrame"], styles: ["UpdateLayoutTree"], layout: ["Layout"], paint: ["PrePaint", "Paint", "Layerize"], canvas: ["Commit"] });
console.log(
  `${robots} robots, ${FRAMES} frames: ${all.toFixed(1)} ms of the CPU for each, of the 16.7 that sixty a second leave ` +
    `(${parts.map(([name, events]) => `${name} ${spent(traceEvents, events).toFixed(1)}`).join(", ")}); ` +
    `${((1000 * FRAMES) / wall_ms).toFixed(0)} frames a second on this machine as it is`,
);
if (wrong.length > 0) console.error(wrong);
await chrome.close();
served.end();
