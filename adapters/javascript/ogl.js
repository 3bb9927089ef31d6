// OGL: Quat, Vec3 and Mat4, in double. Quaternions are x, y, z, w, matrices column by column.
const {serve} = require("./library.js");

import("ogl").then(({Mat3, Mat4, Quat, Vec3}) => {
  const matrix = X => new Mat4(X[0], X[3], X[6], 0, X[1], X[4], X[7], 0, X[2], X[5], X[8], 0, X[9], X[10], X[11], 1);
  const pose = M => [M[0], M[4], M[8], M[1], M[5], M[9], M[2], M[6], M[10], M[12], M[13], M[14]];
  const vector = (x, from = 0) => new Vec3(x[from], x[from + 1], x[from + 2]);
  const axisAngle = phi => [vector(phi).normalize(), vector(phi).len()];
  const numbers = q => [q.x, q.y, q.z, q.w];
  const program = call => `import("ogl").then(({Mat4, Quat, Vec3}) => {\n${call}\n});`;

  serve("ogl", ["double"], {
    exp3_quaternion: [phi => numbers(new Quat().fromAxisAngle(...axisAngle(phi))), program(
      "const v = new Vec3({phi}), angle = v.len(), q = new Quat().fromAxisAngle(v.normalize(), angle);\nconsole.log(q.x, q.y, q.z, q.w);")],
    compose: x => pose(matrix(x).multiply(matrix(x.subarray(12)))),
    inverse: x => pose(matrix(x).inverse()),
    act_point: x => [...vector(x, 12).applyMatrix4(matrix(x))],
    rotate_point: x => [...vector(x, 4).applyQuaternion(new Quat(x[0], x[1], x[2], x[3]))],
    normalize: [Q => numbers(new Quat(...Q).normalize()), program(
      "const q = new Quat({Q}).normalize();\nconsole.log(q.x, q.y, q.z, q.w);")],
    slerp: [x => numbers(new Quat(...x.slice(0, 4)).slerp(new Quat(...x.slice(4, 8)), x[8])), program(
      "const q = new Quat({Q0}).slerp(new Quat({Q1}), {t});\nconsole.log(q.x, q.y, q.z, q.w);")],
  });
});
