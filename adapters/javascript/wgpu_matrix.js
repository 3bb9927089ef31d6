// wgpu-matrix: quat, mat3, mat4 and vec3, in float, and those with the letter d, in double. Quaternions are x, y, z, w,
// matrices column by column, those of 3 x 3 with a fourth number in each column.
const all = require("wgpu-matrix");
const {serve} = require("./library.js");

const of = x => x instanceof Float32Array
  ? {mat3: all.mat3, mat4: all.mat4, quat: all.quat, vec3: all.vec3}
  : {mat3: all.mat3d, mat4: all.mat4d, quat: all.quatd, vec3: all.vec3d};
const matrix = X => X.constructor.of(X[0], X[3], X[6], 0, X[1], X[4], X[7], 0, X[2], X[5], X[8], 0, X[9], X[10], X[11], 1);
const pose = M => [M[0], M[4], M[8], M[1], M[5], M[9], M[2], M[6], M[10], M[12], M[13], M[14]];
const rows = M => [M[0], M[4], M[8], M[1], M[5], M[9], M[2], M[6], M[10]];

// The axis must have length 1.
function exp(phi) {
  const {quat, vec3} = of(phi);
  return quat.fromAxisAngle(vec3.normalize(phi), vec3.length(phi));
}
// The angle is up to 2 pi: the rotation's is that of Q or -Q with w >= 0.
function log(Q) {
  const {angle, axis} = of(Q).quat.toAxisAngle(Q[3] < 0 ? Q.map(x => -x) : Q);
  return [...axis].map(x => angle * x);
}
const program = call => `const all = require("wgpu-matrix"), d = "{scalar}" === "float" ? "" : "d";
const mat3 = all["mat3" + d], quat = all["quat" + d], vec3 = all["vec3" + d], A = d ? Float64Array : Float32Array;
${call}`;
const print = "const {angle, axis} = quat.toAxisAngle(q[3] < 0 ? q.map(x => -x) : q);\nconsole.log(...[...axis].map(x => angle * x));";

serve("wgpu-matrix", ["float", "double"], {
  exp3_quaternion: [exp, program("const v = A.of({phi});\nconsole.log(...quat.fromAxisAngle(vec3.normalize(v), vec3.length(v)));")],
  exp3_matrix: phi => rows(of(phi).mat3.fromQuat(exp(phi))),
  log3_quaternion: [log, program("const q = A.of({Q});\n" + print)],
  log3_matrix: [R => log(of(R).quat.fromMat(R.constructor.of(R[0], R[3], R[6], 0, R[1], R[4], R[7], 0, R[2], R[5], R[8], 0))), program(
    "const R = A.of({R});\nconst q = quat.fromMat(mat3.create(R[0], R[3], R[6], R[1], R[4], R[7], R[2], R[5], R[8]));\n" + print)],
  compose: x => pose(of(x).mat4.multiply(matrix(x.slice(0, 12)), matrix(x.slice(12)))),
  inverse: x => pose(of(x).mat4.inverse(matrix(x))),
  act_point: x => of(x).vec3.transformMat4(x.slice(12), matrix(x)),
  rotate_point: x => of(x).vec3.transformQuat(x.slice(4), x.slice(0, 4)),
  normalize: [Q => of(Q).quat.normalize(Q), program("console.log(...quat.normalize(A.of({Q})));")],
  relative_angle: [x => [of(x).quat.angle(x.slice(0, 4), x.slice(4))], program(
    "console.log(quat.angle(A.of({Q0}), A.of({Q1})));")],
  slerp: [x => of(x).quat.slerp(x.slice(0, 4), x.slice(4, 8), x[8]), program(
    "console.log(...quat.slerp(A.of({Q0}), A.of({Q1}), {t}));")],
  rotation_between: [x => of(x).quat.rotationTo(x.slice(0, 3), x.slice(3)), program(
    "console.log(...quat.rotationTo(A.of({a}), A.of({b})));")],
});
