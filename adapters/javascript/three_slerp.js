// Quaternion.slerp of an older release of three.js, which the argument names: node three_slerp.js 0.93
const {serve} = require("./library.js");
const release = process.argv[2], name = `three-${release}`, {Quaternion} = require(name);

const quaternion = Q => new Quaternion(Q[0], Q[1], Q[2], Q[3]);

serve(name, ["double"], {
  slerp: [x => quaternion(x).slerp(quaternion(x.subarray(4)), x[8]).toArray(),
    `const {Quaternion} = require("${name}");\nconsole.log(...new Quaternion({Q0}).slerp(new Quaternion({Q1}), {t}).toArray());`],
});
