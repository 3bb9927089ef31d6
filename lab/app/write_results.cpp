#include <app/command.hpp>
#include <history/bench.hpp>
#include <lattice/lattice.hpp>
#include <nlohmann/json.hpp>
#include <results/bench.hpp>
#include <results/coefficients.hpp>
#include <results/scenes.hpp>

namespace liecheck::properties {

template <class... Results>
void write_record_of(const std::string& file, const Results&... results) {
  if (!file.empty()) write_record(file, record_of(results...));
}

template void write_record_of(const std::string&, const BugBench&);
template void write_record_of(const std::string&, const HistoryBench&);
template void write_record_of(const std::string&, const LatticeResult&);
template void write_record_of(const std::string&, const SpeedBench&);
template void write_record_of(const std::string&, const WireBench&);
template void write_record_of(const std::string&, const SweepResult&);
template void write_record_of(const std::string&, const SceneSweepResult&);

}  // namespace liecheck::properties
