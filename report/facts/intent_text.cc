// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/facts/intent_text.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "report/text/number_text.h"
#include "report/text/table.h"

namespace gnomon::report {

namespace {

constexpr int kDigits = 3;

/// "1 pair", "2,000 pairs".
std::string counted_as(std::size_t count, const char* one, const char* many) {
  return grouped(count) + " " + (count == 1 ? one : many);
}

/// Answers in words, of an intent and the names of its scene.
class IntentWords {
 public:
  IntentWords(const Scene& scene, const Intent& intent) : scene_(scene), intent_(intent) {}

  const std::string& id(std::uint32_t polygon) const { return scene_.polygons[polygon].id; }

  /// "window 1e-07 behind wall".
  std::string pair(const NearlyCoplanarPair& pair) const {
    return id(pair.polygon) + " " + rounded(std::abs(pair.distance), kDigits) +
           (pair.distance < 0 ? " behind " : " before ") + id(pair.other);
  }
  std::string bent(const BentPolygon& polygon) const {
    return id(polygon.polygon) + " by " + rounded(polygon.distance, kDigits);
  }
  /// "box-bottom and 5 more".
  std::string component(const ClosedComponent& component) const {
    std::string text = id(component.polygons[0]);
    if (component.polygons.size() > 1) {
      text += " and " + grouped(component.polygons.size() - 1) + " more";
    }
    return text;
  }
  std::string lights_of(const ClosedComponent& component) const {
    std::string text = scene_.lights[component.lights_inside[0]].id;
    if (component.lights_inside.size() > 1) {
      text += " and " + grouped(component.lights_inside.size() - 1) + " more";
    }
    return text;
  }
  std::vector<const ClosedComponent*> closed(
      const std::function<bool(const ClosedComponent&)>& wanted) const {
    std::vector<const ClosedComponent*> found;
    for (const ClosedComponent& component : intent_.closed) {
      if (wanted(component)) found.push_back(&component);
    }
    return found;
  }
  std::vector<const ClosedComponent*> seen_through() const {
    return closed([&](const auto& component) { return intent_.is_seen_through(component); });
  }
  std::vector<const ClosedComponent*> inside_out() const {
    return closed([&](const auto& component) { return intent_.is_inside_out(component); });
  }
  std::vector<const ClosedComponent*> mixed() const {
    return looking(ComponentOrientation::kMixed);
  }
  std::vector<const ClosedComponent*> looking(ComponentOrientation orientation) const {
    return closed([&](const auto& component) { return component.orientation == orientation; });
  }
  std::string far() const {
    return "coordinates up to " + rounded(intent_.farthest_coordinate, kDigits) + ", " +
           rounded(intent_.farthest_coordinate / intent_.diagonal, 2) +
           " times the scene's size: doubles there are " +
           rounded(
               std::nextafter(intent_.farthest_coordinate, INFINITY) - intent_.farthest_coordinate,
               kDigits) +
           " apart";
  }

 private:
  const Scene& scene_;
  const Intent& intent_;
};

/// A heading and the first few of a list.
class Lines {
 public:
  explicit Lines(bool all) : all_(all) {}

  void heading(const std::string& text) { text_ += wrapped(text, TextTable::kWidth, 2, 6); }
  template <class Element, class Words>
  void list(const std::vector<Element>& elements, const Words& words) {
    constexpr std::size_t kMost = 3;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (!all_ && i == kMost) {
        text_ += "    ... (--all lists every one)\n";
        return;
      }
      text_ += wrapped(words(elements[i]), TextTable::kWidth, 4, 8);
    }
  }
  std::string take() { return std::move(text_); }

 private:
  bool all_;
  std::string text_;
};

std::string point_of(const PreparedScene& prepared, VertexId vertex) {
  const auto& p = prepared.geometry.positions[vertex];
  return "(" + rounded(p[0], 9) + ", " + rounded(p[1], 9) + ", " + rounded(p[2], 9) + ")";
}

void nearly_equal_lines(Lines& lines, const IntentWords& words, const PreparedScene& prepared,
                        const Intent& intent) {
  if (!intent.nearly_coplanar.empty()) {
    lines.heading(counted_as(intent.nearly_coplanar.size(), "pair of polygons overlaps",
                             "pairs of polygons overlap") +
                  " all but in one plane (convert --snap):");
    lines.list(intent.nearly_coplanar, [&](const NearlyCoplanarPair& pair) {
      return words.pair(pair) + ", angle " + rounded(pair.angle, kDigits) + " degrees, overlap " +
             rounded(pair.overlap);
    });
  }
  if (!intent.near_vertices.empty()) {
    lines.heading(counted_as(intent.near_vertices.size(), "pair", "pairs") +
                  " of vertices all but coincide, " +
                  counted_as(intent.near_edges.size(), "pair", "pairs") +
                  " of edges (convert --snap):");
    lines.list(intent.near_vertices, [&](const NearlySharedVertices& pair) {
      return point_of(prepared, pair.a) + " and another " + rounded(pair.distance, kDigits) +
             " away";
    });
  }
  if (!intent.bent.empty()) {
    lines.heading(counted_as(intent.bent.size(), "polygon is", "polygons are") +
                  " bent by rounding, and cut into triangles (--numbers decimal, convert --snap):");
    lines.list(intent.bent, [&](const BentPolygon& polygon) { return words.bent(polygon); });
  }
}

void orientation_lines(Lines& lines, const IntentWords& words, const Intent& intent) {
  const auto name = [&](const ClosedComponent* component) { return words.component(*component); };
  const auto seen = words.seen_through();
  if (!seen.empty()) {
    lines.heading(counted_as(seen.size(), "closed component looks", "closed components look") +
                  " outwards with a light inside, which shines through (convert --orient):");
    lines.list(seen, [&](const ClosedComponent* component) {
      return words.lights_of(*component) + " inside " + words.component(*component);
    });
  }
  const auto inside_out = words.inside_out();
  if (!inside_out.empty()) {
    lines.heading(
        counted_as(inside_out.size(), "closed component looks", "closed components look") +
        " inwards with no light inside (convert --orient):");
    lines.list(inside_out, name);
  }
  const auto mixed = words.mixed();
  if (!mixed.empty()) {
    lines.heading(counted_as(mixed.size(), "closed component looks", "closed components look") +
                  " one way here and the other there (convert --orient):");
    lines.list(mixed, name);
  }
  if (!intent.facing_nothing.empty()) {
    lines.heading(counted_as(intent.facing_nothing.size(),
                             "polygon looks away from every light, and neither receives nor casts",
                             "polygons look away from every light, and neither receive nor cast") +
                  " (--two-sided):");
    lines.list(intent.facing_nothing, [&](std::uint32_t polygon) { return words.id(polygon); });
  }
}

const char* orientation_name(ComponentOrientation orientation) {
  switch (orientation) {
    case ComponentOrientation::kOutwards:
      return "outwards";
    case ComponentOrientation::kInwards:
      return "inwards";
    case ComponentOrientation::kMixed:
      return "mixed";
    case ComponentOrientation::kFlat:
      return "flat";
  }
  return "";
}

void write_pairs(JsonWriter& json, const Scene& scene, const PreparedScene& prepared,
                 const Intent& intent) {
  const auto id = [&](std::uint32_t polygon) { return scene.polygons[polygon].id; };
  json.key("nearly_coplanar");
  json.begin_array();
  for (const NearlyCoplanarPair& pair : intent.nearly_coplanar) {
    json.begin_object(JsonLayout::kInline);
    json.member("polygon", id(pair.polygon));
    json.member("other", id(pair.other));
    json.member("distance", pair.distance);
    json.member("angle", pair.angle);
    json.member("overlap", pair.overlap);
    json.end_object();
  }
  json.end_array();
  json.key("nearly_shared_vertices");
  json.begin_array();
  for (const NearlySharedVertices& pair : intent.near_vertices) {
    json.begin_object(JsonLayout::kInline);
    json.key("vertex");
    json.begin_array(JsonLayout::kInline);
    for (const double coordinate : prepared.geometry.positions[pair.a]) json.value(coordinate);
    json.end_array();
    json.member("distance", pair.distance);
    json.end_object();
  }
  json.end_array();
  json.member("nearly_shared_edges", intent.near_edges.size());
  json.key("bent");
  json.begin_array();
  for (const BentPolygon& polygon : intent.bent) {
    json.begin_object(JsonLayout::kInline);
    json.member("polygon", id(polygon.polygon));
    json.member("distance", polygon.distance);
    json.end_object();
  }
  json.end_array();
}

}  // namespace

std::string intent_warning(const Scene& scene, const Intent& intent) {
  if (!intent.is_doubtful()) return {};
  const IntentWords words(scene, intent);
  std::string text;
  const auto add = [&](const std::string& clause) { text += (text.empty() ? "" : "; ") + clause; };
  if (const auto& pairs = intent.nearly_coplanar; !pairs.empty()) {
    add(counted_as(pairs.size(), "pair of polygons overlaps", "pairs of polygons overlap") +
        " all but in one plane (" + words.pair(pairs[0]) + ")");
  }
  if (const auto& pairs = intent.near_vertices; !pairs.empty()) {
    add(counted_as(pairs.size(), "pair of vertices all but coincides",
                   "pairs of vertices all but coincide"));
  }
  if (!intent.bent.empty()) {
    const auto most = std::ranges::max_element(intent.bent, {}, &BentPolygon::distance);
    add(counted_as(intent.bent.size(), "polygon is", "polygons are") + " bent by rounding (" +
        words.bent(*most) + ")");
  }
  if (const auto seen = words.seen_through(); !seen.empty()) {
    add(words.lights_of(*seen[0]) + " shines through a closed component that looks outwards (" +
        words.component(*seen[0]) + ")");
  }
  if (const auto inside_out = words.inside_out(); !inside_out.empty()) {
    add(counted_as(inside_out.size(), "closed component looks", "closed components look") +
        " inwards with no light inside (" + words.component(*inside_out[0]) + ")");
  }
  if (const auto mixed = words.mixed(); !mixed.empty()) {
    add(counted_as(mixed.size(), "closed component looks", "closed components look") +
        " one way here and the other there (" + words.component(*mixed[0]) + ")");
  }
  if (!intent.facing_nothing.empty()) {
    add(counted_as(intent.facing_nothing.size(),
                   "polygon looks away from every light and casts nothing (",
                   "polygons look away from every light and cast nothing (") +
        words.id(intent.facing_nothing[0]) + ")");
  }
  if (intent.is_far_from_origin()) add(words.far());
  return "taken as the numbers say, perhaps not as meant: " + text +
         "; 'gnomon info' tells more, 'gnomon convert' can repair";
}

std::string intent_text(const Scene& scene, const PreparedScene& prepared, const Intent& intent,
                        bool all) {
  const IntentWords words(scene, intent);
  Lines lines(all);
  nearly_equal_lines(lines, words, prepared, intent);
  orientation_lines(lines, words, intent);
  if (intent.is_far_from_origin()) lines.heading(words.far());
  std::string doubtful = lines.take();
  const auto count = [&](ComponentOrientation orientation) {
    return words.looking(orientation).size();
  };
  std::string text = "\nclosed components: " + grouped(intent.closed.size());
  if (!intent.closed.empty()) {
    text += "; " + grouped(count(ComponentOrientation::kOutwards)) + " look outwards, " +
            grouped(count(ComponentOrientation::kInwards)) + " inwards, " +
            grouped(count(ComponentOrientation::kMixed)) + " both ways, " +
            grouped(count(ComponentOrientation::kFlat)) + " have no volume";
  }
  text += "\nperhaps not as meant (near: closer than " + rounded(intent.near, kDigits) + ")\n";
  return text + (doubtful.empty() ? "  nothing found\n" : doubtful);
}

void write_intent_json(JsonWriter& json, const Scene& scene, const PreparedScene& prepared,
                       const Intent& intent) {
  json.key("intent");
  json.begin_object();
  json.member("near", intent.near);
  write_pairs(json, scene, prepared, intent);
  json.key("closed_components");
  json.begin_array();
  for (const ClosedComponent& component : intent.closed) {
    json.begin_object(JsonLayout::kInline);
    json.member("first_polygon", scene.polygons[component.polygons[0]].id);
    json.member("polygons", component.polygons.size());
    json.member("looks", orientation_name(component.orientation));
    json.key("lights_inside");
    json.begin_array(JsonLayout::kInline);
    for (const std::uint32_t light : component.lights_inside) json.value(scene.lights[light].id);
    json.end_array();
    json.end_object();
  }
  json.end_array();
  json.key("facing_nothing");
  json.begin_array(JsonLayout::kInline);
  for (const std::uint32_t polygon : intent.facing_nothing) {
    json.value(scene.polygons[polygon].id);
  }
  json.end_array();
  json.member("farthest_coordinate", intent.farthest_coordinate);
  json.member("far_from_origin", intent.is_far_from_origin());
  json.end_object();
}

}  // namespace gnomon::report
