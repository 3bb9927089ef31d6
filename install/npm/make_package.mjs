// node make_package.mjs --program FILE --version VERSION --out DIR
// Writes DIR/liecheck-VERSION.tgz, which npm installs: the files of the folder package, liecheck's lists of operations and
// license, and the program. The program stands in this package, and not in one for each platform that npm chooses from, as
// there is one platform and a package from a file has everything.
import {execFileSync} from "child_process";
import fs from "fs";
import os from "os";
import path from "path";
import {fileURLToPath} from "url";
import {gzipSync} from "zlib";

const here = path.dirname(fileURLToPath(import.meta.url)), root = path.join(here, "../..");

function given(args) {
  const flags = {};
  for (let i = 0; i < args.length; i += 2) flags[args[i]] = args[i + 1];
  const {"--program": program, "--version": version, "--out": out, ...others} = flags;
  for (const flag of ["--program", "--version", "--out"]) if (!flags[flag]) throw new Error(`${flag} is missing`);
  if (Object.keys(others).length) throw new Error(`${Object.keys(others)[0]}: unknown`);
  if (!/^\d+\.\d+\.\d+(-[\w.-]+)?$/.test(version)) throw new Error(`--version: '${version}' is no version such as 1.2.3`);
  if (!fs.existsSync(program) || !fs.statSync(program).isFile()) throw new Error(`--program: ${program}: no such file`);
  return {program, version, out};
}

/** The lines of a file, with `from` replaced by `to`. Throws an error if it does not have it. */
function edit(file, from, to) {
  const text = fs.readFileSync(file, "utf8");
  if (!text.includes(from)) throw new Error(`${file}: has no '${from}'`);
  fs.writeFileSync(file, text.replace(from, to));
}

function make({program, version, out}, folder) {
  const to = path.join(folder, "package");
  for (const sub of ["", "bin"]) fs.mkdirSync(path.join(to, sub));
  const lists = ["operations", "model_operations"].map(list => path.join(root, `properties/adapters/liecheck_${list}.inc`));
  const own = fs.readdirSync(path.join(here, "package")).map(file => path.join(here, "package", file));
  for (const file of [...own, ...lists, path.join(root, "LICENSE")]) fs.copyFileSync(file, path.join(to, path.basename(file)));
  fs.copyFileSync(program, path.join(to, "bin/liecheck"));
  for (const file of ["liecheck.js", "bin/liecheck"]) fs.chmodSync(path.join(to, file), 0o755);
  edit(path.join(to, "package.json"), '"name": "liecheck",', `"name": "liecheck",\n  "version": "${version}",`);
  const names = lists.map(list => fs.readFileSync(list, "utf8")).join("").match(/(?<=^LIECHECK_\w+\()\w+/gm);
  edit(path.join(to, "index.d.ts"), "OperationName = string;", `OperationName = ${names.map(n => `"${n}"`).join(" | ")};`);
  const tar = execFileSync("tar", ["--sort=name", "--owner=0", "--group=0", "--numeric-owner", "--mode=u=rwX,go=rX",
                            "--mtime=@0", "-C", folder, "-cf", "-", "package"],
                           {maxBuffer: 2 ** 31});
  fs.mkdirSync(out, {recursive: true});
  const file = path.join(out, `liecheck-${version}.tgz`);
  fs.writeFileSync(`${file}.part`, gzipSync(tar));
  fs.renameSync(`${file}.part`, file);
  return file;
}

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "liecheck-npm-"));
try {
  console.log(make(given(process.argv.slice(2)), folder));
} catch (error) {
  console.error(`make_package.mjs: ${error.message}`);
  process.exitCode = 2;
} finally {
  fs.rmSync(folder, {recursive: true});
}
