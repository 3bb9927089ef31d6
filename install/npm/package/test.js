// The laws as cases of a test runner.
"use strict";
const {spawn, spawnSync} = require("child_process");
const path = require("path"), url = require("url");
const {program, notStarted, commandOf, scalarsOf, environment} = require("./program.js");

const running = new Set();  // programs, which end with this process
function end() {
  for (const child of running) child.kill();
}
function start(file, args) {
  if (!running.size) {
    process.on("exit", end);
    for (const signal of ["SIGINT", "SIGTERM", "SIGHUP"]) process.on(signal, passOn);
  }
  const child = spawn(file, args, {stdio: ["ignore", "pipe", "pipe"], env: environment()});
  running.add(child);
  child.on("close", () => {
    running.delete(child);
    if (running.size) return;
    process.removeListener("exit", end);
    for (const signal of ["SIGINT", "SIGTERM", "SIGHUP"]) process.removeListener(signal, passOn);
  });
  return child;
}
/** Ends the programs and, unless the runner has its own handler, this process. */
function passOn(signal) {
  end();
  if (process.listenerCount(signal) > 1) return;
  process.removeListener(signal, passOn);
  process.kill(process.pid, signal);
}

/** An error whose message is what the program printed, and whose stack names the adapter alone. */
function failure(text, file) {
  const error = new Error(text);
  error.stack = `${text}\n    at ${path.resolve(file)}:1:1`;
  return error;
}

/** Runs `liecheck test` with these arguments. t: the context that node:test gives, if the runner is node:test. */
function run(file, args, t) {
  return new Promise((resolve, reject) => {
    const child = start(program(), args), text = {stdout: "", stderr: ""};
    for (const stream of ["stdout", "stderr"])
      child[stream].setEncoding("utf8").on("data", more => text[stream] += more);
    const signal = t && t.signal;
    if (signal && signal.addEventListener) signal.addEventListener("abort", () => child.kill());
    child.on("error", error => reject(notStarted(error)));
    child.on("close", (code, ended) => {
      const lines = text.stdout.split("\n--verbose shows")[0].split("\n");
      if (code !== 0) {
        const told = code === 1 || code === 3 ? lines.join("\n").trim() : "";
        const last = ended ? "" : text.stderr.trim().split("\n").pop();
        return reject(failure(told || last || `liecheck ended with ${ended || `exit code ${code}`}`, file));
      }
      const tell = (how, told) => told.length && t && typeof t[how] === "function" && t[how](told.join("; "));
      tell("todo", lines.filter(line => /^expected failure: (?!.*: 0 of \d+ cases: )/.test(line)));
      tell("diagnostic", lines.filter(line => line.startsWith("expected failure that passed: ")));
      resolve();
    });
  });
}

/** Flags of the program: {cases: 500, "no-probe": true} is --cases 500 --no-probe. */
function flagsOf(options) {
  const flags = [];
  for (const name of Object.keys(options))
    for (const value of [].concat(options[name])) flags.push(`--${name}`, ...(value === true ? [] : [String(value)]));
  return flags;
}

/**
 * A case for each law and scalar of which the adapter offers an operation: `for (const law of laws("./adapter.mjs"))
 * test(law.name, law.run)`. adapter: a path from the working folder, or a URL. options: flags of `liecheck test`.
 */
exports.laws = function laws(adapter, options = {}) {
  const file = adapter instanceof URL || /^file:/.test(adapter) ? url.fileURLToPath(adapter) : adapter;
  const command = commandOf(file), scalars = scalarsOf(file);
  const flags = flagsOf(Object.assign({cases: 1000, seed: 42}, options));
  const listed = spawnSync(program(), ["list", "--laws", "--adapter", command], {encoding: "utf8"});
  if (listed.error) throw notStarted(listed.error);
  if (listed.status !== 0) throw failure(listed.stderr.trim().split("\n").pop(), file);
  const names = listed.stdout.split("\n").filter(Boolean);
  if (!names.length) throw failure(`${file}: no law has only operations that it offers`, file);
  const cases = names.map(law => scalars.map(scalar => ({
    law, scalar, name: `${law} in ${scalar}`,
    // Without a named argument, so that a runner does not take it for a callback.
    run: (...context) => run(file, ["test", command, "--property", law, "--scalar", scalar, ...flags], context[0]),
  })));
  return [].concat(...cases);
};
