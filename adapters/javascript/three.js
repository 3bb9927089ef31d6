// three.js: Quaternion, Matrix4, Vector3 and Vector4, in double. Quaternions are x, y, z, w; Matrix4.set takes rows.
const {serve} = require("./library.js");

import("three").then(({Euler, Matrix4, Quaternion, Vector3, Vector4}) => {
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

  // Euler's x, y and z are about the axes of the body, in the order that a name gives.
  const orders = ["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"];
  function orderOf(number) {
    const name = number % 2 === 1 ? orders[(number - 1) / 2] : undefined;
    if (!name) throw new RangeError("Euler has no such order");
    return name;
  }
  const euler = x => new Euler(...["X", "Y", "Z"].map(axis => x[1 + orderOf(x[0]).indexOf(axis)]), orderOf(x[0]));
  const inOrder = e => [...e.order].map(axis => e[axis.toLowerCase()]);

  const program = (names, call) => `import("three").then(({${names}}) => {\n${call}\n});`;
  const axis = `const v = new Vector3({phi}), angle = v.length(), axis = v.normalize();\n`;

  serve("three", ["double"], {
    exp3_quaternion: [phi => new Quaternion().setFromAxisAngle(...axisAngle(phi)).toArray(),
      program("Quaternion, Vector3", axis + "console.log(...new Quaternion().setFromAxisAngle(axis, angle));")],
    exp3_matrix: [phi => rows(new Matrix4().makeRotationAxis(...axisAngle(phi))), program("Matrix3, Matrix4, Vector3",
      axis + "const R = new Matrix4().makeRotationAxis(axis, angle);\nconsole.log(...new Matrix3().setFromMatrix4(R).transpose().elements);")],
    log3_quaternion: [log3_quaternion, program("Quaternion, Vector4",
      "const q = new Quaternion(...[{Q}].map((x, i, Q) => Q[3] < 0 ? -x : x));\nconst a = new Vector4().setAxisAngleFromQuaternion(q);\nconsole.log(a.w * a.x, a.w * a.y, a.w * a.z);")],
    log3_matrix: [R => rotationVector(new Vector4().setAxisAngleFromRotationMatrix(matrix(R))), program("Matrix3, Matrix4, Vector4",
      "const R = new Matrix4().setFromMatrix3(new Matrix3().set({R}));\nconst a = new Vector4().setAxisAngleFromRotationMatrix(R);\nconsole.log(a.w * a.x, a.w * a.y, a.w * a.z);")],
    compose: x => numbers(pose(x).multiply(pose(x.subarray(12)))),
    inverse: x => numbers(pose(x).invert()),
    act_point: x => vector(x, 12).applyMatrix4(pose(x)).toArray(),
    rotate_point: x => vector(x, 4).applyQuaternion(quaternion(x)).toArray(),
    normalize: [Q => quaternion(Q).normalize().toArray(), program("Quaternion", "console.log(...new Quaternion({Q}).normalize());")],
    relative_angle: [x => [quaternion(x).angleTo(quaternion(x.subarray(4)))],
      program("Quaternion", "console.log(new Quaternion({Q0}).angleTo(new Quaternion({Q1})));")],
    slerp: [x => quaternion(x).slerp(quaternion(x.subarray(4)), x[8]).toArray(),
      program("Quaternion", "console.log(...new Quaternion({Q0}).slerp(new Quaternion({Q1}), {t}));")],
    rotation_between: [x => new Quaternion().setFromUnitVectors(vector(x), vector(x, 3)).toArray(), program("Quaternion, Vector3",
      "console.log(...new Quaternion().setFromUnitVectors(new Vector3({a}), new Vector3({b})));")],
    quaternion_from_matrix: [R => new Quaternion().setFromRotationMatrix(matrix(R)).toArray(), program("Matrix3, Matrix4, Quaternion",
      "const R = new Matrix4().setFromMatrix3(new Matrix3().set({R}));\nconsole.log(...new Quaternion().setFromRotationMatrix(R));")],
    matrix_from_quaternion: [Q => rows(new Matrix4().makeRotationFromQuaternion(quaternion(Q))), program("Matrix3, Matrix4, Quaternion",
      "const R = new Matrix4().makeRotationFromQuaternion(new Quaternion({Q}));\nconsole.log(...new Matrix3().setFromMatrix4(R).transpose().elements);")],
    quaternion_product: x => quaternion(x).multiply(quaternion(x.subarray(4))).toArray(),
    quaternion_inverse: Q => quaternion(Q).invert().toArray(),
    axis_angle_from_quaternion: [Q => new Vector4().setAxisAngleFromQuaternion(quaternion(Q)).toArray(), program("Quaternion, Vector4",
      "console.log(...new Vector4().setAxisAngleFromQuaternion(new Quaternion({Q})));")],
    axis_angle_from_matrix: [R => new Vector4().setAxisAngleFromRotationMatrix(matrix(R)).toArray(), program("Matrix3, Matrix4, Vector4",
      "const R = new Matrix4().setFromMatrix3(new Matrix3().set({R}));\nconsole.log(...new Vector4().setAxisAngleFromRotationMatrix(R));")],
    quaternion_from_axis_angle: x => new Quaternion().setFromAxisAngle(vector(x), x[3]).toArray(),
    matrix_from_axis_angle: x => rows(new Matrix4().makeRotationAxis(vector(x), x[3])),
    angle_between: [x => [vector(x).angleTo(vector(x, 3))],
      program("Vector3", "console.log(new Vector3({a}).angleTo(new Vector3({b})));")],
    euler_to_quaternion: x => new Quaternion().setFromEuler(euler(x)).toArray(),
    euler_to_matrix: x => rows(new Matrix4().makeRotationFromEuler(euler(x))),
    euler_from_quaternion: [x => inOrder(new Euler().setFromQuaternion(quaternion(x.subarray(1)), orderOf(x[0]))),
      program("Euler, Quaternion", `const order = ["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"][({order} - 1) / 2];
const e = new Euler().setFromQuaternion(new Quaternion({Q}), order);\nconsole.log(...[...order].map(axis => e[axis.toLowerCase()]));`)],
    euler_from_matrix: [x => inOrder(new Euler().setFromRotationMatrix(matrix(x.subarray(1)), orderOf(x[0]))),
      program("Euler, Matrix3, Matrix4", `const order = ["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX"][({order} - 1) / 2];
const e = new Euler().setFromRotationMatrix(new Matrix4().setFromMatrix3(new Matrix3().set({R})), order);\nconsole.log(...[...order].map(axis => e[axis.toLowerCase()]));`)],
  }, {
    compose: x => ((X, Y, out) => () => out.multiplyMatrices(X, Y))(pose(x), pose(x.subarray(12)), new Matrix4()),
    inverse: x => ((X, out) => () => out.copy(X).invert())(pose(x), new Matrix4()),
    act_point: x => ((X, p, out) => () => out.copy(p).applyMatrix4(X))(pose(x), vector(x, 12), new Vector3()),
    rotate_point: x => ((q, p, out) => () => out.copy(p).applyQuaternion(q))(quaternion(x), vector(x, 4), new Vector3()),
    normalize: Q => ((q, out) => () => out.copy(q).normalize())(quaternion(Q), new Quaternion()),
    slerp: x => ((a, b, out) => () => out.slerpQuaternions(a, b, x[8]))(quaternion(x), quaternion(x.subarray(4)), new Quaternion()),
    quaternion_product: x => ((a, b, out) => () => out.multiplyQuaternions(a, b))(quaternion(x), quaternion(x.subarray(4)), new Quaternion()),
    quaternion_from_matrix: R => ((M, out) => () => out.setFromRotationMatrix(M))(matrix(R), new Quaternion()),
    matrix_from_quaternion: Q => ((q, out) => () => out.makeRotationFromQuaternion(q))(quaternion(Q), new Matrix4()),
    log3_quaternion: Q => ((q, out) => () => out.setAxisAngleFromQuaternion(q))(quaternion(Q), new Vector4()),
    exp3_quaternion: phi => ((a, out) => () => out.setFromAxisAngle(...a))(axisAngle(phi), new Quaternion()),
  });
});
