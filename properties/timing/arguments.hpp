#pragma once
// The arguments of an operation out of the numbers of a law's input: parts and fields of one name are the same numbers.

#include <invariants/property.hpp>
#include <tuple>

namespace liecheck::properties {

/// The fields of a law, by name.
class FieldPositions {
 public:
  explicit FieldPositions(const std::vector<Field>& fields) : fields_(fields) {}

  /// Does the law's input hold every argument of the operation?
  bool has_arguments_of(const Operation& operation) const {
    for (const Layout* argument : operation.arguments)
      for (const Part& part : argument->parts)
        if (!find(part.name).first) return false;
    return true;
  }
  /// Appends the part's numbers; the six of an inertia become the nine of its matrix.
  template <class S>
  void append(const Part& part, const std::vector<S>& x, std::vector<S>& numbers) const {
    const auto [field, from] = find(part.name);
    if (field->kind == Kind::inertia)  // xx xy yy xz yz zz
      for (std::size_t i : {0, 1, 3, 1, 2, 4, 3, 4, 5}) numbers.push_back(x[from + i]);
    else
      for (std::size_t i = 0; i < static_cast<std::size_t>(field->size); ++i) numbers.push_back(x[from + i]);
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

namespace timing_detail {

template <class S, int R, int C>
void assign(Eigen::Matrix<S, R, C>& m, const S*& from) {
  for (int i = 0; i < R; ++i)
    for (int j = 0; j < C; ++j) m(i, j) = *from++;
}
template <class S>
void assign(Pose<S>& X, const S*& from) {
  assign(X.R, from), assign(X.p, from);
}
template <class S>
void assign(Body<S>& I, const S*& from) {
  I.mass = *from++, assign(I.c, from), assign(I.I_C, from);
}

}  // namespace timing_detail

/// The arguments of an operation, read from an input of the law that has these fields.
template <class S, class Id, bool Bound, class Result, class... Arguments>
std::tuple<typename Arguments::template of<S>...> arguments_of(
    const Typed<Id, Bound, Result, Arguments...>& operation, const FieldPositions& fields,
    const std::vector<S>& input) {
  std::vector<S> numbers;
  for (const Layout* argument : operation.arguments)
    for (const Part& part : argument->parts) fields.append(part, input, numbers);
  std::tuple<typename Arguments::template of<S>...> all;
  const S* from = numbers.data();
  std::apply([&](auto&... argument) { (timing_detail::assign(argument, from), ...); }, all);
  return all;
}

/// The first law, by name, that measures the operation on its own arguments; null where there is none.
template <class S>
const Property<S>* law_of(const Operation& operation, const std::vector<std::unique_ptr<Property<S>>>& laws) {
  for (const auto& law : laws)
    for (const Output& o : law->outputs())
      if (o.record == &operation && FieldPositions(law->fields()).has_arguments_of(operation))
        return law.get();
  return nullptr;
}

}  // namespace liecheck::properties
