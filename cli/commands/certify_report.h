// SPDX-License-Identifier: GPL-3.0-or-later
// The directory of `gnomon certify --report`: verdict.json, table.txt, and pictures of where the
// candidates differ from the exact answer.
#ifndef GNOMON_CLI_COMMANDS_CERTIFY_REPORT_H
#define GNOMON_CLI_COMMANDS_CERTIFY_REPORT_H

#include <filesystem>
#include <vector>

#include "cli/common/algorithm_choice.h"
#include "cli/common/scene_options.h"
#include "gnomon/result/claims.h"
#include "report/certificate/certificate.h"

namespace gnomon::cli {

/// `candidates`: one for each run of the certificate that has a report, in the same order.
/// scene.svg shows the exact answer beside the run that is worst; every other failed run has a
/// picture of its own, scene-NAME.svg. Errors: kFile.
Expected<void> write_certificate_report(const std::filesystem::path& directory,
                                        const LoadedScene& loaded,
                                        const report::Certificate& certificate,
                                        const std::vector<Claims>& candidates, bool times);

/// The exact answer of the chosen lights as the kernel `plane` has it, for pictures. Errors:
/// kInterrupted, kLimit.
Expected<Claims> exact_fragments(const LoadedScene& loaded, const AlgorithmChoice& algorithm = {});

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_CERTIFY_REPORT_H
