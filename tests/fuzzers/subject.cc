// SPDX-License-Identifier: GPL-3.0-or-later
// The name of a subject: kernel, policies, algorithms, mutation, or a command.
#include "fuzz/check/subject.h"

#include "harness.h"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  const auto subject = fuzz::parse_subject(fuzzers::text_of(data, size));
  if (!subject) {
    fuzzers::require(!subject.error().what.empty(), "an error without words");
    return 0;
  }
  const auto again = fuzz::parse_subject(fuzz::name_of(*subject));
  fuzzers::require(again.has_value() && *again == *subject, "a subject's name is another subject");
  return 0;
}
