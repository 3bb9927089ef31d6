"""Libraries that the tests of the Python package serve: a correct one in every form, and ones that are
wrong."""
import os
import sys
import time

import numpy as np

import liecheck

sys.path.insert(0, os.environ.get("LIECHECK_TREES", "."))


def product(P, Q):
    (x, y, z, w), (a, b, c, d) = np.moveaxis(P, -1, 0), np.moveaxis(Q, -1, 0)
    return np.stack(
        [
            w * a + x * d + y * c - z * b,
            w * b - x * c + y * d + z * a,
            w * c + x * b - y * a + z * d,
            w * d - x * a - y * b - z * c,
        ],
        axis=-1,
    )


class Forms:
    """Batches, both scalars, poses as matrices and as pairs."""

    name, version, scalars = "forms", "2.1", ["float32", "float64"]

    @liecheck.operation("quaternion_product", batch=True)
    def many(self, Q0, Q1):
        assert Q0.ndim == 2 and Q0.dtype in (np.float32, np.float64)
        return product(Q0, Q1)

    def compose(self, X, Y):
        return X @ Y

    def inverse(self, R, p):
        return R.T, -R.T @ p

    def act_point(self, X, p_Y):
        return X[:3, :3] @ p_Y + X[:3, 3]

    def quaternion_inverse(self, Q):
        if not Q.any():
            raise ValueError("Q is 0")
        return Q * np.array([-1, -1, -1, 1], Q.dtype)


class Fault(Forms):
    """A quaternion product whose last number has a wrong sign."""

    scalars = "float64"

    def many(self, Q0, Q1):
        return product(Q0, Q1) * [1, 1, 1, -1]


Fault.many = liecheck.operation("quaternion_product", batch=True)(Fault.many)


class Crash:
    def quaternion_inverse(self, Q):
        with open("starts", "a") as file:
            print(os.getppid(), file=file)
        os._exit(3)


class Hang:
    def quaternion_inverse(self, Q):
        while Q[0] != 1.25:
            time.sleep(0.001)
        return Q


class Shape:
    def exp3_matrix(self, phi):
        return phi


class Transposed:
    def inverse(self, X):
        return np.linalg.inv(X).T


class Nothing:
    def log3_quaternion(self, Q):
        return None


class Misnamed:
    def exp_6(self, xi):
        return xi


class Misspelt:
    def invers(self, X):
        return X

    def compose(self, X, Y):
        return X @ Y


class Foreign:
    def exp3_matrix(phi):
        return Foreign()


class Arity:
    def act_point(self, X, a, b, c):
        return a


class Raises:
    def exp3_matrix(self, phi):
        return phi.nothing


class Scalars:
    scalars = "float16"
    exp3_matrix = Shape.exp3_matrix


def trees():
    """The simulator of fixtures/adapters/trees with NumPy arrays."""
    from tree import Tree

    class Model(Tree):
        tree_rnea, tree_crba, tree_aba, tree_kinetic_energy = (
            Tree.rnea,
            Tree.crba,
            Tree.aba,
            Tree.kinetic_energy,
        )

        def frame_pose(self, q, frame):
            return super().frame_pose(q, np.hstack(frame))

        def frame_jacobian(self, q, seen, frame):
            return super().frame_jacobian(q, seen, np.hstack(frame))

    class Trees:
        models = "joints"

    Trees.Model = Model
    return Trees


def __getattr__(name):
    if name == "Trees":
        return trees()
    raise AttributeError(name)
