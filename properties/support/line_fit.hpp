#pragma once
// The slope of a line through points.

namespace liecheck::properties {

/// y = a + b x by least squares.
class LineFit {
 public:
  void add(double x, double y) { ++n_, x_ += x, y_ += y, xx_ += x * x, xy_ += x * y; }
  double count() const { return n_; }
  /// b; 0 if all x are equal.
  double slope() const {
    const double spread = n_ * xx_ - x_ * x_;
    return spread > 0 ? (n_ * xy_ - x_ * y_) / spread : 0;
  }

 private:
  double n_ = 0, x_ = 0, y_ = 0, xx_ = 0, xy_ = 0;
};

}  // namespace liecheck::properties
