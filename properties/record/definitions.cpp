#include <record/definitions.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <string>

namespace liecheck::properties {
namespace {

using nlohmann::json;

json size_of(const Part& part) {
  switch (part.size) {
    case nq:
      return "nq";
    case nv:
      return "nv";
    case nv_by_nv:
      return "nv x nv";
    case six_by_nv:
      return "6 x nv";
    default:
      return part.size;
  }
}

/// One entry for each part. Its name is "phi" if its argument has one part, and "X.R" if it has several.
template <class Layouts>
json parts_of(const Layouts& layouts) {
  json list = json::array();
  for (const Layout* l : layouts) {
    if (l->parts.size() == 0)
      list.push_back({{"name", l->name}, {"size", 1}, {"unit", "1"}, {"frame", l->frame}});
    for (const Part& p : l->parts)
      list.push_back(
          {{"name", l->parts.size() == 1 ? std::string(p.name) : fmt::format("{}.{}", l->name, p.name)},
           {"size", size_of(p)},
           {"unit", p.unit},
           {"frame", l->frame}});
  }
  return list;
}

}  // namespace

json definition_of(const Operation& o) {
  return {{"operation", o.name},
          {"definition", o.definition},
          {"source", o.source},
          {"frame", o.results[0]->frame},
          {"arguments", parts_of(o.arguments)},
          {"results", parts_of(o.results)},
          {"expression", o.call.expression}};
}

json definition_of(const Output& o) {
  return {{"operation", o.operation},
          {"block", o.block},
          {"error", o.definition->error},
          {"denominator", o.definition->denominator},
          {"unit", o.definition->unit}};
}

}  // namespace liecheck::properties
