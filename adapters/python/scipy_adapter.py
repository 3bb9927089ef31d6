"""scipy.spatial.transform.Rotation. Its quaternions are x, y, z, w and may have any norm but 0."""
import operator

import scipy
from liecheck_protocol import serve
from scipy.spatial.transform import Rotation, Slerp


def quaternion(Q):
    return Rotation.from_quat(Q)


def matrix(R):
    return Rotation.from_matrix(R.reshape(R.shape[:-1] + (3, 3)))


def log3_quaternion(Q):
    return quaternion(Q).as_rotvec()


def rotate_point(x):
    return quaternion(x[..., :4]).apply(x[..., 4:])


def relative_angle(x):
    return (quaternion(x[..., :4]).inv() * quaternion(x[..., 4:])).magnitude()


def slerp(x):
    return Slerp([0, 1], Rotation.from_quat([x[:4], x[4:8]]))(x[8]).as_quat()


ORDERS = "xyz xzy yxz yzx zxy zyx xyx xzx yxy yzy zxz zyz".split()


def order(number):
    name = ORDERS[int(number) // 2]
    return name.upper() if number % 2 else name  # upper case: axes of the body


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
    "matrix_from_quaternion_any_norm": (lambda Q: quaternion(Q).as_matrix(), 4, 9,
        program("Rotation.from_quat([{Q}]).as_matrix()")),
    "rotate_point_any_norm": (rotate_point, 7, 3,
        program("Rotation.from_quat([{Q}]).apply([{p}])")),
    "log3_any_norm": (log3_quaternion, 4, 3,
        program("Rotation.from_quat([{Q}]).as_rotvec()")),
    "relative_angle": (relative_angle, 8, 1,
        "import numpy as np\n" + program("np.array((Rotation.from_quat([{Q0}]).inv() * Rotation.from_quat([{Q1}])).magnitude())")),
    "slerp": (slerp, 9, 4,
        "from scipy.spatial.transform import Slerp\n" + program("Slerp([0, 1], Rotation.from_quat([[{Q0}], [{Q1}]]))({t}).as_quat()")),
    "quaternion_from_matrix": (lambda R: matrix(R).as_quat(), 9, 4,
        "import numpy as np\n" + program("Rotation.from_matrix(np.reshape([{R}], (3, 3))).as_quat()")),
    "matrix_from_quaternion": (lambda Q: quaternion(Q).as_matrix(), 4, 9,
        program("Rotation.from_quat([{Q}]).as_matrix()")),
    "quaternion_product": (lambda x: (quaternion(x[..., :4]) * quaternion(x[..., 4:])).as_quat(), 8, 4,
        program("(Rotation.from_quat([{Q0}]) * Rotation.from_quat([{Q1}])).as_quat()")),
    "quaternion_inverse": (lambda Q: quaternion(Q).inv().as_quat(), 4, 4,
        program("Rotation.from_quat([{Q}]).inv().as_quat()")),
    "mrp_from_quaternion": (lambda Q: quaternion(Q).as_mrp(), 4, 3,
        program("Rotation.from_quat([{Q}]).as_mrp()")),
    "quaternion_from_mrp": (lambda s: Rotation.from_mrp(s).as_quat(), 3, 4,
        program("Rotation.from_mrp([{mrp}]).as_quat()")),
    "mean_rotation": (lambda x: Rotation.from_quat(x[:12].reshape(3, 4)).mean(x[12:]).as_quat(), 15, 4,
        program("Rotation.from_quat([[{Q0}], [{Q1}], [{Q2}]]).mean([{weights}]).as_quat()")),
    "euler_to_quaternion": (lambda x: Rotation.from_euler(order(x[0]), x[1:]).as_quat(), 4, 4),
    "euler_to_matrix": (lambda x: Rotation.from_euler(order(x[0]), x[1:]).as_matrix(), 4, 9),
    "euler_from_quaternion": (lambda x: quaternion(x[1:]).as_euler(order(x[0])), 5, 3,
        f"o = {ORDERS}[int({{order}}) // 2]; o = o.upper() if {{order}} % 2 else o\n" + program("Rotation.from_quat([{Q}]).as_euler(o)")),
    "euler_from_matrix": (lambda x: matrix(x[1:]).as_euler(order(x[0])), 10, 3,
        f"import numpy as np; o = {ORDERS}[int({{order}}) // 2]; o = o.upper() if {{order}} % 2 else o\n" +
        program("Rotation.from_matrix(np.reshape([{R}], (3, 3))).as_euler(o)")),
}, many="""exp3_quaternion exp3_matrix log3_quaternion log3_matrix rotate_point normalize matrix_from_quaternion_any_norm
    rotate_point_any_norm log3_any_norm relative_angle quaternion_from_matrix matrix_from_quaternion quaternion_product
    quaternion_inverse mrp_from_quaternion quaternion_from_mrp""".split(), own={
    "rotate_point": lambda x: (quaternion(x[..., :4]).apply, (x[..., 4:],)),
    "quaternion_product": lambda x: (operator.mul, (quaternion(x[..., :4]), quaternion(x[..., 4:]))),
    "quaternion_inverse": lambda Q: (quaternion(Q).inv, ()),
    "matrix_from_quaternion": lambda Q: (quaternion(Q).as_matrix, ()),
    "log3_quaternion": lambda Q: (quaternion(Q).as_rotvec, ()),
    "mrp_from_quaternion": lambda Q: (quaternion(Q).as_mrp, ()),
    "exp3_quaternion": lambda phi: (Rotation.from_rotvec, (phi,)),
    "quaternion_from_matrix": lambda R: (Rotation.from_matrix, (R.reshape(R.shape[:-1] + (3, 3)),)),
})
