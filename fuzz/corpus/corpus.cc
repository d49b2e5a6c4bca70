// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/corpus/corpus.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "fuzz/corpus/fixture_note.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/write.h"
#include "scene/base/text_file.h"

namespace gnomon::fuzz {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kNoteSuffix = ".expected.json";
constexpr std::array<std::string_view, 10> kErrorNames = {
    "usage", "file", "syntax",   "format", "number",
    "index", "id",   "geometry", "limit",  "interrupted"};

std::optional<Expectation> expectation_of(std::string_view file_name) {
  if (file_name.starts_with("y_")) return Expectation::kAgree;
  if (file_name.starts_with("i_")) return Expectation::kInform;
  if (file_name.starts_with("n_")) return Expectation::kReject;
  return std::nullopt;
}

Expected<FixtureNote> read_words(const NoteReader& note) {
  auto shows = note.text("shows", true);
  if (!shows) return tl::unexpected(shows.error());
  auto kind = note.text("kind", true);
  if (!kind) return tl::unexpected(kind.error());
  auto found = note.text("found", false);
  if (!found) return tl::unexpected(found.error());
  return FixtureNote{std::move(*shows), std::move(*kind), std::move(*found), {}, false};
}

Expected<void> read_note(const NoteReader& note, Fixture& fixture) {
  auto words = read_words(note);
  if (!words) return tl::unexpected(words.error());
  fixture.shows = std::move(words->shows);
  fixture.kind = std::move(words->kind);
  fixture.found = std::move(words->found);
  return {};
}

Expected<void> read_scene_fixture(Fixture& fixture) {
  auto read = read_scene(fixture.file);
  if (!read) return tl::unexpected(read.error());
  fixture.scene = std::move(read->scene);
  NoteReader note(fixture.file.string(), "/extra");
  if (auto done = note.parse(fixture.scene.extra); !done) return done;
  if (auto done = read_note(note, fixture); !done) return done;
  auto fractions = note.fractions(fixture.scene);
  if (!fractions) return tl::unexpected(fractions.error());
  fixture.fractions = std::move(*fractions);
  if (fixture.expectation == Expectation::kAgree) {
    if (!note.has("wrong")) return {};
    return note.wrong("/wrong", "a y_ scene that some get wrong", "an i_ scene");
  }
  auto wrong = note.texts("wrong");
  if (!wrong) return tl::unexpected(wrong.error());
  fixture.wrong = std::move(*wrong);
  std::ranges::sort(fixture.wrong);
  return {};
}

Expected<void> read_rejected_fixture(Fixture& fixture) {
  const std::string file = fixture.file.string() + std::string(kNoteSuffix);
  const auto text = read_file(file);
  if (!text) return tl::unexpected(text.error());
  NoteReader note(file, "");
  if (auto done = note.parse(*text); !done) return done;
  if (auto done = read_note(note, fixture); !done) return done;
  const auto code = note.text("error", true);
  if (!code) return tl::unexpected(code.error());
  const auto known = error_code_by_name(*code);
  if (!known) {
    std::string names;
    for (const std::string_view name : kErrorNames) {
      names += (names.empty() ? "" : ", ") + std::string(name);
    }
    return note.wrong("/error", "no such error: " + *code, "one of: " + names);
  }
  const auto line = note.count("line"), column = note.count("column");
  if (!line) return tl::unexpected(line.error());
  if (!column) return tl::unexpected(column.error());
  const auto pointer = note.text("pointer", false);
  if (!pointer) return tl::unexpected(pointer.error());
  fixture.error.code = *known;
  fixture.error.where = {{}, *line, *column, *pointer};
  return {};
}

Expected<Fixture> read_fixture(const fs::path& file, const std::string& name) {
  Fixture fixture;
  fixture.file = file;
  fixture.name = name;
  const auto expectation = expectation_of(file.filename().string());
  if (!expectation) {
    return fail(ErrorCode::kFormat, "a file whose name does not say what must hold",
                "a name that begins with y_, i_ or n_", ErrorPlace{file.string(), 0, 0, {}});
  }
  fixture.expectation = *expectation;
  const auto done = fixture.expectation == Expectation::kReject ? read_rejected_fixture(fixture)
                                                                : read_scene_fixture(fixture);
  if (!done) return tl::unexpected(done.error());
  return fixture;
}

/// Files that are fixtures or want to be: all with the extension of a scene, but the notes beside
/// n_ files.
bool is_fixture_file(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name.starts_with(".") || name.ends_with(kNoteSuffix)) return false;
  const std::optional<SceneFormat> format = format_by_extension(file);
  return format && file.extension().string().substr(1) == format_name(*format);  // lower case only
}

/// Names and files, sorted by name.
Expected<std::vector<std::pair<std::string, fs::path>>> fixture_files(const fs::path& path) {
  std::error_code failure;
  const auto file_error = [&](const std::string& what) {
    return fail(ErrorCode::kFile, what + (failure ? ": " + failure.message() : ""), {},
                ErrorPlace{path.string(), 0, 0, {}});
  };
  std::vector<std::pair<std::string, fs::path>> files;
  if (fs::is_regular_file(path, failure)) {
    files.emplace_back(path.stem().string(), path);
    return files;
  }
  fs::recursive_directory_iterator at(path, failure);
  if (failure) return file_error("the corpus cannot be read");
  for (; at != fs::recursive_directory_iterator(); at.increment(failure)) {
    if (!at->is_regular_file(failure) || !is_fixture_file(at->path())) continue;
    const fs::path name = at->path().lexically_relative(path);
    files.emplace_back((name.parent_path() / name.stem()).generic_string(), at->path());
  }
  if (failure) return file_error("the corpus cannot be read");
  if (files.empty()) {
    return fail(ErrorCode::kFormat, "no fixture in it", "files called y_*, i_* or n_*",
                ErrorPlace{path.string(), 0, 0, {}});
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

Expected<std::vector<Fixture>> read_corpus(const fs::path& path) {
  const auto files = fixture_files(path);
  if (!files) return tl::unexpected(files.error());
  std::vector<Fixture> fixtures;
  for (const auto& [name, file] : *files) {
    auto fixture = read_fixture(file, name);
    if (!fixture) return tl::unexpected(fixture.error());
    fixtures.push_back(std::move(*fixture));
  }
  return fixtures;
}

Expected<std::vector<fs::path>> scene_files(const fs::path& path) {
  const auto files = fixture_files(path);
  if (!files) return tl::unexpected(files.error());
  std::vector<fs::path> scenes;
  for (const auto& [name, file] : *files) {
    const auto expectation = expectation_of(file.filename().string());
    if (expectation && *expectation != Expectation::kReject) scenes.push_back(file);
  }
  return scenes;
}

Expected<std::string> fixture_text(const JudgedScene& scene, const FixtureNote& note) {
  const auto lights = exact_answer_of(scene);
  if (!lights) return tl::unexpected(lights.error());
  Scene noted = scene.scene();
  noted.extra = note_text(note, *lights);
  const auto written = scene_to_text(noted, SceneFormat::kJson);
  if (!written) return tl::unexpected(written.error());
  return written->text;
}

Expected<FixtureNote> read_note_of(const Scene& scene) {
  NoteReader note(scene.file, "/extra");
  if (auto done = note.parse(scene.extra); !done) return tl::unexpected(done.error());
  return read_words(note);
}

std::string_view error_code_name(ErrorCode code) {
  return kErrorNames[static_cast<std::size_t>(code)];
}

std::optional<ErrorCode> error_code_by_name(std::string_view name) {
  for (std::size_t i = 0; i < kErrorNames.size(); ++i) {
    if (kErrorNames[i] == name) return static_cast<ErrorCode>(i);
  }
  return std::nullopt;
}

}  // namespace gnomon::fuzz
