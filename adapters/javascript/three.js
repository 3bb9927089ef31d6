// three.js: Quaternion, Matrix4, Vector3 and Vector4, in double. Quaternions are x, y, z, w; Matrix4.set takes rows.
const {serve} = require("./liecheck_protocol.js");

import("three").then(({Matrix4, Quaternion, Vector3, Vector4}) => {
  const matrix = R => new Matrix4().set(R[0], R[1], R[2], 0, R[3], R[4], R[5], 0, R[6], R[7], R[8], 0, 0, 0, 0, 1);
  const pose = X => matrix(X).setPosition(X[9], X[10], X[11]);
  const rows = ({elements: e}) => [e[0], e[4], e[8], e[1], e[5], e[9], e[2], e[6], e[10]];
  const numbers = M => [...rows(M), M.elements[12], M.elements[13], M.elements[14]];
  const vector = (x, from = 0) => new Vector3().fromArray(x, from);
  const quaternion = Q => new Quaternion(Q[0], Q[1], Q[2], Q[3]);

  // An axis and an angle: the axis must have length 1.
  const axisAngle = phi => [vector(phi).normalize(), vector(phi).length()];
  const rotationVector = a => [a.w * a.x, a.w * a.y, a.w * a.z];

  // The angle is up to 2 pi: the rotation's is that of Q or -Q with w >= 0.
  function log3_quaternion(Q) {
    return rotationVector(new Vector4().setAxisAngleFromQuaternion(quaternion(Q[3] < 0 ? Q.map(x => -x) : Q)));
  }

  const program = (names, call) => `import("three").then(({${names}}) => {\n${call}\n});`;
  const axis = `const v = new Vector3({phi}), angle = v.length(), axis = v.normalize();\n`;

  serve("three", ["double"], {
    exp3_quaternion: [phi => new Quaternion().setFromAxisAngle(...axisAngle(phi)).toArray(), 3, 4,
      program("Quaternion, Vector3", axis + "console.log(...new Quaternion().setFromAxisAngle(axis, angle));")],
    exp3_matrix: [phi => rows(new Matrix4().makeRotationAxis(...axisAngle(phi))), 3, 9, program("Matrix3, Matrix4, Vector3",
      axis + "const R = new Matrix4().makeRotationAxis(axis, angle);\nconsole.log(...new Matrix3().setFromMatrix4(R).transpose().elements);")],
    log3_quaternion: [log3_quaternion, 4, 3, program("Quaternion, Vector4",
      "const q = new Quaternion(...[{Q}].map((x, i, Q) => Q[3] < 0 ? -x : x));\nconst a = new Vector4().setAxisAngleFromQuaternion(q);\nconsole.log(a.w * a.x, a.w * a.y, a.w * a.z);")],
    log3_matrix: [R => rotationVector(new Vector4().setAxisAngleFromRotationMatrix(matrix(R))), 9, 3, program("Matrix3, Matrix4, Vector4",
      "const R = new Matrix4().setFromMatrix3(new Matrix3().set({R}));\nconst a = new Vector4().setAxisAngleFromRotationMatrix(R);\nconsole.log(a.w * a.x, a.w * a.y, a.w * a.z);")],
    compose: [x => numbers(pose(x).multiply(pose(x.subarray(12)))), 24, 12],
    inverse: [x => numbers(pose(x).invert()), 12, 12],
    act_point: [x => vector(x, 12).applyMatrix4(pose(x)).toArray(), 15, 3],
    rotate_point: [x => vector(x, 4).applyQuaternion(quaternion(x)).toArray(), 7, 3],
    normalize: [Q => quaternion(Q).normalize().toArray(), 4, 4, program("Quaternion", "console.log(...new Quaternion({Q}).normalize());")],
  });
});
