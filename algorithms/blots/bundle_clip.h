// SPDX-License-Identifier: LGPL-3.0-or-later
// A sub-object as seen from the light, or a convex piece of one: the pieces of its faces, which
// tile it, and the planes that cut it out. Cutting the faces and the outline is one step, so that
// what is lit of a sub-object has its partial outline with it (Crow 1977: "partial silhouettes are
// then computed based only on the unshadowed portion").
//
// Guarantee on exact kernels: the bundles that a cut makes tile the one before, each is convex, and
// nothing is cut in vain: if no area is inside all planes, the bundle stays whole.
#ifndef GNOMON_ALGORITHMS_BLOTS_BUNDLE_CLIP_H
#define GNOMON_ALGORITHMS_BLOTS_BUNDLE_CLIP_H

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/cone_clip.h"
#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/split.h"
#include "algorithms/two_pass/list_clipping.h"

namespace gnomon {

/// Ranges of a BundleStore.
struct Bundle {
  std::uint32_t first_face = 0, face_count = 0;
  std::uint32_t first_cut = 0, cut_count = 0;
  bool located = false;  // its box is its own, and not that of the sub-object
  ChartBox box = {};
};

/// The bundles of one sub-object.
struct BundleStore {
  std::vector<ListPiece> faces;
  /// Of bundles of several faces, the planes that have cut them, inside in front: which of its
  /// edges are borders is then not told by one loop.
  std::vector<PlaneRef> cuts;

  void clear() {
    faces.clear();
    cuts.clear();
  }
  std::span<const ListPiece> faces_of(const Bundle& bundle) const {
    return {faces.data() + bundle.first_face, bundle.face_count};
  }
  std::span<const PlaneRef> cuts_of(const Bundle& bundle) const {
    return {cuts.data() + bundle.first_cut, bundle.cut_count};
  }
};

template <DecisionSpace Space>
class BundleClip {
 public:
  using Vertex = typename Space::Vertex;

  /// Cuts a bundle of `store` by the planes of a cone. The pieces of faces are appended to `loops`,
  /// where the faces are, too. `plane_of(face)`: the support plane of a face.
  template <class PlaneOf>
  ConePlace clip(Space& space, std::span<const PlaneRef> planes, const Bundle& bundle,
                 const PlaneOf& plane_of, LoopStore<Vertex>& loops, BundleStore& store) {
    outside_.clear();
    inside_ = bundle;
    return bundle.face_count == 1 ? clip_loop(space, planes, plane_of, loops, store)
                                  : clip_faces(space, planes, plane_of, loops, store);
  }
  /// Of the last bundle that was inside or cut; without faces: vanished (rounded kernels).
  const Bundle& inside() const { return inside_; }
  std::span<const Bundle> outside() const { return outside_; }

  /// Whether a loop is inside of all planes.
  bool is_inside(Space& space, std::span<const PlaneRef> planes, const LoopView<Vertex>& loop) {
    for (const PlaneRef plane : planes) {
      if (record_.decide(space, plane, loop) != Placement::kFront) return false;
    }
    return true;
  }
  std::uint64_t cuts() const { return loop_clip_.cuts() + cuts_; }
  std::uint64_t take_vanished() { return loop_clip_.take_vanished() + std::exchange(vanished_, 0); }

 private:
  template <class PlaneOf>
  ConePlace clip_loop(Space& space, std::span<const PlaneRef> planes, const PlaneOf& plane_of,
                      LoopStore<Vertex>& loops, BundleStore& store) {
    const ListPiece face = store.faces[inside_.first_face];
    const ConePlace place = loop_clip_.clip(space, planes, face.loop, plane_of(face), loops);
    if (place != ConePlace::kCut) return place;
    const auto put = [&](const LoopRange& loop) {
      Bundle bundle{static_cast<std::uint32_t>(store.faces.size()), 1};
      store.faces.push_back(face);
      store.faces.back().loop = loop;
      return bundle;
    };
    for (const LoopRange& rest : loop_clip_.outside()) outside_.push_back(put(rest));
    inside_ = loop_clip_.inside().count < 3 ? Bundle{} : put(loop_clip_.inside());
    return place;
  }

  template <class PlaneOf>
  ConePlace clip_faces(Space& space, std::span<const PlaneRef> planes, const PlaneOf& plane_of,
                       LoopStore<Vertex>& loops, BundleStore& store) {
    const auto placement = [&](PlaneRef plane, const ListPiece& face) {
      return record_.decide(space, plane, loops.view(face.loop, plane_of(face)));
    };
    spanning_.clear();
    for (const PlaneRef plane : planes) {
      bool front = false, back = false;
      for (const ListPiece& face : store.faces_of(inside_)) {
        const Placement place = placement(plane, face);
        front |= place == Placement::kFront || place == Placement::kSpanning;
        back |= place == Placement::kBack || place == Placement::kSpanning;
      }
      if (!front) return ConePlace::kOutside;
      if (back) spanning_.push_back(plane);
    }
    if (spanning_.empty()) return ConePlace::kInside;
    const std::uint32_t loops_mark = loops.size();
    const std::size_t faces_mark = store.faces.size(), cuts_mark = store.cuts.size();
    for (const PlaneRef plane : spanning_) {
      front_.clear();
      back_.clear();
      for (std::uint32_t i = 0; i < inside_.face_count; ++i) {
        const ListPiece face = store.faces[inside_.first_face + i];
        switch (placement(plane, face)) {
          case Placement::kFront:
            front_.push_back(face);
            break;
          case Placement::kBack:
          case Placement::kOn:
            back_.push_back(face);
            break;
          case Placement::kSpanning:
            split(space, plane, face, plane_of(face), loops);
            break;
        }
      }
      if (front_.empty()) {  // some of the bundle is inside each plane, none inside all
        loops.truncate(loops_mark);
        store.faces.resize(faces_mark);
        store.cuts.resize(cuts_mark);
        outside_.clear();
        return ConePlace::kOutside;
      }
      if (back_.empty()) continue;
      outside_.push_back(put(back_, -plane, store));
      inside_ = put(front_, plane, store);
    }
    return outside_.empty() ? ConePlace::kInside : ConePlace::kCut;
  }

  void split(Space& space, PlaneRef plane, const ListPiece& face, PlaneId support,
             LoopStore<Vertex>& loops) {
    ++cuts_;
    loops.reserve_more(2 * std::size_t{face.loop.count} + 4);
    const SplitChildren children =
        make_children(space, plane, loops.view(face.loop, support), record_, crossings_, loops);
    const auto put_child = [&](const LoopRange& loop, std::vector<ListPiece>& list) {
      if (loop.count < 3) {
        ++vanished_;
        return;
      }
      list.push_back(face);
      list.back().loop = loop;
    };
    put_child(children.back, back_);
    put_child(children.front, front_);
  }

  /// A bundle with the cuts of inside_ and one more.
  Bundle put(std::span<const ListPiece> faces, PlaneRef cut, BundleStore& store) {
    Bundle bundle{static_cast<std::uint32_t>(store.faces.size()),
                  static_cast<std::uint32_t>(faces.size()),
                  static_cast<std::uint32_t>(store.cuts.size()), inside_.cut_count + 1};
    store.faces.insert(store.faces.end(), faces.begin(), faces.end());
    for (std::uint32_t i = 0; i < inside_.cut_count; ++i) {
      const PlaneRef before = store.cuts[inside_.first_cut + i];
      store.cuts.push_back(before);
    }
    store.cuts.push_back(cut);
    return bundle;
  }

  ConeClip<Space> loop_clip_;
  Bundle inside_;
  std::vector<Bundle> outside_;
  std::vector<PlaneRef> spanning_;
  std::vector<ListPiece> front_, back_;
  SplitRecord record_;
  std::vector<Vertex> crossings_;
  std::uint64_t cuts_ = 0, vanished_ = 0;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_BLOTS_BUNDLE_CLIP_H
