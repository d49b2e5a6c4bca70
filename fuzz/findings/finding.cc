// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/findings/finding.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <system_error>
#include <utility>

#include "fuzz/findings/finding_evidence.h"
#include "fuzz/findings/finding_text.h"
#include "fuzz/shrink/shrink.h"
#include "fuzz/shrink/still_fails.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/write.h"
#include "scene/base/output_file.h"
#include "scene/base/text_file.h"
#include "scene/base/text_hash.h"

namespace gnomon::fuzz {

namespace {

namespace fs = std::filesystem;

/// Letters that need no quotes anywhere; at most so many.
std::string name_part(std::string text) {
  constexpr std::size_t kMost = 40;
  std::ranges::replace_if(
      text,
      [](char c) {
        return (c < '0' || c > '9') && (c < 'a' || c > 'z') && (c < 'A' || c > 'Z') && c != '+' &&
               c != '.';
      },
      '-');
  if (text.size() > kMost) text.resize(kMost);
  return text;
}

tl::unexpected<Error> file_error(const fs::path& path, const std::string& what,
                                 const std::error_code& code) {
  return fail(ErrorCode::kFile, what + ": " + code.message(), {}, {path.string(), 0, 0, {}});
}

/// Thrown away with this object, unless it was moved to another place.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(fs::path path) : path_(std::move(path)) {}
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) fs::remove_all(path_, ignored);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

Expected<Scene> scene_from(const fs::path& file) {
  ReadOptions options;
  options.format = SceneFormat::kJson;
  auto read = read_scene(file, options);
  if (!read) return tl::unexpected(read.error());
  return std::move(read->scene);
}

}  // namespace

std::string finding_name(const Finding& finding) {
  const std::uint64_t digest =
      text_hash(finding.failure.signature() + '\n' + fingerprint_of(finding.scene));
  return fmt::format("{}-{}-{}-{:08x}", name_part(std::string(id_of(finding.failure.property))),
                     name_part(finding.failure.disagreement), name_part(finding.failure.subject),
                     digest >> 32);
}

Expected<fs::path> write_finding(const fs::path& folder, const Finding& given) {
  Finding finding = given;
  finding.check = narrowed(given.check, given.failure);
  finding.check.stage = {};
  const std::string name = finding_name(finding);
  const fs::path place = folder / name;
  std::error_code code;
  fs::create_directories(folder, code);
  if (code) return file_error(folder, "cannot make the folder", code);
  if (fs::exists(place, code)) return place;

  static std::atomic<unsigned> next = 0;
  const TemporaryFolder temporary(folder / fmt::format(".{}.{}.{}", name, ::getpid(), next++));
  fs::create_directory(temporary.path(), code);
  if (code) return file_error(temporary.path(), "cannot make the folder", code);

  Scene scene = finding.scene;
  scene.name = finding.failure.subject + ": " + finding.failure.disagreement;
  scene.extra.clear();
  const auto plain_text = scene_to_text(scene, SceneFormat::kJson);
  if (!plain_text) return tl::unexpected(plain_text.error());
  const auto original_text = scene_to_text(finding.original, SceneFormat::kJson);
  if (!original_text) return tl::unexpected(original_text.error());
  // First, since a foreign program reads it.
  const fs::path scene_file = temporary.path() / "scene.json";
  if (auto done = write_file(scene_file, plain_text->text); !done) {
    return tl::unexpected(done.error());
  }
  const Evidence evidence = gather_evidence(finding, scene, scene_file);
  scene.extra = short_verdict(evidence.failure);
  const auto scene_text = scene_to_text(scene, SceneFormat::kJson);
  if (!scene_text) return tl::unexpected(scene_text.error());
  for (const auto& [file, text] :
       {std::pair<const char*, std::string>("original.json", original_text->text),
        {"scene.json", scene_text->text},
        {"verdict.json", verdict_text(finding, evidence)},
        {"README.md", readme_text(finding, evidence, name)},
        {"candidate.svg", evidence.candidate_svg},
        {"exact.svg", evidence.exact_svg},
        {"result.json", evidence.foreign_result},
        {"fixture.json", evidence.fixture}}) {
    if (text.empty()) continue;
    if (auto done = write_file(temporary.path() / file, text); !done) {
      return tl::unexpected(done.error());
    }
  }
  fs::rename(temporary.path(), place, code);
  // Somebody else may have been faster with the same finding; theirs stays, ours goes.
  std::error_code ignored;
  if (code && !fs::exists(place, ignored))
    return file_error(place, "cannot be put in its place", code);
  return place;
}

Expected<Finding> read_finding(const fs::path& path) {
  const fs::path verdict_file = path / "verdict.json";
  auto text = read_file(verdict_file);
  if (!text) return tl::unexpected(text.error());
  auto finding = parse_verdict(*text, verdict_file.string());
  if (!finding) return tl::unexpected(finding.error());
  auto scene = scene_from(path / "scene.json");
  if (!scene) return tl::unexpected(scene.error());
  finding->scene = std::move(*scene);
  auto original = scene_from(path / "original.json");
  if (!original) return tl::unexpected(original.error());
  finding->original = std::move(*original);
  return finding;
}

}  // namespace gnomon::fuzz
