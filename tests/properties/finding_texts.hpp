#pragma once
// The findings of a registered subject under the limits for ordinary code.

#include <campaign/campaign.hpp>
#include <campaign/robots.hpp>
#include <failures/findings.hpp>
#include <string>
#include <vector>

namespace liecheck::properties {

/// Their texts, of the first cases of the laws in double; of all laws if none is named.
inline std::vector<std::string> finding_texts(const std::string& subject,
                                              const std::vector<std::string>& laws = {},
                                              std::uint64_t cases = 1000) {
  CampaignOptions options;
  options.selection = {{subject}, laws, {"double"}};
  options.selection.profiles = {{"", Profile::careful}};
  options.cases = cases, options.jobs = 1, options.quiet = true;
  const CampaignResult r = run_campaign(options, built_in_robot());
  std::vector<FailedBlock> failed = failed_blocks(r);
  std::vector<std::string> texts;
  for (const Finding& f : findings_of(r, failed, {})) texts.push_back(text_of(f, texts.size() + 1, r));
  return texts;
}
inline bool says(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace liecheck::properties
