#include <app/command.hpp>
#include <iostream>
#include <stdexcept>
#include <store/merge.hpp>
#include <store/store_path.hpp>
#include <support/files.hpp>

namespace liecheck::properties {

namespace {

struct ExportFlags {
  std::string store, out;
};

int run(const ExportFlags& f) {
  const std::string text = export_text(load_campaign(f.store));
  if (!f.out.empty())
    write_whole(f.out, text);
  else if (!(std::cout << text << std::flush))
    throw std::runtime_error("standard output: cannot be written");
  return within_budget;
}

}  // namespace

Command export_command(CLI::App& program) {
  CommandWith<ExportFlags> a(
      program, "export",
      "print a store as text. It depends on the results alone, not on stops and merges. "
      "Exit code 0; 2 for bad input");
  a.text("STORE", a->store, "", "a store, or STORE@N for its Nth campaign").required();
  a.output("--out", a->out, "FILE", "write to FILE instead of the standard output");
  return a.runs(run);
}

}  // namespace liecheck::properties
