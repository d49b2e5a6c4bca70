// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/page/scene_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "report/json/json_writer.h"
#include "report/text/base64.h"

namespace gnomon::report {

namespace {

using Point = std::array<double, 3>;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

template <class Number>
void write_numbers(JsonWriter& json, std::string_view name, const std::vector<Number>& numbers) {
  json.member(name, base64_of(std::span<const Number>(numbers)));
}

void write_point(JsonWriter& json, std::string_view name, const Point& point) {
  json.key(name);
  json.begin_array(JsonLayout::kInline);
  for (const double coordinate : point) json.value(coordinate);
  json.end_array();
}

/// Loops of points about a centre.
class Rings {
 public:
  explicit Rings(const Point& centre) : centre_(centre) {}

  void add_point(const Point& point) {
    for (std::size_t axis = 0; axis < point.size(); ++axis) {
      points_.push_back(static_cast<float>(point[axis] - centre_[axis]));
    }
    ++size_;
  }
  /// What was added since the last ring is one; a hole is of the ring before it that is none.
  void end_ring(bool is_hole) {
    sizes_.push_back(size_ * 2 + (is_hole ? 1 : 0));
    size_ = 0;
  }
  void write(JsonWriter& json) const {
    write_numbers(json, "rings", sizes_);
    write_numbers(json, "points", points_);
  }

 private:
  Point centre_;
  std::vector<float> points_;
  std::vector<std::uint32_t> sizes_;
  std::uint32_t size_ = 0;
};

class ViewWriter {
 public:
  ViewWriter(JsonWriter& json, const Scene& scene, const PreparedScene& prepared)
      : json_(json), scene_(scene), prepared_(prepared) {
    for (std::uint32_t i = 0; i < scene.polygons.size(); ++i)
      index_.emplace(scene.polygons[i].id, i);
    find_frame();
  }

  void write_scene();
  void write_layer(const ViewLayer& layer, std::uint64_t& points_left);

 private:
  void find_frame();
  void write_lights();
  void write_parts();
  void write_fragments(const ClaimedLight& light);
  std::uint32_t index_of(const std::string& id) const {
    const auto found = index_.find(id);
    return found == index_.end() ? kNone : found->second;
  }

  JsonWriter& json_;
  const Scene& scene_;
  const PreparedScene& prepared_;
  std::unordered_map<std::string, std::uint32_t> index_;
  Point centre_{};
  double radius_ = 0;
};

void ViewWriter::find_frame() {
  Point low{}, high{};
  bool first = true;
  for (const VertexId vertex : prepared_.loop_vertices) {
    const Point& point = prepared_.geometry.positions[vertex];
    for (std::size_t axis = 0; axis < point.size(); ++axis) {
      low[axis] = first ? point[axis] : std::min(low[axis], point[axis]);
      high[axis] = first ? point[axis] : std::max(high[axis], point[axis]);
    }
    first = false;
  }
  // Halves first: the sum of two large numbers is none.
  for (std::size_t axis = 0; axis < centre_.size(); ++axis) {
    centre_[axis] = low[axis] / 2 + high[axis] / 2;
    radius_ = std::hypot(radius_, high[axis] / 2 - low[axis] / 2);
  }
}

void ViewWriter::write_scene() {
  write_point(json_, "centre", centre_);
  json_.member("radius", radius_);
  json_.key("polygons");
  json_.begin_array();
  for (const Polygon& polygon : scene_.polygons) json_.value(polygon.id);
  json_.end_array();
  write_lights();
  write_parts();
}

void ViewWriter::write_lights() {
  json_.key("lights");
  json_.begin_array();
  for (const Light& light : scene_.lights) {
    const auto position = [](const Position& numbers) {
      return Point{numbers[0].nearest(), numbers[1].nearest(), numbers[2].nearest()};
    };
    json_.begin_object(JsonLayout::kInline);
    json_.member("id", light.id);
    if (light.is_point()) write_point(json_, "position", position(light.position));
    if (light.is_directional()) write_point(json_, "to_light", position(light.position));
    if (light.has_area()) {
      json_.key("loop");
      json_.begin_array(JsonLayout::kInline);
      for (const Position& corner : light.loop) {
        json_.begin_array(JsonLayout::kInline);
        for (const double coordinate : position(corner)) json_.value(coordinate);
        json_.end_array();
      }
      json_.end_array();
    }
    json_.end_object();
  }
  json_.end_array();
}

/// The convex parts of all polygons, counter-clockwise seen from their front.
void ViewWriter::write_parts() {
  Rings rings(centre_);
  std::vector<std::uint32_t> polygons;
  for (const Part& part : prepared_.parts) {
    polygons.push_back(part.polygon);
    for (const VertexId vertex : prepared_.loop(part)) {
      rings.add_point(prepared_.geometry.positions[vertex]);
    }
    rings.end_ring(false);
  }
  json_.key("parts");
  json_.begin_object();
  write_numbers(json_, "polygon", polygons);
  rings.write(json_);
  json_.end_object();
}

std::uint64_t point_count(const ClaimedLight& light) {
  std::uint64_t count = 0;
  for (const ClaimedPolygon& polygon : light.polygons) {
    for (const ClaimedFragment& fragment : polygon.fragments) {
      count += fragment.loop.size();
      for (const RationalLoop& hole : fragment.holes) count += hole.size();
    }
  }
  return count;
}

void ViewWriter::write_fragments(const ClaimedLight& light) {
  Rings rings(centre_);
  std::vector<std::uint32_t> polygons, casters, levels;
  std::vector<std::uint8_t> sides, states;
  const auto add_ring = [&](const RationalLoop& loop, bool is_hole) {
    for (const RationalPoint& point : loop) {
      rings.add_point({point[0].get_d(), point[1].get_d(), point[2].get_d()});
    }
    rings.end_ring(is_hole);
  };
  for (const ClaimedPolygon& polygon : light.polygons) {
    for (const ClaimedFragment& fragment : polygon.fragments) {
      polygons.push_back(index_of(polygon.id));
      casters.push_back(fragment.caster.empty() ? kNone : index_of(fragment.caster));
      levels.push_back(static_cast<std::uint32_t>(fragment.level));
      sides.push_back(polygon.side == Side::kBack ? 1 : 0);
      states.push_back(static_cast<std::uint8_t>(fragment.state));
      add_ring(fragment.loop, false);
      for (const RationalLoop& hole : fragment.holes) add_ring(hole, true);
    }
  }
  json_.member("fragments", polygons.size());
  write_numbers(json_, "polygon", polygons);
  write_numbers(json_, "side", sides);
  write_numbers(json_, "state", states);
  write_numbers(json_, "caster", casters);
  if (light.cover == Cover::kOverlay) write_numbers(json_, "level", levels);
  rings.write(json_);
}

void ViewWriter::write_layer(const ViewLayer& layer, std::uint64_t& points_left) {
  const ClaimedLight& light = *layer.light;
  json_.begin_object();
  json_.member("run", layer.run);
  json_.member("light", light.id);
  if (light.background) json_.member("background", name_of(*light.background));
  const std::uint64_t points = point_count(light);
  if (light.shares_alone) {
    json_.member("left_out", "it tells shares without fragments");
  } else if (points > points_left) {
    json_.member("left_out", "its fragments have " + std::to_string(points) +
                                 " points, more than the " + std::to_string(points_left) +
                                 " that the page has room for");
  } else {
    points_left -= points;
    write_fragments(light);
  }
  json_.end_object();
}

}  // namespace

void write_scene_view(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
                      std::span<const ViewLayer> layers, std::uint64_t most_points) {
  JsonWriter json(sink);
  json.begin_object();
  json.member("format", "gnomon-view");
  json.member("version", 1);
  json.key("states");
  json.begin_array(JsonLayout::kInline);
  for (const LightState state :
       {LightState::kLit, LightState::kShadow, LightState::kPenumbra, LightState::kUmbra}) {
    json.value(name_of(state));
  }
  json.end_array();
  ViewWriter view(json, scene, prepared);
  view.write_scene();
  json.key("layers");
  json.begin_array();
  for (const ViewLayer& layer : layers) view.write_layer(layer, most_points);
  json.end_array();
  json.end_object();
  json.finish();
}

}  // namespace gnomon::report
