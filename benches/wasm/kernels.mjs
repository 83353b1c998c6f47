// Times the WebAssembly kernel under Node: one line of JSON in (hidden, rows, fastest, count), one line out (microseconds an update).
// usage: node kernels.mjs MODULE.wasm
import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";

const module = await WebAssembly.compile(readFileSync(process.argv[2]));
// The timed functions call nothing outside; imports that other parts of the crate's dependencies declare are not there.
const imports = {};
for (const { module: from, name } of WebAssembly.Module.imports(module)) {
  (imports[from] ??= {})[name] = () => {
    throw new Error(`${from}.${name} was called`);
  };
}
const instance = await WebAssembly.instantiate(module, imports);
const { prepare, updates, acts } = instance.exports;
let prepared = "";

for await (const line of createInterface({ input: process.stdin })) {
  const { hidden, rows, fastest, count, act } = JSON.parse(line);
  const wanted = `${hidden} ${rows} ${fastest}`;
  if (wanted !== prepared) {
    prepare(hidden, rows, fastest);
    updates(Math.max(20, count / 4)); // until the optimising compiler has taken over
    prepared = wanted;
  }
  const start = performance.now();
  (act ? acts : updates)(count);
  console.log((1000 * (performance.now() - start)) / count);
}
