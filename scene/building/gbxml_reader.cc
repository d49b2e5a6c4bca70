// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/building/gbxml_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "scene/base/text_file.h"
#include "scene/building/length_units.h"
#include "scene/building/uncut_openings.h"
#include "scene/files/readers.h"
#include "scene/files/usable_id.h"
#include "scene/model/decimal_arithmetic.h"

namespace gnomon {

namespace {

/// The name of an element without its prefix.
std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

/// The first child of that name; null if there is none.
pugi::xml_node child(const pugi::xml_node& node, std::string_view name) {
  for (const pugi::xml_node& at : node.children()) {
    if (local_name(at) == name) return at;
  }
  return {};
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Types of surfaces that face the outdoors, and that are no part of a room.
constexpr std::string_view kOuter[] = {"ExteriorWall", "Roof", "ExposedFloor", "RaisedFloor"};
constexpr std::string_view kFree[] = {"Shade", "FreestandingColumn"};
constexpr std::string_view kInner[] = {"InteriorWall",       "InteriorFloor",   "Ceiling",
                                       "UndergroundWall",    "UndergroundSlab", "SlabOnGrade",
                                       "UndergroundCeiling", "EmbeddedColumn"};

template <std::size_t count>
bool is_one_of(std::string_view word, const std::string_view (&words)[count]) {
  return std::ranges::find(words, word) != std::end(words);
}

}  // namespace

GbXmlReader::GbXmlReader(std::string_view text, const std::string& file, const ReadOptions& options)
    : text_(text),
      file_(file),
      builder_(file, options, NumberMeaning::kDecimal),
      factor_(Number::from_short_decimal(1, 0)) {}

std::size_t GbXmlReader::offset(const pugi::xml_node& node) const {
  const std::ptrdiff_t offset = node.offset_debug();
  return byte_order_mark(text_) + (offset < 0 ? 0 : static_cast<std::size_t>(offset));
}

tl::unexpected<Error> GbXmlReader::error(const pugi::xml_node& node, ErrorCode code,
                                         std::string what, std::string expected) const {
  return fail(code, std::move(what), std::move(expected),
              place_in_text(file_, text_, offset(node)));
}

tl::unexpected<Error> GbXmlReader::at(const pugi::xml_node& node, const Error& why) const {
  return error(node, why.code, why.what, why.expected);
}

Expected<void> GbXmlReader::skip(const pugi::xml_node& node, std::size_t before, Error why) {
  const std::string id = usable_id(node.attribute("id").value());
  if (!builder_.skips_bad() || why.code == ErrorCode::kId || id.empty()) {
    return tl::unexpected(std::move(why));
  }
  builder_.take_back(before);
  builder_.add_bad(id, offset(node), std::move(why));
  return {};
}

Expected<ReadResult> GbXmlReader::read() {
  if (auto readable = check_is_text(text_, file_); !readable) {
    return tl::unexpected(std::move(readable.error()));
  }
  const std::size_t start = byte_order_mark(text_);
  // Bytes as they are, so that offsets are those of the file; names escape what is no UTF-8.
  const pugi::xml_parse_result parsed = document_.load_buffer(
      text_.data() + start, text_.size() - start, pugi::parse_default, pugi::encoding_utf8);
  if (!parsed) {
    return fail(
        parsed.status == pugi::status_out_of_memory ? ErrorCode::kLimit : ErrorCode::kSyntax,
        std::string("no well-formed XML: ") + parsed.description(), "gbXML",
        place_in_text(file_, text_, start + static_cast<std::size_t>(parsed.offset)));
  }
  const pugi::xml_node root = document_.document_element();
  if (local_name(root) != "gbXML") {
    return error(root, ErrorCode::kFormat, "the root element is " + quoted_text(local_name(root)),
                 "gbXML");
  }
  if (auto done = read_units(root); !done) return tl::unexpected(std::move(done.error()));
  for (const pugi::xml_node& campus : root.children()) {
    if (local_name(campus) != "Campus") continue;
    for (const pugi::xml_node& surface : campus.children()) {
      if (local_name(surface) != "Surface") continue;
      if (auto done = read_surface(surface); !done) return tl::unexpected(std::move(done.error()));
    }
  }
  warn();
  std::vector<std::pair<std::string, std::string>> facts = {{"units", "\"" + units_ + "\""}};
  builder_.write_extra("gbxml", facts);
  return builder_.finish();
}

Expected<void> GbXmlReader::read_units(const pugi::xml_node& root) {
  const std::string_view name = root.attribute("lengthUnit").value();
  if (name.empty()) {
    return error(root, ErrorCode::kFormat, "gbXML without a lengthUnit", shown_length_units());
  }
  const LengthUnit* const unit = length_unit(name);
  if (unit == nullptr) {
    return error(root, ErrorCode::kFormat, "a lengthUnit " + quoted_text(name),
                 shown_length_units());
  }
  units_ = unit->name;
  factor_ = unit->metres();
  return {};
}

Expected<Position> GbXmlReader::point(const pugi::xml_node& element) const {
  Position result;
  std::size_t count = 0;
  for (const pugi::xml_node& coordinate : element.children()) {
    if (local_name(coordinate) != "Coordinate") continue;
    if (count < result.size()) {
      auto number = Number::parse(trimmed(coordinate.child_value()), NumberMeaning::kDecimal);
      if (!number) return at(coordinate, number.error());
      result[count] = decimal_product(*number, factor_);
    }
    ++count;
  }
  if (count != result.size()) {
    return error(element, ErrorCode::kFormat,
                 "a point of " + counted_as(count, "coordinate", "coordinates"), "three of them");
  }
  return result;
}

Expected<std::vector<Position>> GbXmlReader::poly_loop(const pugi::xml_node& element) const {
  const pugi::xml_node geometry = child(element, "PlanarGeometry");
  const pugi::xml_node loop = child(geometry, "PolyLoop");
  if (!loop) {
    return error(geometry ? geometry : element, ErrorCode::kFormat, "there is no PolyLoop",
                 "a PlanarGeometry with a PolyLoop (a RectangularGeometry has rounded angles)");
  }
  std::vector<Position> corners;
  for (const pugi::xml_node& corner : loop.children()) {
    if (local_name(corner) != "CartesianPoint") continue;
    auto position = point(corner);
    if (!position) return tl::unexpected(std::move(position.error()));
    corners.push_back(*std::move(position));
  }
  constexpr std::size_t kFewest = 3;
  if (corners.size() < kFewest) {
    return error(loop, ErrorCode::kFormat,
                 "a loop of " + counted_as(corners.size(), "vertex", "vertices"),
                 "at least 3 vertices");
  }
  return corners;
}

Expected<void> GbXmlReader::read_surface(const pugi::xml_node& surface) {
  std::string kind = surface.attribute("surfaceType").value();
  if (kind.empty()) {
    // What it bounds tells.
    std::size_t spaces = 0;
    for (const pugi::xml_node& at : surface.children()) {
      if (local_name(at) == "AdjacentSpaceId") ++spaces;
    }
    kind = spaces == 0 ? "Shade" : spaces == 1 ? "ExteriorWall" : "InteriorWall";
  }
  std::size_t openings = 0;
  for (const pugi::xml_node& at : surface.children()) {
    if (local_name(at) == "Opening") ++openings;
  }
  if (kind == "Air") {
    ++air_;
    return {};
  }
  if (is_one_of(kind, kInner)) {
    interior_ += 1 + openings;
    return {};
  }
  const std::size_t before = builder_.polygon_count();
  if (!is_one_of(kind, kOuter) && !is_one_of(kind, kFree)) {
    return skip(surface, before,
                error(surface, ErrorCode::kFormat, "a surfaceType " + quoted_text(kind),
                      "ExteriorWall, Roof, Shade, ...")
                    .value());
  }
  if (auto done = add_surface(surface, kind); !done) {
    return skip(surface, before, std::move(done.error()));
  }
  return {};
}

Expected<void> GbXmlReader::add_surface(const pugi::xml_node& surface, const std::string& kind) {
  const auto corners = poly_loop(surface);
  if (!corners) return tl::unexpected(corners.error());
  const auto loop = builder_.vertices(*corners);
  if (!loop) return at(surface, loop.error());
  const std::size_t wall = builder_.polygon_count();
  auto polygon = builder_.add(usable_id(surface.attribute("id").value()), offset(surface));
  if (!polygon) return at(surface, polygon.error());
  (*polygon)->loop = *loop;
  const bool is_free = is_one_of(kind, kFree);
  if (is_free) (*polygon)->two_sided = true;
  const std::string space =
      is_free ? "" : usable_text(child(surface, "AdjacentSpaceId").attribute("spaceIdRef").value());
  builder_.put_into_groups(space, kind);
  if (std::string_view(surface.attribute("exposedToSun").value()) == "false") ++unexposed_;
  return add_openings(surface, wall, OpeningPlane(*corners), space);
}

Expected<void> GbXmlReader::add_openings(const pugi::xml_node& surface, std::size_t wall,
                                         const OpeningPlane& plane, const std::string& space) {
  std::vector<double> distances;
  for (const pugi::xml_node& opening : surface.children()) {
    if (local_name(opening) != "Opening") continue;
    const std::size_t before = builder_.polygon_count();
    auto distance = add_opening(opening, wall, plane, space);
    if (distance) {
      distances.push_back(*distance);
      continue;
    }
    if (auto skipped = skip(opening, before, std::move(distance.error())); !skipped) return skipped;
  }
  return fill_unusable_holes(wall, distances);
}

Expected<void> GbXmlReader::fill_unusable_holes(std::size_t wall,
                                                const std::vector<double>& distances) {
  Polygon& polygon = builder_.scene().polygons[wall];
  const auto unusable = unusable_holes(builder_.scene(), polygon);
  if (!unusable) return tl::unexpected(unusable.error());
  for (auto hole = unusable->rbegin(); hole != unusable->rend(); ++hole) {
    polygon.holes.erase(polygon.holes.begin() + static_cast<std::ptrdiff_t>(*hole));
    farthest_uncut_ = std::max(farthest_uncut_, distances[*hole]);
  }
  uncut_ += unusable->size();
  for (std::size_t hole = 0; hole < distances.size(); ++hole) {
    if (std::ranges::count(*unusable, hole) > 0 || distances[hole] == 0) continue;
    ++off_plane_;
    farthest_ = std::max(farthest_, distances[hole]);
  }
  return {};
}

Expected<double> GbXmlReader::add_opening(const pugi::xml_node& opening, std::size_t wall,
                                          const OpeningPlane& plane, const std::string& space) {
  const auto corners = poly_loop(opening);
  if (!corners) return tl::unexpected(corners.error());
  const auto loop = builder_.vertices(*corners);
  if (!loop) return at(opening, loop.error());
  const std::string kind = opening.attribute("openingType").value();
  // There is nothing in an opening of air.
  if (kind != "Air") {
    auto polygon = builder_.add(usable_id(opening.attribute("id").value()), offset(opening));
    if (!polygon) return at(opening, polygon.error());
    (*polygon)->loop = *loop;
    if (builder_.scene().polygons[wall].two_sided) (*polygon)->two_sided = true;
    builder_.put_into_groups(space, kind.empty() ? "Opening" : usable_text(kind));
  }
  builder_.scene().polygons[wall].holes.push_back(*loop);
  ++openings_;
  return plane.distance(*corners);
}

void GbXmlReader::warn() {
  builder_.warn_of(interior_, "interior surface", "interior surfaces",
                   " left out: what does not face the outdoors neither casts nor receives");
  builder_.warn_of(air_, "surface of air", "surfaces of air",
                   " left out: there is nothing in them");
  builder_.warn_of(unexposed_, "outer surface is", "outer surfaces are",
                   " said not to be exposed to the sun: kept");
  if (off_plane_ != 0) {
    builder_.warn(std::to_string(off_plane_) + " of " +
                  counted_as(openings_, "opening", "openings") +
                  " not exactly in the plane of the surface, by up to " + shown_length(farthest_) +
                  " m: the surface around them is not planar, and triangulated");
  }
  if (uncut_ == 0) return;
  std::string off;
  if (farthest_uncut_ > 0) {
    // The power of ten above all that is off, since the surface may be bent by what it holds.
    const double enough =
        std::pow(10.0, std::floor(std::log10(std::max(farthest_, farthest_uncut_))) + 1);
    off = ", up to " + shown_length(farthest_uncut_) +
          " m before or behind it: 'gnomon convert --snap " + shown_length(enough) +
          " --parent' can put them into its plane";
  }
  builder_.warn(
      std::to_string(uncut_) + " of " + counted_as(openings_, "opening", "openings") +
      " not cut out: they cross or touch the edge of their surface or one another, and lie on it" +
      off);
}

Likeness looks_like_gbxml(std::string_view text) {
  constexpr std::size_t kFarEnough = std::size_t{1} << 16;
  text = first_word_on(text).substr(0, kFarEnough);
  if (!text.starts_with("<")) return Likeness::kNone;
  for (std::size_t at = text.find("gbXML"); at != std::string_view::npos;
       at = text.find("gbXML", at + 1)) {
    const std::size_t open = text.rfind('<', at);
    const std::string_view before = text.substr(open + 1, at - open - 1);
    const bool is_element = before.find_first_of(" \t\r\n>\"!?") == std::string_view::npos;
    if (open != std::string_view::npos && is_element) return Likeness::kCertain;
  }
  return Likeness::kNone;
}

Expected<ReadResult> read_gbxml(const std::string& text, const std::string& file,
                                const ReadOptions& options) {
  return GbXmlReader(text, file, options).read();
}

}  // namespace gnomon
