#!/usr/bin/env node
// The command liecheck. It runs the program, to which an argument that names a file of JavaScript is an adapter.
"use strict";
const fs = require("fs"), os = require("os");
const {spawn} = require("child_process");
const {program, notStarted, commandOf, scalarsOf, environment} = require("./program.js");

/** An argument as the program takes it. */
function translated(argument) {
  const [, flag, file] = /^(--adapter=)?(.*\.[cm]?[jt]s)$/.exec(argument) || [];
  if (!file || (/\s/.test(file) && !fs.existsSync(file))) return argument;
  const command = commandOf(file);
  scalarsOf(file);
  return (flag || "") + command;
}

function fail(error) {
  process.stderr.write(`liecheck: ${error.message}\n`);
  process.exit(2);
}

function main() {
  const child = spawn(program(), process.argv.slice(2).map(translated), {stdio: "inherit", env: environment()});
  child.on("error", error => fail(notStarted(error)));
  // A terminal gives its signals to the program, too. The program decides what they end.
  for (const signal of ["SIGINT", "SIGQUIT"]) process.on(signal, () => {});
  for (const signal of ["SIGTERM", "SIGHUP"]) process.on(signal, () => child.kill(signal));
  child.on("exit", (code, signal) => process.exit(signal ? 128 + os.constants.signals[signal] : code));
}

try {
  main();
} catch (error) {
  fail(error);
}
