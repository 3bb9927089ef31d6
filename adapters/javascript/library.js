// The adapters of this folder: libraries of package.json, or one of its own, served with their names and versions.
const {serve} = require("./adapter.js"), versions = require("./package.json").dependencies;

// functions: operation -> function, or [function, program]. own: operation -> a function that makes of an input a call in
// the library's own types, which is timed instead.
exports.serve = function (library, scalars, functions, own = {}) {
  const name = library.replace(/^@(.*)\/core$/, "$1").replace(/.*\//, "").replace(".", "_");
  serve({name, version: (versions[library] || "1").replace(/.*@/, ""), scalars, own, ...functions});
};
