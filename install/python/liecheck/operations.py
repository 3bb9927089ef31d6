"""The operations of docs/operations.md: the names, shapes and parts of their arguments and results."""
import math

PARTS = {  # of the values that have several: name and shape of each
    "pose": "R:3x3 p:3",
    "extended": "R:3x3 p:3 v:3",
    "tangent": "rho:3 phi:3",
    "tangent9": "rho:3 nu:3 phi:3",
    "twist": "u:3 omega:3",
    "wrench": "f:3 n:3",
    "spatial": "linear:3 angular:3",
    "body": "mass:1 c:3 I_C:3x3",
    "configuration": "p:3 Q:4",
    "planar": "p:2 r:2",
    "planar_tangent": "rho:2 omega:1",
    "axis_angle": "axis:3 angle:1",
    "screw": "axis:3 pitch:1 point:3",
    "increment": "dR:3x3 dp:3 dv:3",
    "frame": "joint:1 Q:4 p:3",
    "derivatives": "by_q:vxv by_v:vxv",
    "derivatives6": "by_q:6xv by_v:6xv",
}
SIGNATURES = """
phi:3 -> Q:4 = exp3_quaternion
phi:3 -> R:3x3 = exp3_matrix
Q:4 -> phi:3 = log3_quaternion log3_any_norm
R:3x3 -> phi:3 = log3_matrix
xi:tangent -> T:pose = exp6
X:pose -> xi:tangent = log6
X:pose Y:pose -> X:pose = compose
X:pose -> X:pose = inverse
X:pose p_Y:3 -> x_A:3 = act_point
X:pose V:twist -> V:twist = act_motion act_inverse_motion
X:pose F:wrench -> F:wrench = act_force act_inverse_force
V:twist W:twist -> [V,W]:spatial = cross_motion
V:twist F:wrench -> VxF:spatial = cross_force
Q:4 p:3 -> x_A:3 = rotate_point rotate_point_any_norm
X:pose I:body -> I:body = act_inertia act_inverse_inertia
I:body V:twist -> h:spatial = momentum
I:body V:twist -> T:1 = kinetic_energy
I:body -> M:6x6 = inertia_matrix
q0:configuration delta:tangent -> q1:configuration = integrate integrate_any_norm
q0:configuration q1:configuration -> delta:tangent = difference difference_any_norm
phi:3 -> J:3x3 = left_jacobian3 right_jacobian3 left_jacobian3_inverse right_jacobian3_inverse
xi:tangent -> J:6x6 = left_jacobian6 right_jacobian6 left_jacobian6_inverse right_jacobian6_inverse
q0:configuration delta:tangent -> J:6x6 = d_integrate_arg0 d_integrate_arg1
q0:configuration q1:configuration -> J:6x6 = d_difference_arg0 d_difference_arg1 d_difference_any_norm
q:configuration -> J:7x6 = integrate_coefficient_jacobian
Q:4 -> Q_n:4 = normalize first_order_normalize
Q:4 -> R:3x3 = matrix_from_quaternion matrix_from_quaternion_any_norm
Q0:4 Q1:4 -> angle:1 = relative_angle
Q:4 axis:3 -> angle:1 = twist_angle
Q0:4 Q1:4 t:1 -> Q:4 = slerp
a:3 b:3 -> Q:4 = rotation_between
order:1 angles:3 -> Q:4 = euler_to_quaternion
order:1 angles:3 -> R:3x3 = euler_to_matrix
order:1 Q:4 -> angles:3 = euler_from_quaternion
order:1 R:3x3 -> angles:3 = euler_from_matrix
q:configuration V:twist -> q_dot:configuration = velocity_to_rate
q:configuration q_dot:configuration -> V:twist = rate_to_velocity
delta:planar_tangent -> q:planar = se2_exp
q1:planar -> delta:planar_tangent = se2_log
q0:planar q1:planar -> q:planar = se2_compose
q0:planar delta:planar_tangent -> q:planar = se2_integrate
q0:planar q1:planar -> delta:planar_tangent = se2_difference
R:3x3 -> Q:4 = quaternion_from_matrix
Q0:4 Q1:4 -> Q:4 = quaternion_product
Q:4 -> Q:4 = quaternion_inverse
Q:4 -> axis_angle:axis_angle = axis_angle_from_quaternion
R:3x3 -> axis_angle:axis_angle = axis_angle_from_matrix
axis:3 angle:1 -> Q:4 = quaternion_from_axis_angle
axis:3 angle:1 -> R:3x3 = matrix_from_axis_angle
Q:4 -> gibbs:3 = gibbs_from_quaternion
gibbs:3 -> Q:4 = quaternion_from_gibbs
Q:4 -> mrp:3 = mrp_from_quaternion
mrp:3 -> Q:4 = quaternion_from_mrp
A:3x3 -> R:3x3 = nearest_rotation gram_schmidt
X:pose -> Ad:6x6 = adjoint coadjoint
V:twist -> ad:6x6 = small_adjoint
X:pose Sigma:6x6 -> Sigma:6x6 = transport_covariance
V:twist -> screw:screw = screw_parameters
Q0:4 Q1:4 Q2:4 weights:3 -> Q:4 = mean_rotation geodesic_mean
q0:configuration q1:configuration q2:configuration weights:3 -> q:configuration = mean_pose
q0:configuration q1:configuration t:1 -> q:configuration = interpolate
a:3 b:3 -> angle:1 = angle_between
a:3 b:3 t:1 -> x:3 = slerp_directions
xi:tangent9 -> X:extended = se23_exp
X:extended -> xi:tangent9 = se23_log
xi:tangent9 -> J:9x9 = se23_left_jacobian se23_right_jacobian
X:extended -> J:9x9 = se23_adjoint
gyro:3x3 accelerometer:3x3 dt:1 -> increment:increment = preintegrate_forster preintegrate_brossard
gyro:3x3 accelerometer:3x3 dt:1 -> D:15x3 = forster_bias_jacobians brossard_bias_jacobians
Q:4 -> = check_quaternion
R:3x3 -> = check_rotation
"""
# Of a tree: q and v stand for the numbers of a configuration and of a velocity.
TREE_SIGNATURES = """
q:q v:v a:v wrench_joint:1 wrench:wrench -> tau:v = tree_rnea
q:q v:v tau:v wrench_joint:1 wrench:wrench -> a:v = tree_aba
q:q v:v -> tau:v = tree_nonlinear_effects
q:q -> tau:v = tree_gravity
q:q -> M:vxv = tree_crba tree_mass_inverse
q:q v:v a:v wrench_joint:1 wrench:wrench -> D:derivatives = rnea_derivatives
q:q v:v tau:v wrench_joint:1 wrench:wrench -> D:derivatives = aba_derivatives
q:q v:v -> T:1 = tree_kinetic_energy
q:q -> V:1 = tree_potential_energy
q:q v:v -> h_g:spatial = tree_momentum
q:q -> A_g:6xv = tree_momentum_map
q:q frame:frame -> oMf:pose = frame_pose
q:q v:v seen:1 frame:frame -> V:spatial = frame_velocity
q:q v:v a:v seen:1 frame:frame -> A:spatial = frame_acceleration frame_classical_acceleration
q:q seen:1 frame:frame -> J:6xv = frame_jacobian
q:q v:v seen:1 frame:frame -> J:6xv = frame_jacobian_rate
q:q wrench_joint:1 wrench:wrench -> tau:v = tree_static_torque
q:q wrench_joint:1 wrench:wrench -> D:vxv = static_torque_derivative
q:q v:v -> C:vxv = tree_coriolis
q:q -> c:3 = tree_center_of_mass
q:q -> J_c:3xv = tree_com_jacobian
q:q v:v -> D:6xv = momentum_derivative
q:q v:v a:v -> D:derivatives6 = momentum_rate_derivatives
q:q v:v seen:1 frame:frame -> D:derivatives6 = frame_velocity_derivatives
q:q v:v a:v seen:1 frame:frame -> D:derivatives6 = frame_acceleration_derivatives
q:q seen:1 frame:frame -> Lambda:6x6 = operational_inertia
q0:q delta:v -> q1:q = robot_integrate
q0:q q1:q -> delta:v = robot_difference
q0:q q1:q -> same:1 = robot_is_same
q0:q delta:v -> J:vxv = robot_d_integrate_arg0 robot_d_integrate_arg1
q0:q q1:q -> J:vxv = robot_d_difference_arg0 robot_d_difference_arg1
"""


class Value:
    """An argument or a result: its shape as one array, or None if only its parts have one."""

    def __init__(self, name, kind, sizes):
        self.name, self.kind = name, kind
        if kind in PARTS:
            self.parts = [Value(*part.split(":"), sizes) for part in PARTS[kind].split()]
            self.size = sum(part.size for part in self.parts)
            flat = all(len(part.shape) < 2 for part in self.parts)
            self.shape = (4, 4) if kind == "pose" else (self.size,) if flat else None
        else:
            self.parts = []
            shape = tuple(sizes[n] if n in sizes else int(n) for n in kind.split("x"))
            self.shape = () if shape == (1,) and kind == "1" else shape
            self.size = math.prod(shape)

    def words(self):
        """What a function may take or give for it."""
        parts = ", ".join(f"{part.name} {part.shape}" for part in self.parts)
        if self.shape is None:
            return f"{self.name} is ({parts})"
        return f"{self.name} has shape {self.shape}" + (f", or is ({parts})" if parts else "")


def signatures(tree=None, quaternion_poses=False):
    """operation -> (arguments, result or None). tree: (nq, nv), for the operations on a tree;
    quaternion_poses: a pose is (p, Q)."""
    sizes = {} if tree is None else {"q": tree[0], "v": tree[1]}
    found = {}
    for line in (SIGNATURES if tree is None else TREE_SIGNATURES).strip().splitlines():
        values, operations = (
            line.replace(":pose", ":configuration").split(" = ") if quaternion_poses else line.split(" = ")
        )
        arguments, result = (
            [Value(*v.split(":"), sizes) for v in side.split()] for side in values.split("->")
        )
        for operation in operations.split():
            found[operation] = arguments, result[0] if result else None
    return found
