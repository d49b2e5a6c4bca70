// SPDX-License-Identifier: GPL-3.0-or-later
// What a fixture says beside its scene: in the scene's "extra", or in a file of its own beside what
// must be rejected.
#ifndef GNOMON_FUZZ_CORPUS_FIXTURE_NOTE_H
#define GNOMON_FUZZ_CORPUS_FIXTURE_NOTE_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/corpus/corpus.h"
#include "scene/json/json_value.h"

namespace gnomon::fuzz {

/// Reads the words of one fixture; every error names the file and the place.
class NoteReader {
 public:
  /// `prefix`: the JSON pointer of the note in its file.
  NoteReader(std::string file, std::string prefix)
      : file_(std::move(file)), prefix_(std::move(prefix)) {}

  Expected<void> parse(const std::string& text);
  bool has(const char* key) const { return find_member(document_, key) != nullptr; }

  Expected<std::string> text(const char* key, bool required) const;
  /// 0 if there is no such member.
  Expected<std::uint64_t> count(const char* key) const;
  Expected<std::vector<std::string>> texts(const char* key) const;
  /// What every polygon side of the scene has of every class.
  Expected<std::vector<RecordedLight>> fractions(const Scene& scene) const;

  tl::unexpected<Error> wrong(const std::string& pointer, std::string what,
                              std::string expected = {}) const;

 private:
  Expected<RecordedSide> side(const JsonValue& json, bool area, const std::string& pointer) const;
  Expected<void> shares(const JsonValue& json, bool area, const std::string& pointer,
                        RecordedSide& result) const;
  Expected<void> parts(const JsonValue& json, bool area, const std::string& pointer,
                       RecordedSide& result) const;

  std::string file_, prefix_;
  rapidjson::Document document_;
};

/// The note as the "extra" of a scene's file.
std::string note_text(const FixtureNote& note, const std::vector<RecordedLight>& lights);

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CORPUS_FIXTURE_NOTE_H
