#pragma once
// A store holds campaigns in one SQLite file. A transaction saves the progress every few chunks of cases.
// kill -9 or a power cut loses only the cases after the last transaction.
//
// campaigns        the options: seed, cases, the file's range, program, budgets, robot with its URDF
// series           property x subject x scalar: number of cases done, two digests (hexadecimal sums)
// done             the ranges [first, last) of cases done, coalesced
// cells            series x output x band: counts of outcomes, maxima, worst case, histogram "bin:count ..."
// limits           the limits files that judged some of the subjects: name and whole text
// failures         the worst input of each cell that fails, as hexadecimal floats
// counterexamples  failures of other files that were merged into this one
//
// A file holds one campaign or several; the last one is the current one. Rows hold whole tallies, not
// differences, so a transaction rewrites each row that changed. Between transactions there is no second file
// (rollback journal). Unsigned integers (seeds) are stored as signed ones with the same bits. Rows are sealed
// (row_seal.hpp). A file with another structure, such as a view or a trigger, is refused.
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
  /// Throws if the file is not a store or is damaged.
  Store(const std::string& path, Open how);

  int campaigns();                  ///< the number of campaigns
  StoredCampaign load(int number);  ///< the first one has number 1
  /// The counterexamples of all campaigns in the file and of merged files, without duplicates.
  std::vector<Counterexample> counterexamples();

  /// Begins the campaign or, with `resume`, fills in the tallies of the stored one. Throws
  /// std::invalid_argument with the differences if the stored campaign does not permit that.
  void begin(const CampaignSpec& spec, std::vector<SeriesResult>& series, bool resume);
  /// Writes the changed series and cells in one transaction. Throws if another process wrote to the file.
  void commit(const std::vector<SeriesResult>& series, const Checkpoint::ChangedRows& changed);
  /// Writes a whole campaign, in place of the last one or after it, and adds counterexamples of other files.
  void write(const StoredCampaign& campaign, bool replace_last, const std::vector<Counterexample>& others);
  /// Adds counterexamples of another file.
  void adopt(const std::vector<Counterexample>& others);
  void copy_to(const std::string& path);  ///< copies the store to a new or empty file
  /// From now on, no other Store can write to the file. Throws if another process has replaced it.
  void reserve();

 private:
  void check_format(Open how);
  void check_structure();
  void check_campaigns();  ///< their numbers, and that no row belongs to another one
  bool empty();  ///< whether the file is no database yet
  void create_tables();
  void check_no_other_writer();
  void insert(const CampaignSpec& spec);
  void insert_limits(const CampaignSpec& spec);
  void write_series(std::size_t series, const SeriesName& name, const Tally& tally);
  void write_cell(std::size_t series, Cell cell, const Label& label, const Row& row);
  void write_failure(std::size_t series, Cell cell, const Failure& failure);
  void insert(const std::vector<Counterexample>& others);
  std::int64_t integer(const std::string& query);
  [[noreturn]] void fail(const std::string& reason) const;
  [[noreturn]] void fail(const SQLite::Exception& error) const;

  std::string path_;
  bool is_new_;  ///< the file was not there before
  SQLite::Database database_;
  std::unique_ptr<SQLite::Database> reserved_;  ///< holds the lock of reserve()
  std::unique_ptr<SQLite::Statement> cells_;
  std::uint64_t seed_ = 0;
  int campaign_ = 0;               ///< number of the current campaign
  std::int64_t data_version_ = 0;  ///< SQLite's counter of other connections' changes
};

}  // namespace liecheck::properties
