// The process protocol of docs/adapters.md, for the JavaScript adapters of this folder.
const fs = require("fs"), versions = require("./package.json").dependencies;

function read(size) {  // exactly size bytes; null at the end of the input
  const bytes = Buffer.alloc(size);
  for (let at = 0; at < size;) {
    const n = fs.readSync(0, bytes, at, size - at);
    if (n === 0) return null;
    at += n;
  }
  return bytes;
}
function readLine() {
  let line = "";
  for (let c = read(1); c; c = read(1)) {
    if (c[0] === 10) return line;
    line += String.fromCharCode(c[0]);
  }
  return null;
}
function write(bytes) {
  for (let at = 0; at < bytes.length;) at += fs.writeSync(1, bytes, at);
}

// The processor time [ns] of passes over all calls. What they return is kept, so that they are not left out. Each loop has a
// text of its own and runs 40 ms before it is timed, so that V8 compiles it for the calls that it makes.
const loops = {};
function timed(name, calls, passes) {
  if (!loops[name]) {
    loops[name] = new Function("calls", "passes", "keep", `// ${name}
      const start = process.cpuUsage();
      for (let pass = 0; pass < passes; ++pass) for (let i = 0; i < calls.length; ++i) keep.last = calls[i]();
      const {user, system} = process.cpuUsage(start);
      return 1000 * (user + system);`);
    for (const start = Date.now(); Date.now() - start < 40;) loops[name](calls, 10, loops);
  }
  return loops[name](calls, passes, loops) || 1;
}

// Answers calls until the input ends. functions: operation -> [function, arguments, results, program]. A function takes
// the numbers of one input, a Float32Array or a Float64Array, and returns those of its result; one that throws a
// RangeError refuses the input. The program, which may be left out, is the same call for a user of the library, with
// {phi} and so on for the numbers. own: operation -> a function that makes of an input a call in the library's own types,
// which is timed instead.
exports.serve = function (name, scalars, functions, own = {}) {
  const subject = name.replace(/^@(.*)\/core$/, "$1").replace(/.*\//, "").replace(".", "_"), version = (versions[name] || "1").replace(/.*@/, "");
  console.log = console.warn = console.error;  // what the library prints must not come between the answers
  readLine();  // "liecheck 1"
  const operations = Object.fromEntries(Object.keys(functions).map(operation => [operation, scalars]));
  const programs = Object.entries(functions).filter(([, f]) => f[3]).map(([operation, f]) => [operation, f[3]]);
  const source = Object.fromEntries(programs), times = Object.fromEntries(Object.keys(functions).map(operation => [operation, own[operation] ? "one, own types" : "one"]));
  write(Buffer.from(JSON.stringify({protocol: 1, name: subject, version, operations, source, timed: times}) + "\n"));
  for (let call = readLine(); call; call = readLine()) {  // "call exp3_quaternion double 128", or "time one exp3_quaternion double 256 10"
    const words = call.split(" "), how = words[0] === "time" ? words.splice(1, 1)[0] : "";
    const [, operation, scalar, count, passes] = words, n = Number(count), [f, size, resultSize] = functions[operation];
    const Numbers = scalar === "float" ? Float32Array : Float64Array;
    const bytes = read(n * size * Numbers.BYTES_PER_ELEMENT);
    const inputs = new Numbers(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
    if (how) {
      const call = how === "nothing" ? x => () => x : own[operation] || (x => () => f(x));
      const calls = Array.from({length: n}, (_, i) => call(inputs.slice(i * size, (i + 1) * size)));
      write(Buffer.from(`timed ${timed(`${how} ${operation} ${scalar}`, calls, Number(passes))}\n`));
      continue;
    }
    const results = new Numbers(n * resultSize), status = Buffer.alloc(n);
    let reason = "";
    for (let i = 0; i < n; ++i) {
      try {
        results.set(f(inputs.slice(i * size, (i + 1) * size)), i * resultSize);
      } catch (error) {
        if (!(error instanceof RangeError)) throw error;
        status[i] = 1;
        reason = ` ${error.message}`;
      }
    }
    write(Buffer.concat([Buffer.from(`done ${n}${reason}\n`), status, Buffer.from(results.buffer)]));
  }
};
