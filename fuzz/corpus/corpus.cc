// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/corpus/corpus.h"

#include <fmt/format.h>
#include <rapidjson/document.h>
#include <rapidjson/error/en.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <system_error>
#include <utility>

#include "fuzz/text/rational_text.h"
#include "gnomon/result/classes.h"
#include "gnomon/scene/read.h"
#include "gnomon/scene/write.h"
#include "report/json/json_writer.h"
#include "scene/base/text_file.h"

namespace gnomon::fuzz {

namespace {

namespace fs = std::filesystem;
using Json = rapidjson::Value;

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

/// Reads the words of one fixture; every error names the file and the place.
class NoteReader {
 public:
  NoteReader(std::string file, std::string prefix)
      : file_(std::move(file)), prefix_(std::move(prefix)) {}

  tl::unexpected<Error> wrong(const std::string& pointer, std::string what,
                              std::string expected = {}) const {
    return fail(ErrorCode::kFormat, std::move(what), std::move(expected),
                ErrorPlace{file_, 0, 0, prefix_ + pointer});
  }

  Expected<void> parse(const std::string& text) {
    if (text.empty()) return wrong("", "\"extra\" is missing", "what the scene shows");
    document_.Parse<rapidjson::kParseIterativeFlag>(text.data(), text.size());
    if (document_.HasParseError()) {
      return wrong("", rapidjson::GetParseError_En(document_.GetParseError()));
    }
    if (!document_.IsObject()) return wrong("", "not an object", "an object");
    return {};
  }

  const Json& root() const { return document_; }

  Expected<std::string> text(const char* key, bool required) const {
    const auto place = document_.FindMember(key);
    if (place == document_.MemberEnd()) {
      if (!required) return std::string();
      return wrong("", fmt::format("key \"{}\" is missing", key));
    }
    if (!place->value.IsString() || place->value.GetStringLength() == 0) {
      return wrong(fmt::format("/{}", key), "not a text", "a string that is not empty");
    }
    return std::string(place->value.GetString(), place->value.GetStringLength());
  }

  Expected<std::uint64_t> count(const char* key) const {
    const auto place = document_.FindMember(key);
    if (place == document_.MemberEnd()) return std::uint64_t{0};
    if (!place->value.IsUint64()) return wrong(fmt::format("/{}", key), "not a count");
    return place->value.GetUint64();
  }

  Expected<std::vector<std::string>> texts(const char* key) const {
    std::vector<std::string> list;
    const auto place = document_.FindMember(key);
    if (place == document_.MemberEnd()) {
      return wrong("", fmt::format("key \"{}\" is missing", key), "a list, perhaps empty");
    }
    const auto not_a_list = [&] {
      return wrong(fmt::format("/{}", key), "not a list of texts", "names of subjects");
    };
    if (!place->value.IsArray()) return not_a_list();
    for (const Json& element : place->value.GetArray()) {
      if (!element.IsString()) return not_a_list();
      list.emplace_back(element.GetString(), element.GetStringLength());
    }
    return list;
  }

  Expected<std::vector<RecordedLight>> fractions(const Scene& scene) const {
    const auto place = document_.FindMember("fractions");
    if (place == document_.MemberEnd() || !place->value.IsObject()) {
      return wrong("", "key \"fractions\" is missing or no object", "an object with every light");
    }
    std::vector<RecordedLight> lights;
    for (const Light& light : scene.lights) {
      const std::string pointer = "/fractions/" + light.id;
      const auto own = place->value.FindMember(light.id.c_str());
      if (own == place->value.MemberEnd() || !own->value.IsArray()) {
        return wrong(pointer, fmt::format("light '{}' is missing or no list", light.id),
                     "a list of polygon sides");
      }
      RecordedLight& recorded = lights.emplace_back();
      recorded.id = light.id;
      recorded.area = light.type == LightType::kArea;
      for (rapidjson::SizeType i = 0; i < own->value.Size(); ++i) {
        auto one = side(own->value[i], recorded.area, fmt::format("{}/{}", pointer, i));
        if (!one) return tl::unexpected(one.error());
        const bool known = std::ranges::any_of(
            scene.polygons, [&](const Polygon& polygon) { return polygon.id == one->polygon; });
        if (!known) {
          return wrong(fmt::format("{}/{}/id", pointer, i),
                       fmt::format("no polygon '{}' in the scene", one->polygon));
        }
        recorded.sides.push_back(std::move(*one));
      }
    }
    if (place->value.MemberCount() != scene.lights.size()) {
      return wrong("/fractions", "a light that is not in the scene");
    }
    return lights;
  }

 private:
  Expected<RecordedSide> side(const Json& json, bool area, const std::string& pointer) const {
    if (!json.IsObject()) return wrong(pointer, "not an object", "one polygon side");
    RecordedSide result;
    const auto id = json.FindMember("id");
    if (id == json.MemberEnd() || !id->value.IsString()) {
      return wrong(pointer, "key \"id\" is missing or no text");
    }
    result.polygon.assign(id->value.GetString(), id->value.GetStringLength());
    const auto side = json.FindMember("side");
    const std::string_view name =
        side == json.MemberEnd() || !side->value.IsString()
            ? std::string_view()
            : std::string_view(side->value.GetString(), side->value.GetStringLength());
    const auto known = side_by_name(name);
    if (!known) {
      return wrong(pointer + "/side", "no side", "\"front\" or \"back\"");
    }
    result.side = *known;
    mpq_class sum = 0;
    bool exact = true;
    for (const std::string_view shade : share_names(area)) {
      const std::string place = fmt::format("{}/{}", pointer, shade);
      const auto value = json.FindMember(std::string(shade).c_str());
      if (value == json.MemberEnd()) return wrong(place, "a class is missing");
      RecordedShare& share = result.shares.emplace_back();
      if (value->value.IsNumber()) {
        share.nearest = value->value.GetDouble();
        exact = false;
        continue;
      }
      share.exact = rational(value->value);
      if (!share.exact) return wrong(place, "no fraction", "a rational as text, or a number");
      share.nearest = share.exact->get_d();
      sum += *share.exact;
    }
    if (exact && sum != 1) {
      return wrong(pointer, "the fractions add up to " + sum.get_str(), "1");
    }
    const auto parts = json.FindMember("parts");
    if (exact != (parts == json.MemberEnd())) {
      return wrong(pointer, "parts are given where they are not needed, or the other way round");
    }
    if (exact) return result;
    if (!parts->value.IsArray()) return wrong(pointer + "/parts", "not a list");
    for (const Json& part : parts->value.GetArray()) {
      std::vector<mpq_class>& shares = result.parts.emplace_back();
      sum = 0;
      for (const std::string_view shade : share_names(area)) {
        std::optional<mpq_class> share;
        if (part.IsObject() && part.HasMember(std::string(shade).c_str())) {
          share = rational(part[std::string(shade).c_str()]);
        }
        if (!share) return wrong(pointer + "/parts", "a part without exact fractions");
        sum += *share;
        shares.push_back(std::move(*share));
      }
      if (sum != 1) return wrong(pointer + "/parts", "fractions that do not add up to 1");
    }
    return result;
  }

  static std::optional<mpq_class> rational(const Json& json) {
    if (!json.IsString()) return std::nullopt;
    return parse_fraction({json.GetString(), json.GetStringLength()});
  }

  std::string file_, prefix_;
  rapidjson::Document document_;
};

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
    if (!note.root().HasMember("wrong")) return {};
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
  const std::string extension = file.extension().string();
  return extension == ".json" || extension == ".obj" || extension == ".off" || extension == ".ply";
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

void write_shares(report::JsonWriter& json, const RecordedLight& light, const RecordedSide& side) {
  const auto names = share_names(light.area);
  json.begin_object(report::JsonLayout::kInline);
  json.member("id", side.polygon);
  json.member("side", name_of(side.side));
  for (std::size_t k = 0; k < names.size(); ++k) {
    json.key(names[k]);
    if (side.shares[k].exact) {
      json.value(side.shares[k].exact->get_str());
    } else {
      json.value(side.shares[k].nearest);
    }
  }
  if (!side.parts.empty()) {
    json.key("parts");
    json.begin_array();
    for (const std::vector<mpq_class>& part : side.parts) {
      json.begin_object();
      for (std::size_t k = 0; k < names.size(); ++k) json.member(names[k], part[k].get_str());
      json.end_object();
    }
    json.end_array();
  }
  json.end_object();
}

std::string extra_text(const FixtureNote& note, const std::vector<RecordedLight>& lights) {
  report::StringSink sink;
  {
    report::JsonWriter json(sink);
    json.begin_object();
    json.member("shows", note.shows);
    json.member("kind", note.kind);
    if (!note.found.empty()) json.member("found", note.found);
    if (note.inform || !note.wrong.empty()) {
      std::vector<std::string> wrong = note.wrong;
      std::ranges::sort(wrong);
      json.key("wrong");
      json.begin_array(report::JsonLayout::kInline);
      for (const std::string& name : wrong) json.value(name);
      json.end_array();
    }
    json.key("fractions");
    json.begin_object();
    for (const RecordedLight& light : lights) {
      json.key(light.id);
      json.begin_array();
      for (const RecordedSide& side : light.sides) write_shares(json, light, side);
      json.end_array();
    }
    json.end_object();
    json.end_object();
  }
  // Within the scene it stands one level deeper.
  std::string text;
  for (const char c : sink.text()) {
    text += c;
    if (c == '\n') text += ' ';
  }
  return text;
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
  noted.extra = extra_text(note, *lights);
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
