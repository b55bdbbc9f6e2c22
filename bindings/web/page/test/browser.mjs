// What the tests share: the program that serves the page, and a browser that opens it.

import assert from "node:assert/strict";
import { spawn, execFileSync } from "node:child_process";
import { dirname, join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";
import puppeteer from "puppeteer-core";

export const root = join(dirname(fileURLToPath(import.meta.url)), "../../../..");
export const program = process.env["CLOSERANKS"] ?? join(root, "target/debug/closeranks");
const chromium = process.env["CHROMIUM"] ?? "/usr/bin/chromium";

/**
 * Starts `closeranks view` with arguments; gives its address and a way to end it. With `{ input: true }` last, lines can be written to it,
 * and the address comes once it has read enough of them.
 */
export async function view(...words) {
  const { input = false } = typeof words.at(-1) === "object" ? words.pop() : {};
  const child = spawn(program, ["view", ...words], { stdio: [input ? "pipe" : "ignore", "pipe", "inherit"] });
  const lines = createInterface({ input: child.stdout });
  const address = Promise.race([
    new Promise((resolve) => lines.once("line", resolve)),
    new Promise((_, reject) => child.once("exit", (code) => reject(new Error(`view ended with ${code}`)))),
  ]).then((line) => {
    assert.match(line, /^http:\/\/127\.0\.0\.1:\d+\/$/);
    return line;
  });
  const end = () => child.kill();
  if (input) return { address, end, write: (text) => child.stdin.write(text), close: () => child.stdin.end() };
  return { address: await address, end };
}

/** Runs the program; a broken law is no failure here. */
export function closeranks(...words) {
  try {
    return execFileSync(program, words, { encoding: "utf8" });
  } catch (error) {
    if (error.status !== 1) throw error;
    return error.stdout;
  }
}

/** What `closeranks run` says of a scenario. */
export function run(text) {
  try {
    return JSON.parse(execFileSync(program, ["run", "-", "--json"], { input: text, encoding: "utf8" }));
  } catch (error) {
    // A broken law is exit code 1, and the numbers are there all the same.
    if (error.status !== 1) throw error;
    return JSON.parse(error.stdout);
  }
}

export function browser() {
  return puppeteer.launch({ executablePath: chromium, headless: true, args: ["--no-sandbox", "--force-color-profile=srgb"] });
}

/** Opens the page and notes everything that should not happen. */
export async function opened(chrome, address, { width = 1280, height = 900, script = true, motion = "no-preference", clock = 0 } = {}) {
  const page = await chrome.newPage();
  const wrong = [];
  page.on("console", (message) => ["error", "warn"].includes(message.type()) && wrong.push(message.text()));
  page.on("pageerror", (error) => wrong.push(String(error)));
  page.on("requestfailed", (request) => {
    // Chromium tells its debugger of a response that came bit by bit and ended well that it was aborted. The page says itself how it ended.
    const streamed = request.url().endsWith("/moments.jsonl") && request.failure()?.errorText === "net::ERR_ABORTED";
    if (!streamed) wrong.push(`failed: ${request.url()}`);
  });
  page.on("request", (request) => {
    const { protocol, origin } = new URL(request.url());
    if (!["data:", "blob:"].includes(protocol) && origin !== new URL(address).origin) wrong.push(`foreign: ${request.url()}`);
  });
  await page.setViewport({ width, height });
  await page.setJavaScriptEnabled(script);
  await page.emulateMediaFeatures([{ name: "prefers-reduced-motion", value: motion }]);
  if (clock > 0) {
    await page.evaluateOnNewDocument((hertz) => {
      const real = window.requestAnimationFrame.bind(window);
      const start = performance.now();
      let frame = 0;
      let seen = -1;
      // All who ask in one frame are told the same time.
      window.requestAnimationFrame = (then) =>
        real((now) => {
          if (now !== seen) frame += 1;
          seen = now;
          then(start + (1000 * frame) / hertz);
        });
    }, clock);
  }
  page.setDefaultTimeout(120_000);
  await page.goto(address);
  if (script) await page.waitForSelector("html.alive");
  return { page, wrong };
}

/** Waits until a selector finds an element whose text a pattern matches; gives the match. */
export async function text(page, selector, pattern) {
  const found = await page.waitForFunction(
    (selector, source) => [...document.querySelectorAll(selector)].map((one) => one.textContent.match(new RegExp(source))).find(Boolean),
    { polling: 100 },
    selector,
    pattern.source,
  );
  return found.jsonValue();
}

/** Brings an act in sight. */
export async function see(page, act) {
  await page.$eval(`${act} .stage`, (element) => element.scrollIntoView({ block: "start", behavior: "instant" }));
  await page.waitForFunction((act) => document.querySelector(`${act} .robot`) !== null, {}, act);
}

/** Waits until a task is ticked. */
export function ticked(page, act, task) {
  return page.waitForSelector(`${act} [data-task="${task}"].done`);
}

/** The middle of a robot, px. */
export function middle(page, act, robot) {
  return page.$eval(`${act} .robot:nth-child(${robot})`, (element) => {
    const { left, top, width, height } = element.getBoundingClientRect();
    return { x: left + width / 2, y: top + height / 2 };
  });
}
