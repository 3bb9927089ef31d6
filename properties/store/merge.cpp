#include <store/merge.hpp>

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <store/store.hpp>
#include <store/store_path.hpp>
#include <support/files.hpp>
#include <support/progress.hpp>

namespace liecheck::properties {

namespace {

struct Shard {
  std::string file, text;
  StoredCampaign campaign;
};

std::string shown(const Range& r) {
  return fmt::format("{}..{}", r.first, r.second);
}

[[noreturn]] void refuse(const std::string& text) {
  throw std::invalid_argument(text);
}

/// Returns the first shard that has run a case of these ranges in the series, or null.
const Shard* overlapping(const std::vector<const Shard*>& all, std::size_t series, const Ranges& done) {
  for (const Shard* p : all)
    for (const auto& [first, last] : p->campaign.series[series].tally.done)
      if (Ranges copy = done; !copy.add(first, last)) return p;
  return nullptr;
}

}  // namespace

StoredCampaign merge(const std::vector<std::string>& files, bool partial) {
  std::vector<Shard> parts;
  for (const std::string& file : files) {
    Shard p{file, "", load_campaign(file)};
    p.text = export_text(p.campaign);
    if (!parts.empty())
      if (const auto d = parts[0].campaign.spec.differences(p.campaign.spec, false); !d.empty())
        refuse(fmt::format("{} and {} are parts of different campaigns: {}", parts[0].file, file, d));
    if (p.campaign.spec.cases == 0)
      refuse(fmt::format("{}: ran for a time, not for a number of cases: it cannot be merged", file));
    if (!partial && !p.campaign.complete()) {
      for (const StoredSeries& s : p.campaign.series)
        for (const Range& r : s.tally.done.gaps(p.campaign.spec.first, p.campaign.spec.last))
          refuse(fmt::format("{}: unfinished: {} of {} in {} lacks cases {}; use --resume or --partial", file,
                             s.property, s.subject, s.scalar, shown(r)));
    }
    const bool again =
        std::any_of(parts.begin(), parts.end(), [&](const Shard& q) { return q.text == p.text; });
    if (!again) parts.push_back(std::move(p));
  }
  if (parts.empty()) refuse("nothing to merge");
  // Neither the result nor an error may depend on the order of the files.
  std::sort(parts.begin(), parts.end(), [](const Shard& a, const Shard& b) {
    return std::tie(a.campaign.spec.first, a.text) < std::tie(b.campaign.spec.first, b.text);
  });

  StoredCampaign all = parts[0].campaign;
  CampaignSpec& spec = all.spec;
  spec.first = 0, spec.last = spec.cases;
  std::vector<const Shard*> taken{&parts[0]};
  Counted merged("merging", "series", 1);
  for (std::size_t k = 1; k < parts.size(); ++k) {
    for (std::size_t i = 0; i < all.series.size(); ++i) {
      merged.next();
      StoredSeries& to = all.series[i];
      const StoredSeries& from = parts[k].campaign.series[i];
      if (const Shard* other = overlapping(taken, i, from.tally.done)) {
        const auto &a = other->campaign.spec, &b = parts[k].campaign.spec;
        refuse(fmt::format("{} (cases {}) and {} (cases {}) overlap{}", other->file, shown({a.first, a.last}),
                           parts[k].file, shown({b.first, b.last}),
                           a.first == b.first && a.last == b.last ? ", with different results" : ""));
      }
      to.labels.insert(from.labels.begin(), from.labels.end());
      to.tally.merge(from.tally);
      for (const auto& [cell, failure] : from.failures)
        if (to.tally.rows.at(cell).worst_index == failure.index) to.failures[cell] = failure;
    }
    taken.push_back(&parts[k]);
  }
  if (!partial)
    for (const StoredSeries& s : all.series)
      for (const Range& r : s.tally.done.gaps(spec.first, spec.last))
        refuse(fmt::format("cases {} of 0..{} are in none of {}; --partial merges the other cases", shown(r),
                           spec.last, fmt::join(files, ", ")));
  return all;
}

void merge_into(const std::string& out, const std::vector<std::string>& files, bool partial) {
  namespace fs = std::filesystem;
  const StoredCampaign merged = merge(files, partial);
  std::vector<Counterexample> others;
  for (const std::string& file : files) {
    const auto some = Store(stored_file(file), Store::Open::existing).counterexamples();
    others.insert(others.end(), some.begin(), some.end());
  }
  std::error_code error;
  std::optional<Store> old;
  if (fs::exists(out, error)) {
    old.emplace(out, Store::Open::existing);
    old->reserve();  // what another process added before `part` takes the place of `out` would be lost
  }
  Replacement part(out);
  bool replace = false;
  try {
    if (old) {
      const int n = old->campaigns();
      const StoredCampaign last = n > 0 ? old->load(n) : StoredCampaign{};
      replace = n > 0 && last.spec.differences(merged.spec, false).empty();
      if (!replace && last.spec.cases > 0 && !last.complete())
        refuse(
            fmt::format("{}: holds a different campaign, which is unfinished or still runs: finish it with "
                        "--resume, or merge into another file",
                        out));
      if (replace)
        for (std::size_t i = 0; i < merged.series.size(); ++i)
          for (const auto& [from, to] : last.series[i].tally.done)
            if (!merged.series[i].tally.done.covers(from, to))
              refuse(fmt::format("{}: holds cases {} of this campaign, the merged files do not", out,
                                 shown({from, to})));
      old->copy_to(part.name());
    }
    Store(part.name(), Store::Open::create).write(merged, replace, others);
  } catch (const std::runtime_error& e) {
    fs::remove(part.name() + "-journal", error);
    const std::string why = e.what();  // names the file that would have taken the place of `out`
    if (!why.starts_with(part.name())) throw;
    throw std::runtime_error(out + why.substr(part.name().size()));
  } catch (...) {
    fs::remove(part.name() + "-journal", error);
    throw;
  }
  part.take_place(old ? Replacement::Place::any : Replacement::Place::empty);
}

}  // namespace liecheck::properties
