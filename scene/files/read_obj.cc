// SPDX-License-Identifier: LGPL-3.0-or-later
// The Wavefront OBJ reader: `v` and `f`, with continued lines and indices relative to the last
// vertex, and the groups and objects that faces are in (`g`, `o`). Whatever else a file holds has
// no surface and is passed over; elements that draw something are counted in a warning.
#include <algorithm>
#include <array>
#include <unordered_map>

#include "gnomon/scene/groups.h"
#include "scene/base/text_file.h"
#include "scene/files/mesh_text.h"
#include "scene/files/readers.h"
#include "scene/files/usable_id.h"

namespace gnomon {

namespace {

struct Drawn {
  std::string_view keyword;
  const char* name;
  std::size_t count = 0;
};

/// `weighted` counts the vertices with a weight that is not 1.
Expected<void> read_vertex(Tokens& tokens, MeshBuilder& mesh, const Token& keyword,
                           std::size_t& weighted) {
  Position position;
  std::size_t count = 0;
  bool has_weight = false;
  while (auto token = tokens.in_line()) {
    // Behind the coordinates: a weight, or a colour. It has to be a number, and is not used.
    auto value = mesh.number(*token);
    if (!value) return tl::unexpected(std::move(value.error()));
    if (count == position.size()) has_weight = !(*value == Number(1.0));
    if (count < position.size()) position[count] = *std::move(value);
    ++count;
  }
  constexpr std::size_t kMostValues = 8;  // coordinates, weight, colour with alpha
  if (count < position.size() || count > kMostValues) {
    return mesh.error(ErrorCode::kFormat, "a vertex of " + std::to_string(count) + " numbers",
                      "three coordinates", keyword.offset);
  }
  if (has_weight && count == position.size() + 1) ++weighted;
  mesh.add_vertex(std::move(position));
  return {};
}

/// "i", "i/t", "i//n" or "i/t/n"; only i counts.
Expected<void> read_corner(MeshBuilder& mesh, const Token& token) {
  std::string_view rest = token.text;
  const std::string_view first = rest.substr(0, rest.find('/'));
  const auto index = to_integer(first);
  rest.remove_prefix(first.size());
  bool well_formed = index.has_value();
  for (int part = 0; well_formed && !rest.empty(); ++part) {
    rest.remove_prefix(1);  // the slash
    const std::string_view other = rest.substr(0, rest.find('/'));
    rest.remove_prefix(other.size());
    well_formed = part < 2 && (other.empty() || to_integer(other));
  }
  if (!well_formed) {
    return mesh.error(ErrorCode::kSyntax, quoted_text(token.text) + " is not a vertex of a face",
                      "an index such as 7, 7/1 or 7//2", token.offset);
  }
  if (*index == 0) {
    return mesh.error(ErrorCode::kIndex, "index 0", "indices from 1, or from -1 backwards",
                      token.offset);
  }
  const auto count = static_cast<std::int64_t>(mesh.vertex_count());
  if (*index < 0 && *index < -count) {
    return mesh.error(
        ErrorCode::kIndex, "index " + std::to_string(*index) + " goes back beyond the first vertex",
        count == 0 ? "vertices" : "-" + std::to_string(count) + " to -1", token.offset);
  }
  return mesh.add_index(*index > 0 ? *index - 1 : count + *index, token.offset);
}

Expected<void> read_face(Tokens& tokens, MeshBuilder& mesh, const Token& keyword) {
  while (auto token = tokens.in_line()) {
    if (auto corner = read_corner(mesh, *token); !corner) return corner;
  }
  return mesh.end_face(keyword.offset);
}

/// The groups and objects of a file: `g` puts the faces that follow into all groups that it names,
/// `o` into one object. Group and object of one name are one group. Faces are called by the names
/// of both, and numbered within them: OBJECT/GROUP/0, OBJECT/GROUP/1, ...
class NamedGroups {
 public:
  void read_names(Tokens& tokens, bool object) {
    auto& current = object ? object_ : groups_;
    std::string& prefix = object ? object_prefix_ : group_prefix_;
    current.clear();
    prefix.clear();
    // Without a name, g goes back to the group named so.
    while (const auto name = tokens.in_line()) {
      current.push_back(index_of(name->text));
      prefix += usable_id(name->text) + "/";
    }
    if (current.empty() && !object) current.push_back(index_of("default"));
    const bool is_one = object_prefix_ == group_prefix_;
    // Faces of one name are numbered together wherever they stand.
    next_ = &counts_[is_one ? object_prefix_ : object_prefix_ + group_prefix_];
    prefix_ = is_one ? object_prefix_ : object_prefix_ + group_prefix_;
  }
  void add_face(std::uint32_t face, MeshBuilder& mesh) {
    for (const auto* current : {&object_, &groups_}) {
      for (const std::size_t group : *current) {
        std::vector<std::uint32_t>& faces = all_[group].polygons;
        if (faces.empty() || faces.back() != face) faces.push_back(face);
      }
    }
    if (!prefix_.empty()) mesh.call_face(prefix_ + std::to_string((*next_)++));
    if (mesh.skips_bad()) ids_.push_back(prefix_.empty() ? std::to_string(face) : mesh.face_id());
  }
  /// Some of the faces may have been left out.
  void write(Scene& scene) {
    if (all_.empty()) return;
    std::unordered_map<std::string_view, std::uint32_t> polygons;
    for (std::uint32_t i = 0; i < scene.polygons.size(); ++i) {
      polygons.emplace(scene.polygons[i].id, i);
    }
    for (PolygonGroup& group : all_) {
      std::vector<std::uint32_t> kept;
      for (const std::uint32_t face : group.polygons) {
        const auto found = ids_.empty() ? polygons.end() : polygons.find(ids_[face]);
        if (found != polygons.end()) kept.push_back(found->second);
      }
      if (ids_.empty()) kept = std::move(group.polygons);
      group.polygons = std::move(kept);
    }
    std::erase_if(all_, [](const PolygonGroup& group) { return group.polygons.empty(); });
    if (!all_.empty()) set_polygon_groups(scene, all_);
  }

 private:
  std::size_t index_of(std::string_view text) {
    std::string name(text);
    if (!check_is_utf8(name, {})) {  // a group's name is
      std::ranges::replace_if(
          name, [](char c) { return static_cast<signed char>(c) < 0; }, '?');
    }
    const auto [place, is_new] = index_.try_emplace(name, all_.size());
    if (is_new) all_.push_back({name, {}});
    return place->second;
  }

  std::vector<PolygonGroup> all_;  // in the order of their names in the file
  std::unordered_map<std::string, std::size_t> index_;
  std::vector<std::size_t> object_, groups_;               // those of the faces that come
  std::string object_prefix_, group_prefix_, prefix_;      // of the same
  std::unordered_map<std::string, std::uint32_t> counts_;  // of the faces of each prefix
  std::uint32_t* next_ = nullptr;                          // of those of this one
  std::vector<std::string> ids_;                           // of all faces, if some are left out
};

/// A line that cannot be used is passed over where that was asked for.
bool skip(MeshBuilder& mesh, const Token& keyword, const Error& why) {
  if (!mesh.skips_bad()) return false;
  if (keyword.text == "v") {
    mesh.add_bad_vertex(why);
    return true;
  }
  mesh.spoil_face(why);
  return mesh.end_face(keyword.offset).has_value();
}

/// Faces may name vertices that come later. Too many at worst, where a line that begins with v goes
/// on with another.
std::uint64_t count_vertex_lines(std::string_view text) {
  std::uint64_t count = 0;
  std::size_t at = byte_order_mark(text);
  while (at < text.size()) {
    at = std::min(text.find_first_not_of(" \t\r\v\f", at), text.size());
    if (at + 1 < text.size() && text[at] == 'v' &&
        std::string_view(" \t\r\v\f\\").find(text[at + 1]) != std::string_view::npos) {
      ++count;
    }
    at = std::min(text.find('\n', at), text.size() - 1) + 1;
  }
  return count;
}

}  // namespace

/// Does one of the first lines begin with the keyword of a vertex? Other formats may have such
/// lines too.
Likeness looks_like_obj(std::string_view text) {
  constexpr std::size_t kFarEnough = std::size_t{1} << 16;
  text = first_word_on(text).substr(0, kFarEnough);
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with("v ") || line.starts_with("v\t")) return Likeness::kPossible;
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return Likeness::kNone;
}

Expected<ReadResult> read_obj(const std::string& text, const std::string& file,
                              const ReadOptions& options) {
  if (auto readable = check_is_text(text, file); !readable) {
    return tl::unexpected(std::move(readable.error()));
  }
  MeshBuilder mesh(text, file, options);
  mesh.count_indices_from(1);
  mesh.expect_vertices(count_vertex_lines(text));
  std::array<Drawn, 4> passed_over{{{"l", "line elements (l)"},
                                    {"p", "point elements (p)"},
                                    {"curv", "curves (curv)"},
                                    {"surf", "free-form surfaces (surf)"}}};
  std::size_t weighted = 0;
  NamedGroups groups;
  Tokens tokens(text, byte_order_mark(text), Tokens::Continuation::kBackslash);
  do {
    const auto keyword = tokens.in_line();
    if (!keyword) continue;
    Expected<void> done;
    if (keyword->text == "v") {
      done = read_vertex(tokens, mesh, *keyword, weighted);
    } else if (keyword->text == "f") {
      done = read_face(tokens, mesh, *keyword);
      if (!done && skip(mesh, *keyword, done.error())) done = {};
      if (done) groups.add_face(static_cast<std::uint32_t>(mesh.face_count() - 1), mesh);
    } else if (keyword->text == "g" || keyword->text == "o") {
      groups.read_names(tokens, keyword->text == "o");
    } else {
      for (Drawn& drawn : passed_over) {
        if (drawn.keyword == keyword->text) ++drawn.count;
      }
    }
    if (!done && !skip(mesh, *keyword, done.error())) {
      return tl::unexpected(std::move(done.error()));
    }
  } while (tokens.next_line());
  if (mesh.vertex_count() == 0 && mesh.face_count() == 0) {
    return mesh.error(ErrorCode::kFormat, "no vertex and no face", "an OBJ file: v and f lines", 0);
  }
  if (weighted != 0) {
    mesh.warn(std::to_string(weighted) +
              (weighted == 1 ? " vertex has a weight" : " vertices have weights") +
              " other than 1, which are ignored: the three coordinates count");
  }
  for (const Drawn& drawn : passed_over) {
    if (drawn.count != 0) mesh.warn(std::to_string(drawn.count) + " " + drawn.name + " ignored");
  }
  auto result = mesh.finish();
  if (result) groups.write(result->scene);
  return result;
}

}  // namespace gnomon
