// SPDX-License-Identifier: GPL-3.0-or-later
// What `gnomon certify` reports (report_output.h): the page, verdict.json, table.txt, verdicts.csv,
// and pictures of where the candidates differ from the exact answer.
#ifndef GNOMON_CLI_COMMANDS_CERTIFY_REPORT_H
#define GNOMON_CLI_COMMANDS_CERTIFY_REPORT_H

#include <vector>

#include "cli/common/algorithm_choice.h"
#include "cli/common/report_output.h"
#include "cli/common/scene_options.h"
#include "gnomon/algorithms/shadow_result.h"
#include "gnomon/result/claims.h"
#include "report/certificate/certificate.h"

namespace gnomon::cli {

/// `candidates`: one for each run of the certificate that has a report, in the same order.
/// scene.svg shows the exact answer beside the run that is worst; every other failed run has a
/// picture of its own, scene-NAME.svg. Errors: kFile, kInterrupted.
Expected<void> write_certificate_report(const ReportOptions& options, const LoadedScene& loaded,
                                        const report::Certificate& certificate,
                                        const std::vector<Claims>& candidates, bool times);

/// The exact answer of the chosen lights as the kernel `plane` has it, with points. Errors:
/// kInterrupted, kLimit.
Expected<ShadowResult> exact_result(const LoadedScene& loaded,
                                    const AlgorithmChoice& algorithm = {});
/// The same as claims, for pictures.
Expected<Claims> exact_fragments(const LoadedScene& loaded, const AlgorithmChoice& algorithm = {});

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_CERTIFY_REPORT_H
