#pragma once
// The result of one call of a model in double, as a vector.

#include <adapters/trees.hpp>

namespace liecheck::properties::adapters {

inline std::vector<double> asked(const Model& model, const Operation& operation,
                                 const std::vector<double>& arguments) {
  std::vector<double> results(model.sizes(operation).results);
  model.call(operation, arguments.data(), results.data());
  return results;
}

}  // namespace liecheck::properties::adapters
