#include <fmt/format.h>
#include <adapters/check.hpp>
#include <adapters/sizes.hpp>
#include <adapters/subjects.hpp>
#include <app/command.hpp>
#include <stdexcept>
#include <support/progress.hpp>
#include <support/say.hpp>

namespace liecheck::properties {

namespace {

struct AdapterCheckFlags {
  std::string adapter, memory;
};

int check(const AdapterCheckFlags& f) try {
  const Steps probed("probing " + f.adapter);
  const auto adapter = adapters::start(f.adapter);
  const adapters::Description& d = adapter->description();
  if (const std::string why = adapters::complaint_of_name(d.name); !why.empty())
    throw std::invalid_argument(fmt::format("'{}': {}", f.adapter, why));
  say("{} {}: {} function{}\n", d.name, d.version, d.offered.size(), d.offered.size() == 1 ? "" : "s");
  const adapters::Checked all = adapters::check(*adapter);
  std::size_t wrong = 0;
  for (const adapters::CheckedOperation& o : all.operations) {
    say("{:<32}{:<8}{}\n", o.operation, o.scalar, o.complaint.empty() ? "agrees" : o.complaint);
    wrong += !o.complaint.empty();
  }
  for (const auto& [operation, scalar] : d.offered)
    if (!adapters::is_operation(operation)) {
      say("{:<32}{:<8}{}\n", operation, scalar, adapters::no_operation(operation));
      ++wrong;
    }
  for (const conventions::Finding& f : all.findings) say("{}\n", f.sentence);
  say("{}\n", d.offered.empty() ? "it offers nothing"
              : wrong           ? fmt::format("{} of {} functions are wrong", wrong, d.offered.size())
                                : fmt::format("every function agrees with its definition to {:g} at moderate "
                                                        "angles; 'liecheck test' measures its accuracy",
                                              conventions::probe_tolerance));
  return wrong || d.offered.empty() ? property_failed : within_budget;
} catch (const adapters::AdapterFailed& e) {
  throw std::invalid_argument(fmt::format("'{}': {}", f.adapter, e.what()));
}

int serve(const AdapterCheckFlags& f) try {
  adapters::serve(*adapters::load_library(f.adapter, false), f.memory);
  return within_budget;
} catch (const adapters::AdapterFailed& e) {
  throw std::invalid_argument(e.what());
}

}  // namespace

Command adapter_check_command(CLI::App& adapter) {
  CommandWith<AdapterCheckFlags> a(
      adapter, "check",
      "call each function of an adapter at moderate arguments, name the conventions in which it "
      "differs, and say in words what else is wrong with its answers. Exit code 0 if nothing is; 1 "
      "otherwise; 2 if it does not start");
  a.text("ADAPTER", a->adapter, "", "a command, or a shared library (*.so): docs/start.md").required();
  return a.runs(check);
}

Command adapter_serve_command(CLI::App& adapter) {
  CommandWith<AdapterCheckFlags> a(
      adapter, "serve", "call the functions of a shared library for the program that started this process");
  a.text("LIBRARY", a->adapter, "", "a shared library with the C interface: docs/start.md").required();
  a.text("--memory", a->memory, "FILE", "memory of that program, in which it writes the calls").required();
  return a.runs(serve);
}

}  // namespace liecheck::properties
