// SPDX-License-Identifier: LGPL-3.0-or-later
#include "algorithms/run/canonical_order.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace gnomon {
namespace {

/// Calls f for the vertices of a part, from `start` on; stops where f returns false.
template <class F>
bool for_loop(const PreparedScene& scene, const Part& part, std::uint32_t start, const F& f) {
  const auto loop = scene.loop(part);
  for (std::uint32_t k = 0; k < part.count; ++k) {
    const std::uint32_t at = start + k;
    if (!f(k, loop[at < part.count ? at : at - part.count])) return false;
  }
  return true;
}

/// An area light is the same from whichever corner its loop starts.
void start_at_smallest(std::vector<std::array<mpz_class, 3>>& loop) {
  std::ranges::rotate(loop, std::ranges::min_element(loop));
}

}  // namespace

CanonicalOrder::CanonicalOrder(const PreparedScene& scene, bool keep_order) : scene_(scene) {
  starts_.resize(scene.parts.size());
  for (std::size_t i = 0; i < scene.parts.size(); ++i) {
    const auto loop = scene.loop(scene.parts[i]);
    starts_[i] = static_cast<std::uint32_t>(std::ranges::min_element(loop) - loop.begin());
    changed_ = changed_ || starts_[i] != 0;
  }
  polygons_.resize(scene.first_part.empty() ? 0 : scene.first_part.size() - 1);
  std::iota(polygons_.begin(), polygons_.end(), 0u);
  if (!keep_order) sort_polygons();
  changed_ = changed_ || std::ranges::any_of(scene.lights, [](const PreparedLight& light) {
               return light.has_area() &&
                      std::ranges::min_element(light.area_loop) != light.area_loop.begin();
             });
  if (changed_) copy();
}

/// By the loops of their parts, one after the other; of equal ones, by what is said of them.
void CanonicalOrder::sort_polygons() {
  const auto order_of_parts = [&](std::uint32_t a, std::uint32_t b) {
    const Part &p = scene_.parts[a], &q = scene_.parts[b];
    int order = p.count < q.count ? -1 : p.count > q.count ? 1 : 0;
    const auto loop = scene_.loop(q);
    for_loop(scene_, p, starts_[a], [&](std::uint32_t k, VertexId vertex) {
      if (k >= q.count) return false;
      const std::uint32_t at = starts_[b] + k;
      const VertexId other = loop[at < q.count ? at : at - q.count];
      if (vertex == other) return true;
      order = vertex < other ? -1 : 1;
      return false;
    });
    if (order != 0) return order;
    const auto said = [](const Part& part) { return std::pair(part.two_sided, part.casts); };
    return said(p) < said(q) ? -1 : said(q) < said(p) ? 1 : 0;
  };
  const auto before = [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t a_end = scene_.first_part[a + 1], b_end = scene_.first_part[b + 1];
    std::uint32_t i = scene_.first_part[a], j = scene_.first_part[b];
    for (; i < a_end && j < b_end; ++i, ++j) {
      if (const int order = order_of_parts(i, j); order != 0) return order < 0;
    }
    return i == a_end && j < b_end;
  };
  if (std::ranges::is_sorted(polygons_, before)) return;
  std::ranges::stable_sort(polygons_, before);
  changed_ = true;
}

void CanonicalOrder::copy() {
  copy_.geometry = scene_.geometry;
  copy_.lights = scene_.lights;
  copy_.vertex_of_input = scene_.vertex_of_input;
  copy_.position_bits = scene_.position_bits;
  copy_.direction_bits = scene_.direction_bits;
  for (PreparedLight& light : copy_.lights) {
    if (light.has_area()) start_at_smallest(light.area_loop);
  }
  copy_.loop_vertices.reserve(scene_.loop_vertices.size());
  copy_.loop_edges.reserve(scene_.loop_edges.size());
  copy_.parts.reserve(scene_.parts.size());
  copy_.first_part.reserve(scene_.first_part.size());
  parts_.reserve(scene_.parts.size());
  for (const std::uint32_t polygon : polygons_) add_polygon(polygon);
  copy_.first_part.push_back(static_cast<std::uint32_t>(copy_.parts.size()));
}

void CanonicalOrder::add_polygon(std::uint32_t polygon) {
  const auto index = static_cast<std::uint32_t>(copy_.first_part.size());
  copy_.first_part.push_back(static_cast<std::uint32_t>(copy_.parts.size()));
  for (std::uint32_t i = scene_.first_part[polygon]; i < scene_.first_part[polygon + 1]; ++i) {
    const Part& part = scene_.parts[i];
    parts_.push_back(i);
    copy_.parts.push_back(part);
    copy_.parts.back().polygon = index;
    copy_.parts.back().first = static_cast<std::uint32_t>(copy_.loop_vertices.size());
    const auto add_from_start = [&](const auto& loop, auto& to) {
      const auto start = loop.begin() + starts_[i];
      to.insert(to.end(), start, loop.end());
      to.insert(to.end(), loop.begin(), start);
    };
    add_from_start(scene_.loop(part), copy_.loop_vertices);
    add_from_start(scene_.edges(part), copy_.loop_edges);
  }
}

void CanonicalOrder::restore(LightResult& light) const {
  if (!changed_) return;
  for (PartResult& part : light.parts) part.part = parts_[part.part];
  std::vector<std::size_t> order(light.parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return light.parts[i].part; });
  const auto permute = [&](auto& items) {
    if (items.empty()) return;
    std::decay_t<decltype(items)> sorted;
    sorted.reserve(items.size());
    for (const std::size_t i : order) sorted.push_back(std::move(items[i]));
    items = std::move(sorted);
  };
  permute(light.parts);
  permute(light.area_fractions);
  permute(light.exact_fractions);
  std::vector<Fragment> fragments;
  fragments.reserve(light.fragments.size());
  for (PartResult& part : light.parts) {
    const auto from = light.fragments.begin() + part.first_fragment;
    part.first_fragment = static_cast<std::uint32_t>(fragments.size());
    fragments.insert(fragments.end(), from, from + part.fragment_count);
  }
  for (Fragment& fragment : fragments) {
    if (fragment.caster != Fragment::kNoCaster) fragment.caster = parts_[fragment.caster];
  }
  light.fragments = std::move(fragments);
  for (std::vector<std::uint32_t>& casters : light.caster_sets) {
    for (std::uint32_t& caster : casters) caster = parts_[caster];
  }
}

void CanonicalOrder::restore(ShadowResult& result) const {
  if (!changed_) return;
  for (LightResult& light : result.lights) restore(light);
  for (CombinedFragment& fragment : result.combined) fragment.part = parts_[fragment.part];
  std::ranges::stable_sort(result.combined, {}, [&](const CombinedFragment& fragment) {
    return std::pair(scene_.parts[fragment.part].polygon, -static_cast<int>(fragment.side));
  });
  for (PaintedPolygon& painted : result.overlay) painted.part = parts_[painted.part];
  std::vector<std::uint32_t> order(result.overlay.size()), place(result.overlay.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) {
    const PaintedPolygon& painted = result.overlay[i];
    return std::tuple(scene_.parts[painted.part].polygon, -static_cast<int>(painted.side),
                      painted.level);
  });
  for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
  std::vector<PaintedPolygon> overlay;
  overlay.reserve(order.size());
  for (const std::uint32_t i : order) {
    overlay.push_back(result.overlay[i]);
    std::uint32_t& owner = overlay.back().on;
    if (owner != PaintedPolygon::kNoOwner) owner = place[owner];
  }
  result.overlay = std::move(overlay);
}

}  // namespace gnomon
