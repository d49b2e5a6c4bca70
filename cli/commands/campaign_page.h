// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a campaign (report_output.h): its figures, and the scenes of its findings.
#ifndef GNOMON_CLI_COMMANDS_CAMPAIGN_PAGE_H
#define GNOMON_CLI_COMMANDS_CAMPAIGN_PAGE_H

#include <functional>
#include <string>

#include "cli/common/report_output.h"
#include "fuzz/campaign/campaign.h"
#include "gnomon/kernel/error.h"

namespace gnomon::cli {

/// `counts`: whether a failure is one for the exit status. A finding that was written as a folder
/// is shown shrunken, too. Errors: those of write_report().
Expected<void> write_campaign_page(const ReportOptions& options, const std::string& plan,
                                   const fuzz::CampaignOutcome& outcome, bool times,
                                   const std::function<bool(const fuzz::Failure&)>& counts);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_CAMPAIGN_PAGE_H
