"""astropy.coordinates.matrix_utilities. Its rotation matrices turn the axes, not the vector: the angle is negative."""
import math

import astropy
import numpy as np
from astropy import units
from astropy.coordinates.matrix_utilities import angle_axis, rotation_matrix
from liecheck_protocol import serve


def exp3_matrix(phi):  # any axis for the angle 0; the function divides by the length of the axis
    return rotation_matrix(-math.hypot(*phi) * units.rad, axis=phi / abs(phi).max() if phi.any() else np.array([1.0, 0, 0]))


def log3_matrix(R):
    angle, axis = angle_axis(R.reshape(3, 3))
    return -angle.to_value(units.rad) * axis


head = "import numpy as np\nfrom astropy import units\nfrom astropy.coordinates.matrix_utilities import angle_axis, rotation_matrix\n"
serve("astropy", astropy.__version__, {
    "exp3_matrix": (exp3_matrix, 3, 9, head + (
        "phi = np.array([{phi}])\n"
        "print(*rotation_matrix(-np.linalg.norm(phi) * units.rad, axis=phi if phi.any() else np.array([1.0, 0, 0])).ravel())")),
    "log3_matrix": (log3_matrix, 9, 3, head + (
        "angle, axis = angle_axis(np.reshape([{R}], (3, 3)))\nprint(*(-angle.to_value(units.rad) * axis).tolist())")),
})
