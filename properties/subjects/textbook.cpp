// Subject "textbook" in float and double: subjects/textbook.hpp. It is the positive control: every campaign over all
// subjects must find its large errors near the cutoff. The variants textbook:1e-1 ... textbook:1e-12 have the cutoff
// in their name and run only if they are named.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <subjects/own_programs.hpp>
#include <subjects/textbook.hpp>

#include <utility>
#include <vector>

namespace liecheck::properties {
namespace {

const Registered<float> in_float(Textbook<float>::make<8, false>());
const Registered<double> in_double(Textbook<double>::make<8, false>());

template <class S, int... i>
std::vector<Registered<S>> variants(std::integer_sequence<int, i...>) {
  return {Registered<S>(Textbook<S>::template make<i + 1, true>())...};
}
const auto variants_in_float = variants<float>(std::make_integer_sequence<int, 12>());
const auto variants_in_double = variants<double>(std::make_integer_sequence<int, 12>());

/// The argument as the textbook's functions take it: a pose by its two parts.
std::string argument(const Layout& l) {
  return l.type == "SE3<S>" ? fmt::format("{{{}, {}}}", l.parts[0].name, l.parts[1].name)
                            : std::string(l.name);
}

/// The programs of the textbook with this cutoff.
OwnPrograms programs(const std::string& cutoff) {
  OwnPrograms all{"-I lib -I properties",
                  "#include <subjects/textbook.hpp>\nusing namespace liecheck::properties;\n",
                  "const Textbook<S> book{{}, " + cutoff + "};\n",
                  {}};
  const auto offered = Textbook<double>::make<8, false>().operations;
  offered.for_each([&](const Operation& o) {
    if (!offered.has(o)) return;
    std::vector<std::string> arguments;
    for (const Layout* l : o.arguments) arguments.push_back(argument(*l));
    const std::string value = fmt::format("book.{}({})", o.name, fmt::join(arguments, ", "));
    all.statements.emplace_back(
        &o, o.results[0]->type == "SE3<S>"
                ? "const Pose<S> T = " + value + ";\nstd::cout << T.R << '\\n' << T.p << '\\n';"
                : value);
  });
  return all;
}

const std::vector<RegisteredPrograms> registered_programs = [] {
  std::vector<RegisteredPrograms> all{{"textbook", programs("1e-8")}};
  for (int e = 1; e <= 12; ++e)
    all.emplace_back(fmt::format("textbook:1e-{}", e), programs(fmt::format("1e-{}", e)));
  return all;
}();

}  // namespace
}  // namespace liecheck::properties
