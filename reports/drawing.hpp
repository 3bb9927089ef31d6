#pragma once
// The elements of the pictures, as SVG.

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace liecheck::reports {

/// The size of a picture and the frame of its axes [px].
inline constexpr double width = 320, height = 236, left = 30, right = 312, top = 12, bottom = 196;

std::string text(double x, double y, const std::string& words, const char* anchor = "middle",
                 const char* kind = "");

/// 10 to a power, "10⁻⁸".
std::string power(int exponent);

std::string line(double x0, double y0, double x1, double y1, const char* kind);

inline constexpr std::size_t look_count = 11;  ///< of libraries, which have a colour and an outline each

/// The outline of a look, around (0, 0).
const char* outline(std::size_t look);

/// The mark of a look, with a title that a pointer shows; a small one has two thirds of its size.
std::string marker(double x, double y, std::size_t look, const std::string& title, const char* kind = "mark",
                   bool is_small = false);

/// The elements of a library, in its colour.
std::string in_look(std::size_t look, const std::string& elements);

/// A picture with its label for those who do not see it.
std::string drawn(const std::string& label, const std::string& elements, double high = height);

/// Names beside points. A name that finds no room beside its point stands
/// farther away, at a line; if there is no room there either, it is left out.
class Names {
 public:
  struct Box {
    double x0, y0, x1, y1;
  };
  void keep_free(const Box& box) { taken_.push_back(box); }
  /// Keeps a mark free; the names of others keep clear of it, where there is room.
  void keep_mark(double x, double y) { keep_free({x - 5, y - 5, x + 5, y + 5}), marks_.emplace_back(x, y); }
  /// The name of the point (x, y), or "".
  std::string name(double x, double y, const std::string& words, const char* kind);

 private:
  bool is_free(const Box& box) const;
  /// Whether all marks but that at (x, y) are so far from the box.
  bool is_clear(const Box& box, double x, double y, double clear) const;
  std::vector<Box> taken_;
  std::vector<std::pair<double, double>> marks_;
};

}  // namespace liecheck::reports
