// How many numbers each operation takes and gives: from the lists of liecheck's header for C.
"use strict";
const fs = require("fs"), path = require("path");

/** The entries of a list: [name, ...numbers]. It is beside this file, or where the repository has it. */
function entries(list) {
  const files = [".", "../../../properties/adapters"].map(folder => path.join(__dirname, folder, list));
  const text = fs.readFileSync(files.find(fs.existsSync) || files[0], "utf8");
  const lines = text.matchAll(/^LIECHECK_(?:MODEL_)?OPERATION\((.*)\)/gm);
  return Array.from(lines, line => line[1].split(", ")).map(([name, ...n]) => [name, ...n.map(Number)]);
}

/** Operation -> the numbers of its arguments and of its result. */
const sizes = new Map([["check_quaternion", [4, 0]], ["check_rotation", [9, 0]]]);
for (const [name, ...numbers] of entries("liecheck_operations.inc")) sizes.set(name, numbers);
/** Operation on a tree or robot -> the same as a function of a model, which has nq and nv. */
const modelSizes = new Map();
for (const [name, q, v, one, rq, rv, rvv, r1] of entries("liecheck_model_operations.inc"))
  modelSizes.set(name, ({nq, nv}) => [q * nq + v * nv + one, rq * nq + rv * nv + rvv * nv * nv + r1]);

/** How many poses an operation takes and gives. Each has five numbers fewer where poses are (p, Q). */
function posesOf(operation) {
  const named = {exp6: [0, 1], compose: [2, 1], inverse: [1, 1]}[operation];
  return named || (/^(log6|act_.*|adjoint|coadjoint|transport_covariance)$/.test(operation) ? [1, 0] : [0, 0]);
}

/** The least number of letters to insert, leave out or replace that makes `b` of `a`. */
function distance(a, b) {
  let row = Array.from({length: b.length + 1}, (_, j) => j);
  for (let i = 1; i <= a.length; ++i) {
    const next = [i];
    for (let j = 1; j <= b.length; ++j)
      next[j] = Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] === b[j - 1] ? 0 : 1));
    row = next;
  }
  return row[b.length];
}
/** The operation whose name is nearest to `name`, and how far it is. */
function nearest(name) {
  const far = Array.from(sizes.keys()).concat(Array.from(modelSizes.keys()))
    .map(operation => ({operation, distance: distance(name.toLowerCase(), operation)}));
  return far.reduce((least, one) => one.distance < least.distance ? one : least);
}

Object.assign(exports, {sizes, modelSizes, posesOf, nearest});
