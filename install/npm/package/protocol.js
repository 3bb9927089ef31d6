// The process protocol, version 1, for libraries in JavaScript: docs/adapters.md of liecheck.
"use strict";
const fs = require("fs");

let input = Buffer.alloc(0);  // what was read and is not used yet

/** Waits a millisecond where the library has made a pipe one that does not block; other errors are thrown. */
function wait(error) {
  if (error.code !== "EAGAIN") throw error;
  Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, 1);
}
/** Reads more of the standard input; false at its end. */
function more() {
  const bytes = Buffer.allocUnsafe(1 << 16);
  for (;;) {
    try {
      const n = fs.readSync(0, bytes, 0, bytes.length, null);
      input = Buffer.concat([input, bytes.slice(0, n)]);
      return n > 0;
    } catch (error) {
      wait(error);
    }
  }
}
/** The next `size` bytes, or null at the end of the input. */
function read(size) {
  while (input.length < size)
    if (!more()) return null;
  const bytes = input.slice(0, size);
  input = input.slice(size);
  return bytes;
}
function readLine() {
  for (let from = 0;;) {
    const end = input.indexOf(10, from);
    if (end >= 0) return read(end + 1).toString().slice(0, -1);
    from = input.length;
    if (!more()) return null;
  }
}
function write(bytes) {
  for (let at = 0; at < bytes.length;) {
    try {
      at += fs.writeSync(1, bytes, at);
    } catch (error) {
      wait(error);
    }
  }
}

// The processor time [ns] of passes over all calls. What they return is kept, so that they are not left out. Each loop
// has a text of its own and runs 40 ms before it is timed, so that V8 compiles it for the calls that it makes.
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

/** The `size` numbers of what an operation returned. NaN is a number, which liecheck judges. */
function numbersOf(result, size, operation) {
  if (size === 0) return [];
  let numbers = typeof result === "number" ? [result] : result;
  if (Array.isArray(numbers)) numbers = numbers.flat(Infinity);
  else if (numbers && typeof numbers.length !== "number" && numbers[Symbol.iterator]) numbers = Array.from(numbers);
  if (typeof numbers !== "object" || !numbers || typeof numbers.length !== "number") {
    const what = numbers && numbers.then ? "a promise" : String(numbers);
    throw new Error(`${operation} returned ${what}, and must return ${size} numbers`);
  }
  if (numbers.length !== size)
    throw new Error(`${operation} returned ${numbers.length} numbers, and its result has ${size}`);
  for (let i = 0; i < size; ++i)
    if (typeof numbers[i] !== "number")
      throw new Error(`${operation} returned ${String(numbers[i])} as number ${i} of its result, from 0`);
  return numbers;
}

/** Why a call has no result, in a line. An error of the code itself has its name and its place. */
function reasonOf(error) {
  const words = (error instanceof Error ? error.message : String(error)).replace(/\s+/g, " ").trim();
  if (!(error instanceof Error) || error instanceof RangeError || error.constructor === Error) return words;
  // The first file, which is no part of node.
  const place = /^\s+at (?:.*\()?(?:file:\/\/)?\/(?:.*\/)?([^/()]+:\d+):\d+\)?$/m.exec(error.stack || "");
  return `${error.name}: ${words}${place ? ` (${place[1]})` : ""}`;
}

/** Throws the error with which an operation refuses its input. */
function refuse(reason) {
  throw new RangeError(reason);
}

/** The line that begins the answers. */
function descriptionOf({name, version, scalars, conventions, trees, own, functions, programs}) {
  const operations = {}, timed = {};
  for (const operation of Object.keys(functions)) {
    operations[operation] = scalars;
    timed[operation] = own[operation] ? "one, own types" : "one";
  }
  return JSON.stringify({protocol: 1, name, version, operations, conventions, trees, source: programs, timed}) + "\n";
}

/** As many calls, of those alone that do not refuse their input, as they may some orders of Euler angles. */
function answered(calls) {
  let why = null;
  const some = calls.filter(call => {
    try {
      call();
      return true;
    } catch (error) {
      if (!(error instanceof RangeError)) throw error;
      why = error;
      return false;
    }
  });
  if (!some.length) throw why;
  return calls.map((_, i) => some[i % some.length]);
}

/**
 * Answers calls until the input ends. Of a subject: functions: operation -> a function of the numbers of one input, a
 * Float32Array or a Float64Array, which returns those of its result; a RangeError refuses the input, any other error is a
 * crash; null if it is one of the class Model, which is made of a model. sizeOf: operation -> how many numbers these are, for a model.
 * programs: operation -> the same call for a user of the library, with {phi} and so on for the numbers. own: operation ->
 * a function that makes of an input a call in the library's own types, which is timed instead.
 */
function answer(subject) {
  Object.defineProperty(process, "stdout", {get: () => process.stderr});  // what the library prints is no answer
  process.exit = code => {
    throw new Error(`process.exit(${code}) was called`);
  };
  let model = null, description = {};
  readLine();  // "liecheck 1"
  write(Buffer.from(descriptionOf(subject)));
  for (let line = readLine(); line !== null; line = readLine()) {
    const words = line.split(" ");
    if (words[0] === "model") {
      let said = "done";
      try {
        description = JSON.parse(line.slice(6));
        model = new subject.Model(description);
      } catch (error) {
        said = `refused ${reasonOf(error)}`;
      }
      write(Buffer.from(said + "\n"));
      continue;
    }
    // "call exp3_quaternion double 128", or "time one exp3_quaternion double 256 10"
    const how = words[0] === "time" ? words.splice(1, 1)[0] : "", [, operation, scalar, count, passes] = words;
    const f = subject.functions[operation] || (x => model[operation](x)), n = Number(count);
    const [size, resultSize] = subject.sizeOf[operation](description);
    const Numbers = scalar === "float" ? Float32Array : Float64Array;
    const bytes = read(n * size * Numbers.BYTES_PER_ELEMENT);
    if (!bytes) return;
    const inputs = new Numbers(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
    const input = i => inputs.slice(i * size, (i + 1) * size);
    if (how) {
      const call = how === "nothing" ? x => () => x : subject.own[operation] || (x => () => f(x));
      const calls = answered(Array.from({length: n}, (_, i) => call(input(i))));
      write(Buffer.from(`timed ${timed(`${how} ${operation} ${scalar}`, calls, Number(passes))}\n`));
      continue;
    }
    const results = new Numbers(n * resultSize), status = Buffer.alloc(n);
    let reason = "", crash = "";
    for (let i = 0; i < n && !crash; ++i) {
      try {
        results.set(numbersOf(f(input(i)), resultSize, operation), i * resultSize);
      } catch (error) {
        if (!(error instanceof RangeError)) crash = reasonOf(error);
        status[i] = 1;
        reason = ` ${reasonOf(error)}`;
      }
    }
    if (crash) write(Buffer.from(`crashed ${crash}\n`));
    else write(Buffer.concat([Buffer.from(`done ${n}${reason}\n`), status, Buffer.from(results.buffer)]));
  }
}

exports.answer = answer;
exports.reasonOf = reasonOf;
exports.refuse = refuse;
