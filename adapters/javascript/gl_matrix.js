// gl-matrix: quat, mat3, mat4 and vec3. Quaternions are x, y, z, w, matrices column by column. A function writes to
// an array that the caller gives, and so computes in float or double.
const {glMatrix, mat3, mat4, quat, vec3} = require("gl-matrix");
const {serve} = require("./library.js");

glMatrix.setMatrixArrayType(Array);  // of the arrays that gl-matrix makes itself

const like = (x, size) => new x.constructor(size);
const columns = R => R.constructor.of(R[0], R[3], R[6], R[1], R[4], R[7], R[2], R[5], R[8]);  // also back to rows
const matrix = X => X.constructor.of(X[0], X[3], X[6], 0, X[1], X[4], X[7], 0, X[2], X[5], X[8], 0, X[9], X[10], X[11], 1);
const pose = M => [M[0], M[4], M[8], M[1], M[5], M[9], M[2], M[6], M[10], M[12], M[13], M[14]];

// quat.exp and quat.ln are those of quaternions: exp(phi/2, 0) and (phi/2, 0).
function exp3_quaternion([x, y, z], out) {
  return quat.exp(out, [x / 2, y / 2, z / 2, 0]);
}
// quat.ln is the logarithm of the quaternion, so Q and -Q have two. The rotation's is that of the one with w >= 0.
function log3_quaternion(Q) {
  const q = like(Q, 4).map((_, i) => Q[3] < 0 ? -Q[i] : Q[i]);
  const [x, y, z] = quat.ln(like(Q, 4), q);
  return [2 * x, 2 * y, 2 * z];
}

function axis_angle_from_quaternion(Q) {
  const axis = like(Q, 3), angle = quat.getAxisAngle(axis, Q);
  return [...axis, angle];
}

const program = call => `const {glMatrix, mat3, quat} = require("gl-matrix");
const A = "{scalar}" === "float" ? Float32Array : Array;
glMatrix.setMatrixArrayType(A);
${call}`;
const print = "console.log(...A.from(quat.ln(new A(4), Q)).slice(0, 3).map(x => 2 * x));";

serve("gl-matrix", ["float", "double"], {
  exp3_quaternion: [phi => exp3_quaternion(phi, like(phi, 4)),
    program("console.log(...quat.exp(new A(4), A.of(...A.of({phi}).map(x => x / 2), 0)));")],
  exp3_matrix: [phi => columns(mat3.fromQuat(like(phi, 9), exp3_quaternion(phi, like(phi, 4)))),
    program("const Q = quat.exp(new A(4), A.of(...A.of({phi}).map(x => x / 2), 0));\nconsole.log(...mat3.transpose(new A(9), mat3.fromQuat(new A(9), Q)));")],
  log3_quaternion: [log3_quaternion,
    program("const Q = A.of({Q}).map((x, i, q) => q[3] < 0 ? -x : x);\n" + print)],
  log3_matrix: [R => log3_quaternion(quat.fromMat3(like(R, 4), columns(R))),
    program(`const q = quat.fromMat3(new A(4), mat3.transpose(new A(9), A.of({R})));\nconst Q = q.map(x => q[3] < 0 ? -x : x);\n${print}`)],
  compose: x => pose(mat4.multiply(like(x, 16), matrix(x.slice(0, 12)), matrix(x.slice(12)))),
  inverse: x => pose(mat4.invert(like(x, 16), matrix(x))),
  act_point: x => vec3.transformMat4(like(x, 3), x.slice(12), matrix(x)),
  rotate_point: x => vec3.transformQuat(like(x, 3), x.slice(4), x.slice(0, 4)),
  normalize: [Q => quat.normalize(like(Q, 4), Q), program("console.log(...quat.normalize(new A(4), A.of({Q})));")],
  relative_angle: [x => [quat.getAngle(x.slice(0, 4), x.slice(4))],
    program("console.log(quat.getAngle(A.of({Q0}), A.of({Q1})));")],
  slerp: [x => quat.slerp(like(x, 4), x.slice(0, 4), x.slice(4, 8), x[8]),
    program("console.log(...quat.slerp(new A(4), A.of({Q0}), A.of({Q1}), {t}));")],
  rotation_between: [x => quat.rotationTo(like(x, 4), x.slice(0, 3), x.slice(3)),
    program("console.log(...quat.rotationTo(new A(4), A.of({a}), A.of({b})));")],
  quaternion_from_matrix: [R => quat.fromMat3(like(R, 4), columns(R)),
    program("console.log(...quat.fromMat3(new A(4), mat3.transpose(new A(9), A.of({R}))));")],
  matrix_from_quaternion: [Q => columns(mat3.fromQuat(like(Q, 9), Q)),
    program("console.log(...mat3.transpose(new A(9), mat3.fromQuat(new A(9), A.of({Q}))));")],
  quaternion_product: x => quat.multiply(like(x, 4), x.slice(0, 4), x.slice(4)),
  quaternion_inverse: Q => quat.invert(like(Q, 4), Q),
  axis_angle_from_quaternion: [axis_angle_from_quaternion,
    program("const axis = new A(3), angle = quat.getAxisAngle(axis, A.of({Q}));\nconsole.log(...axis, angle);")],
  quaternion_from_axis_angle: x => quat.setAxisAngle(like(x, 4), x.slice(0, 3), x[3]),
  angle_between: [x => [vec3.angle(x.slice(0, 3), x.slice(3))],
    program("console.log(require(\"gl-matrix\").vec3.angle(A.of({a}), A.of({b})));")],
  slerp_directions: [x => vec3.slerp(like(x, 3), x.slice(0, 3), x.slice(3, 6), x[6]),
    program("console.log(...require(\"gl-matrix\").vec3.slerp(new A(3), A.of({a}), A.of({b}), {t}));")],
});
