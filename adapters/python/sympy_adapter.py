"""SymPy's Quaternion, with its Float of 15 digits, which has the 53 bits of a double. Its numbers are w, x, y, z."""
import sympy
from liecheck_protocol import serve
from sympy import Float, Matrix
from sympy.algebras.quaternion import Quaternion


def floats(x):
    return [Float(float(a)) for a in x]


def quaternion(Q):
    x, y, z, w = floats(Q)
    return Quaternion(w, x, y, z)


def numbers(q):
    return [float(a) for a in (q.b, q.c, q.d, q.a)]


def rotation(phi):  # any axis for the angle 0
    v = floats(phi)
    angle = sympy.sqrt(sum(a * a for a in v))
    return Quaternion.from_axis_angle(v if angle else [1, 0, 0], angle)


def log3_quaternion(Q):  # the angle is up to 2 pi: the rotation's is that of Q or -Q with w >= 0
    axis, angle = quaternion(-Q if Q[3] < 0 else Q).to_axis_angle()
    return [float(angle * a) for a in axis]


def rotate_point(x):
    return [float(a) for a in Quaternion.rotate_point(tuple(floats(x[4:])), quaternion(x[:4]))]


def program(*lines):
    return "\n".join(["from sympy import Float", "from sympy.algebras.quaternion import Quaternion", *lines])


serve("sympy", sympy.__version__, {
    "exp3_quaternion": (lambda phi: numbers(rotation(phi)), 3, 4, program(
        "v = [Float(a) for a in [{phi}]]; angle = sum(a * a for a in v) ** 0.5",
        "q = Quaternion.from_axis_angle(v if angle else [1, 0, 0], angle)",
        "print(*[float(a) for a in (q.b, q.c, q.d, q.a)])")),
    "log3_quaternion": (log3_quaternion, 4, 3, program(
        "x, y, z, w = [Float(a) for a in [{Q}]]; q = Quaternion(w, x, y, z) if w >= 0 else Quaternion(-w, -x, -y, -z)",
        "axis, angle = q.to_axis_angle()", "print(*[float(angle * a) for a in axis])")),
    "rotate_point": (rotate_point, 7, 3),
})
