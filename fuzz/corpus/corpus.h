// SPDX-License-Identifier: GPL-3.0-or-later
// The corpus of degenerate scenes (docs/corpus.md): a folder of files, each of which shows one
// thing and says what must come out. Any implementation in any language can be judged by it.
//
//   y_NAME.json  every implementation gets it right, rounded ones within tolerance;
//   i_NAME.json  rounded ones may differ: which of ours do is recorded, and not scored;
//   n_NAME.EXT   must be rejected; n_NAME.EXT.expected.json says with which error.
//
// What a scene shows and the exact fractions that must come out stand in its "extra".
#ifndef GNOMON_FUZZ_CORPUS_CORPUS_H
#define GNOMON_FUZZ_CORPUS_CORPUS_H

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fuzz/corpus/recorded.h"
#include "gnomon/kernel/error.h"
#include "gnomon/scene/scene.h"

namespace gnomon::fuzz {

enum class Expectation : std::uint8_t {
  kAgree,   // y_
  kInform,  // i_
  kReject,  // n_
};

struct Fixture {
  std::filesystem::path file;
  std::string name;   // below the corpus, without extension: "coplanar/y_two_tiles"
  std::string kind;   // "coplanar"
  std::string shows;  // one sentence
  std::string found;  // where it comes from, if that is told
  Expectation expectation = Expectation::kAgree;

  // y_ and i_
  Scene scene;
  std::vector<RecordedLight> fractions;
  std::vector<std::string> wrong;  // i_: names of the subjects that are known to differ, sorted

  // n_
  Error error;  // code, and `where` without file; `what` and `expected` are not recorded
};

/// All fixtures below a folder, or a single one, sorted by name. Errors: kFile; kFormat for a
/// folder without any; whatever is wrong with a fixture, with its file and the JSON pointer.
Expected<std::vector<Fixture>> read_corpus(const std::filesystem::path& path);

/// The y_ and i_ files of a corpus, sorted, whether they are fixtures already or not. Errors: as
/// read_corpus().
Expected<std::vector<std::filesystem::path>> scene_files(const std::filesystem::path& path);

/// What a fixture says beside its scene.
struct FixtureNote {
  std::string shows;               // one sentence
  std::string kind;                // its group, such as "coplanar"
  std::string found;               // such as "double, generator soup-lattice, seed 7"; may be empty
  std::vector<std::string> wrong;  // subjects that are known to differ
  bool inform = false;             // an i_ scene: "wrong" is written even if it is empty
};

/// The text of a y_ or i_ fixture: the scene, with its exact fractions by the kernel `plane` and by
/// the oracle in "extra" (what was there is replaced). Errors: those of exact_answer_of() and of
/// scene_to_text().
Expected<std::string> fixture_text(const JudgedScene& scene, const FixtureNote& note);

/// The note of a scene that need not be a fixture yet: "shows" and "kind" of its "extra" must be
/// there, "found" may be. Errors: kFormat.
Expected<FixtureNote> read_note_of(const Scene& scene);

/// "usage", "file", "syntax", "format", "number", "index", "id", "geometry", "limit",
/// "interrupted".
std::string_view error_code_name(ErrorCode code);
std::optional<ErrorCode> error_code_by_name(std::string_view name);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CORPUS_CORPUS_H
