#include <operations/operations.hpp>

#include <fmt/format.h>
#include <algorithm>

namespace liecheck::properties {
namespace {

/// Escapes vertical bars, which would end a cell of the table.
std::string cell(std::string_view text) {
  std::string escaped;
  for (char c : text) escaped += c == '|' ? std::string("\\|") : std::string(1, c);
  return escaped;
}

template <class Layouts>
std::string names_of(const Layouts& layouts) {
  std::string text;
  for (const Layout* l : layouts) {
    text += (text.empty() ? "" : ", ") + std::string(l->name);
    if (l->parts.size() < 2) continue;
    text += " = (";
    for (std::size_t i = 0; i < l->parts.size(); ++i)
      text += fmt::format("{}{} [{}]", i ? ", " : "", l->parts[i].name, l->parts[i].unit);
    text += ")";
  }
  return cell(text);
}

}  // namespace

const std::vector<const Operation*>& all_operations() {
  static const std::vector<const Operation*> all = [] {
    std::vector<const Operation*> list;
    const auto add = [&](const Operation& o) { list.push_back(&o); };
    SpatialSlots<double>::for_each(add);
    RobotOperations<double>::for_each(add);
    TreeOperations<double>::for_each(add);
    for (const Operation* formed :
         {&op::difference_of_integrate, &op::integrate_of_difference, &op::power, &op::energy_frames,
          &op::rnea_of_aba, &op::crba_symmetric, &op::crba_positive, &op::crba_columns, &op::tree_power,
          &op::momentum_conserved, &op::rnea_of_a_moved_world, &op::rnea_of_reordered_joints,
          &op::rnea_of_split_bodies, &op::quaternion_of_drifted_matrix, &op::log_of_drifted_matrix})
      list.push_back(formed);
    return list;
  }();
  return all;
}

std::string operations_table() {
  std::string text =
      "# Operations\n\n"
      "What each operation takes and returns, and how the error of each block of its result is measured: "
      "numerator over\n"
      "denominator, in eps of the scalar. `liecheck list --operations` prints this page from the records in\n"
      "`properties/operations`.\n\n"
      "| operation | definition | takes | returns, axes | source |\n|---|---|---|---|---|\n";
  for (const Operation* o : all_operations())
    text += fmt::format("| {} | {} | {} | {}; {} | {} |\n", o->name, cell(o->definition),
                        names_of(o->arguments), names_of(o->results), cell(o->results[0]->frame), o->source);
  // One row for a block that several operations have.
  std::vector<std::pair<const Block*, std::string>> blocks;
  for (const Operation* o : all_operations())
    for (const Block& b : o->blocks) {
      const auto same = std::ranges::find_if(blocks, [&](const auto& row) {
        return row.first->name.text == b.name.text && row.first->error == b.error &&
               row.first->denominator == b.denominator && row.first->unit == b.unit;
      });
      if (same == blocks.end())
        blocks.emplace_back(&b, o->name);
      else
        same->second += ", " + std::string(o->name);
    }
  text += "\n| block | numerator | denominator | unit | of |\n|---|---|---|---|---|\n";
  for (const auto& [b, operations] : blocks)
    text += fmt::format("| {} | {} | {} | {} | {} |\n", b->name.text, cell(b->error), cell(b->denominator),
                        b->unit, operations);
  return text;
}

}  // namespace liecheck::properties
