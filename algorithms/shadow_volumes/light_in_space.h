// SPDX-License-Identifier: LGPL-3.0-or-later
// One light of any kind in three dimensions: which sides of the parts see it, and the shadow
// volumes that may reach a receiver.
//
// Volumes of casters are made once per light. Only where a receiver's own plane cuts an area light
// are they made again, for the part of the light in front of it, and forgotten with the receiver.
#ifndef GNOMON_ALGORITHMS_SHADOW_VOLUMES_LIGHT_IN_SPACE_H
#define GNOMON_ALGORITHMS_SHADOW_VOLUMES_LIGHT_IN_SPACE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <mutex>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/partition/import_export.h"
#include "algorithms/partition/in_parallel.h"
#include "algorithms/partition/loop_store.h"
#include "algorithms/partition/piece_class.h"
#include "algorithms/partition/rules.h"
#include "algorithms/partition/split.h"
#include "algorithms/shadow_volumes/caster_tree.h"
#include "algorithms/shadow_volumes/light_geometry.h"
#include "algorithms/shadow_volumes/receiver_cutter.h"
#include "algorithms/shadow_volumes/shadow_volume.h"
#include "algorithms/shadow_volumes/shell_casters.h"
#include "algorithms/shadow_volumes/solid_casters.h"
#include "algorithms/shadow_volumes/volumes_of_casters.h"
#include "gnomon/algorithms/shadow_result.h"
#include "kernel/concept/kernel_concept.h"

namespace gnomon {

/// What one side of a part has of a light.
struct Sight {
  ShadowReason reason = ShadowReason::kNone;  // kNone: it sees some of it
  bool sees() const { return reason == ShadowReason::kNone; }
};

/// What a thread needs for one receiver after another; the volumes in `own` and the planes made for
/// them are those of the last one.
template <VolumeSpaceModel Space>
struct ReceiverWorkspace {
  ReceiverWorkspace(Space fork, const Rules& rules)
      : space(std::move(fork)), builder(space, rules), shells(space), cutter(space, rules) {}
  ReceiverWorkspace(const ReceiverWorkspace&) = delete;
  ReceiverWorkspace& operator=(const ReceiverWorkspace&) = delete;

  Space space;
  VolumeBuilder<Space> builder;
  ShellBuilder<Space> shells;
  ReceiverCutter<Space> cutter;
  LoopStore<typename Space::Vertex> whole, caster, front, light;
  VolumeStore own;
  std::vector<std::uint32_t> parts;
  std::vector<VolumeToCut> volumes;
  SplitRecord record;
  std::vector<typename Space::Vertex> crossings;
};

template <VolumeSpaceModel Space>
class LightInSpace {
 public:
  using Vertex = typename Space::Vertex;
  using Loop = LoopView<Vertex>;
  using Workspace = ReceiverWorkspace<Space>;

  /// Adds the planes of all volumes to `space`, which must be forked afterwards. `tree`, `scene`,
  /// `solids` and `shells`, which may be null, must outlive it. `solids` cast as wholes under a
  /// light without an area; `shells` cast their penumbras as wholes under one with an area, so that
  /// their parts have umbras alone. `jobs` other than 1: on the threads of the arena that the
  /// caller is in.
  LightInSpace(Space& space, const LightGeometry& scene, const CasterTree& tree,
               std::uint32_t light, const Rules& rules, const SolidCasters* solids = nullptr,
               const ShellCasters* shells = nullptr, unsigned jobs = 1)
      : scene_(*scene.scene),
        number_(light),
        light_(&scene.scene->lights[light]),
        tree_(&tree),
        rules_(rules),
        solids_(solids),
        shells_(shells) {
    const LightFace& face = scene.faces[light];
    for (std::size_t i = 0; i < face.loop.size(); ++i) {
      PlaneRef edge;
      if (!face.edges.empty()) {
        edge = space.edges().of_edge(face.edges[i].index(), face.edges[i].flipped());
      }
      loop_.push(space.input_vertex(face.loop[i]), edge);
      box_.add(grid_fraction(scene.geometry.grid, face.loop[i]));
    }
    plane_id_ = face.edges.empty() ? kNoPlane : face.plane;
    if (has_area()) plane_ = PlaneRef(face.plane, face.flipped);
    make_volumes(space, jobs);
  }
  /// The same for a piece of an area light, a convex loop on its plane that support planes cut out.
  LightInSpace(Space& space, const LightGeometry& scene, const CasterTree& tree,
               std::uint32_t light, const Rules& rules, const Loop& piece, unsigned jobs = 1)
      : scene_(*scene.scene),
        number_(light),
        light_(&scene.scene->lights[light]),
        tree_(&tree),
        rules_(rules) {
    const LightFace& face = scene.faces[light];
    for (const VertexId vertex : face.loop) {
      box_.add(grid_fraction(scene.geometry.grid, vertex));
    }
    loop_.append(piece);
    plane_id_ = face.plane;
    plane_ = PlaneRef(face.plane, face.flipped);
    make_volumes(space, jobs);
  }

  bool has_area() const { return light_->has_area(); }
  /// The solid that a witness stands for; kNone: it is a part.
  std::uint32_t solid_of(std::uint32_t caster) const {
    const auto parts = static_cast<std::uint32_t>(scene_.parts.size());
    const bool is_none = caster == Fragment::kNoCaster || caster < parts || solid_volumes_.empty();
    return is_none ? SolidCasters::kNone : caster - parts;
  }
  /// The volumes that make up all shadows: those of solids that cast as wholes, and of all parts
  /// that cast by themselves.
  std::vector<std::uint32_t> casting_volumes() const;
  /// Those of them that a part has, alone or as one of a solid; [begin, end).
  std::pair<std::uint32_t, std::uint32_t> casting_volumes_of(std::uint32_t part) const {
    const std::uint32_t solid = caster_of(part);
    if (solid == SolidCasters::kNone) return volumes_of(part);
    return {solid_volumes_[solid], solid_volumes_[solid] + 1};
  }
  /// The box of whatever casts a volume, in fractions of the grid's extent.
  Box caster_box(std::uint32_t volume) const {
    const std::uint32_t caster = store_[volume].caster;
    const std::uint32_t solid = solid_of(caster);
    if (solid == SolidCasters::kNone) return tree_->box(caster);
    Box box;
    for (const std::uint32_t part : solids_->solids[solid]) box.add(tree_->box(part));
    return box;
  }
  /// Faces of a solid that together shadow all of a piece of the receiver that was prepared, none
  /// of whose polygons is needless. Requires: the solid shadows all of the piece.
  std::vector<std::uint32_t> faces_hiding(Workspace& workspace, const Loop& piece,
                                          std::uint32_t solid) const;
  /// Volumes and their planes.
  void count(WorkCounts& counts) const;
  /// Decisions that forks of the space have made for the volumes, and the space has not counted.
  const StageCounts& stage_counts() const { return stages_; }
  LightState in_shadow() const { return has_area() ? LightState::kUmbra : LightState::kShadow; }
  PlaneRef plane() const { return plane_; }
  /// Of the region that it shines in, inside in front; none: everywhere.
  std::span<const PlaneRef> region() const { return light_->region; }
  const VolumeStore& volumes() const { return store_; }
  /// The store of the volumes that prepare() has found.
  const VolumeStore& store(const Workspace& workspace) const {
    return workspace.own.size() > 0 ? workspace.own : store_;
  }
  const PreparedScene& scene() const { return scene_; }
  /// Index into PreparedScene::lights.
  std::uint32_t number() const { return number_; }
  /// The volumes of a part's sides, by index: two for a two-sided part whose plane cuts the light.
  std::pair<std::uint32_t, std::uint32_t> volumes_of(std::uint32_t part) const {
    return {first_volume_[part], first_volume_[part + 1]};
  }

  /// Shells are casters, too, with numbers after those of parts.
  std::uint32_t shell_count() const {
    return static_cast<std::uint32_t>(first_volume_.size() - 1 - scene_.parts.size());
  }
  const ConvexShell& shell(std::uint32_t caster) const {
    return shells_->shells[caster - scene_.parts.size()];
  }
  /// Whether a caster is a shell, or a solid.
  bool is_solid(std::uint32_t caster) const { return caster >= scene_.parts.size(); }
  /// Those of a part or of a shell.
  std::span<const VertexId> vertices_of(std::uint32_t caster) const {
    if (is_solid(caster)) return shell(caster).vertices;
    return scene_.loop(scene_.parts[caster]);
  }
  /// The shell that casts a part's penumbra; kNone: the part does.
  std::uint32_t shell_of(std::uint32_t part) const {
    if (casts_as_one_.empty()) return ShellCasters::kNone;
    const std::uint32_t shell = shells_->of_part[part];
    if (shell == ShellCasters::kNone || casts_as_one_[shell] == 0) return ShellCasters::kNone;
    return static_cast<std::uint32_t>(scene_.parts.size()) + shell;
  }
  LightShape<Vertex> shape() const {
    return {loop_.view({0, loop_.size(), 0}, plane_id_),
            light_->is_directional() ? &light_->point : nullptr, plane_};
  }

  /// The part of an area light in front of a receiver whose plane cuts it, in the workspace; of
  /// less than three corners if it has no area. None: the plane cuts nothing.
  std::optional<LightShape<Vertex>> cut_by(Workspace& workspace, PlaneRef receiving) const;
  /// The box of a cut light, as wide as its corners are known; that of all of it if they are not.
  Box box_of(const Space& space, const Loop& light) const;
  /// The corners of a light or of a cut one to within UmbraReach::kMargin; none if some are not
  /// known so well.
  static void corners_of(const Space& space, const Loop& light,
                         std::vector<std::array<double, 3>>& corners);

  /// Whether that side of a part, if it receives at all, sees some of the light.
  Sight sight(Workspace& workspace, std::uint32_t part, Side side) const;
  /// Cuts a piece of the side of a part (its whole loop, or a fragment of an earlier light) and
  /// calls emit(PieceClass, Loop) for each fragment; false if emit was. Requires: it sees the
  /// light, and prepare() was called for this receiver.
  template <class Emit>
  bool cut(Workspace& workspace, const Loop& piece, const Emit& emit) const;
  /// Finds the volumes that may reach a receiver, for cut().
  void prepare(Workspace& workspace, std::uint32_t part, Side side) const;

  /// For a light without an area: emits what of a loop is outside of its region; inside(loop) gets
  /// the rest, if there is one. False once either is.
  template <class Emit, class Inside>
  bool clip_to_region(Workspace& workspace, const Loop& piece, const Emit& emit,
                      const Inside& inside) const;

 private:
  static constexpr PlaneId kNoPlane = 0xffffffffu;
  /// So many casters are tried for a penumbra that holds a whole receiver.
  static constexpr std::size_t kMostCovers = 16;
  /// Keeps the shadow of a caster at the light finite, as far as the order of casters goes.
  static constexpr double kNearestToLight = 1e-12;

  void make_volumes(Space& space, unsigned jobs);
  void find_who_cast_as_one(Space& space, unsigned jobs);
  void make_solid_volumes(Space& space, VolumeBuilder<Space>& builder);
  /// The solid that casts in place of a part; kNone: the part casts.
  std::uint32_t caster_of(std::uint32_t part) const {
    if (solid_volumes_.empty() || solids_->of_part[part] == SolidCasters::kNone) {
      return SolidCasters::kNone;
    }
    const std::uint32_t solid = solids_->of_part[part];
    return solid_volumes_[solid] == SolidCasters::kNone ? SolidCasters::kNone : solid;
  }
  void add_solid(Workspace& workspace, std::uint32_t solid, std::uint32_t receiver) const;
  UmbraReach umbra_reach(const Space& space, const Loop& light, const Box& receiver) const {
    if (!has_area()) return {};
    std::vector<std::array<double, 3>> corners;
    corners_of(space, light, corners);
    return UmbraReach(corners, receiver);
  }
  void sort_by_shadow(std::uint32_t receiver, std::vector<std::uint32_t>& casters) const;
  void drop_behind(Workspace& workspace, std::uint32_t receiver, PlaneRef receiving,
                   std::vector<std::uint32_t>& casters) const;
  Shaft shaft_to(const Box& receiver, const Box& light) const {
    if (!light_->is_directional()) return Shaft(receiver, light);
    std::array<double, 3> direction{};
    for (std::size_t k = 0; k < 3; ++k) direction[k] = light_->point.grid[k].get_d();
    return Shaft(receiver, direction);
  }

  const PreparedScene& scene_;
  std::uint32_t number_ = 0;
  const PreparedLight* light_;
  const CasterTree* tree_;
  Rules rules_;
  LoopStore<Vertex> loop_;
  Box box_;
  PlaneId plane_id_ = kNoPlane;
  PlaneRef plane_;  // of an area light; it emits to its front
  VolumeStore store_;
  std::vector<std::uint32_t> first_volume_;
  StageCounts stages_;
  const SolidCasters* solids_ = nullptr;
  std::vector<std::uint32_t> solid_volumes_;  // by solid; kNone: its parts cast
  const ShellCasters* shells_ = nullptr;
  std::vector<char> casts_as_one_;  // by shell, whether it does; empty: there are none
};

template <VolumeSpaceModel Space>
void LightInSpace<Space>::make_volumes(Space& space, unsigned jobs) {
  const auto parts = static_cast<std::uint32_t>(scene_.parts.size());
  if (shells_ != nullptr && has_area()) find_who_cast_as_one(space, jobs);
  const auto casters = parts + static_cast<std::uint32_t>(casts_as_one_.size());
  const auto add = [&](VolumeTools<Space>& tools, std::uint32_t caster, VolumeStore& store) {
    if (caster >= parts) {
      if (casts_as_one_[caster - parts] == 0) return;
      return tools.shells.add(scene_, shells_->shells[caster - parts], caster, shape(), store);
    }
    const Part& part = scene_.parts[caster];
    // A polygon in the light's plane casts nothing.
    if (!casts_under(*light_, part) || part.plane == plane_id_) return;
    const bool umbra_alone = shell_of(caster) != ShellCasters::kNone;
    add_part_volumes(tools.builder, tools.space, scene_, caster, shape(), tools.loops, store,
                     umbra_alone ? VolumesWanted::kUmbra : VolumesWanted::kBoth);
  };
  VolumesOfCasters made = gnomon::make_volumes(space, rules_, casters, parts, add, jobs);
  store_ = std::move(made.store);
  first_volume_ = std::move(made.first);
  stages_ += made.stages;
  if (solids_ != nullptr && !has_area()) {
    VolumeBuilder<Space> builder(space, rules_);
    make_solid_volumes(space, builder);
  }
}

template <VolumeSpaceModel Space>
void LightInSpace<Space>::find_who_cast_as_one(Space& space, unsigned jobs) {
  constexpr std::uint32_t kGrain = 256;
  const auto shells = static_cast<std::uint32_t>(shells_->shells.size());
  casts_as_one_.resize(shells);
  std::mutex mutex;
  in_parallel(Space::kParallel ? jobs : 1, shells, kGrain,
              [&](std::uint32_t begin, std::uint32_t end) {
                Space fork = space.fork();
                ShellBuilder<Space> builder(fork);
                for (std::uint32_t i = begin; i < end; ++i) {
                  casts_as_one_[i] = builder.casts_as_one(scene_, shells_->shells[i], shape());
                }
                const std::lock_guard lock(mutex);
                stages_ += fork.stage_counts();
              });
}

/// One volume a solid, besides those of its faces, by which its witnesses are told. Of a light
/// inside of a solid no face has the light in front.
template <VolumeSpaceModel Space>
void LightInSpace<Space>::make_solid_volumes(Space& space, VolumeBuilder<Space>& builder) {
  const auto parts = static_cast<std::uint32_t>(scene_.parts.size());
  solid_volumes_.assign(solids_->solids.size(), SolidCasters::kNone);
  for (std::uint32_t solid = 0; solid < solids_->solids.size(); ++solid) {
    LoopStore<Vertex> loops, one;
    std::vector<LoopRange> ranges;
    for (const std::uint32_t part : solids_->solids[solid]) {
      if (!builder.is_in_front(plane_of_side(scene_.parts[part], Side::kFront), shape())) continue;
      ranges.push_back(loops.append(part_loop(space, scene_, part, one)));
    }
    if (ranges.empty()) continue;
    std::vector<typename VolumeBuilder<Space>::Face> faces;
    for (const LoopRange& range : ranges) {
      const Part& part = scene_.parts[range.part];
      faces.push_back({loops.view(range, part.plane), plane_of_side(part, Side::kFront)});
    }
    solid_volumes_[solid] = static_cast<std::uint32_t>(store_.size());
    builder.add_solid(faces, parts + solid, shape(), store_);
  }
}

/// A face in the receiver's plane that the light is in front of has all of the solid behind that
/// plane.
template <VolumeSpaceModel Space>
void LightInSpace<Space>::add_solid(Workspace& workspace, std::uint32_t solid,
                                    std::uint32_t receiver) const {
  const std::uint32_t volume = solid_volumes_[solid];
  const auto is_there = [&](const VolumeToCut& other) { return other.volume == volume; };
  if (std::ranges::any_of(workspace.volumes, is_there)) return;
  for (const std::uint32_t part : solids_->solids[solid]) {
    if (scene_.parts[part].plane == scene_.parts[receiver].plane &&
        workspace.builder.is_in_front(plane_of_side(scene_.parts[part], Side::kFront), shape())) {
      return;
    }
  }
  workspace.volumes.push_back({volume, true});
}

template <VolumeSpaceModel Space>
std::vector<std::uint32_t> LightInSpace<Space>::faces_hiding(Workspace& workspace,
                                                             const Loop& piece,
                                                             std::uint32_t solid) const {
  std::vector<std::uint32_t> faces;
  for (const std::uint32_t part : solids_->solids[solid]) {
    if (workspace.builder.is_in_front(plane_of_side(scene_.parts[part], Side::kFront), shape())) {
      faces.push_back(part);
    }
  }
  const auto hide = [&](const std::vector<std::uint32_t>& parts) {
    std::vector<VolumeToCut> volumes;
    for (const std::uint32_t part : parts) {
      for (std::uint32_t i = first_volume_[part]; i < first_volume_[part + 1]; ++i) {
        volumes.push_back({i, true});
      }
    }
    return workspace.cutter.cut(
        piece, store_, volumes, in_shadow(),
        [](const PieceClass& own, const Loop&) { return own.state != LightState::kLit; });
  };
  for (std::size_t i = 0; i < faces.size();) {
    const std::uint32_t polygon = scene_.parts[faces[i]].polygon;
    std::vector<std::uint32_t> others;
    std::ranges::copy_if(faces, std::back_inserter(others),
                         [&](std::uint32_t part) { return scene_.parts[part].polygon != polygon; });
    if (!others.empty() && hide(others)) {
      faces = std::move(others);
      i = 0;
    } else {
      ++i;
    }
  }
  return faces;
}

template <VolumeSpaceModel Space>
std::vector<std::uint32_t> LightInSpace<Space>::casting_volumes() const {
  std::vector<std::uint32_t> volumes;
  for (std::uint32_t part = 0; part < scene_.parts.size(); ++part) {
    if (caster_of(part) != SolidCasters::kNone) continue;
    for (std::uint32_t i = first_volume_[part]; i < first_volume_[part + 1]; ++i) {
      volumes.push_back(i);
    }
  }
  for (std::uint32_t i = first_volume_[scene_.parts.size()]; i < first_volume_.back(); ++i) {
    volumes.push_back(i);
  }
  std::ranges::copy_if(solid_volumes_, std::back_inserter(volumes),
                       [](std::uint32_t volume) { return volume != SolidCasters::kNone; });
  return volumes;
}

template <VolumeSpaceModel Space>
void LightInSpace<Space>::count(WorkCounts& counts) const {
  for (const std::uint32_t i : casting_volumes()) {
    const ShadowVolume& volume = store_[i];
    const std::uint32_t planes = volume.penumbra_count + volume.umbra_count;
    if (planes == 0) continue;
    ++counts[Counter::kVolumes];
    counts[Counter::kVolumePlanes] += planes;
    if (is_solid(volume.caster)) ++counts[Counter::kSolids];
  }
}

template <VolumeSpaceModel Space>
Sight LightInSpace<Space>::sight(Workspace& workspace, std::uint32_t index, Side side) const {
  const Part& part = scene_.parts[index];
  const PlaneRef receiving = plane_of_side(part, side);
  const LightShape<Vertex> light = shape();
  if (!workspace.builder.is_in_front(receiving, light)) {
    const bool in_plane = workspace.builder.holds(receiving, light);
    return {in_plane ? ShadowReason::kLightInPlane : ShadowReason::kFacesAway};
  }
  if (has_area()) {
    const Loop loop = part_loop(workspace.space, scene_, index, workspace.whole);
    const Placement placement = workspace.record.decide(workspace.space, plane_, loop);
    if (placement == Placement::kBack || placement == Placement::kOn) {
      return {ShadowReason::kBehindLight};
    }
  }
  return {};
}

/// Casters with the largest shadows on the receiver first, as far as boxes tell: what is penumbra
/// already need not be cut by other penumbras. A heuristic: the order changes fragments only.
template <VolumeSpaceModel Space>
void LightInSpace<Space>::sort_by_shadow(std::uint32_t receiver,
                                         std::vector<std::uint32_t>& casters) const {
  const auto middle = [](const Box& box, std::size_t k) { return (box.low[k] + box.high[k]) / 2; };
  const auto size = [](const Box& box) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += box.high[k] - box.low[k];
    return sum;
  };
  const auto distance = [&](const Box& a, const Box& b) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += std::fabs(middle(a, k) - middle(b, k));
    return sum;
  };
  const bool directional = light_->is_directional();
  std::vector<std::pair<double, std::uint32_t>> keys;
  keys.reserve(casters.size());
  for (const std::uint32_t caster : casters) {
    const Box& box = tree_->box(caster);
    // A point of the shadow is (1 + t) o - t a.
    const double t =
        directional ? 0
                    : distance(box, tree_->box(receiver)) / (distance(box, box_) + kNearestToLight);
    keys.emplace_back(-((1 + t) * size(box) + (directional ? 0 : t * size(box_))), caster);
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t i = 0; i < keys.size(); ++i) casters[i] = keys[i].second;
}

template <VolumeSpaceModel Space>
std::optional<LightShape<typename Space::Vertex>> LightInSpace<Space>::cut_by(
    Workspace& workspace, PlaneRef receiving) const {
  LightShape<Vertex> light = shape();
  if (!has_area() || !rules_.straddling_light_is_cut ||
      workspace.record.decide(workspace.space, receiving, light.loop) != Placement::kSpanning) {
    return std::nullopt;
  }
  workspace.light.clear();
  const SplitChildren children =
      make_children(workspace.space, receiving, light.loop, workspace.record, workspace.crossings,
                    workspace.light);
  light.loop = workspace.light.view(children.front, plane_id_);
  return light;
}

template <VolumeSpaceModel Space>
Box LightInSpace<Space>::box_of(const Space& space, const Loop& light) const {
  Box box;
  for (std::uint32_t i = 0; i < light.size(); ++i) {
    const std::array<Ball, 3> position = space.position(light.corner(i));
    std::array<double, 3> low{}, high{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!position[k].is_finite()) return box_;
      low[k] = position[k].lower();
      high[k] = position[k].upper();
    }
    box.add(low);
    box.add(high);
  }
  return box;
}

template <VolumeSpaceModel Space>
void LightInSpace<Space>::corners_of(const Space& space, const Loop& light,
                                     std::vector<std::array<double, 3>>& corners) {
  corners.clear();
  for (std::uint32_t i = 0; i < light.size(); ++i) {
    const std::array<Ball, 3> position = space.position(light.corner(i));
    std::array<double, 3> point{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(position[k].radius < UmbraReach::kMargin)) return corners.clear();
      point[k] = position[k].middle;
    }
    corners.push_back(point);
  }
}

template <VolumeSpaceModel Space>
void LightInSpace<Space>::prepare(Workspace& workspace, std::uint32_t index, Side side) const {
  Space& space = workspace.space;
  const PlaneRef receiving = plane_of_side(scene_.parts[index], side);
  workspace.own.clear();
  workspace.volumes.clear();
  const std::optional<LightShape<Vertex>> cut = cut_by(workspace, receiving);
  if (cut && cut->loop.size() < 3) return;
  const LightShape<Vertex> light = cut ? *cut : shape();
  const Box& box = tree_->box(index);
  const Box light_box = cut ? box_of(space, light.loop) : box_;
  const UmbraReach reach = umbra_reach(space, light.loop, box);
  const Loop loop = part_loop(space, scene_, index, workspace.front);
  const auto is_missed = [&](const ShadowVolume& volume) {
    const auto planes = store_.penumbra(volume);
    return std::any_of(planes.begin(), planes.end(),
                       [&](PlaneRef plane) { return workspace.cutter.is_outside(loop, plane); });
  };
  std::vector<std::uint32_t> added;  // shells
  bool covered = false;              // by one penumbra: others do not matter any more
  // Volumes of the whole light cost nothing more, and the cutter asks them again: only where
  // `may_cover` is likely is it worth to ask here.
  const auto add = [&](std::uint32_t part, bool may_cover) {
    const bool umbra = reach.may_reach(tree_->box(part));
    if (covered && !umbra) return;
    if (const std::uint32_t solid = caster_of(part); solid != SolidCasters::kNone) {
      return add_solid(workspace, solid, index);
    }
    const std::uint32_t shell = shell_of(part);
    auto [begin, end] = volumes_of(part);
    if (cut) {
      // What hides nothing of the whole light hides nothing of a part of it.
      const auto [first, last] =
          shell == ShellCasters::kNone ? std::pair(begin, end) : volumes_of(shell);
      const auto whole = store_.volumes().subspan(first, last - first);
      if (std::all_of(whole.begin(), whole.end(), is_missed)) return;
      begin = static_cast<std::uint32_t>(workspace.own.size());
      add_part_volumes(workspace.builder, space, scene_, part, light, workspace.caster,
                       workspace.own);
      end = static_cast<std::uint32_t>(workspace.own.size());
    }
    const VolumeStore& store = cut ? workspace.own : store_;
    const auto push = [&](std::uint32_t volume) {
      workspace.volumes.push_back({volume, umbra});
      const auto penumbra = store.penumbra(store[volume]);
      covered =
          covered || (may_cover && !penumbra.empty() && workspace.cutter.is_inside(loop, penumbra));
    };
    for (std::uint32_t i = begin; i < end; ++i) push(i);
    if (cut || shell == ShellCasters::kNone || std::ranges::find(added, shell) != added.end()) {
      return;
    }
    added.push_back(shell);
    for (auto [i, last] = volumes_of(shell); i < last; ++i) push(i);
  };
  // Casters before the middle of the light are most likely to have all of the receiver in their
  // penumbra; then only umbras remain to be looked for, which reach less far.
  std::vector<std::uint32_t> asked;
  if (has_area()) {
    Box middle;
    middle.add(std::array{(light_box.low[0] + light_box.high[0]) / 2,
                          (light_box.low[1] + light_box.high[1]) / 2,
                          (light_box.low[2] + light_box.high[2]) / 2});
    tree_->find(shaft_to(box, middle), asked);
    drop_behind(workspace, index, receiving, asked);
    sort_by_shadow(index, asked);
    if (asked.size() > kMostCovers) asked.resize(kMostCovers);
    std::size_t tried = 0;
    while (tried < asked.size() && !covered) add(asked[tried++], true);
    asked.resize(tried);
    std::sort(asked.begin(), asked.end());
  }
  workspace.parts.clear();
  if (covered) {
    tree_->find(shaft_to(box, light_box), reach, workspace.parts);
  } else {
    tree_->find(shaft_to(box, light_box), workspace.parts);
  }
  std::erase_if(workspace.parts, [&](std::uint32_t part) {
    return std::binary_search(asked.begin(), asked.end(), part);
  });
  drop_behind(workspace, index, receiving, workspace.parts);
  sort_by_shadow(index, workspace.parts);
  for (const std::uint32_t part : workspace.parts) add(part, cut.has_value());
}

/// Only what is partly in front of the receiver can be in its light.
template <VolumeSpaceModel Space>
void LightInSpace<Space>::drop_behind(Workspace& workspace, std::uint32_t receiver,
                                      PlaneRef receiving,
                                      std::vector<std::uint32_t>& casters) const {
  std::erase_if(casters, [&](std::uint32_t other) {
    const Part& part = scene_.parts[other];
    if (other == receiver || part.plane == scene_.parts[receiver].plane ||
        !casts_under(*light_, part)) {
      return true;
    }
    const Loop loop = part_loop(workspace.space, scene_, other, workspace.caster);
    for (std::uint32_t i = 0; i < loop.size(); ++i) {
      if (workspace.space.side_of_plane(receiving, loop.corner(i)) == Side::kFront) return false;
    }
    return true;
  });
}

template <VolumeSpaceModel Space>
template <class Emit, class Inside>
bool LightInSpace<Space>::clip_to_region(Workspace& workspace, const Loop& piece, const Emit& emit,
                                         const Inside& inside) const {
  constexpr PieceClass kOutside{LightState::kShadow, Fragment::kNoCaster,
                                ShadowReason::kOutsideRegion};
  Loop rest = piece;
  workspace.front.clear();
  for (const PlaneRef plane : light_->region) {
    const Placement placement = workspace.record.decide(workspace.space, plane, rest);
    if (placement == Placement::kBack) return emit(kOutside, rest);
    if (placement != Placement::kSpanning) continue;
    LoopStore<Vertex> parent;  // the store may move what lies in it
    const LoopRange range = parent.append(rest);
    const SplitChildren children =
        make_children(workspace.space, plane, parent.view(range, piece.support), workspace.record,
                      workspace.crossings, workspace.front);
    if (children.back.count >= 3 &&
        !emit(kOutside, workspace.front.view(children.back, piece.support))) {
      return false;
    }
    if (children.front.count < 3) return true;
    rest = workspace.front.view(children.front, piece.support);
  }
  return inside(rest);
}

template <VolumeSpaceModel Space>
template <class Emit>
bool LightInSpace<Space>::cut(Workspace& workspace, const Loop& piece, const Emit& emit) const {
  const VolumeStore& store = this->store(workspace);
  if (!has_area()) {
    return clip_to_region(workspace, piece, emit, [&](const Loop& inside) {
      return workspace.cutter.cut(inside, store, workspace.volumes, in_shadow(), emit);
    });
  }
  constexpr PieceClass kBehind{LightState::kUmbra, Fragment::kNoCaster, ShadowReason::kBehindLight};
  switch (workspace.record.decide(workspace.space, plane_, piece)) {
    case Placement::kBack:
    case Placement::kOn:
      return emit(kBehind, piece);
    case Placement::kFront:
      return workspace.cutter.cut(piece, store, workspace.volumes, in_shadow(), emit);
    case Placement::kSpanning:
      break;
  }
  workspace.front.clear();
  const SplitChildren children = make_children(workspace.space, plane_, piece, workspace.record,
                                               workspace.crossings, workspace.front);
  if (children.back.count >= 3 &&
      !emit(kBehind, workspace.front.view(children.back, piece.support))) {
    return false;
  }
  return children.front.count < 3 ||
         workspace.cutter.cut(workspace.front.view(children.front, piece.support), store,
                              workspace.volumes, in_shadow(), emit);
}

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_SHADOW_VOLUMES_LIGHT_IN_SPACE_H
