// math.gl: Quaternion, Matrix4 and Vector3, in double. Quaternions are x, y, z, w, matrices column by column.
const {Matrix4, Quaternion, Vector3} = require("@math.gl/core");
const {serve} = require("./library.js");

const matrix = X => new Matrix4([X[0], X[3], X[6], 0, X[1], X[4], X[7], 0, X[2], X[5], X[8], 0, X[9], X[10], X[11], 1]);
const pose = M => [M[0], M[4], M[8], M[1], M[5], M[9], M[2], M[6], M[10], M[12], M[13], M[14]];
const vector = (x, from = 0) => new Vector3(x[from], x[from + 1], x[from + 2]);
const program = call => `const {Matrix4, Quaternion, Vector3} = require("@math.gl/core");\n${call}`;

serve("@math.gl/core", ["double"], {
  // the axis must have length 1
  exp3_quaternion: [phi => [...new Quaternion().fromAxisRotation(vector(phi).normalize(), vector(phi).len())], program(
    "const v = new Vector3({phi}), angle = v.len();\nconsole.log(...new Quaternion().fromAxisRotation(v.normalize(), angle));")],
  exp3_matrix: phi => pose(new Matrix4().rotateAxis(vector(phi).len(), vector(phi))).slice(0, 9),
  compose: x => pose(matrix(x).multiplyRight(matrix(x.subarray(12)))),
  inverse: x => pose(matrix(x).invert()),
  act_point: x => [...matrix(x).transformAsPoint([...x.slice(12)])],
  rotate_point: x => [...vector(x, 4).transformByQuaternion(new Quaternion(x[0], x[1], x[2], x[3]))],
  normalize: [Q => [...new Quaternion(...Q).normalize()], program("console.log(...new Quaternion({Q}).normalize());")],
  slerp: [x => [...new Quaternion(...x.slice(0, 4)).slerp([...x.slice(4, 8)], x[8])], program(
    "console.log(...new Quaternion({Q0}).slerp([{Q1}], {t}));")],
  rotation_between: [x => [...new Quaternion().rotationTo([...x.slice(0, 3)], [...x.slice(3)])], program(
    "console.log(...new Quaternion().rotationTo([{a}], [{b}]));")],
});
