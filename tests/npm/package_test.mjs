// node package_test.mjs PROGRAM ROOT WORK [PARTS]
// Makes the package for npm, unpacks it into a project, and uses it there as its users do, without npm and network.
import assert from "assert";
import {execFileSync, spawn, spawnSync} from "child_process";
import fs from "fs";
import path from "path";

const [program, root, work] = process.argv.slice(2, 5).map(file => path.resolve(file)), some = new RegExp(process.argv[5] || "");
const project = path.join(work, "project"), installed = path.join(project, "node_modules/liecheck");
const environment = {...process.env};
for (const name of ["LIECHECK_PROGRAM", "NODE_TEST_CONTEXT", "NODE_OPTIONS"]) delete environment[name];

/** What a command in the project printed, and its exit code. */
function run(command, args, more = {}) {
  const {status, stdout, stderr} = spawnSync(command, args, {cwd: project, encoding: "utf8", env: {...environment, ...more}});
  return {status, stdout, stderr};
}
const liecheck = (args, more) => run(process.execPath, [path.join("node_modules/liecheck/liecheck.js"), ...args], more);
function write(name, text) {
  fs.writeFileSync(path.join(project, name), text);
}
/** The line of a refusal, which is all that is printed, with exit code 2. */
function refusal(args, more) {
  const {status, stdout, stderr} = liecheck(args, more);
  assert.strictEqual(status, 2, stderr);
  assert.strictEqual(stdout, "");
  assert.match(stderr, /^liecheck: [^\n]*\n$/);
  return stderr;
}
/** The cases of a test file: name -> {ok, todo, text}. */
function cases(file) {
  const {stdout, stderr} = run(process.execPath, ["--test", "--test-reporter=tap", file]);
  const all = {};
  for (const part of stdout.split(/^(?= *(?:not )?ok \d+ - )/m)) {
    const [, not, name, todo] = /^ *(not )?ok \d+ - (.*? in (?:double|float))( # TODO.*)?\n/.exec(part) || [];
    if (name) all[name] = {ok: !not, todo, text: part};
  }
  assert(Object.keys(all).length, stdout + stderr);
  return all;
}
const laws = (adapter, options) => `import test from "node:test";
import {laws} from "liecheck/test";
for (const law of laws("${adapter}", ${JSON.stringify(options)})) test(law.name, law.run);
`;
/** The processes that have all words in their command lines. */
function processes(...words) {
  return fs.readdirSync("/proc").filter(id => /^\d+$/.test(id) && Number(id) !== process.pid).filter(id => {
    try {
      const line = fs.readFileSync(`/proc/${id}/cmdline`, "latin1");
      return words.every(word => line.includes(word));
    } catch (error) {
      return false;  // it has ended
    }
  });
}
const pause = seconds => new Promise(resolve => setTimeout(resolve, 1000 * seconds));

const parts = {
  aPackageIsMadeAndUnpacked() {
    fs.rmSync(work, {recursive: true, force: true});
    fs.cpSync(path.join(root, "tests/npm/project"), project, {recursive: true});
    const make = version => spawnSync(process.execPath, [path.join(root, "install/npm/make_package.mjs"), "--program", program,
                                      "--version", version, "--out", work], {encoding: "utf8"});
    assert.match(make("one").stderr, /^make_package.mjs: --version: 'one' is no version such as 1.2.3\n$/);
    assert.strictEqual(make("1.2.3").stdout, `${path.join(work, "liecheck-1.2.3.tgz")}\n`);
    fs.mkdirSync(installed, {recursive: true});
    execFileSync("tar", ["xzf", path.join(work, "liecheck-1.2.3.tgz"), "-C", installed, "--strip-components=1"]);
    assert.strictEqual(JSON.parse(fs.readFileSync(path.join(installed, "package.json"))).version, "1.2.3");
    assert.match(fs.readFileSync(path.join(installed, "index.d.ts"), "utf8"), /OperationName = "exp3_quaternion" \| .*"tree_rnea"/);
  },

  theCommandPrintsTheFourFaults() {
    const {status, stdout} = liecheck(["test", "./adapter.mjs", "--cases", "500"]);
    assert.strictEqual(status, 1);
    const rows = stdout.match(/^\d+ {2}.*/gm).sort().map(row => row.replace(/^\d+ */, ""));
    assert.strictEqual(rows.length, 4, stdout);
    for (const fault of [/^exp3_quaternion .*digits lost/, /^exp3_matrix .*NaN or Inf/, /^left_jacobian6 .coupling.*digits lost/,
                         /^log3_quaternion .rotation vector.: wrong branch/])
      assert(rows.some(row => fault.test(row)), `no ${fault} in ${stdout}`);
    const replay = stdout.match(/replay +npx liecheck (replay raw.log_oracle\S*) --adapter (\S*)\n/);
    assert.strictEqual(replay[2], "adapter.mjs");
    assert.match(liecheck([...replay[1].split(" "), "--adapter", replay[2]]).stdout, /wrong branch/);
    assert.match(liecheck([...replay[1].split(" "), "--adapter=adapter.mjs"]).stdout, /wrong branch/);
  },

  nodeTestHasARedTestForEachFault() {
    const all = cases("laws.test.mjs");
    const red = {"exp_oracle in double": /NaN or Inf in double/, "jacobian_oracle in double": /left_jacobian6 .coupling/,
                 "log_oracle in double": /log3_quaternion .rotation vector.: wrong branch/, "small_angle_branches in double": /exp3_quaternion .jump/};
    assert.deepStrictEqual(Object.keys(all).filter(name => !all[name].ok).sort(), Object.keys(red));
    for (const name of Object.keys(red)) assert.match(all[name].text, red[name]);
    assert.match(all["exp_oracle in double"].text, /error: [^\n]*\n *verdict fail: .*\n *\n *1 {2}exp3_quaternion .*\n *where .*\n *perhaps .*\n *example /);
    for (const name of ["pose_group in double", "any_norm in double"]) assert(all[name].ok);
  },

  anExpectedFailureIsToDo() {
    write("one.mjs", `export {log3_quaternion, normalize, name, conventions} from "./adapter.mjs";`);
    write("mylib.limits", `version = 3\nsubject = mylib_javascript\n[expected]
log3_quaternion, rotation vector, pi-theta 0..1e-5 = the sign near pi, https://example.org/1\n`);
    write("expected.mjs", laws("one.mjs", {cases: 300, limits: "mylib.limits"}));
    const all = cases("expected.mjs");
    assert(all["log_oracle in double"].ok);
    assert.match(all["log_oracle in double"].todo, /# TODO expected failure: mylib_javascript, log3_quaternion rotation vector .*the sign near pi/);
    assert(all["any_norm in double"].ok && !all["any_norm in double"].todo);
    write("expected.mjs", laws("one.mjs", {cases: 300, limits: "no.limits"}));
    assert.match(cases("expected.mjs")["log_oracle in double"].text, /no\.limits/);
  },

  aCrashOfTheLibraryIsARedTest() {
    write("crash.mjs", `export {normalize} from "./adapter.mjs";
export function exp3_quaternion([x, y, z]) {
  if (x > 2) process.kill(process.pid, "SIGKILL");
  const t = Math.hypot(x, y, z), s = t > 0 ? Math.sin(t / 2) / t : 0.5;
  return [s * x, s * y, s * z, Math.cos(t / 2)];
}`);
    write("crashes.mjs", laws("crash.mjs", {cases: 30, "no-hard-cases": true}));
    const all = cases("crashes.mjs");
    assert.match(all["exp_oracle in double"].text, /^ *not ok .*[^]*exp3_quaternion .*crashed in double/);
    assert.match(all["exp_oracle in double"].text, /the adapter ended by signal 9 .Killed/);
  },

  async ctrlCLeavesNothing() {
    const slow = `slow_${process.pid}.mjs`;
    write(slow, `export const normalize = Q => {
  for (const start = Date.now(); Date.now() - start < 50;);
  return Q.map(x => x / Math.hypot(...Q));
};`);
    write("slow.test.mjs", laws(slow, {cases: 100000}));
    for (const signal of ["SIGINT", "SIGTERM"]) {
      const child = spawn(process.execPath, ["--test", "slow.test.mjs"], {cwd: project, env: environment, detached: true, stdio: "ignore"});
      const ended = new Promise(resolve => child.on("exit", resolve));
      for (let i = 0; i < 300 && !processes(slow, "--property").length; ++i) await pause(0.1);
      assert(processes(slow, "--property").length, "the program was not started");
      process.kill(signal === "SIGINT" ? -child.pid : child.pid, signal);
      await ended;
      for (let i = 0; i < 100 && processes(slow).length; ++i) await pause(0.1);
      assert.deepStrictEqual(processes(slow), [], signal);
    }
  },

  whatIsWrongWithAnAdapterIsSaidInALine() {
    const of = text => {
      write("bad.mjs", text);
      return refusal(["test", "bad.mjs"]);
    };
    assert.match(refusal(["test", "./nowhere.mjs"]), /\.\/nowhere\.mjs: no such file; paths are from /);
    assert.match(of("export const exp3_quaternoin = x => x, hat = x => x;"), /bad\.mjs: .*operations\.md\), exp3_quaternoin \(is it exp3_quaternion\?\)\n/);
    assert.match(of("\nexport const exp6 ="), /bad\.mjs:2: SyntaxError: /);
    assert.match(of('import "no-such-package"; export const exp6 = x => x;'), /'no-such-package'/);
    assert.match(of("process.exit(3); export const exp6 = x => x;"), /bad\.mjs: node ended with exit code 3 before it was loaded/);
    assert.match(of("await new Promise(() => {}); export const exp6 = x => x;"), /bad\.mjs: node ended with exit code 0 before/);
    assert.match(of("export const exp6 = 1;"), /bad\.mjs: exp6 is no function/);
    assert.match(of('export const scalars = ["half"], exp6 = x => x;'), /bad\.mjs: scalars is \["half"\], and must be /);
    assert.match(of('export const conventions = {quaternion: "zyxw"}, exp6 = x => x;'), /"zyxw" is no convention/);
    assert.match(refusal(["list"], {LIECHECK_PROGRAM: "/nowhere"}), /LIECHECK_PROGRAM: \/nowhere: no such program/);
    write("foreign", "#!/no/such/loader\n");
    fs.chmodSync(path.join(project, "foreign"), 0o755);
    assert.match(refusal(["list"], {LIECHECK_PROGRAM: "./foreign"}), /\.\/foreign: not started .ENOENT.: it needs glibc/);
    write("platform.cjs", 'Object.defineProperty(process, "platform", {value: "darwin"});');
    assert.match(refusal(["list"], {NODE_OPTIONS: "--require ./platform.cjs"}), /for linux-x64, and this is darwin-x64: /);
  },

  argumentsAreOneArrayAndRefusedInputsAreNotTimed() {
    write("bad.mjs", `export const slerp = (a, b, t) => a;
export const euler_to_quaternion = ([order]) => { if (order < 12) throw new RangeError("no such order"); return [0, 0, 0, 1]; };`);
    assert.match(liecheck(["adapter", "check", "bad.mjs"]).stderr, /bad.mjs: slerp takes more than one argument, and gets all numbers in one array\n/);
    const {status, stdout, stderr} = liecheck(["cost", "--adapter", "bad.mjs", "--op", "euler_to_quaternion", "--for", "1s"]);
    assert.strictEqual(status, 0, stdout + stderr);
    assert.match(stdout, /euler_to_quaternion/);
  },

  whatIsWrongWithAResultIsSaidInWords() {
    write("bad.mjs", `import {refuse} from "liecheck";
export const exp3_quaternion = ([x, y, z]) => [x, y, z], normalize = async Q => Q, quaternion_inverse = Q => [Q[0], undefined, 1, 1];
export const compose = X => X.a.b, relative_angle = x => "1", exp3_matrix = phi => refuse("not\\ntoday"), expp6 = x => x;
export const log3_quaternion = Q => process.exit(3);`);
    const {stdout, stderr, status} = liecheck(["adapter", "check", "bad.mjs"]);
    assert.strictEqual(status, 1);
    assert.match(stderr, /^liecheck: bad.mjs: no operation: expp6 \(is it exp6\?\)\n/);
    for (const words of ["crashed: exp3_quaternion returned 3 numbers, and its result has 4", "crashed: normalize returned a promise, and must return 4 numbers",
                         "crashed: quaternion_inverse returned undefined as number 1 of its result, from 0", "crashed: TypeError: .* (bad.mjs:3)",
                         "crashed: relative_angle returned 1, and must return 1 numbers", "the input is refused: not today",
                         "crashed: process.exit(3) was called"])
      assert.match(stdout, new RegExp(words.replace(/[()]/g, "\\$&")));
    const all = liecheck(["test", "bad.mjs", "--property", "exp_oracle", "--cases", "200"]);
    assert.match(all.stdout, /\n\d {2}exp3_quaternion .*crashed in double\n/);
  },

  classesFloatsTreesAndPosesAreServed() {
    write("float.cjs", `class MyLib { static exp3_quaternion(phi) {
  if (phi.constructor !== Float32Array) throw new RangeError("no float");
  const t = Math.hypot(...phi), s = t > 0 ? Math.sin(t / 2) / t : 0.5;
  console.log("not an answer");
  process.stdout.write("nor this");
  return Float32Array.of(s * phi[0], s * phi[1], s * phi[2], Math.cos(t / 2));
} }
MyLib.scalars = ["float"];
module.exports = MyLib;`);
    const float = liecheck(["test", "float.cjs", "--cases", "300"]);
    assert.match(float.stdout, /^verdict pass; MyLib unknown\n/, float.stdout + float.stderr);
    write("object.mjs", `export default class Ours { static conventions = {quaternion: "wxyz"};
  quaternion_inverse(q) { return this.conjugate(q); }
  conjugate(q) { return [q[0], -q[1], -q[2], -q[3]]; }
}`);
    assert.match(liecheck(["adapter", "check", "object.mjs"]).stdout, /^Ours .*: 1 function\nquaternion_inverse +double +agrees$/m);
    const {stdout} = liecheck(["adapter", "check", path.join(root, "tests/npm/slides.mjs")]);
    for (const line of [/^slides .*: 2 functions$/m, /^frame_pose +double +agrees$/m, /^act_point +double +agrees$/m]) assert.match(stdout, line);
  },

  theSizesOfPosesAreThoseOfTheOperations() {
    write("sizes.cjs", 'console.log(JSON.stringify(Array.from(require("./node_modules/liecheck/operations.js").sizes.keys(), o => [o, require("./node_modules/liecheck/operations.js").posesOf(o)])));');
    const poses = text => (text.match(/\((R|R_Y) \[1\], (p|p_Y) \[m\]\)/g) || []).length;
    const rows = Object.fromEntries(liecheck(["list", "--operations"]).stdout.split("\n").filter(row => row.startsWith("| "))
      .map(row => row.split(/(?<!\\)\|/)).map(([, name, , takes, returns]) => [name.trim(), [poses(takes || ""), poses(returns || "")]]));
    for (const [operation, numbers] of JSON.parse(run(process.execPath, ["sizes.cjs"]).stdout))
      if (!operation.startsWith("check_")) assert.deepStrictEqual(numbers, rows[operation], operation);
  },
};

for (const [name, part] of Object.entries(parts)) {
  if (name !== "aPackageIsMadeAndUnpacked" && !some.test(name)) continue;
  const start = Date.now();
  await part();
  console.log(`${name}: ${((Date.now() - start) / 1000).toFixed(1)} s`);
}
