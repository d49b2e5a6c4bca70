// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/shrink/structure_steps.h"

#include <algorithm>
#include <utility>

#include "fuzz/scene/scene_steps.h"

namespace gnomon::fuzz {

namespace {

/// Delta debugging: halves first, then ever smaller chunks, from the end. `without(begin, end)`
/// is the best scene without these items; `count()` how many it has now.
template <class Count, class Without>
void drop_in_chunks(SmallestScene& search, const Count& count, const Without& without) {
  for (std::size_t chunk = (count() + 1) / 2; chunk > 0; chunk = chunk == 1 ? 0 : (chunk + 1) / 2) {
    for (std::size_t end = count(); end > 0 && !search.stopped();) {
      const std::size_t begin = end > chunk ? end - chunk : 0;
      search.attempt_tidy(without(begin, end));
      end = std::min(begin, count());
    }
  }
}

/// `loop_of(scene)` is one loop of the scene.
template <class LoopOf>
void drop_corners_of(SmallestScene& search, const LoopOf& loop_of) {
  constexpr std::size_t kFewest = 3;
  drop_in_chunks(
      search, [&] { return loop_of(search.best()).size(); },
      [&](std::size_t begin, std::size_t end) {
        Scene scene = search.best();
        auto& loop = loop_of(scene);
        if (loop.size() >= kFewest + (end - begin)) {
          loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(begin),
                     loop.begin() + static_cast<std::ptrdiff_t>(end));
        }
        return scene;
      });
}

}  // namespace

void undo_moves(SmallestScene& search) {
  for (const Scene& simpler : search.options().simpler) {
    if (search.attempt(simpler, true)) return;
  }
}

void tidy_up(SmallestScene& search) {
  search.attempt(tidied(search.best()));
  search.attempt(without_unused_vertices(search.best()));
}

void drop_polygons(SmallestScene& search) {
  drop_in_chunks(
      search, [&] { return search.best().polygons.size(); },
      [&](std::size_t begin, std::size_t end) {
        Scene scene = search.best();
        scene.polygons.erase(scene.polygons.begin() + static_cast<std::ptrdiff_t>(begin),
                             scene.polygons.begin() + static_cast<std::ptrdiff_t>(end));
        return scene;
      });
}

void drop_lights(SmallestScene& search) {
  // Most failures need one light.
  for (std::size_t i = 0; search.best().lights.size() > 1 && i < search.best().lights.size(); ++i) {
    Scene scene = search.best();
    scene.lights = {search.best().lights[i]};
    if (search.attempt(std::move(scene))) break;
  }
  for (std::size_t i = search.best().lights.size(); i-- > 0;) {
    Scene scene = search.best();
    scene.lights.erase(scene.lights.begin() + static_cast<std::ptrdiff_t>(i));
    search.attempt(std::move(scene));
  }
}

void drop_holes(SmallestScene& search) {
  for (std::size_t p = 0; p < search.best().polygons.size(); ++p) {
    for (std::size_t h = search.best().polygons[p].holes.size(); h-- > 0;) {
      Scene scene = search.best();
      auto& holes = scene.polygons[p].holes;
      holes.erase(holes.begin() + static_cast<std::ptrdiff_t>(h));
      search.attempt_tidy(std::move(scene));
    }
  }
}

void drop_corners(SmallestScene& search) {
  for (std::size_t p = 0; p < search.best().polygons.size(); ++p) {
    drop_corners_of(
        search, [p](auto& scene) -> auto& { return scene.polygons[p].loop; });
    for (std::size_t h = 0; h < search.best().polygons[p].holes.size(); ++h) {
      drop_corners_of(
          search, [ p, h ](auto& scene) -> auto& { return scene.polygons[p].holes[h]; });
    }
  }
  for (std::size_t i = 0; i < search.best().lights.size(); ++i) {
    if (!search.best().lights[i].has_area()) continue;
    drop_corners_of(
        search, [i](auto& scene) -> auto& { return scene.lights[i].loop; });
  }
}

void reset_flags(SmallestScene& search) {
  if (flags_of(search.best()) == 0) return;
  search.attempt(with_default_flags(search.best()));
  const std::size_t count = flag_steps(search.best());
  for (std::size_t i = 0; i < count; ++i) search.attempt(with_flag_step(search.best(), i));
}

void join_vertices(SmallestScene& search) {
  for (std::size_t from = search.best().vertices.size(); from-- > 0 && !search.stopped();) {
    for (std::size_t to = 0; to < search.best().vertices.size(); ++to) {
      if (from == to || from >= search.best().vertices.size()) continue;
      if (search.attempt(without_unused_vertices(with_joined_vertices(
              search.best(), static_cast<VertexId>(from), static_cast<VertexId>(to))))) {
        break;
      }
    }
  }
}

}  // namespace gnomon::fuzz
