// SPDX-License-Identifier: GPL-3.0-or-later
// The findings of a campaign as folders: each is made again from its seed, shrunken, and written.
#ifndef GNOMON_CLI_COMMANDS_CAMPAIGN_FINDINGS_H
#define GNOMON_CLI_COMMANDS_CAMPAIGN_FINDINGS_H

#include <functional>
#include <string>

#include "fuzz/campaign/campaign.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

struct FindingsOptions {
  std::string folder;
  std::string program;   // the gnomon command
  std::string database;  // where it is noted what was written; empty: nowhere
  double seconds = 60;   // of shrinking, each
  /// A line that stays: the case as it came, before it is shrunken; the folder, after.
  std::function<void(const std::string&)> say;
  /// What it is at; may be empty.
  std::function<void(const std::string&)> progress;
};

/// Those of `outcome` that have no folder yet; their `folder` is filled in. A campaign that was
/// stopped meanwhile goes on with the rest. Errors: kFile; kUsage, for generators that there are no
/// more; kInterrupted.
Expected<void> write_campaign_findings(const fuzz::CampaignPlan& plan,
                                       fuzz::CampaignOutcome& outcome,
                                       const FindingsOptions& options);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_CAMPAIGN_FINDINGS_H
