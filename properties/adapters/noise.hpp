#pragma once
// What adapters say on standard error, in few lines: an adapter that crashes in every tenth call would print a
// traceback for each.

#include <string>
#include <string_view>

namespace liecheck::properties::adapters {

/// Says on standard error that a call failed, once for each kind and operation, with the last line that the adapter
/// wrote to its standard error. Later ones are counted.
void say_failed(const std::string& subject, std::string_view operation, const std::string& how,
                const std::string& errors);

/// Says on standard error which repeated call gave another result, once for each operation. Later ones are counted.
void say_not_repeatable(const std::string& subject, std::string_view operation, const std::string& which);

/// Passes on what an adapter wrote to its standard error: 20 lines in all, the last ones of what it wrote at a time, since a
/// traceback ends with what went wrong. The others are counted.
void pass_on(const std::string& errors);

/// Says on standard error how often each of them happened, if more than once, and forgets them.
void say_counts();

}  // namespace liecheck::properties::adapters
