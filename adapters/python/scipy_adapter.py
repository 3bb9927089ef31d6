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


def program(call):
    return f"from scipy.spatial.transform import Rotation\nprint(*({call}).ravel().tolist())"


serve("scipy", scipy.__version__, {
    "exp3_quaternion": (lambda phi: Rotation.from_rotvec(phi).as_quat(), 3, 4,
        program("Rotation.from_rotvec([{phi}]).as_quat()")),
    "exp3_matrix": (lambda phi: Rotation.from_rotvec(phi).as_matrix(), 3, 9,
        program("Rotation.from_rotvec([{phi}]).as_matrix()")),
    "log3_quaternion": (log3_quaternion, 4, 3,
        program("Rotation.from_quat([{Q}]).as_rotvec()")),
    "log3_matrix": (lambda R: matrix(R).as_rotvec(), 9, 3,
        "import numpy as np\n" + program("Rotation.from_matrix(np.reshape([{R}], (3, 3))).as_rotvec()")),
    "rotate_point": (rotate_point, 7, 3,
        program("Rotation.from_quat([{Q}]).apply([{p}])")),
    "normalize": (lambda Q: quaternion(Q).as_quat(), 4, 4,
        program("Rotation.from_quat([{Q}]).as_quat()")),
    "quaternion_matrix": (lambda Q: quaternion(Q).as_matrix(), 4, 9,
        program("Rotation.from_quat([{Q}]).as_matrix()")),
    "rotate_point_any_norm": (rotate_point, 7, 3,
        program("Rotation.from_quat([{Q}]).apply([{p}])")),
    "log3_any_norm": (log3_quaternion, 4, 3,
        program("Rotation.from_quat([{Q}]).as_rotvec()")),
})
