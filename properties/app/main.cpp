// The program liecheck.

#include <app/lab.hpp>
#include <app/programs.hpp>

int main(int argc, char** argv) {
  using namespace liecheck::properties;
  if (const auto code = run_in_lab(argc, argv)) return *code;
  return run_main(argc, argv, liecheck_program);
}
