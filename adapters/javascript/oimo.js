// oimo.js: Quat and Vec3, in double. Quaternions are x, y, z, w.
const {serve} = require("./library.js");
const {Quat, Vec3} = require("oimo");

const numbers = q => [q.x, q.y, q.z, q.w];
const rotated = x => {
  const v = new Vec3(x[4], x[5], x[6]).applyQuaternion(new Quat(x[0], x[1], x[2], x[3]));
  return [v.x, v.y, v.z];
};
const program = call => `const {Quat, Vec3} = require("oimo");\n${call}`;

serve("oimo", ["double"], {
  // the axis must have length 1
  exp3_quaternion: [phi => {
    const v = new Vec3(phi[0], phi[1], phi[2]), angle = v.length();
    return numbers(new Quat().setFromAxis(v.normalize(), angle));
  }, program(
    "const v = new Vec3({phi}), angle = v.length(), q = new Quat().setFromAxis(v.normalize(), angle);\nconsole.log(q.x, q.y, q.z, q.w);")],
  rotate_point: x => rotated(x),
  normalize: [Q => numbers(new Quat(...Q).normalize()), program(
    "const q = new Quat({Q}).normalize();\nconsole.log(q.x, q.y, q.z, q.w);")],
  rotation_between: [x => numbers(new Quat().setFromUnitVectors(new Vec3(x[0], x[1], x[2]), new Vec3(x[3], x[4], x[5]))), program(
    "const q = new Quat().setFromUnitVectors(new Vec3({a}), new Vec3({b}));\nconsole.log(q.x, q.y, q.z, q.w);")],
});
