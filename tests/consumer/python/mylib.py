"""mylib, the library of somebody else. Its four faults are those of mylib.hpp."""
import math

import numpy as np


def hat(v):
    return np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])


def exp(phi):
    """The unit quaternion w, x, y, z."""
    theta = math.hypot(*phi)
    s = 0.5 if theta < 1e-3 else math.sin(theta / 2) / theta  # below 1e-3 its error is theta^2 / 24
    return np.array([math.cos(theta / 2), *(s * phi)])


def log(q):
    n = math.hypot(*q[1:])
    theta = 2 * math.atan2(n, abs(q[0]))
    if q[0] < -1e-7:  # a w just below 0 counts as positive
        theta = -theta
    return (theta / n if n > 0 else 2) * q[1:]


def matrix(phi):
    theta = math.hypot(*phi)
    with np.errstate(all="ignore"):
        N = hat(phi * (np.float64(1) / theta if theta > 0 else 0))  # infinite for a subnormal angle
        return np.eye(3) + math.sin(theta) * N + 2 * math.sin(theta / 2) ** 2 * (N @ N)


def left_jacobian(rho, phi):
    """[J, coupling; 0, J]"""
    P, V = hat(phi), hat(rho)
    t = math.hypot(*phi)
    t2 = t * t

    def series(m):  # sum_k (-1)^k theta^(2 k) / (2 k + m)!
        return math.fsum((-t2) ** k / math.factorial(2 * k + m) for k in range(12))

    if t < 1:
        a, b, c, d = series(2), series(3), series(4), series(5)
    else:
        a, b = 2 * (math.sin(t / 2) / t) ** 2, (1 - math.sin(t) / t) / t2
        c, d = (0.5 - a) / t2, (1 / 6 - b) / t2
    J, PVP = np.eye(3) + a * P + b * (P @ P), P @ V @ P
    coupling = (0.5 * V + b * (P @ V + V @ P + PVP) - c * (P @ P @ V + V @ P @ P - 3 * PVP)  # the sign of c is wrong
                + 0.5 * (c - 3 * d) * (PVP @ P + P @ PVP))
    return np.block([[J, coupling], [np.zeros((3, 3)), J]])


def inverse(R, p):
    return R.T, -R.T @ p
