// Builds the page from src and the simulator (the WebAssembly module) into a folder: node build.mjs MODULE FOLDER
//
// The same sources and tools give the same bytes: nothing here depends on time, place or the order of files.

import { mkdir, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { build } from "esbuild";

const [module, folder] = process.argv.slice(2);
if (!module || !folder) {
  console.error("node build.mjs MODULE FOLDER");
  process.exit(2);
}
const here = dirname(fileURLToPath(import.meta.url));
const source = join(here, "src");
const common = { bundle: true, format: "esm", target: "es2022", logLevel: "warning", absWorkingDir: here };

const wasm = await readFile(module);
await rm(folder, { recursive: true, force: true });
await mkdir(folder, { recursive: true });
await build({ ...common, entryPoints: { page: join(source, "main.ts") }, outdir: folder, minify: true, legalComments: "eof" });
await writeFile(join(folder, "closeranks.wasm"), wasm);

// The pictures of the article, drawn by the simulator itself.
const drawn = join(tmpdir(), `closeranks-still-${process.pid}.mjs`);
await build({
  ...common,
  stdin: {
    contents: 'export { stills } from "./still"; export { Simulator } from "./model/simulator";',
    resolveDir: source,
    loader: "ts",
  },
  outfile: drawn,
  platform: "neutral",
  mainFields: ["module", "main"],
  loader: { ".css": "empty" },
});
const { stills, Simulator } = await import(pathToFileURL(drawn).href);
await rm(drawn);
let text = await readFile(join(source, "index.html"), "utf8");
for (const [act, picture] of Object.entries(stills(await Simulator.of(wasm)))) {
  const place = `<!-- still ${act} -->`;
  if (!text.includes(place)) throw new Error(`the article has no place for the picture of ${act}`);
  text = text.replace(place, () => picture);
}
await writeFile(join(folder, "index.html"), text);
