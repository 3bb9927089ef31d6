// What an adapter in JavaScript offers. Run as a program, `node adapter.js FILE` answers the calls of liecheck with it,
// and `node adapter.js FILE --look` prints its scalars and what may be wrong with it, as JSON.
"use strict";
const fs = require("fs"), path = require("path"), url = require("url");
const {spawnSync} = require("child_process");
const {sizes, modelSizes, posesOf, nearest} = require("./operations.js");
const {answer, reasonOf, refuse} = require("./protocol.js");

/** The functions of an object and of its class that have nearly the name of an operation: "exp (is it exp6?)". */
function misspelt(adapter) {
  const names = [];
  for (let o = adapter; o && o !== Object.prototype && o !== Function.prototype; o = Object.getPrototypeOf(o))
    names.push(...Object.getOwnPropertyNames(o));
  return names.filter(name => typeof adapter[name] === "function" && !sizes.has(name) && !modelSizes.has(name))
    .map(name => [name, nearest(name)]).filter(([name, near]) => 2 * near.distance <= name.length)
    .map(([name, {operation}]) => `${name} (is it ${operation}?)`);
}

/** The settings and functions of an adapter, an object or a class with static functions; `named` if it has no name. */
function subjectOf(adapter, named) {
  const {scalars = ["double"], conventions, trees, own = {}, Model, version = "unknown"} = adapter;
  const name = typeof adapter.name === "string" && adapter.name ? adapter.name : named;
  if (typeof version !== "string") throw new Error(`version is ${version}, and must be a text`);
  if (!Array.isArray(scalars) || !scalars.length || scalars.some(s => s !== "double" && s !== "float"))
    throw new Error(`scalars is ${JSON.stringify(scalars)}, and must be ["double"], ["float"] or ["double", "float"]`);
  const functions = {}, programs = {}, sizeOf = {};
  const fewer = conventions && conventions["pose form"] === "quaternion" ? 5 : 0;
  for (const [operation, numbers] of sizes) {
    if (adapter[operation] === undefined) continue;
    const [f, program] = [].concat(adapter[operation]);
    if (typeof f !== "function") throw new Error(`${operation} is no function`);
    if (program !== undefined) programs[operation] = program;
    functions[operation] = f.bind(adapter);
    sizeOf[operation] = () => numbers.map((n, i) => n - fewer * posesOf(operation)[i]);
  }
  for (const [operation, numbers] of modelSizes) {
    if (typeof Model !== "function" || typeof Model.prototype[operation] !== "function") continue;
    functions[operation] = null;
    sizeOf[operation] = numbers;
  }
  if (!Object.keys(functions).length)
    throw new Error(["it exports no function named as an operation (docs/operations.md)"].concat(misspelt(adapter)).join(", "));
  return {name, version, scalars, conventions, trees, own, Model, functions, programs, sizeOf};
}

/** Answers calls of liecheck on the standard input until it ends, with the functions of an adapter. */
function serve(adapter) {
  answer(subjectOf(adapter, "adapter"));
}

/** An object of a class whose functions are not static, made without arguments, with what is static in the class. */
function objectOf(Class) {
  const object = new Class();
  for (const name of Object.getOwnPropertyNames(Class))
    if (!(name in object) && name !== "length" && name !== "prototype") object[name] = Class[name];
  return object;
}

/** The adapter of a file: what it exports by default, or all that it exports. */
async function load(file) {
  const module = await import(url.pathToFileURL(file).href);
  const one = module.default;
  if (typeof one === "function" && Object.getOwnPropertyNames(one.prototype || {}).some(name => sizes.has(name))) return objectOf(one);
  return one && (typeof one === "object" || typeof one === "function") ? one : module;
}

async function main(file, look) {
  const exit = process.exit;
  try {
    const adapter = await load(path.resolve(file));
    const subject = subjectOf(adapter, path.parse(file).name.replace(/\W/g, "_"));
    if (!look) answer(subject);
    else {
      const many = Object.keys(subject.functions).filter(name => subject.functions[name] && subject.functions[name].length > 1);
      const notes = misspelt(adapter).map(name => `no operation: ${name}`)
        .concat(many.map(name => `${name} takes more than one argument, and gets all numbers in one array`));
      fs.writeSync(1, JSON.stringify({scalars: subject.scalars, notes}));
    }
    exit(0);
  } catch (error) {
    const checked = error instanceof SyntaxError ? spawnSync(process.execPath, ["--check", file]).stderr : "";
    const [, line] = /^.*:(\d+)\n/.exec(checked) || [];
    fs.writeSync(2, `liecheck: ${file}${line ? `:${line}` : ""}: ${reasonOf(error)}\n`);
    exit(2);
  }
}
if (require.main === module) main(...process.argv.slice(2));

exports.refuse = refuse;
exports.serve = serve;
