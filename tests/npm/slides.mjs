// An adapter with a class of models: poses of frames on trees with prismatic joints; and with poses as (p, Q).
const rotate = ([x, y, z, w], [a, b, c]) => {
  const n = x * x + y * y + z * z + w * w, t = [y * c - z * b, z * a - x * c, x * b - y * a].map(v => 2 * v / n);
  return [a + w * t[0] + y * t[2] - z * t[1], b + w * t[1] + z * t[0] - x * t[2], c + w * t[2] + x * t[1] - y * t[0]];
};
const product = ([x, y, z, w], [a, b, c, d]) =>
  [w * a + x * d + y * c - z * b, w * b - x * c + y * d + z * a, w * c + x * b - y * a + z * d, w * d - x * a - y * b - z * c];
const at = ({Q, p}, X) => ({Q: product(Q, X.Q), p: rotate(Q, X.p).map((a, i) => a + p[i])});

export const conventions = {"pose form": "quaternion"}, trees = {joints: ["prismatic"]};
export const act_point = x => at({p: x.slice(0, 3), Q: x.slice(3, 7)}, {Q: [0, 0, 0, 1], p: x.slice(7)}).p;
export class Model {
  constructor({joints}) {
    this.joints = joints;
  }
  frame_pose(x) {
    const poses = [], q = x.slice(0, this.joints.length), [joint, ...frame] = x.slice(q.length);
    this.joints.forEach(({parent, Q, p, axis}, i) => {
      const X = parent < 0 ? {Q, p} : at(poses[parent], {Q, p}), s = q[i] / Math.hypot(...axis);
      poses.push(at(X, {Q: [0, 0, 0, 1], p: axis.map(a => s * a)}));
    });
    const {Q, p} = at(poses[joint], {Q: frame.slice(0, 4), p: frame.slice(4)});
    return [...[0, 1, 2].map(i => rotate(Q, [0, 1, 2].map(j => Number(i === j)))).reduce((R, c) => R.map((r, i) => [...r, c[i]]), [[], [], []]), p];
  }
}
