// Loads the WebAssembly module that is the last argument; the script of a benchmark follows, and uses `exports` and `questions`.
import { readFileSync } from "node:fs";
import { createInterface } from "node:readline";

const module = await WebAssembly.compile(readFileSync(process.argv.at(-1)));
// What is timed calls nothing outside; imports that other parts of the crate's dependencies declare are not there.
const imports = {};
for (const { module: from, name } of WebAssembly.Module.imports(module)) {
  (imports[from] ??= {})[name] = () => {
    throw new Error(`${from}.${name} was called`);
  };
}
const { exports } = await WebAssembly.instantiate(module, imports);
const questions = createInterface({ input: process.stdin });
