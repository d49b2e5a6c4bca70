// SPDX-License-Identifier: LGPL-3.0-or-later
// A scene that grows by polygons with names and by exact positions: what readers of formats share
// that do not number their vertices. Positions of the same value become one vertex.
#ifndef GNOMON_SCENE_FILES_SCENE_BUILDER_H
#define GNOMON_SCENE_FILES_SCENE_BUILDER_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "gnomon/scene/read.h"
#include "gnomon/scene/unusable.h"
#include "scene/files/extra_groups.h"

namespace gnomon {

/// "1 wall", "7 walls".
std::string counted_as(std::size_t count, const std::string& one, const std::string& many);

class SceneBuilder {
 public:
  /// `numbers`: what they mean unless the options say otherwise. The options must outlive this.
  SceneBuilder(const std::string& file, const ReadOptions& options, NumberMeaning numbers);

  Scene& scene() { return scene_; }
  bool skips_bad() const { return options_.skip_bad; }

  /// The exact position as the scene's numbers are meant: itself, or the nearest doubles. Errors,
  /// without a place: kNumber, kLimit.
  Expected<Position> as_meant(const Position& exact);
  Expected<VertexId> vertex(const Position& exact);
  Expected<std::vector<VertexId>> vertices(const std::vector<Position>& exact);

  /// Adds a polygon without a loop, that begins at that byte of the file. Errors, without a place:
  /// kId (no name, or that of another).
  Expected<Polygon*> add(const std::string& id, std::uint64_t offset);
  /// The same called `id`, or `id`/1, `id`/2, ... if others are called so.
  Polygon& add_renamed(const std::string& id, std::uint64_t offset);
  /// Takes the polygons behind the first `count` back.
  void take_back(std::size_t count);
  /// A polygon that cannot be used, to be left out and listed. Requires: skips_bad().
  void add_bad(const std::string& id, std::uint64_t offset, Error why);
  std::size_t polygon_count() const { return scene_.polygons.size(); }

  /// The last polygon belongs to this room, object or modifier, and is of that kind. An empty name
  /// is none.
  void put_into_groups(const std::string& owner, const std::string& kind);
  /// Writes the groups, and FORMAT: {the facts, "kinds": [names of groups]}, as the scene's "extra"
  /// (extra_with_groups()).
  void write_extra(const std::string& format, std::vector<ExtraFact> facts);

  void warn(std::string warning) { warnings_.push_back(std::move(warning)); }
  /// One line if the count is not 0: "7 walls" and the rest.
  void warn_of(std::size_t count, const std::string& one, const std::string& many,
               const std::string& rest);
  ReadResult finish();

 private:
  std::string free_id(const std::string& id);

  const ReadOptions& options_;
  Scene scene_;
  std::unordered_map<std::string, VertexId> vertex_index_;  // by value
  std::unordered_map<std::string, std::uint32_t> names_;    // how many ids begin like this one
  GroupList owners_, kinds_;
  std::vector<std::uint64_t> offsets_;  // of polygons
  std::vector<PolygonProblem> problems_;
  std::vector<std::string> warnings_;
  std::size_t underflows_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_FILES_SCENE_BUILDER_H
