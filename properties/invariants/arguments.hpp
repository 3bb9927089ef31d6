#pragma once
// Takes the arguments of an operation from the input of a law. A part of an argument has the numbers of the
// field with the same name.

#include <invariants/property.hpp>

namespace liecheck::properties {

/// Finds the fields of a law by name.
class FieldPositions {
 public:
  explicit FieldPositions(const std::vector<Field>& fields) : fields_(fields) {}

  /// Whether the law's input has every argument of the operation.
  bool has_arguments_of(const Operation& operation) const {
    for (const Layout* argument : operation.arguments)
      for (const Part& part : argument->parts)
        if (const Field* const f = find(part.name).first;
            !f || (f->size != part.size && !(f->kind == Kind::inertia && part.size == 9)))
          return false;
    return true;
  }
  /// The numbers of an operation's arguments, in the order of their layouts. A double holds a float exactly.
  /// The six numbers of an inertia become the nine of its matrix.
  template <class S>
  std::vector<double> arguments_of(const Operation& operation, const std::vector<S>& x) const {
    std::vector<double> numbers;
    for (const Layout* argument : operation.arguments)
      for (const Part& part : argument->parts) {
        const auto [field, from] = find(part.name);
        if (field->kind == Kind::inertia)  // xx xy yy xz yz zz
          for (std::size_t i : {0, 1, 3, 1, 2, 4, 3, 4, 5}) numbers.push_back(double(x[from + i]));
        else
          for (std::size_t i = 0; i < std::size_t(field->size); ++i) numbers.push_back(double(x[from + i]));
      }
    return numbers;
  }

 private:
  std::pair<const Field*, std::size_t> find(std::string_view name) const {
    std::size_t from = 0;
    for (const Field& f : fields_) {
      if (f.name == name) return {&f, from};
      from += static_cast<std::size_t>(f.size);
    }
    return {nullptr, 0};
  }
  const std::vector<Field>& fields_;
};

/// The first law, by name, that measures the operation on its own arguments; null if there is none.
inline const Property* law_of(const Operation& operation,
                              const std::vector<std::unique_ptr<Property>>& laws) {
  for (const auto& law : laws)
    for (const Output& o : law->outputs())
      if (o.record == &operation && FieldPositions(law->fields()).has_arguments_of(operation))
        return law.get();
  return nullptr;
}

}  // namespace liecheck::properties
