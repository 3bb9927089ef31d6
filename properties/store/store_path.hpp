#pragma once
// The argument that names a stored campaign is FILE@N for the Nth campaign of a store, or FILE for its last
// one. A file whose whole name is FILE@N takes precedence.

#include <store/stored_campaign.hpp>
#include <string>

namespace liecheck::properties {

/// Throws std::runtime_error with the name of the file.
StoredCampaign load_campaign(const std::string& argument);
/// Returns FILE.
std::string stored_file(const std::string& argument);
/// Whether the file begins like an SQLite database.
bool is_store(const std::string& file);

}  // namespace liecheck::properties
