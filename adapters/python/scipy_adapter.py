"""scipy.spatial.transform.Rotation. Its quaternions are x, y, z, w and may have any norm but 0."""
import scipy
from liecheck_protocol import serve
from scipy.spatial.transform import Rotation


def quaternion(Q):
    return Rotation.from_quat(Q)


def matrix(R):
    return Rotation.from_matrix(R.reshape(3, 3))


def log3_quaternion(Q):
    return quaternion(Q).as_rotvec()


def rotate_point(x):
    return quaternion(x[:4]).apply(x[4:])


serve("scipy", scipy.__version__, {
    "exp3_quaternion": (lambda phi: Rotation.from_rotvec(phi).as_quat(), 3, 4),
    "exp3_matrix": (lambda phi: Rotation.from_rotvec(phi).as_matrix(), 3, 9),
    "log3_quaternion": (log3_quaternion, 4, 3),
    "log3_matrix": (lambda R: matrix(R).as_rotvec(), 9, 3),
    "rotate_point": (rotate_point, 7, 3),
    "normalize": (lambda Q: quaternion(Q).as_quat(), 4, 4),
    "quaternion_matrix": (lambda Q: quaternion(Q).as_matrix(), 4, 9),
    "rotate_point_any_norm": (rotate_point, 7, 3),
    "log3_any_norm": (log3_quaternion, 4, 3),
})
