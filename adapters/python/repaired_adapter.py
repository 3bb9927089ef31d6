"""Not a library: forms without a threshold, an acos or a cancellation, which the findings of the league propose. Each
function is a program of its own."""
import inspect
import math

from liecheck_protocol import serve


def exp3_quaternion(phi):
    theta = math.hypot(*phi)
    s = math.sin(theta / 2) / theta if theta > 0 else 0.5
    return [s * phi[0], s * phi[1], s * phi[2], math.cos(theta / 2)]


def exp3_matrix(phi):
    (x, y, z), theta = phi, math.hypot(*phi)
    a = math.sin(theta) / theta if theta > 0 else 1.0
    b = 2 * (math.sin(theta / 2) / theta if theta > 0 else 0.5) ** 2  # never 1 - cos(theta)
    return [1 - b * (y * y + z * z), b * x * y - a * z, b * x * z + a * y,
            b * x * y + a * z, 1 - b * (x * x + z * z), b * y * z - a * x,
            b * x * z - a * y, b * y * z + a * x, 1 - b * (x * x + y * y)]


def log3_quaternion(Q):
    x, y, z, w = Q
    n = math.hypot(x, y, z)
    k = 2 * math.atan2(math.copysign(n, w), abs(w)) / n if n > 0 else 0.0
    return [k * x, k * y, k * z]


def log3_matrix(R):
    d = [R[0] + R[4] + R[8], R[0], R[4], R[8]]
    i, at = d.index(max(d)) - 1, lambda a, b: R[3 * (a % 3) + b % 3]
    if i < 0:
        Q = [R[7] - R[5], R[2] - R[6], R[3] - R[1], 1 + d[0]]
    else:  # the largest pivot
        v = [1 + at(i, i) - at(i + 1, i + 1) - at(i + 2, i + 2), at(i, i + 1) + at(i + 1, i), at(i, i + 2) + at(i + 2, i)]
        Q = [v[(k - i) % 3] for k in range(3)] + [at(i + 2, i + 1) - at(i + 1, i + 2)]
    n = math.hypot(*Q[:3])
    k = 2 * math.atan2(math.copysign(n, Q[3]), abs(Q[3])) / n if n > 0 else 0.0
    return [k * x for x in Q[:3]]


def normalize(Q):
    m = max(abs(x) for x in Q)
    n = math.hypot(*(x / m for x in Q))
    return [x / m / n for x in Q]


def log3_any_norm(Q):
    m = max(abs(x) for x in Q)
    x, y, z, w = (a / m for a in Q)
    n = math.hypot(x, y, z)
    k = 2 * math.atan2(math.copysign(n, w), abs(w)) / n if n > 0 else 0.0
    return [k * x, k * y, k * z]


def matrix_from_quaternion_any_norm(Q):
    m = max(abs(x) for x in Q)
    x, y, z, w = (a / m for a in Q)
    s = 2 / (x * x + y * y + z * z + w * w)
    return [1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),
            s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),
            s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)]


def relative_angle(x):
    (x0, y0, z0, w0), (x1, y1, z1, w1) = x[:4], x[4:]
    w = x0 * x1 + y0 * y1 + z0 * z1 + w0 * w1
    v = (w0 * x1 - w1 * x0 - (y0 * z1 - z0 * y1), w0 * y1 - w1 * y0 - (z0 * x1 - x0 * z1),
         w0 * z1 - w1 * z0 - (x0 * y1 - y0 * x1))
    return [2 * math.atan2(math.hypot(*v), abs(w))]  # never acos(w)


def slerp(x):
    Q0, Q1, t = x[:4], x[4:8], x[8]
    if sum(a * b for a, b in zip(Q0, Q1)) < 0:
        Q1 = [-b for b in Q1]
    h = 2 * math.atan2(math.dist(Q0, Q1), math.hypot(*(a + b for a, b in zip(Q0, Q1))))
    s, e = (math.sin((1 - t) * h), math.sin(t * h)) if h > 0 else (1.0, 0.0)
    Q = [s * a + e * b for a, b in zip(Q0, Q1)]
    return [q / math.hypot(*Q) for q in Q]  # the norm is sin(h), without a threshold on h


def own(f, arguments, size, *places):
    program = "import math\n\n" + inspect.getsource(f) + f"\nprint(*{f.__name__}([{', '.join(f'{{{p}}}' for p in places)}]))"
    return lambda x: f([float(a) for a in x]), arguments, size, program


serve("repaired_python", "1", {
    "exp3_quaternion": own(exp3_quaternion, 3, 4, "phi"),
    "exp3_matrix": own(exp3_matrix, 3, 9, "phi"),
    "log3_quaternion": own(log3_quaternion, 4, 3, "Q"),
    "log3_matrix": own(log3_matrix, 9, 3, "R"),
    "normalize": own(normalize, 4, 4, "Q"),
    "log3_any_norm": own(log3_any_norm, 4, 3, "Q"),
    "matrix_from_quaternion_any_norm": own(matrix_from_quaternion_any_norm, 4, 9, "Q"),
    "relative_angle": own(relative_angle, 8, 1, "Q0", "Q1"),
    "slerp": own(slerp, 9, 4, "Q0", "Q1", "t"),
})
