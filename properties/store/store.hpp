#pragma once
// The store: campaigns in one SQLite file, saved in a transaction every few chunks of cases. kill -9 and a power cut
// lose what came after the last transaction, and nothing else.
//
// campaigns        what was asked: seed, cases, the range of this file, program, budgets, robot with its URDF
// series           property x subject x scalar, with its number of cases done and its two digests (sums, hexadecimal)
// done             the ranges [first, last) of cases done, coalesced
// cells            series x output x band: counts of the outcomes, maxima, worst case, histogram "bin:count ..."
// failures         the worst input of each cell that fails, as hexadecimal floats
// counterexamples  failures of other files that were merged into this one
//
// A file holds one campaign or several; the last one is the current one. Rows hold whole tallies, not differences: a
// transaction rewrites each row that changed (rollback journal: one file between transactions). Integers without a
// sign (seeds) are stored as their two's complement. Rows are sealed (row_seal.hpp), those of done and
// counterexamples excepted.
//
// Every error is one line of a std::runtime_error: "FILE: reason".

#include <SQLiteCpp/SQLiteCpp.h>

#include <memory>
#include <store/counterexamples.hpp>
#include <store/stored_campaign.hpp>

namespace liecheck::properties {

class Store {
 public:
  enum class Open { existing, create };
  /// Throws for a file that is not an undamaged store.
  Store(const std::string& path, Open how);

  int campaigns();                  ///< how many it holds
  StoredCampaign load(int number);  ///< from 1
  /// Those of every campaign in the file and those that merging brought, each once.
  std::vector<Counterexample> counterexamples();

  /// Begins the campaign, or fills in its tallies where `resume` and the store holds it. Throws
  /// std::invalid_argument naming what differs.
  void begin(const CampaignSpec& spec, std::vector<SeriesResult>& series, bool resume);
  /// Writes the series and cells that changed, in one transaction. Throws where another process has written since.
  void commit(const std::vector<SeriesResult>& series, const Checkpoint::ChangedRows& changed);
  /// Writes a whole campaign in the place of the last one or after it, and adds counterexamples of other files.
  void write(const StoredCampaign& campaign, bool replace_last, const std::vector<Counterexample>& others);
  /// Adds counterexamples of another file.
  void adopt(const std::vector<Counterexample>& others);
  void copy_to(const std::string& path);  ///< as a new file

 private:
  void check_format(Open how);
  void create_tables();
  void check_no_other_writer();
  void insert(const CampaignSpec& spec);
  void write_series(std::size_t series, const SeriesName& name, const Tally& tally);
  void write_cell(std::size_t series, Cell cell, const Label& label, const Row& row);
  void write_failure(std::size_t series, Cell cell, const Failure& failure);
  void insert(const std::vector<Counterexample>& others);
  std::int64_t integer(const std::string& query);
  [[noreturn]] void fail(const std::string& reason) const;
  [[noreturn]] void fail(const SQLite::Exception& error) const;

  std::string path_;
  SQLite::Database database_;
  std::unique_ptr<SQLite::Statement> cells_;
  std::uint64_t seed_ = 0;
  int campaign_ = 0;               ///< the current one
  std::int64_t data_version_ = 0;  ///< SQLite's counter of other connections' changes
};

}  // namespace liecheck::properties
