// Not a library: forms without a threshold, an acos or a cancellation, which the findings of the league propose.
// Each function is a program of its own.
const {serve} = require("./library.js");

function exp3_quaternion([x, y, z]) {
  const theta = Math.hypot(x, y, z), s = theta > 0 ? Math.sin(theta / 2) / theta : 0.5;
  return [s * x, s * y, s * z, Math.cos(theta / 2)];
}
function exp3_matrix([x, y, z]) {
  const theta = Math.hypot(x, y, z), h = theta > 0 ? Math.sin(theta / 2) / theta : 0.5;
  const a = theta > 0 ? Math.sin(theta) / theta : 1, b = 2 * h * h;  // never 1 - cos(theta)
  return [1 - b * (y * y + z * z), b * x * y - a * z, b * x * z + a * y,
          b * x * y + a * z, 1 - b * (x * x + z * z), b * y * z - a * x,
          b * x * z - a * y, b * y * z + a * x, 1 - b * (x * x + y * y)];
}
function log3_quaternion([x, y, z, w]) {
  const n = Math.hypot(x, y, z), k = n > 0 ? 2 * Math.atan2(w < 0 ? -n : n, Math.abs(w)) / n : 0;
  return [k * x, k * y, k * z];
}
function log3_matrix(R) {
  const d = [R[0] + R[4] + R[8], R[0], R[4], R[8]], k = d.indexOf(Math.max(...d)), Q = [0, 0, 0, 0];
  const at = (i, j) => R[3 * (i % 3) + j % 3], i = k - 1;  // the largest pivot
  if (k === 0) Q.splice(0, 4, R[7] - R[5], R[2] - R[6], R[3] - R[1], 1 + d[0]);
  else Q[i] = 1 + at(i, i) - at(i + 1, i + 1) - at(i + 2, i + 2), Q[3] = at(i + 2, i + 1) - at(i + 1, i + 2),
    Q[(i + 1) % 3] = at(i, i + 1) + at(i + 1, i), Q[(i + 2) % 3] = at(i, i + 2) + at(i + 2, i);
  const n = Math.hypot(Q[0], Q[1], Q[2]), f = n > 0 ? 2 * Math.atan2(Q[3] < 0 ? -n : n, Math.abs(Q[3])) / n : 0;
  return [f * Q[0], f * Q[1], f * Q[2]];
}
function normalize(Q) {
  const m = Math.max(...Q.map(Math.abs)), q = Q.map(x => x / m), n = Math.hypot(...q);
  return q.map(x => x / n);
}
function rotate_point([x, y, z, w, p0, p1, p2]) {
  const n = x * x + y * y + z * z + w * w, t = [y * p2 - z * p1, z * p0 - x * p2, x * p1 - y * p0].map(a => 2 * a / n);
  return [p0 + w * t[0] + y * t[2] - z * t[1], p1 + w * t[1] + z * t[0] - x * t[2], p2 + w * t[2] + x * t[1] - y * t[0]];
}

function relative_angle([x0, y0, z0, w0, x1, y1, z1, w1]) {
  const w = x0 * x1 + y0 * y1 + z0 * z1 + w0 * w1;
  const x = w0 * x1 - w1 * x0 - (y0 * z1 - z0 * y1), y = w0 * y1 - w1 * y0 - (z0 * x1 - x0 * z1);
  const z = w0 * z1 - w1 * z0 - (x0 * y1 - y0 * x1);
  return [2 * Math.atan2(Math.hypot(x, y, z), Math.abs(w))];  // never acos(w)
}
function slerp(x) {
  const Q0 = x.slice(0, 4), t = x[8], sign = Q0.reduce((c, q, i) => c + q * x[4 + i], 0) < 0 ? -1 : 1;
  const Q1 = x.slice(4, 8).map(q => sign * q);
  const h = 2 * Math.atan2(Math.hypot(...Q0.map((q, i) => Q1[i] - q)), Math.hypot(...Q0.map((q, i) => Q1[i] + q)));
  const a = h > 0 ? Math.sin((1 - t) * h) : 1, b = h > 0 ? Math.sin(t * h) : 0;
  const Q = Q0.map((q, i) => a * q + b * Q1[i]), n = Math.hypot(...Q);
  return Q.map(q => q / n);  // n is sin(h), without a threshold on h
}
function rotation_between(x) {
  const l = Math.hypot(x[0], x[1], x[2]), m = Math.hypot(x[3], x[4], x[5]), [a0, a1, a2] = x.slice(0, 3).map(a => a / l);
  const c0 = a0 + x[3] / m, c1 = a1 + x[4] / m, c2 = a2 + x[5] / m, n = Math.hypot(c0, c1, c2);
  const Q = n > 4 * Number.EPSILON ? [(a1 * c2 - a2 * c1) / n, (a2 * c0 - a0 * c2) / n, (a0 * c1 - a1 * c0) / n, n / 2]  // a x (a + b) = a x b
    : Math.abs(a0) > Math.abs(a2) ? [-a1, a0, 0, 0] : [0, -a2, a1, 0];  // b = -a but for rounding: any axis perpendicular to a
  const q = Math.hypot(...Q);
  return Q.map(x => x / q);
}

const program = (f, ...places) => `const f = ${f};\nconsole.log(...f([${places.map(p => `{${p}}`).join(", ")}]));`;
const own = (f, ...places) => [x => f(Array.from(x)), program(f, ...places)];

serve("repaired_js", ["double", "float"], {
  exp3_quaternion: own(exp3_quaternion, "phi"),
  exp3_matrix: own(exp3_matrix, "phi"),
  log3_quaternion: own(log3_quaternion, "Q"),
  log3_matrix: own(log3_matrix, "R"),
  normalize: own(normalize, "Q"),
  rotate_point: own(rotate_point, "Q", "p"),
  relative_angle: own(relative_angle, "Q0", "Q1"),
  slerp: own(slerp, "Q0", "Q1", "t"),
  rotation_between: own(rotation_between, "a", "b"),
});
