"""transforms3d: quaternions and axangles. Its quaternions are w, x, y, z."""
import math

import numpy as np
import transforms3d
from liecheck_protocol import serve
from transforms3d import axangles, euler, quaternions


def w_first(Q):
    return np.array([Q[3], Q[0], Q[1], Q[2]])


def axis_angle(phi):  # phi = 0 is the angle 0 about any axis; the functions divide by the length of the axis
    return (phi / abs(phi).max() if phi.any() else np.array([1.0, 0, 0])), math.hypot(*phi)


def exp3_quaternion(phi):
    w, x, y, z = quaternions.axangle2quat(*axis_angle(phi))
    return x, y, z, w


def log3_quaternion(Q):  # the angle is up to 2 pi: the rotation's is that of Q or -Q with w >= 0
    axis, angle = quaternions.quat2axangle(w_first(-Q if Q[3] < 0 else Q))
    return angle * axis


def log3_matrix(R):
    axis, angle = axangles.mat2axangle(R.reshape(3, 3))
    return angle * axis


def axis_angle_from_quaternion(Q):
    axis, angle = quaternions.quat2axangle(w_first(Q))
    return [*axis, angle]


def axis_angle_from_matrix(R):
    axis, angle = axangles.mat2axangle(R.reshape(3, 3))
    return [*axis, angle]


ORDERS = "xyz xzy yxz yzx zxy zyx xyx xzx yxy yzy zxz zyz".split()


def order(number):
    return ("r" if number % 2 else "s") + ORDERS[int(number) // 2]


def euler_from(function, rotation, number):  # the middle angle of these orders is in [-pi, 0], another convention
    if order(number)[1:] in ("xzx", "yxy", "zyz"):
        raise ValueError("the middle angle has another range")
    return function(rotation, order(number))


def program(*lines):
    return "\n".join(["import numpy as np", "from transforms3d import axangles, euler, quaternions", *lines])


axis_angle_of = "phi = np.array([{phi}]); angle = np.linalg.norm(phi); axis = phi if angle else [1, 0, 0]"
log_of = "x, y, z, w = np.array([{Q}]); axis, angle = quaternions.quat2axangle(np.array([w, x, y, z]) * (-1 if w < 0 else 1))"

serve("transforms3d", transforms3d.__version__, {
    "exp3_quaternion": (exp3_quaternion, 3, 4,
        program(axis_angle_of, "w, x, y, z = quaternions.axangle2quat(axis, angle).tolist()", "print(x, y, z, w)")),
    "exp3_matrix": (lambda phi: axangles.axangle2mat(*axis_angle(phi)), 3, 9,
        program(axis_angle_of, "print(*axangles.axangle2mat(axis, angle).ravel().tolist())")),
    "log3_quaternion": (log3_quaternion, 4, 3, program(log_of, "print(*(angle * axis).tolist())")),
    "log3_matrix": (log3_matrix, 9, 3, program("axis, angle = axangles.mat2axangle(np.reshape([{R}], (3, 3)))", "print(*(angle * axis).tolist())")),
    "rotate_point": (lambda x: quaternions.rotate_vector(x[4:], w_first(x)), 7, 3),
    "quaternion_from_matrix": (lambda R: np.roll(quaternions.mat2quat(R.reshape(3, 3)), -1), 9, 4,
        program("w, x, y, z = quaternions.mat2quat(np.reshape([{R}], (3, 3))).tolist()", "print(x, y, z, w)")),
    "matrix_from_quaternion": (lambda Q: quaternions.quat2mat(w_first(Q)), 4, 9,
        program("x, y, z, w = {Q}", "print(*quaternions.quat2mat([w, x, y, z]).ravel().tolist())")),
    "quaternion_product": (lambda x: np.roll(quaternions.qmult(w_first(x[:4]), w_first(x[4:])), -1), 8, 4),
    "quaternion_inverse": (lambda Q: np.roll(quaternions.qinverse(w_first(Q)), -1), 4, 4),
    "axis_angle_from_quaternion": (axis_angle_from_quaternion, 4, 4,
        program("x, y, z, w = {Q}", "axis, angle = quaternions.quat2axangle([w, x, y, z])", "print(*axis.tolist(), angle)")),
    "axis_angle_from_matrix": (axis_angle_from_matrix, 9, 4,
        program("axis, angle = axangles.mat2axangle(np.reshape([{R}], (3, 3)))", "print(*axis.tolist(), float(angle))")),
    "quaternion_from_axis_angle": (lambda x: np.roll(quaternions.axangle2quat(x[:3], x[3]), -1), 4, 4),
    "matrix_from_axis_angle": (lambda x: axangles.axangle2mat(x[:3], x[3]), 4, 9),
    # documented for quaternions that are not normalized
    "matrix_from_quaternion_any_norm": (lambda Q: quaternions.quat2mat(w_first(Q)), 4, 9,
        program("x, y, z, w = {Q}", "print(*quaternions.quat2mat([w, x, y, z]).ravel().tolist())")),
    "rotate_point_any_norm": (lambda x: quaternions.rotate_vector(x[4:], w_first(x), is_normalized=False), 7, 3),
    "log3_any_norm": (log3_quaternion, 4, 3, program(log_of, "print(*(angle * axis).tolist())")),
    "euler_to_quaternion": (lambda x: np.roll(euler.euler2quat(*x[1:], order(x[0])), -1), 4, 4),
    "euler_to_matrix": (lambda x: euler.euler2mat(*x[1:], order(x[0])), 4, 9),
    "euler_from_quaternion": (lambda x: euler_from(euler.quat2euler, w_first(x[1:]), x[0]), 5, 3,
        program("x, y, z, w = {Q}", f"o = {ORDERS}[int({{order}}) // 2]", "print(*euler.quat2euler([w, x, y, z], 'sr'[int({order}) % 2] + o))")),
    "euler_from_matrix": (lambda x: euler_from(euler.mat2euler, x[1:].reshape(3, 3), x[0]), 10, 3,
        program(f"o = {ORDERS}[int({{order}}) // 2]", "print(*euler.mat2euler(np.reshape([{R}], (3, 3)), 'sr'[int({order}) % 2] + o))")),
})
