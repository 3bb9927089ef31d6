#include <store/stored_run.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <campaign/robots.hpp>
#include <stdexcept>

namespace liecheck::properties {

namespace {

class StoreCheckpoint : public Checkpoint {
 public:
  StoreCheckpoint(Store& store, bool resume) : store_(store), resume_(resume) {}
  void restore(CampaignResult& campaign) override {
    const CampaignOptions& o = campaign.options;
    if (o.shard == 1) counterexamples = replay_counterexamples(store_.counterexamples(), campaign.series);
    store_.begin(spec_of(o, campaign.robot, campaign.series), campaign.series, resume_);
  }
  void save(const std::vector<SeriesResult>& series, const ChangedRows& changed) override {
    store_.commit(series, changed);
  }
  Counterexamples counterexamples;

 private:
  Store& store_;
  bool resume_;
};

}  // namespace

StoredRun run_stored(const CampaignOptions& options, const Robot& robot, Store& store, bool resume) {
  StoreCheckpoint checkpoint(store, resume);
  StoredRun run;
  run.result = run_campaign(options, robot, &checkpoint);
  run.counterexamples = std::move(checkpoint.counterexamples);
  run.result.failed = run.result.failed || !run.counterexamples.failing.empty();
  run.result.incomplete = run.result.incomplete || !run.counterexamples.complete;
  return run;
}

namespace {

/// The limits and profiles of a stored campaign, and its subjects that this program has.
Selection selection_of(const StoredCampaign& c) {
  const auto known = subject_names();
  Selection selection;
  for (const StoredSeries& s : c.series)
    if (std::ranges::count(known, s.subject) && !std::ranges::count(selection.subjects, s.subject))
      selection.subjects.push_back(s.subject);
  for (const StoredSeries& s : c.series) selection.profiles[s.subject] = profile_named(s.profile).value();
  selection.limits = c.spec.limits;
  return selection;
}

}  // namespace

StoredRun result_of(const StoredCampaign& c, const std::string& name) {
  StoredRun run;
  CampaignResult& result = run.result;
  CampaignOptions& o = result.options;
  o.seed = c.spec.seed, o.cases = c.spec.cases;
  if (c.spec.cases == 0) o.seconds = 0;
  o.range_override = Range{c.spec.first, c.spec.last};
  result.robot = c.spec.robot;
  run.environment = c.spec.environment;
  const auto refuse = [&](const std::string& what) {
    throw std::runtime_error(fmt::format("{}: {}", name, what));
  };
  if (c.spec.program != LIECHECK_VERSION || c.spec.generator != generator_version)
    refuse(fmt::format("written by liecheck {}, generator {}; this is {}, generator {}", c.spec.program,
                       c.spec.generator, LIECHECK_VERSION, generator_version));
  o.selection.limits = c.spec.limits;
  std::vector<std::unique_ptr<Series>> all;
  try {
    robot_of(c.spec.robot.urdf, "its robot", c.spec.robot.fixed);
    all = select(selection_of(c), c.spec.robot);
  } catch (const std::exception& e) {
    refuse(fmt::format("its robot, subjects or limits: {}", e.what()));
  }
  for (const StoredSeries& s : c.series) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& x) {
      return x && x->property == s.property && x->subject == s.subject && x->scalar == s.scalar;
    });
    if (found == all.end())
      refuse(fmt::format("holds {} of {} in {}, which this program lacks", s.property, s.subject, s.scalar));
    for (const auto& [cell, label] : s.labels) {
      const auto [output, band] = cell;
      const bool known = output >= 0 && output < int((*found)->outputs.size()) && band >= 0 &&
                         band < int((*found)->bands().all().size()) &&
                         (*found)->outputs[std::size_t(output)].operation == label.operation &&
                         (*found)->outputs[std::size_t(output)].block == label.block &&
                         (*found)->bands()[std::size_t(band)].name == label.band;
      if (!known)
        refuse(fmt::format("{} has no {}, {}, {}", s.property, label.operation, label.block, label.band));
    }
    result.series.push_back({std::move(*found), s.tally});
  }
  result.summarize();
  return run;
}

}  // namespace liecheck::properties
