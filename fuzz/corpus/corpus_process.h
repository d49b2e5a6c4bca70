// SPDX-License-Identifier: GPL-3.0-or-later
// Kernels judged on one fixture in a process of its own, by `gnomon certify --corpus FILE`.
#ifndef GNOMON_FUZZ_CORPUS_CORPUS_PROCESS_H
#define GNOMON_FUZZ_CORPUS_CORPUS_PROCESS_H

#include <string>
#include <vector>

#include "fuzz/corpus/corpus_judge.h"

namespace gnomon::fuzz {

struct ProcessVerdict {
  std::vector<Judgement> judgements;  // one a name
  std::string oracle;                 // its finding, if any
};

/// `names`: of subjects that are no foreign programs. Where the process ends without a report, each
/// of them gets one of its own, so that the others are not lost with the one that fails.
ProcessVerdict judge_in_process(const Fixture& fixture, const std::vector<std::string>& names,
                                const CorpusOptions& options);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CORPUS_CORPUS_PROCESS_H
