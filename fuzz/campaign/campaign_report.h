// SPDX-License-Identifier: GPL-3.0-or-later
// A campaign in words and in JSON: what was made, what was run, what failed.
#ifndef GNOMON_FUZZ_CAMPAIGN_CAMPAIGN_REPORT_H
#define GNOMON_FUZZ_CAMPAIGN_CAMPAIGN_REPORT_H

#include <string>

#include "fuzz/campaign/campaign.h"
#include "report/text/text_sink.h"

namespace gnomon::fuzz {

/// For people: counts, subjects, the distribution of kinds, failures by signature; at most 100
/// columns.
std::string campaign_report(const CampaignOutcome& outcome);

/// For spreadsheets: a line a finding.
std::string campaign_csv(const CampaignOutcome& outcome);

/// The command that checks a finding again.
std::string replay_command(const CampaignFinding& finding);

/// For programs: stable; times only if asked for.
void write_campaign_json(report::TextSink& sink, const std::string& plan,
                         const CampaignOutcome& outcome, bool times);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CAMPAIGN_CAMPAIGN_REPORT_H
