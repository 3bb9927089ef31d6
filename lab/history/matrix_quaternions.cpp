// Conversions between matrices and quaternions, and products of quaternions.

#include <cmath>
#include <history/history.hpp>

namespace liecheck::properties::history {
namespace {

V4 xyzw(double x, double y, double z, double w) {
  return {x, y, z, w};
}
double root(double x) {
  return std::sqrt(std::max(0., x));
}
/// |x|, |y|, |z|, |w| by the diagonal.
V4 sizes(const M3& R) {
  const double a = R(0, 0), b = R(1, 1), c = R(2, 2);
  return V4(root(1 + a - b - c), root(1 - a + b - c), root(1 - a - b + c), root(1 + a + b + c)) / 2;
}
/// The quaternion whose number `k` among x, y, z is the pivot.
V4 by_axis(const M3& R, int k) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const double s = 2 * root(1 + R(k, k) - R(i, i) - R(j, j));
  V4 q;
  q[k] = s / 4, q[i] = (R(i, k) + R(k, i)) / s, q[j] = (R(j, k) + R(k, j)) / s,
  q[3] = (R(j, i) - R(i, j)) / s;
  return q;
}
int largest_axis(const M3& R) {
  int k = 0;
  R.diagonal().maxCoeff(&k);
  return k;
}
V4 by_trace(const M3& R) {
  const double w = std::sqrt(1 + R.trace()) / 2;
  return joined(differences(R) / (4 * w), w);
}

// Longer than 80 lines: a list of independent rows.
std::vector<HistoricBug> quaternions_of_matrices() {
  const auto row = rows_of(op::quaternion_from_matrix, by_pivot);
  return {
      row("go3d_37", "go3d before the repair", "ungerik/go3d#37", "all", "a norm that is not 1",
          "The trace was that of the 4 x 4 matrix, and no branch looked at its sign.",
          [](const M3& R) -> V4 {
            const double s = std::sqrt(R.trace() + 2);
            return joined(differences(R) / (2 * s), s / 2);
          }),
      row("spatialmath_65", "spatialmath-python 1.1", "bdaiinstitute/spatialmath-python#65", "theta = pi",
          "signs of x, y, z", "The signs were those of differences that are all zero at pi.",
          [](const M3& R) -> V4 {
            V4 q = sizes(R);
            const V3 d = differences(R);
            for (int i = 0; i < 3; ++i)
              if (d[i] < 0) q[i] = -q[i];
            return q;
          }),
      row("spatialmath_73", "spatialmath-python 1.1.5", "bdaiinstitute/spatialmath-python#73",
          "z the largest", "a wrong y", "y was given the size of x.",
          [](const M3& R) -> V4 {
            if (R.trace() > 0 || largest_axis(R) != 2) return by_pivot(R);
            V4 q = by_axis(R, 2);
            q[1] = std::copysign(std::abs(q[0]), R(2, 1) + R(1, 2));
            return q;
          }),
      row("ase_73", "ASE poselib", "nv-tlabs/ASE#73", "two largest of the same size", "signs",
          "Four independent tests for the largest number followed one another, so that two changed the "
          "signs.",
          [](const M3& R) -> V4 {
            V4 q = sizes(R);
            const V3 d = differences(R);
            const auto sign = [](double x) { return x > 0 ? 1. : x < 0 ? -1. : 0.; };
            const double m = q.maxCoeff();
            if (q[3] >= m)
              for (int i = 0; i < 3; ++i) q[i] *= sign(d[i]);
            for (int k = 0; k < 3; ++k)
              if (q[k] >= m) {
                const int i = (k + 1) % 3, j = (k + 2) % 3;
                q[3] *= sign(d[k]), q[i] *= sign(R(i, k) + R(k, i)), q[j] *= sign(R(j, k) + R(k, j));
              }
            return q;
          }),
      row("rbdl_107", "RBDL 3.3.1", "rbdl/rbdl#107", "near pi", "NaN, or a large number",
          "Only the branch of the trace existed, which divides by 4 w.", by_trace),
      row("vecmath_6", "vecmath", "hharrison/vecmath#6", "theta = pi", "NaN",
          "The size of 1 + tr R was tested, and then the root of its negative value taken.",
          [](const M3& R) -> V4 {
            const double ww = (1 + R.trace()) / 4;
            if (std::abs(ww) < 1e-30) return by_axis(R, largest_axis(R)).normalized();
            const double w = std::sqrt(ww);
            return joined(differences(R) / (4 * w), w);
          }),
      row("vectormath_12", "VectorMath before 0.3.1", "nicklockwood/VectorMath#12", "identity", "NaN",
          "The test of the trace was inverted, so that the identity went to the branch of the axes.",
          [](const M3& R) -> V4 {
            const double t = 1 + R.trace();
            return std::abs(t) < 1e-6 ? by_trace(R) : by_axis(R, largest_axis(R));
          }),
      row("bno055_19", "Adafruit_BNO055", "adafruit/Adafruit_BNO055#19", "beyond 120 degrees",
          "lost digits, NaN", "The smallest number of the diagonal was the pivot, not the largest.",
          [](const M3& R) -> V4 {
            if (R.trace() > 0) return by_pivot(R);
            int k = 0;
            R.diagonal().minCoeff(&k);
            return by_axis(R, k);
          }),
      row("mex_wholebody_92", "mex-wholebodymodel", "robotology-legacy/mex-wholebodymodel#92",
          "x the largest, tr R < 0", "a wrong w",
          "w was the sum of two entries in place of their difference.",
          [](const M3& R) -> V4 {
            V4 q = by_pivot(R);
            if (R.trace() <= 0 && largest_axis(R) == 0)
              q = by_axis(R, 0), q[3] = (R(2, 1) + R(1, 2)) / (4 * q[0]);
            return q;
          }),
      row("pytorch3d_646", "PyTorch3D 0.4", "facebookresearch/pytorch3d#646", "theta = pi",
          "the same quaternion for two half turns", "The signs were copied from differences that are zero.",
          [](const M3& R) -> V4 {
            V4 q = sizes(R);
            const V3 d = differences(R);
            for (int i = 0; i < 3; ++i) q[i] = std::copysign(q[i], d[i]);
            return q;
          }),
      row("liegroups_57a4e7f", "liegroups before 2019-03", "commit 57a4e7f of utiasSTARS/liegroups", "all",
          "a wrong z", "z was the difference of entries that belongs to x.",
          [](const M3& R) -> V4 {
            V4 q = by_pivot(R);
            if (std::abs(q[3]) > 1e-4) q[2] = q[0];
            return q;
          }),
      row("pytransform3d_5d8929a", "pytransform3d, 2016", "commit 5d8929a of dfki-ric/pytransform3d",
          "theta = pi", "zeros", "Differences stood where the sums of entries belong.",
          [](const M3& R) -> V4 {
            if (1 + R.trace() > 1e-12) return by_pivot(R);
            const int k = largest_axis(R), i = (k + 1) % 3, j = (k + 2) % 3;
            V4 q = by_axis(R, k);
            q[i] = (R(i, k) - R(k, i)) / (4 * q[k]), q[j] = (R(j, k) - R(k, j)) / (4 * q[k]);
            return q;
          }),
      row("pyrr_42", "Pyrr", "adamlwgriffiths/Pyrr#42", "numbers of mixed signs", "the signs are lost",
          "The lines that set the signs of four square roots were commented out.", sizes),
      row("reactphysics3d_157", "ReactPhysics3D", "DanielChappuis/reactphysics3d#157",
          "x the largest, tr R < 0", "a zero number", "z was a difference of entries in place of their sum.",
          [](const M3& R) -> V4 {
            V4 q = by_pivot(R);
            if (R.trace() < 0 && largest_axis(R) == 0)
              q = by_axis(R, 0), q[2] = (R(2, 0) - R(0, 2)) / (4 * q[0]);
            return q;
          }),
      row("linmath_37", "linmath.h", "datenwolf/linmath.h#37", "all", "another rotation",
          "The largest number always went to x, and all others were differences.",
          [](const M3& R) -> V4 {
            const int k = largest_axis(R), i = (k + 1) % 3, j = (k + 2) % 3;
            const double r = root(1 + R(k, k) - R(i, i) - R(j, j));
            if (r < 1e-6) return {1, 0, 0, 0};
            return xyzw(r / 2, (R(k, i) - R(i, k)) / (2 * r), (R(j, k) - R(k, j)) / (2 * r),
                        (R(j, i) - R(i, j)) / (2 * r));
          }),
      row("cesium_340", "Cesium, 2012", "CesiumGS/cesium#340", "all", "the conjugate",
          "Rows and columns of the matrix were exchanged.",
          [](const M3& R) -> V4 { return by_pivot(R.transpose()); }),
  };
}

std::vector<HistoricBug> matrices_of_quaternions() {
  const auto row = rows_of(op::matrix_from_quaternion, matrix_of);
  return {
      row("sympy_15193", "SymPy 1.2", "sympy/sympy#15193", "x w != 0", "no rotation",
          "One term of one entry had the wrong sign.",
          [](const V4& Q) -> M3 {
            M3 R = matrix_of(Q);
            R(1, 2) += 4 * Q[3] * Q[0];
            return R;
          }),
      row("librobotcontrol_66", "librobotcontrol", "beagleboard/librobotcontrol#66", "all",
          "a symmetric matrix", "The lower triangle was the mirror of the upper one.",
          [](const V4& Q) -> M3 {
            M3 R = matrix_of(Q);
            R(1, 0) = R(0, 1), R(2, 0) = R(0, 2), R(2, 1) = R(1, 2);
            return R;
          }),
      row("raylib_1793", "raylib", "raysan5/raylib#1793", "all", "the transposed matrix",
          "Every term with w had the opposite sign.",
          [](const V4& Q) -> M3 { return matrix_of(Q).transpose(); }),
      row("libccd_13", "libccd", "danfis/libccd#13", "off unit", "a stretched matrix",
          "The diagonal was w^2 + x^2 - y^2 - z^2 of a quaternion that need not be unit, doubled once too "
          "often.",
          [](const V4& Q) -> M3 {
            M3 R = matrix_of(Q);
            for (int i = 0; i < 3; ++i) R(i, i) = 2 * (Q[3] * Q[3] + Q[i] * Q[i]);
            return R;
          }),
  };
}

std::vector<HistoricBug> products() {
  const auto row = rows_of(op::quaternion_product, H::multiply);
  return {
      row("maf_2", "maf", "bjornbytes/maf#2", "axes that differ", "a commutative product",
          "Both terms of the cross product were subtracted.",
          [](const V4& a, const V4& b) -> V4 {
            return {a[0] * b[3] + a[3] * b[0] - a[1] * b[2] - a[2] * b[1],
                    a[1] * b[3] + a[3] * b[1] - a[2] * b[0] - a[0] * b[2],
                    a[2] * b[3] + a[3] * b[2] - a[0] * b[1] - a[1] * b[0],
                    a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
          }),
      row("pyrr_34", "Pyrr", "adamlwgriffiths/Pyrr#34", "axes that differ", "i j = -k",
          "The factors were exchanged.", [](const V4& a, const V4& b) -> V4 { return H::multiply(b, a); }),
      row("vmath_68", "vmath before 3", "treeform/vmath#68", "all", "no rotation",
          "The product was that of vectors, number by number.",
          [](const V4& a, const V4& b) -> V4 { return a.cwiseProduct(b); }),
      row("mfgd_2", "MathForGameDevelopers", "BSVino/MathForGameDevelopers#2", "all", "a norm that is not 1",
          "The real part was w0 w1 + v0 . v1.",
          [](const V4& a, const V4& b) -> V4 {
            V4 q = H::multiply(a, b);
            q[3] = a[3] * b[3] + a.head<3>().dot(b.head<3>());
            return q;
          }),
  };
}

const HistoryRows of_matrix(quaternions_of_matrices), to_matrix(matrices_of_quaternions),
    of_products(products);

}  // namespace
}  // namespace liecheck::properties::history
