// cannon-es: Quaternion, Vec3 and Transform, in double. Quaternions are x, y, z, w.
const {Quaternion, Transform, Vec3} = require("cannon-es");
const {serve} = require("./library.js");

const vector = (x, from = 0) => new Vec3(x[from], x[from + 1], x[from + 2]);
const quaternion = Q => new Quaternion(Q[0], Q[1], Q[2], Q[3]);
const program = call => `const {Quaternion, Vec3} = require("cannon-es");\n${call}`;

function exp3_quaternion(phi) {  // the axis must have length 1
  const axis = vector(phi), angle = axis.normalize();
  return new Quaternion().setFromAxisAngle(axis, angle).toArray();
}
// The angle is up to 2 pi: the rotation's is that of Q or -Q with w >= 0.
function log3_quaternion(Q) {
  const [axis, angle] = quaternion(Q[3] < 0 ? Q.map(x => -x) : Q).toAxisAngle();
  return axis.scale(angle).toArray();
}

serve("cannon-es", ["double"], {
  exp3_quaternion: [exp3_quaternion, program(
    "const axis = new Vec3({phi}), angle = axis.normalize();\nconsole.log(...new Quaternion().setFromAxisAngle(axis, angle).toArray());")],
  log3_quaternion: [log3_quaternion, program(
    "const q = new Quaternion(...[{Q}].map((x, i, Q) => Q[3] < 0 ? -x : x));\nconst [axis, angle] = q.toAxisAngle();\nconsole.log(...axis.scale(angle).toArray());")],
  rotate_point: x => quaternion(x).vmult(vector(x, 4)).toArray(),
  normalize: [Q => { const q = quaternion(Q); q.normalize(); return q.toArray(); }, program(
    "const q = new Quaternion({Q});\nq.normalize();\nconsole.log(...q.toArray());")],
  slerp: [x => quaternion(x).slerp(quaternion(x.subarray(4)), x[8]).toArray(), program(
    "console.log(...new Quaternion({Q0}).slerp(new Quaternion({Q1}), {t}).toArray());")],
  rotation_between: [x => new Quaternion().setFromVectors(vector(x), vector(x, 3)).toArray(), program(
    "console.log(...new Quaternion().setFromVectors(new Vec3({a}), new Vec3({b})).toArray());")],
});
