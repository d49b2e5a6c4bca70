// SPDX-License-Identifier: LGPL-3.0-or-later
// One receiver cut by the shadow volumes that reach it: the pairwise idea of Nishita & Nakamae
// (Continuous tone representation of three-dimensional objects taking account of shadows and
// interreflection, 1985), with a tree of cells per receiver instead of one of all volumes.
//
// A cell is a convex piece of the receiver with the volumes that cross it. Volumes that miss a cell
// leave it, an umbra that holds it decides it, a penumbra that holds it makes it penumbra whatever
// else is there. A cell with many volumes is halved by a plane across an axis; in one with few the
// volumes are cut out one after another. Sibling cells that come to the same end are one fragment
// again. No order of casters matters to the classes; it does to the fragments and witnesses, and it
// is the same on any number of threads.
//
// Guarantee on exact kernels: the fragments tile the loop; each has the class of the definition
// (docs: semantics) and a witness. Penumbra volumes are open and umbra volumes closed: a receiver
// in a plane of a penumbra is outside of it, one in a plane of an umbra may be inside. Explicit
// stack; memory: the loops of the cells on it.
#ifndef GNOMON_ALGORITHMS_SHADOW_VOLUMES_RECEIVER_CUTTER_H
#define GNOMON_ALGORITHMS_SHADOW_VOLUMES_RECEIVER_CUTTER_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/piece_class.h"
#include "algorithms/partition/rules.h"
#include "algorithms/partition/split.h"
#include "algorithms/shadow_volumes/shadow_volume.h"
#include "gnomon/algorithms/shadow_result.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// A volume that may reach a receiver.
struct VolumeToCut {
  std::uint32_t volume = 0;  // index into a VolumeStore
  bool umbra = true;         // false: its umbra certainly does not
};

template <VolumeSpaceModel Space>
class ReceiverCutter {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;

  explicit ReceiverCutter(Space& space, const Rules& rules = {})
      : space_(&space),
        penumbra_border_(rules.on_goes_to_its_own_side ? Border::kOpen : Border::kClosed),
        umbra_border_(rules.on_goes_to_its_own_side ? Border::kClosed : Border::kOpen) {}

  Space& space() { return *space_; }
  std::uint64_t cells() const { return cells_; }
  std::uint64_t vanished() const { return vanished_; }

  /// Whether what lies in a plane of a volume is in the volume: not in a penumbra, where light is
  /// hidden from nothing on its border, but in an umbra, on whose border all of it is.
  enum class Border : std::uint8_t { kOpen, kClosed };

  /// Is nothing of the loop in front of a plane of a penumbra?
  bool is_outside(const Loop& loop, PlaneRef plane) {
    return is_outside(loop, plane, penumbra_border_);
  }
  /// Is all of it in front of all planes?
  bool is_inside(const Loop& loop, std::span<const PlaneRef> planes) {
    std::uint8_t hint = 0;
    return relation(loop, planes, penumbra_border_, hint) == Relation::kInside;
  }

  /// Is some area of it in front of all planes of a penumbra, or of an umbra?
  bool has_inside(const Loop& loop, std::span<const PlaneRef> planes, bool is_umbra) {
    support_ = loop.support;
    store_.clear();
    std::uint8_t hint = 0;
    LoopRange inside;
    const LoopRange whole = store_.append(loop);
    return clip(whole, planes, is_umbra ? umbra_border_ : penumbra_border_, hint, inside);
  }

  /// Cuts `loop` by volumes of `store` and calls emit(PieceClass, Loop) for each
  /// fragment. `in_shadow`: what is in an umbra volume (kUmbra, or kShadow of a point). Planes
  /// added to the space stay until the caller releases them. `emit` returns false to stop.
  template <class Emit>
  bool cut(const Loop& loop, const VolumeStore& store, std::span<const VolumeToCut> volumes,
           LightState in_shadow, const Emit& emit);

 private:
  /// Cells with more volumes are halved if that helps.
  static constexpr std::uint32_t kLeaf = 16;
  static constexpr int kDeepest = 48, kMostInVain = 8;

  struct Entry {
    std::uint32_t volume = 0;
    bool penumbra = true, umbra = true;  // still to be cut by
    // The planes that last had a piece outside of the two: most likely to have the next one there.
    std::uint8_t penumbra_hint = 0, umbra_hint = 0;
  };
  struct Frame {
    LoopRange loop;
    std::uint32_t begin = 0, end = 0;  // entries_
    PieceClass state;                  // lit, or penumbra of a volume that holds the cell
    int depth = 0, in_vain = 0;
    std::uint32_t before = 0;  // entries of the parent
    std::uint32_t mark = 0;    // of store_, when the cell was entered
    int stage = 0;             // 0: new; 1: front child running; 2: back child running
    LoopRange front, back;
    std::uint32_t own_end = 0;  // entries_ end of the cell's own, children's follow
    bool front_uniform = false;
    PieceClass front_class;
  };
  struct Piece {
    LoopRange loop;
    PieceClass state;
    std::uint32_t next = 0;  // entry to be cut by next
  };
  enum class Relation : std::uint8_t { kOutside, kInside, kCrossing };

  Loop view(const LoopRange& range) const { return store_.view(range, support_); }
  /// Is nothing of the loop in front of the plane, nor, if that counts, the loop in it?
  bool is_outside(const Loop& loop, PlaneRef plane, Border border);
  Relation relation(const Loop& loop, std::span<const PlaneRef> planes, Border border,
                    std::uint8_t& hint);
  bool clip(const LoopRange& loop, std::span<const PlaneRef> planes, Border border,
            std::uint8_t& hint, LoopRange& inside);
  bool decide(Frame& frame);
  bool halve(Frame& frame);
  void cut_out(const Frame& frame);

  Space* space_;
  Border penumbra_border_, umbra_border_;
  const VolumeStore* volumes_ = nullptr;
  LightState in_shadow_ = LightState::kUmbra;
  PlaneId support_ = 0;
  LoopStore<Vertex> store_;
  std::vector<Entry> entries_;
  std::vector<Frame> frames_;
  std::vector<Piece> pending_, pieces_;
  std::vector<LoopRange> outside_;
  std::vector<PlaneRef> spanning_;
  std::vector<Vertex> crossings_;
  SplitRecord record_;
  std::uint64_t cells_ = 0, vanished_ = 0;
};

template <VolumeSpaceModel Space>
bool ReceiverCutter<Space>::is_outside(const Loop& loop, PlaneRef plane, Border border) {
  bool in_plane = true;
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const Side side = space_->side_of_plane(plane, loop.corner(i));
    if (side == Side::kFront) return false;
    in_plane = in_plane && side == Side::kOn;
  }
  return !in_plane || border == Border::kOpen;
}

/// The planes that the loop spans are left in spanning_.
template <VolumeSpaceModel Space>
typename ReceiverCutter<Space>::Relation ReceiverCutter<Space>::relation(
    const Loop& loop, std::span<const PlaneRef> planes, Border border, std::uint8_t& hint) {
  if (is_outside(loop, planes[hint], border)) return Relation::kOutside;
  spanning_.clear();
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Placement placement = record_.decide(*space_, planes[i], loop);
    if (placement == Placement::kSpanning) {
      spanning_.push_back(planes[i]);
    } else if (placement == Placement::kBack ||
               (placement == Placement::kOn && border == Border::kOpen)) {
      hint = static_cast<std::uint8_t>(i);
      return Relation::kOutside;
    }
  }
  return spanning_.empty() ? Relation::kInside : Relation::kCrossing;
}

/// Cuts away what is outside of one of the planes: pieces into outside_, what is left into
/// `inside`. False if nothing is left; the loop is then not cut at all.
template <VolumeSpaceModel Space>
bool ReceiverCutter<Space>::clip(const LoopRange& loop, std::span<const PlaneRef> planes,
                                 Border border, std::uint8_t& hint, LoopRange& inside) {
  outside_.clear();
  if (relation(view(loop), planes, border, hint) == Relation::kOutside) return false;
  const std::uint32_t mark = store_.size();
  inside = loop;
  for (std::size_t i = 0; i < spanning_.size(); ++i) {
    const PlaneRef plane = spanning_[i];
    const Placement placement = record_.decide(*space_, plane, view(inside));
    if (placement == Placement::kFront) continue;
    if (placement != Placement::kSpanning) {
      store_.truncate(mark);
      outside_.clear();
      return false;
    }
    store_.reserve_more(2 * std::size_t{inside.count} + 4);
    const SplitChildren children =
        make_children(*space_, plane, view(inside), record_, crossings_, store_);
    if (children.back.count >= 3) {
      outside_.push_back(children.back);
    } else {
      ++vanished_;
    }
    if (children.front.count < 3) {
      ++vanished_;
      store_.truncate(mark);
      outside_.clear();
      return false;
    }
    inside = children.front;
  }
  return true;
}

/// Drops the volumes that miss the cell. True if the whole cell has one class.
template <VolumeSpaceModel Space>
bool ReceiverCutter<Space>::decide(Frame& frame) {
  const Loop loop = view(frame.loop);
  std::uint32_t kept = frame.begin;
  for (std::uint32_t i = frame.begin; i < frame.end; ++i) {
    Entry entry = entries_[i];
    const ShadowVolume& volume = (*volumes_)[entry.volume];
    if (frame.state.state != LightState::kLit || volume.penumbra_count == 0) {
      entry.penumbra = false;
    } else if (entry.penumbra) {
      const Relation penumbra =
          relation(loop, volumes_->penumbra(volume), penumbra_border_, entry.penumbra_hint);
      if (penumbra == Relation::kOutside) continue;
      if (penumbra == Relation::kInside) {
        frame.state = {LightState::kPenumbra, volume.caster, ShadowReason::kNone};
        entry.penumbra = false;
      }
    }
    if (entry.umbra) {
      const Relation umbra = volume.umbra_count == 0 ? Relation::kOutside
                                                     : relation(loop, volumes_->umbra(volume),
                                                                umbra_border_, entry.umbra_hint);
      if (umbra == Relation::kInside) {
        frame.state = {in_shadow_, volume.caster, ShadowReason::kNone};
        return true;
      }
      entry.umbra = umbra == Relation::kCrossing;
    }
    if (entry.penumbra || entry.umbra) entries_[kept++] = entry;
  }
  if (frame.state.state != LightState::kLit) {
    const auto begin = entries_.begin() + frame.begin;
    kept = frame.begin + static_cast<std::uint32_t>(
                             std::stable_partition(begin, entries_.begin() + kept,
                                                   [](const Entry& e) { return e.umbra; }) -
                             begin);
  }
  frame.end = kept;
  return frame.begin == frame.end;
}

/// Halves the cell across the longest axis of its box. False if it is too narrow.
template <VolumeSpaceModel Space>
bool ReceiverCutter<Space>::halve(Frame& frame) {
  const Loop loop = view(frame.loop);
  std::array<double, 3> low{}, high{};
  for (std::uint32_t i = 0; i < loop.size(); ++i) {
    const std::array<Ball, 3> point = space_->position(loop.corner(i));
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = point[k].middle;
      low[k] = i == 0 || x < low[k] ? x : low[k];
      high[k] = i == 0 || x > high[k] ? x : high[k];
    }
  }
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  }
  const double middle = low[axis] + (high[axis] - low[axis]) / 2;
  if (!(middle > low[axis]) || !(middle < high[axis])) return false;
  const PlaneRef plane = space_->add_axis_plane(static_cast<int>(axis), middle);
  if (!plane.valid() || record_.decide(*space_, plane, loop) != Placement::kSpanning) return false;
  store_.reserve_more(2 * std::size_t{loop.size()} + 4);
  const SplitChildren children =
      make_children(*space_, plane, view(frame.loop), record_, crossings_, store_);
  if (children.front.count < 3 || children.back.count < 3) {
    ++vanished_;
    return false;
  }
  frame.front = children.front;
  frame.back = children.back;
  return true;
}

/// Cuts the cell by its volumes one after another, into pieces_.
template <VolumeSpaceModel Space>
void ReceiverCutter<Space>::cut_out(const Frame& frame) {
  pieces_.clear();
  pending_.clear();
  pending_.push_back({frame.loop, frame.state, frame.begin});
  while (!pending_.empty()) {
    Piece piece = pending_.back();
    pending_.pop_back();
    bool decided = false;
    while (!decided && piece.next < frame.end) {
      Entry& entry = entries_[piece.next++];
      const ShadowVolume& volume = (*volumes_)[entry.volume];
      LoopRange inside = piece.loop;
      PieceClass rest = piece.state;
      bool is_inside = true;
      if (piece.state.state == LightState::kLit && volume.penumbra_count != 0) {
        if (entry.penumbra) {
          is_inside = clip(piece.loop, volumes_->penumbra(volume), penumbra_border_,
                           entry.penumbra_hint, inside);
          if (!is_inside) continue;
          for (const LoopRange& range : outside_) {
            pending_.push_back({range, piece.state, piece.next});
          }
        }
        rest = {LightState::kPenumbra, volume.caster, ShadowReason::kNone};
      }
      piece.loop = inside;
      piece.state = rest;
      if (!entry.umbra ||
          !clip(piece.loop, volumes_->umbra(volume), umbra_border_, entry.umbra_hint, inside))
        continue;
      for (const LoopRange& range : outside_) pending_.push_back({range, rest, piece.next});
      piece.loop = inside;
      piece.state = {in_shadow_, volume.caster, ShadowReason::kNone};
      decided = true;
    }
    pieces_.push_back(piece);
  }
}

template <VolumeSpaceModel Space>
template <class Emit>
bool ReceiverCutter<Space>::cut(const Loop& loop, const VolumeStore& store,
                                std::span<const VolumeToCut> volumes, LightState in_shadow,
                                const Emit& emit) {
  volumes_ = &store;
  in_shadow_ = in_shadow;
  support_ = loop.support;
  store_.clear();
  entries_.clear();
  for (const VolumeToCut& volume : volumes) entries_.push_back({volume.volume, true, volume.umbra});
  frames_.clear();
  frames_.emplace_back();
  frames_.back().loop = store_.append(loop);
  frames_.back().end = static_cast<std::uint32_t>(entries_.size());
  frames_.back().mark = store_.size();
  // What the cell that was finished last came to.
  bool uniform = false;
  PieceClass last;
  const auto finish = [&](bool is_uniform, const PieceClass& state, const Frame& frame) {
    uniform = is_uniform;
    last = state;
    entries_.resize(frame.begin);
    store_.truncate(frame.mark);
    frames_.pop_back();
  };
  while (!frames_.empty()) {
    Frame& frame = frames_.back();
    if (frame.stage == 0) {
      ++cells_;
      if (decide(frame)) {
        finish(true, frame.state, frame);
        continue;
      }
      entries_.resize(frame.end);
      const std::uint32_t count = frame.end - frame.begin;
      // Halving helps if it keeps volumes apart.
      frame.in_vain = 10 * count > 9 * frame.before ? frame.in_vain + 1 : 0;
      if (count > kLeaf && frame.depth < kDeepest && frame.in_vain < kMostInVain && halve(frame)) {
        frame.stage = 1;
        frame.own_end = frame.end;
      } else {
        cut_out(frame);
        const bool same = std::all_of(pieces_.begin(), pieces_.end(), [&](const Piece& piece) {
          return piece.state == pieces_.front().state;
        });
        const PieceClass state = pieces_.front().state;
        if (!same) {
          for (const Piece& piece : pieces_) {
            if (!emit(piece.state, view(piece.loop))) return false;
          }
        }
        finish(same, state, frame);
        continue;
      }
    } else if (frame.stage == 1) {
      frame.front_uniform = uniform;
      frame.front_class = last;
      frame.stage = 2;
    } else {
      const bool same = uniform && frame.front_uniform && last == frame.front_class;
      if (!same) {
        if (frame.front_uniform && !emit(frame.front_class, view(frame.front))) return false;
        if (uniform && !emit(last, view(frame.back))) return false;
      }
      finish(same, last, frame);
      continue;
    }
    // A child, with a copy of the cell's volumes.
    Frame child;
    child.loop = frame.stage == 1 ? frame.front : frame.back;
    child.begin = static_cast<std::uint32_t>(entries_.size());
    for (std::uint32_t i = frame.begin; i < frame.own_end; ++i) entries_.push_back(entries_[i]);
    child.end = static_cast<std::uint32_t>(entries_.size());
    child.state = frame.state;
    child.depth = frame.depth + 1;
    child.in_vain = frame.in_vain;
    child.before = frame.own_end - frame.begin;
    child.mark = store_.size();
    frames_.push_back(child);
  }
  if (uniform) return emit(last, view({0, loop.size(), loop.part}));
  return true;
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_VOLUMES_RECEIVER_CUTTER_H
