#pragma once
// The store: campaigns in one SQLite file, kept chunk by chunk, so that kill -9 loses the chunk in flight and
// nothing else.
//
// campaigns   what was asked: seed, cases, the range of this file, program, budgets, robot with its URDF
// series      property x subject x scalar, with its cases done and its two digests (sums, hexadecimal)
// done        the ranges [first, last) of cases done, coalesced
// cells       series x output x band: counts of the outcomes, maxima, worst case, histogram "bin:count ..."
// failures    the worst input of each cell that fails, as hexadecimal floats
// counterexamples   the same of files that were merged into this one
//
// A file holds one campaign or several, one after the other; the last one is the current one. Rows hold whole
// tallies, not differences: what a chunk touched is written again, in one transaction (rollback journal, one
// file between transactions). Numbers without a sign above 2^63 (seeds) are kept as their two's complement.

#include <store/counterexamples.hpp>
#include <store/sqlite.hpp>

namespace liecheck::properties {

using Cell = Rows::Cell;  ///< (output, band)

/// What makes a campaign this one and no other.
struct CampaignSpec {
  std::uint64_t seed = 0;
  std::uint64_t cases = 0;            ///< a series; 0: as many as the time allows
  std::uint64_t first = 0, last = 0;  ///< the range of cases of this shard
  int generator = generator_version;
  std::string program, budgets;  ///< the version; 16 digits of the table's SHA-256
  Robot robot;
  std::string environment;          ///< of the run, JSON; no part of what is compared
  std::vector<std::string> series;  ///< property, subject with version, scalar, robot

  /// "seed 1 against 2, ...": empty where they are one campaign.
  std::string differences(const CampaignSpec& other, bool with_range = true) const;
};
CampaignSpec spec_of(const CampaignOptions& options, const Robot& robot,
                     const std::vector<SeriesResult>& series);

struct Label {
  std::string operation, block, band;
};
struct Failure {
  std::uint64_t index = 0;
  std::string input;  ///< hexadecimal floats, joined by commas
};

struct SeriesName {
  std::string property, subject, subject_version, scalar, robot;
  std::string text() const;
};
SeriesName name_of(const Series& series);

struct StoredSeries : SeriesName {
  Tally tally;
  std::map<Cell, Label> labels;
  std::map<Cell, Failure> failures;
};

struct StoredCampaign {
  CampaignSpec spec;
  std::vector<StoredSeries> series;
  bool complete() const;  ///< every series has its whole range; never where only the time was given
};

class Store {
 public:
  enum class Open { existing, create };
  /// Throws std::runtime_error, one line with the file, for what is not a sound store.
  Store(const std::string& path, Open how);

  int campaigns();                  ///< how many it holds
  StoredCampaign load(int number);  ///< from 1
  /// Of every campaign in the file, and those that merging brought, each once.
  std::vector<Counterexample> counterexamples();

  /// Begins the campaign, or fills in what was done of it where `resume` and the store holds it. Throws
  /// std::invalid_argument naming what differs.
  void begin(const CampaignSpec& spec, std::vector<SeriesResult>& series, bool resume);
  /// One transaction: the series and cells that changed.
  void commit(const std::vector<SeriesResult>& series, const Checkpoint::ChangedRows& changed);
  /// Adds a whole campaign, in the place of the last one or after it, and counterexamples of other files.
  void write(const StoredCampaign& campaign, bool replace_last, const std::vector<Counterexample>& others);
  /// Keeps counterexamples of another file, to be run first.
  void adopt(const std::vector<Counterexample>& others);
  void copy_to(const std::string& path);  ///< a whole new file

 private:
  void create();
  void insert(const CampaignSpec& spec);
  void write_series(std::size_t series, const SeriesName& name, const Tally& tally);
  void write_cell(std::size_t series, Cell cell, const Label& label, const Row& row);
  void write_failure(std::size_t series, Cell cell, const Failure& failure);
  void keep(const std::vector<Counterexample>& others);
  void check_alone();

  Database database_;
  std::unique_ptr<Statement> cells_;
  std::uint64_t seed_ = 0;
  int campaign_ = 0;               ///< the current one
  std::int64_t data_version_ = 0;  ///< SQLite's count of changes by others
};

/// "FILE", or "FILE@N" for the Nth campaign of a store; without N the last one. Throws naming the file.
StoredCampaign load_campaign(const std::string& name);
/// FILE of that name.
std::string stored_file(const std::string& name);
/// Does the file begin as an SQLite database does?
bool is_store(const std::string& name);

}  // namespace liecheck::properties
