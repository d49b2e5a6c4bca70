// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon certify --corpus DIR: kernels and foreign programs judged by a corpus of degenerate scenes
// (docs/corpus.md).
#ifndef GNOMON_CLI_COMMANDS_CERTIFY_CORPUS_H
#define GNOMON_CLI_COMMANDS_CERTIFY_CORPUS_H

#include <cstdint>
#include <string>
#include <vector>

#include "cli/common/report_output.h"

namespace gnomon::cli {

struct CorpusCommandOptions {
  std::string corpus;                 // a folder, or one file of it
  std::vector<std::string> kernels;   // as parse_subject() reads them
  std::vector<std::string> commands;  // foreign programs
  double tolerance = 1e-9;
  double seconds = 10;
  std::uint64_t megabytes = 2048;
  unsigned jobs = 0;
  bool by_scene = false;
  bool in_process = false;  // kernels too
  bool record = false;
  std::string json;
  ReportOptions report;
};

/// The exit status: 4 where the oracle or an exact kernel does not say what is recorded, 1 where a
/// rounded kernel or a foreign program fails on what is scored.
int run_certify_corpus(const CorpusCommandOptions& options);

}  // namespace gnomon::cli

#endif  // GNOMON_CLI_COMMANDS_CERTIFY_CORPUS_H
