// The program liecheck, and how it is told to start an adapter in JavaScript.
"use strict";
const fs = require("fs"), path = require("path");
const {spawnSync} = require("child_process");

/** The program of this package, or what LIECHECK_PROGRAM names. Throws an error if it is not there. */
function program() {
  const named = process.env.LIECHECK_PROGRAM, file = named || path.join(__dirname, "bin", "liecheck");
  const here = `${process.platform}-${process.arch}`;
  if (!named && here !== "linux-x64")
    throw new Error(`the package has a program for linux-x64, and this is ${here}: build one from source, and name it in ` +
                    "LIECHECK_PROGRAM");
  try {
    fs.accessSync(file, fs.constants.X_OK);
  } catch (error) {
    const why = error.code === "ENOENT" ? "no such program, which LIECHECK_PROGRAM may name" : "not executable";
    throw new Error(`${named ? "LIECHECK_PROGRAM: " : ""}${file}: ${why}`);
  }
  return file;
}
/** Why the program, which is there, was not started. */
function notStarted({code}) {
  return new Error(`${program()}: not started (${code})${code === "ENOENT" ? ": it needs glibc" : ""}`);
}

/** A word of a shell. */
function quoted(word) {
  return /^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replace(/'/g, "'\\''")}'`;
}
/** The path from the working folder, where that is below it. */
function shown(file) {
  const relative = path.relative("", file);
  return relative.startsWith("..") ? file : relative;
}

/** What the command that serves an adapter has before its file. */
function serves() {
  return [process.execPath, shown(path.join(__dirname, "adapter.js")), ""].map(word => word && quoted(word)).join(" ");
}
/** The environment of the program, which prints the commands that a user of this package types. */
function environment() {
  return Object.assign({}, process.env, {LIECHECK_CALLED_AS: "npx liecheck", LIECHECK_SERVES: serves()});
}

/** The command that serves the adapter of a file. Throws an error, in words for its user, if there is none. */
function commandOf(file) {
  if (!fs.existsSync(file)) throw new Error(`${file}: no such file; paths are from ${process.cwd()}`);
  return serves() + quoted(shown(path.resolve(file)));
}

/** The scalars of the adapter of a file; says what may be wrong with it. Throws an error if it cannot be loaded. */
function scalarsOf(file) {
  const seconds = 15;
  const done = spawnSync(process.execPath, [path.join(__dirname, "adapter.js"), file, "--look"],
                         {encoding: "utf8", timeout: 1000 * seconds});
  if (done.error && done.error.code === "ETIMEDOUT") throw new Error(`${file}: it was not loaded in ${seconds} s`);
  try {
    const {scalars, notes} = JSON.parse(done.stdout);
    for (const note of notes) process.stderr.write(`liecheck: ${file}: ${note}\n`);
    return scalars;
  } catch (error) {
    const last = done.stderr.trim().split("\n").pop().replace(/^liecheck: /, "");
    const ended = done.signal ? `signal ${done.signal}` : `exit code ${done.status}`;
    if (done.status === 2 && last) throw new Error(last);
    throw new Error(`${file}: node ended with ${ended} before it was loaded${last ? `: ${last}` : ""}`);
  }
}

Object.assign(exports, {program, notStarted, commandOf, scalarsOf, environment});
