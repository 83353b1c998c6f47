// Times the WebAssembly kernel under Node: one line of JSON in ({what, hidden, rows, count}), one line out (seconds for one).
// Behind load.mjs.

// What prepares each measure (its answer names what to run it on) and what runs it.
const measures = {
  update: { prepare: ({ hidden, rows }) => exports.prepare(8, 2, hidden, rows), run: exports.updates },
  act: { prepare: () => exports.prepare(8, 2, 64, 64), run: exports.acts },
  step: { prepare: () => exports.prepare_trainer(), run: exports.steps },
  step_update: { prepare: () => exports.prepare_step_update(), run: exports.updates },
};
const prepared = new Map();

for await (const line of questions) {
  const { count, ...measure } = JSON.parse(line);
  const { prepare, run } = measures[measure.what];
  const key = JSON.stringify(measure);
  if (!prepared.has(key)) {
    prepared.set(key, prepare(measure));
    run(prepared.get(key), 100); // until the optimising compiler has taken over
  }
  const start = performance.now();
  run(prepared.get(key), count);
  console.log((performance.now() - start) / 1000 / count);
}
