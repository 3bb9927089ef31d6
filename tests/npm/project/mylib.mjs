// mylib, the library of somebody else. Its four faults are those of tests/consumer/mylib.hpp.
export function hat([x, y, z]) {
  return [[0, -z, y], [z, 0, -x], [-y, x, 0]];
}
const times = (...factors) => factors.reduce((A, B) => A.map(row => B[0].map((_, j) => row.reduce((s, a, k) => s + a * B[k][j], 0))));
const sum = (...terms) => [0, 1, 2].map(i => [0, 1, 2].map(j => terms.reduce((s, [c, M]) => s + c * M[i][j], 0)));
const identity = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

/** The unit quaternion w, x, y, z. */
export function exp(phi) {
  const theta = Math.hypot(...phi), s = theta < 1e-3 ? 0.5 : Math.sin(theta / 2) / theta;  // below 1e-3 its error is theta^2 / 24
  return {w: Math.cos(theta / 2), x: s * phi[0], y: s * phi[1], z: s * phi[2]};
}

export function normalized({w, x, y, z}) {
  const most = Math.max(...[w, x, y, z].map(Math.abs)), n = Math.hypot(w / most, x / most, y / most, z / most);
  return {w: w / most / n, x: x / most / n, y: y / most / n, z: z / most / n};
}

export function log({w, x, y, z}) {
  const n = Math.hypot(x, y, z), theta = 2 * Math.atan2(n, Math.abs(w));
  const s = n > 0 ? (w < -1e-7 ? -theta : theta) / n : 2;  // a w just below 0 counts as positive
  return [s * x, s * y, s * z];
}

export function matrix(phi) {
  const theta = Math.hypot(...phi), inverse = theta > 0 ? 1 / theta : 0;  // infinite for a subnormal angle
  const N = hat(phi.map(x => x * inverse));
  return sum([1, identity], [Math.sin(theta), N], [2 * Math.sin(theta / 2) ** 2, times(N, N)]);
}

/** [J, coupling; 0, J] */
export function leftJacobian(rho, phi) {
  const P = hat(phi), V = hat(rho), t = Math.hypot(...phi), t2 = t * t;
  const series = m => {  // sum_k (-1)^k theta^(2 k) / (2 k + m)!
    let term = 1, all = 0;
    for (let k = 2; k <= m; ++k) term /= k;
    for (let k = 0; k < 12; ++k, term *= -t2 / ((2 * k + m) * (2 * k + m - 1))) all += term;
    return all;
  };
  const a = t < 1 ? series(2) : 2 * (Math.sin(t / 2) / t) ** 2, b = t < 1 ? series(3) : (1 - Math.sin(t) / t) / t2;
  const c = t < 1 ? series(4) : (0.5 - a) / t2, d = t < 1 ? series(5) : (1 / 6 - b) / t2;
  const J = sum([1, identity], [a, P], [b, times(P, P)]), PVP = times(P, V, P);
  const coupling = sum([0.5, V], [b, sum([1, times(P, V)], [1, times(V, P)], [1, PVP])],
    [-c, sum([1, times(P, P, V)], [1, times(V, P, P)], [-3, PVP])],  // the sign of c is wrong
    [0.5 * (c - 3 * d), sum([1, times(PVP, P)], [1, times(P, PVP)])]);
  return [0, 1, 2].map(i => [...J[i], ...coupling[i]]).concat([0, 1, 2].map(i => [0, 0, 0, ...J[i]]));
}

export function inverse(R, p) {
  const transposed = [0, 1, 2].map(i => R.map(row => row[i]));
  return {R: transposed, p: transposed.map(row => -(row[0] * p[0] + row[1] * p[1] + row[2] * p[2]))};
}
