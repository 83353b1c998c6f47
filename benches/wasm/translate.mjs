// Times the WebAssembly translator under Node: one line of JSON in ({formula, rounds}), one line out ({seconds, states, sets, jumps}).
// Behind load.mjs.

function write(text) {
  const bytes = new TextEncoder().encode(text);
  const place = exports.room(bytes.length);
  new Uint8Array(exports.memory.buffer).set(bytes, place);
  if (exports.read() !== 1) throw new Error(`no formula: ${text}`);
}

// Until the optimising compiler has taken over.
write("G (a -> (b U c)) & (G F d -> G F e)");
for (let i = 0; i < 100; i++) exports.run();

for await (const line of questions) {
  const { formula, rounds } = JSON.parse(line);
  write(formula);
  let [seconds, states] = [Infinity, 0];
  for (let i = 0; i < rounds; i++) {
    const start = performance.now();
    states = exports.run();
    seconds = Math.min(seconds, (performance.now() - start) / 1000);
  }
  console.log(JSON.stringify({ seconds, states, sets: exports.sets(), jumps: exports.jumps() }));
}
