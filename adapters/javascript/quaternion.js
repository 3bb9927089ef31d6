// quaternion.js: Quaternion, in double. Its numbers are w, x, y, z; matrices are rows.
const {Quaternion} = require("quaternion");
const {serve} = require("./library.js");

const of = ([x, y, z, w]) => new Quaternion(w, x, y, z);
const numbers = q => [q.x, q.y, q.z, q.w];
const nearer = Q => of(Q[3] < 0 ? Q.map(x => -x) : Q);  // the rotation's logarithm is that of Q or -Q with w >= 0
const program = call => `const {Quaternion} = require("quaternion");\n${call}`;
const log = "const v = q.log();\nconsole.log(2 * v.x, 2 * v.y, 2 * v.z);";

function orderOf(number) {
  const name = number % 2 === 1 ? ["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"][(number - 1) / 2] : undefined;
  if (!name) throw new RangeError("toEuler has no such order");
  return name;
}

// exp and log are those of quaternions, exp(0, phi/2) and (0, phi/2).
const exp = ([x, y, z]) => new Quaternion(0, x / 2, y / 2, z / 2).exp();
function twice(q) {
  const {x, y, z} = q.log();
  return [2 * x, 2 * y, 2 * z];
}

serve("quaternion", ["double"], {
  exp3_quaternion: [phi => numbers(exp(phi)), program(
    "const q = new Quaternion(0, ...[{phi}].map(x => x / 2)).exp();\nconsole.log(q.x, q.y, q.z, q.w);")],
  exp3_matrix: [phi => exp(phi).toMatrix(), program(
    "const q = new Quaternion(0, ...[{phi}].map(x => x / 2)).exp();\nconsole.log(...q.toMatrix());")],
  log3_quaternion: [Q => twice(nearer(Q)), program(
    "const [x, y, z, w] = [{Q}].map((a, i, Q) => Q[3] < 0 ? -a : a);\nconst q = new Quaternion(w, x, y, z);\n" + log)],
  log3_matrix: [R => twice(nearer(numbers(Quaternion.fromMatrix([...R])))), program(
    "const r = Quaternion.fromMatrix([{R}]), q = r.w < 0 ? r.neg() : r;\n" + log)],
  rotate_point: [x => of(x).rotateVector([...x.slice(4)]), program(
    "const [x, y, z, w] = [{Q}];\nconsole.log(...new Quaternion(w, x, y, z).rotateVector([{p}]));")],
  normalize: [Q => numbers(of(Q).normalize()), program(
    "const [x, y, z, w] = [{Q}];\nconst q = new Quaternion(w, x, y, z).normalize();\nconsole.log(q.x, q.y, q.z, q.w);")],
  slerp: [x => numbers(of(x).slerp(of(x.subarray(4)))(x[8])), program(
    "const of = (x, y, z, w) => new Quaternion(w, x, y, z);\nconst q = of({Q0}).slerp(of({Q1}))({t});\nconsole.log(q.x, q.y, q.z, q.w);")],
  rotation_between: [x => numbers(Quaternion.fromVectors([...x.slice(0, 3)], [...x.slice(3)])), program(
    "const q = Quaternion.fromVectors([{a}], [{b}]);\nconsole.log(q.x, q.y, q.z, q.w);")],
  // The angles in the order of the axes, which are those of the body.
  euler_to_quaternion: x => numbers(Quaternion.fromEuler(x[1], x[2], x[3], orderOf(x[0]))),
  euler_from_quaternion: [x => of(x.subarray(1)).toEuler(orderOf(x[0])), program(
    `const [x, y, z, w] = [{Q}], order = ["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"][({order} - 1) / 2];\nconsole.log(...new Quaternion(w, x, y, z).toEuler(order));`)],
});
