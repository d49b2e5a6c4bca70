// SPDX-License-Identifier: LGPL-3.0-or-later
// Shadow volumes one after another, front to back (Slater 1992, sec. 3): the cones of the pieces
// that cast, each a piece and the planes through its edges and the light. A target meets some of
// them and loses what is inside.
//
// No support planes are needed: nothing inserted earlier is behind a target, except pieces of its
// own plane, which are inserted only when all of their plane have been targets.
#ifndef GNOMON_ALGORITHMS_BASIC_VOLUME_LIST_H
#define GNOMON_ALGORITHMS_BASIC_VOLUME_LIST_H

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/lights/light_scene.h"
#include "algorithms/partition/classified_loop.h"
#include "algorithms/partition/cone_clip.h"
#include "algorithms/partition/fragment_stays.h"

namespace gnomon {

using VolumeId = std::uint32_t;  // volumes are numbered as they are inserted

template <LightSpaceModel Space>
class VolumeList {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  explicit VolumeList(LightScene<Space>& light) : light_(light) {}

  VolumeId size() const { return static_cast<VolumeId>(volumes_.size()); }
  bool is_alive(VolumeId id) const { return volumes_[id].alive; }
  void kill(VolumeId id) { volumes_[id].alive = false; }
  std::uint32_t caster(VolumeId id) const { return volumes_[id].loop.part; }
  Loop loop(VolumeId id) const { return view(volumes_[id].loop, loops_); }

  /// The volume of a piece; a kernel without identity makes the planes of its edges.
  VolumeId add(const Loop& piece) {
    volumes_.push_back({light_.with_edge_planes(loops_.append(piece), loops_), true});
    return size() - 1;
  }

  /// Whether all vertices of a loop are inside or on all planes of the volume.
  bool holds(VolumeId id, const Loop& loop) { return place(id, loop) == ConePlace::kInside; }
  /// kOutside if one plane alone has all of the loop outside. kCut says that some of it is inside
  /// each plane; of all planes together it tells nothing.
  ConePlace place(VolumeId id, const Loop& loop) {
    ConePlace result = ConePlace::kInside;
    for (const PlaneRef plane : this->loop(id).edges) {
      switch (record_.decide(light_.space, plane, loop)) {
        case Placement::kFront:
          break;
        case Placement::kSpanning:
          result = ConePlace::kCut;
          break;
        case Placement::kBack:
        case Placement::kOn:
          return ConePlace::kOutside;
      }
    }
    return result;
  }

  /// Puts out what of `target` is inside each of the volumes, one loop a volume, whatever they have
  /// in common (the paper's shadow polygons). Returns how many there are.
  template <class Visit>
  std::uint64_t paint(const Loop& target, std::span<const VolumeId> volumes, const Visit& visit) {
    std::uint64_t count = 0;
    for (const VolumeId id : volumes) {
      work_.clear();
      const ConePlace placed =
          clip_.clip(light_.space, loop(id).edges, work_.append(target), target.support, work_);
      if (placed == ConePlace::kOutside || clip_.inside().count < 3) continue;
      const Loop inside = work_.view(clip_.inside(), target.support);
      if (!fragment_stays(light_.space, inside, light_.rules)) continue;
      visit(id, inside);
      ++count;
    }
    return count;
  }

  /// Cuts `target` into what is inside the first volume that holds it, for each of its points, and
  /// what is inside none. Returns how many of the volumes got something.
  std::uint64_t subtract(const Loop& target, std::span<const VolumeId> volumes,
                         ClassifiedLoops<Vertex>& output) {
    work_.clear();
    lit_.assign(1, work_.append(target));
    std::uint64_t useful = 0;
    for (const VolumeId id : volumes) {
      still_lit_.clear();
      bool any = false;
      for (const LoopRange& piece : lit_) {
        const ConePlace placed =
            clip_.clip(light_.space, loop(id).edges, piece, target.support, work_);
        if (placed == ConePlace::kOutside) {
          still_lit_.push_back(piece);
          continue;
        }
        any = true;
        if (placed == ConePlace::kCut) {
          still_lit_.insert(still_lit_.end(), clip_.outside().begin(), clip_.outside().end());
        }
        put_out(clip_.inside(), target.support, LightState::kShadow, caster(id), output);
      }
      if (any) ++useful;
      lit_.swap(still_lit_);
      if (lit_.empty()) break;
    }
    for (const LoopRange& piece : lit_) {
      put_out(piece, target.support, LightState::kLit, Fragment::kNoCaster, output);
    }
    return useful;
  }

  std::uint64_t cuts() const { return clip_.cuts(); }
  std::uint64_t take_vanished() { return clip_.take_vanished(); }

 private:
  struct Volume {
    LoopRange loop;  // in loops_; its edges are the volume's planes
    bool alive = true;
  };
  Loop view(const LoopRange& range, const LoopStore<Vertex>& store) const {
    return store.view(range, light_.plane_of(range.part));
  }
  void put_out(const LoopRange& piece, PlaneId support, LightState state, std::uint32_t caster,
               ClassifiedLoops<Vertex>& output) {
    if (piece.count < 3) return;
    const Loop loop = work_.view(piece, support);
    if (fragment_stays(light_.space, loop, light_.rules)) output.add(loop, state, caster);
  }

  LightScene<Space>& light_;
  LoopStore<Vertex> loops_;
  std::vector<Volume> volumes_;
  // Workspace, kept to save allocations.
  SplitRecord record_;
  ConeClip<Space> clip_;
  LoopStore<Vertex> work_;
  std::vector<LoopRange> lit_, still_lit_;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_BASIC_VOLUME_LIST_H
