#include <league/explanations.hpp>

namespace liecheck::properties::league {

std::string repair_of(const std::string& operation) {
  if (operation.starts_with("exp3_quaternion"))
    return "Q = (sin(theta/2)/theta phi, cos(theta/2)), with 1/2 for sin(theta/2)/theta at theta = 0, and no "
           "other threshold";
  if (operation.starts_with("exp3_matrix"))
    return "R = 1 + c1 [phi] + c2 [phi]^2, with c1 = sin(theta)/theta and c2 = 2 (sin(theta/2)/theta)^2, and "
           "their limits 1 and 1/2 at theta = 0";
  if (operation == "log3_matrix")
    return "the quaternion Q = (v, w) of R by its largest pivot, then phi = 2 atan2(|v|, |w|)/|v| v, with "
           "the sign "
           "of w, and 0 for v = 0";
  if (operation.starts_with("log3"))
    return "phi = 2 atan2(|v|, |w|)/|v| v for Q = (v, w), with the sign of w, and 0 for v = 0";
  if (operation == "relative_angle")
    return "2 atan2(|v|, |w|) for the product (v, w) of the conjugate of Q0 with Q1";
  if (operation == "rotation_between")
    return "for unit a and b, with c = a + b: Q = (a x c / |c|, |c|/2), normalised; where |c| is a few "
           "roundings, w = "
           "0 and any unit axis perpendicular to a";
  if (operation.starts_with("euler_from"))
    return "the middle angle by atan2 of both of its parts, without asin or acos, and without a threshold "
           "for gimbal "
           "lock: one of the outer angles by atan2, and the other from the matrix that is left when its turn "
           "is "
           "taken back";
  if (operation == "slerp")
    return "the angle by atan2(|Q1 - Q0|, |Q1 + Q0|), and its sines, without a threshold on the cosine";
  if (operation == "normalize") return "Q / |Q|, with Q scaled by its largest component first";
  return "none is proposed here";
}

std::string oracles_of(const std::string& operation) {
  if (operation.starts_with("exp"))
    return "the closed form in half angles at 100 digits, and the power series of the matrix exponential at "
           "50";
  if (operation.starts_with("log"))
    return "the closed form with atan2 at 100 digits, and inverse scaling and squaring by square roots, "
           "without "
           "atan2, at 50";
  if (operation.find("jacobian") != operation.npos)
    return "the closed form at 100 digits, and the power series of the matrix at 50";
  if (operation == "relative_angle")
    return "the logarithm of Q0* Q1, and 4 asin of half the distance of Q0 and Q1, both at 100 digits";
  if (operation == "slerp")
    return "the sines of both parts of the arc at 100 digits, and Q0 exp(t log(Q0* Q1)) at 50";
  if (operation == "rotation_between")
    return "they are one of several results; the error is that of the law's equation at 50 digits, for which "
           "no expected "
           "numbers are needed";
  if (operation.starts_with("euler_from"))
    return "the error compares the rotation of the angles, as a product of quaternions at 100 digits and of "
           "matrices at "
           "50, with that of the input";
  return "one formula at 100 digits and another at 50";
}

}  // namespace liecheck::properties::league
