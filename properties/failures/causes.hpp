#pragma once
// Which operation a wrong result of another one comes from: a difference of poses is wrong where the logarithm inside it is.

#include <campaign/series.hpp>

namespace liecheck::properties {

struct NotedCall;  // calls.hpp

/// The operations that explain a wrong result: computed by the definition from the subject's own result of that operation,
/// and from exact ones of all others, it is as wrong, in the same direction, to a third of its error. Blocks that follow
/// from another block of the same result name their own operation. Where rounding decides how wrong a result is, one as wrong
/// in another direction counts, too. Empty if there are none.
std::vector<std::string_view> explained_by(const Series& series, const Output& output, const NotedCall& call);

}  // namespace liecheck::properties
