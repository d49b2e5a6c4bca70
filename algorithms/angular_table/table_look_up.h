// SPDX-License-Identifier: LGPL-3.0-or-later
// Look-ups in the angular tables of one light (Thakur, Cheng & Miura, section 3.4): which samples
// of a span of one polygon are in shadow.
//
// The samples of a span that lie in one slice of a table share a row of it, which is fetched once:
// a look-up. In the row, spans of objects are found by where they begin. An object that is wholly
// in front of the polygon's plane shadows all that its spans hold; of others the stretches of their
// faces tell whether the sample is beyond one. Spans of all objects are united, and the search ends
// when nothing is lit.
//
// Exactness: that of the space. A table of rows takes each sample for one in the middle of its
// slice.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_LOOK_UP_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_LOOK_UP_H

#include <algorithm>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "algorithms/angular_table/light_tables.h"
#include "algorithms/pixels/image_scene.h"
#include "algorithms/pixels/visible_row.h"

namespace gnomon {

template <ImageSpaceModel Space>
class TableLookUp {
 public:
  /// `l`: the light's place in the task.
  TableLookUp(ImageScene<Space>& scene, const PixelTask& task, const LightTables& tables,
              std::size_t l)
      : scene_(scene), task_(task), tables_(tables), light_(l), lit_(task.frame.width) {
    for (const AngularTable& table : tables.tables()) planes_.emplace_back(table.rows().count());
  }

  /// Sets the light's bit of the samples that it reaches. Requires: the seen side faces the light.
  void light(std::uint32_t part, Span run, std::uint32_t row, std::span<std::uint64_t> lit_by,
             WorkCounts& work) {
    run = part_in_region(space(), run, task_.scene.lights[task_.lights[light_]],
                         scene_.facing_eye(part), row);
    if (run.empty()) return;
    std::fill(lit_.begin() + run.begin, lit_.begin() + run.end, std::uint8_t{1});
    at_ = {part, scene_.facing_eye(part), row, &work};
    for (std::size_t t = 0; t < planes_.size(); ++t) look_in(t, run);
    for (std::uint32_t i = run.begin; i < run.end; ++i) {
      if (lit_[i] != 0) lit_by[i] |= std::uint64_t{1} << light_;
    }
  }

 private:
  /// How an object stands to the plane of a polygon that faces the light.
  enum class Standing : std::uint8_t { kUnknown, kInFront, kBehind, kAcross };

  /// Planes of one table in this thread's space.
  struct PlanesOf {
    explicit PlanesOf(std::uint32_t rows) : borders(rows + 1) {}
    std::vector<PlaneRef> borders;  // between slices; not valid() until they are needed
    std::vector<PlaneRef> sides;    // of the chart, if it is a pyramid
    /// By row and edge, or by edge in a table without rows.
    std::unordered_map<std::uint64_t, PlaneRef> right_of;
  };
  /// What is looked up.
  struct Place {
    std::uint32_t part = 0;
    PlaneRef on;
    std::uint32_t row = 0;
    WorkCounts* work = nullptr;
  };

  Space& space() { return scene_.space(); }
  Span part_in_front(Span span, PlaneRef plane) {
    return part_on_side(space(), span, plane, at_.on, at_.row, Sign::kPositive);
  }
  bool is_in_front(std::uint32_t column, PlaneRef plane) {
    return space().side_at_sample(plane, at_.on, {column, at_.row}) == Sign::kPositive;
  }

  void look_in(std::size_t t, Span span) {
    const AngularTable& table = tables_.tables()[t];
    if (table.rows().count() == 0) return;
    span = part_in_chart(t, span);
    span = part_in_front(span, border(t, 0));
    span = part_in_front(span, -border(t, table.rows().count()));
    while (!span.empty()) {
      const std::uint32_t k = slice_of(t, span.begin);
      Span here = part_in_front(span, border(t, k));
      here = part_in_front(here, -border(t, k + 1));
      // On rounded kernels a sample may be in no slice.
      if (here.empty() || here.begin != span.begin) here = {span.begin, span.begin + 1};
      ++(*at_.work)[Counter::kLookUps];
      if (table.rows().is_exact()) {
        look_in_slab(t, k, here);
      } else {
        look_in_row(t, k, here);
      }
      span.begin = here.end;
    }
  }

  Span part_in_chart(std::size_t t, Span span) {
    const TableChart& chart = tables_.tables()[t].mesh().chart();
    if (!chart.is_pyramid) return span;
    std::vector<PlaneRef>& sides = planes_[t].sides;
    for (std::size_t b = 0; b < TableChart::kBorders && sides.size() < TableChart::kBorders; ++b) {
      sides.push_back(space().add_grid_plane(chart.border(static_cast<TableChart::Border>(b))));
    }
    for (const PlaneRef side : sides) {
      if (!span.empty()) span = part_in_front(span, side);
    }
    return span;
  }

  PlaneRef border(std::size_t t, std::uint32_t k) {
    PlaneRef& own = planes_[t].borders[k];
    if (!own.valid()) {
      const AngularTable& table = tables_.tables()[t];
      own = space().add_grid_plane(table.mesh().chart().row(table.rows().border(k)));
    }
    return own;
  }
  /// A guess in doubles, confirmed by two signs, else bisection.
  std::uint32_t slice_of(std::size_t t, std::uint32_t column) {
    const TableRows& rows = tables_.tables()[t].rows();
    const auto is_above = [&](std::uint32_t k) {
      return k == 0 || (k < rows.count() && is_in_front(column, border(t, k)));
    };
    std::uint32_t low = 0, high = rows.count();
    const std::uint32_t guess = rows.guess(tables_.near(t).t(point_at(column)));
    if (is_above(guess)) {
      if (!is_above(guess + 1)) return guess;
      low = guess + 1;
    } else {
      if (is_above(guess - 1)) return guess - 1;
      high = guess - 1;
    }
    while (high - low > 1) {
      const std::uint32_t middle = low + (high - low) / 2;
      (is_above(middle) ? low : high) = middle;
    }
    return low;
  }

  /// The plane through the light and an edge, or where that crosses the row; in front where s is
  /// more.
  PlaneRef right_of(std::size_t t, std::uint32_t k, std::uint32_t edge) {
    const AngularTable& table = tables_.tables()[t];
    const bool is_exact = table.rows().is_exact();
    const std::uint64_t key = is_exact ? edge : std::uint64_t{k} << 32 | edge;
    PlaneRef& own = planes_[t].right_of[key];
    if (!own.valid()) own = is_exact ? plane_of(table, edge) : column_of(table, k, edge);
    return own;
  }
  PlaneRef column_of(const AngularTable& table, std::uint32_t k, std::uint32_t edge) {
    const RowOrder order(table.mesh(), table.rows().middle(k));
    return space().add_grid_plane(table.mesh().chart().column(order.exact(edge)));
  }
  PlaneRef plane_of(const AngularTable& table, std::uint32_t edge) {
    const TableEdge& own = table.mesh().edge(edge);
    if (own.is_border()) {
      const auto side = static_cast<TableChart::Border>(own.source - TableEdge::kBorder);
      const PlaneRef inside = space().add_grid_plane(table.mesh().chart().border(side));
      return side == TableChart::kLeft ? inside : -inside;
    }
    // In front on the left of what goes up, where s is less.
    const bool goes_up = table.rows().rank(own.from) < table.rows().rank(own.to);
    const PlaneRef left = scene_.shadow_plane_of(PlaneRef(own.source, own.flipped), light_);
    return goes_up ? -left : left;
  }

  Standing standing(std::uint32_t object) {
    Standing& own = standing_[std::uint64_t{at_.part} << 32 | object];
    if (own != Standing::kUnknown) return own;
    bool in_front = true, behind = true;
    for (const VertexId v : tables_.objects()[object].vertices) {
      const Side side = space().side_of_vertex(at_.on, v);
      in_front = in_front && side == Side::kFront;
      behind = behind && side != Side::kFront;
      if (!in_front && !behind) break;
    }
    own = in_front ? Standing::kInFront : behind ? Standing::kBehind : Standing::kAcross;
    return own;
  }

  void darken(Span span) {
    std::fill(lit_.begin() + span.begin, lit_.begin() + std::max(span.begin, span.end),
              std::uint8_t{0});
  }
  bool is_all_dark(Span span) const {
    return std::none_of(lit_.begin() + span.begin, lit_.begin() + span.end,
                        [](std::uint8_t lit) { return lit != 0; });
  }

  /// Calls use(interval) for each that may hold a sample of the span, until it returns false: back
  /// from the last that begins before one of them, while one before reaches them.
  template <class Use>
  void for_each_interval(std::size_t t, std::uint32_t k, const IntervalRows& rows, Span here,
                         const Use& use) {
    const std::span<const TableInterval> row = rows.row(k);
    const std::span<const std::uint32_t> reach = rows.reach(k);
    const std::uint32_t first = here.begin, last = here.end - 1;
    const auto begins_before = [&](const TableInterval& one) {
      const PlaneRef begin = right_of(t, k, one.begin);
      return is_in_front(first, begin) || is_in_front(last, begin);
    };
    const auto end = std::partition_point(row.begin(), row.end(), begins_before);
    for (auto i = static_cast<std::size_t>(end - row.begin()); i-- > 0;) {
      const PlaneRef farthest = right_of(t, k, row[reach[i]].end);
      if (is_in_front(first, farthest) && is_in_front(last, farthest)) return;
      if (!use(row[i])) return;
    }
  }
  Span part_in(std::size_t t, std::uint32_t k, const TableInterval& interval, Span span) {
    span = part_in_front(span, right_of(t, k, interval.begin));
    return span.empty() ? span : part_in_front(span, -right_of(t, k, interval.end));
  }

  void look_in_row(std::size_t t, std::uint32_t k, Span here) {
    const AngularTable& table = tables_.tables()[t];
    bool across = false;
    for_each_interval(t, k, table.spans(), here, [&](const TableInterval& span) {
      const Standing stands = standing(span.owner);
      across = across || stands == Standing::kAcross;
      if (stands != Standing::kInFront) return true;
      ++(*at_.work)[Counter::kSpanTests];
      darken(part_in(t, k, span, here));
      return !is_all_dark(here);
    });
    if (!across || is_all_dark(here)) return;
    for_each_interval(t, k, table.stretches(), here, [&](const TableInterval& stretch) {
      test_stretch(t, k, stretch, here);
      return !is_all_dark(here);
    });
  }

  void look_in_slab(std::size_t t, std::uint32_t k, Span here) {
    const AngularTable& table = tables_.tables()[t];
    found_.clear();
    table.crossings_in().find(k, found_);
    std::ranges::sort(found_);  // those of an object together
    bool across = false;
    for (std::size_t i = 0; i < found_.size();) {
      const std::uint32_t object = table.crossings()[found_[i]].object;
      const Standing stands = standing(object);
      across = across || stands == Standing::kAcross;
      sums_.assign(here.size(), 0);
      for (; i < found_.size() && table.crossings()[found_[i]].object == object; ++i) {
        if (stands != Standing::kInFront) continue;
        const RidgeCrossing& crossing = table.crossings()[found_[i]].crossing;
        ++(*at_.work)[Counter::kSpanTests];
        const Span right = part_in_front(here, right_of(t, k, crossing.edge));
        for (std::uint32_t c = right.begin; c < right.end; ++c) {
          sums_[c - here.begin] += crossing.sense;
        }
      }
      for (std::uint32_t c = here.begin; c < here.end; ++c) {
        if (sums_[c - here.begin] > 0) lit_[c] = 0;
      }
    }
    if (!across || is_all_dark(here)) return;
    found_.clear();
    table.stretches_in().find(k, found_);
    for (const std::uint32_t run : found_) {
      test_stretch(t, k, table.stretch_runs()[run], here);
      if (is_all_dark(here)) return;
    }
  }

  /// Darkens the samples that the stretch holds and that are beyond its face.
  void test_stretch(std::size_t t, std::uint32_t k, const TableInterval& stretch, Span here) {
    const std::uint32_t face = stretch.owner;
    if (face == at_.part || standing(tables_.object_of(face)) != Standing::kAcross) return;
    ++(*at_.work)[Counter::kStretchTests];
    if (task_.options.options.interpolation == Interpolation::kLinear && !tables_.is_sun()) {
      darken_by_ends(t, k, stretch, part_in(t, k, stretch, here));
      return;
    }
    const Span beyond = part_beyond(face, here);
    if (!beyond.empty()) darken(part_in(t, k, stretch, beyond));
  }
  Span part_beyond(std::uint32_t face, Span span) {
    const Part& part = scene_.scene().parts[face];
    if (task_.options.options.depth == TableDepth::kFacing) {
      const PlaneRef plane = scene_.facing_light(face, light_);
      // Coplanar polygons do not shadow each other.
      if (!plane.valid() || plane.same_plane(at_.on)) return {span.begin, span.begin};
      return part_in_front(span, -plane);
    }
    // The back of the face is towards the light: what is in front of it is beyond.
    const PlaneRef plane(part.plane, part.flipped);
    if (plane.same_plane(at_.on)) {
      return task_.rules.on_a_hidden_face_is_behind_it ? span : Span{span.begin, span.begin};
    }
    return part_in_front(span, plane);
  }
  /// By distances in doubles, linear in the angle between the two ends of the stretch. Of a sun
  /// planes are linear anyway.
  void darken_by_ends(std::size_t t, std::uint32_t k, const TableInterval& stretch, Span span) {
    const std::uint32_t face = stretch.owner;
    if (scene_.scene().parts[face].plane == at_.on.index()) {
      if (!part_beyond(face, span).empty()) darken(span);
      return;
    }
    const AngularTable& table = tables_.tables()[t];
    const NearChart& near = tables_.near(t);
    for (std::uint32_t c = span.begin; c < span.end; ++c) {
      const NearPoint x = point_at(c);
      const mpq_class row = table.rows().is_exact() ? mpq_class(near.t(x)) : table.rows().middle(k);
      const RowOrder order(table.mesh(), row);
      const double begin = order.near(stretch.begin).s, end = order.near(stretch.end).s;
      const double distance = linear_in_angle(
          begin, near.distance_of_plane(scene_.scene(), face, begin, row.get_d()), end,
          near.distance_of_plane(scene_.scene(), face, end, row.get_d()), near.s(x));
      if (near.distance(x) > distance) lit_[c] = 0;
    }
  }
  NearPoint point_at(std::uint32_t column) const {
    return near_point(scene_.scene(), task_.frame, at_.part, {column, at_.row});
  }

  ImageScene<Space>& scene_;
  const PixelTask& task_;
  const LightTables& tables_;
  std::size_t light_;
  std::vector<PlanesOf> planes_;                          // by tables
  std::unordered_map<std::uint64_t, Standing> standing_;  // by part and object
  std::vector<std::uint8_t> lit_;                         // of the samples of a span
  std::vector<std::uint32_t> found_;
  std::vector<std::int32_t> sums_;
  Place at_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_TABLE_LOOK_UP_H
