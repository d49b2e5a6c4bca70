// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/sample_judge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "oracle/geometry/nearest_place.h"
#include "oracle/judge/clearance.h"
#include "oracle/judge/made_once.h"
#include "oracle/judge/near_border.h"
#include "oracle/visibility/area_sight.h"
#include "oracle/visibility/point_sight.h"

namespace gnomon::oracle {

namespace {

/// What is true of one place on a polygon.
struct SampleTruth {
  mpq_class share;
  bool on_border = false, faces = false;
  std::optional<std::uint32_t> caster;
};

}  // namespace

const char* name_of(SampleOutcome outcome) {
  constexpr std::array<const char*, kSampleOutcomes> kNames{
      "right", "on-border", "ambiguous", "near-border", "ill-conditioned", "wrong"};
  return kNames[static_cast<std::size_t>(outcome)];
}

struct SampleJudge::Data {
  struct LightSights {
    MadeOnce<PointSight> point;
    MadeOnce<AreaSight> area;
  };

  const PreparedScene& scene;
  SampleOptions options;
  NearestPlaces places;
  mutable MadeOnce<PointSight> first_sight;  // what others share their scene with
  mutable std::vector<LightSights> sights;   // of lights

  Data(const PreparedScene& prepared, const SampleOptions& sample_options)
      : scene(prepared),
        options(sample_options),
        places(prepared),
        sights(prepared.lights.size()) {}

  const PointSight& point_sight(std::uint32_t light) const {
    return sights[light].point.get([&] {
      const PreparedLight& own = scene.lights[light];
      return PointSight(first_sight.get([&] { return PointSight(scene, own); }), own);
    });
  }
  const AreaSight& area_sight(std::uint32_t light) const {
    return sights[light].area.get([&] { return AreaSight(scene, scene.lights[light]); });
  }

  std::vector<std::uint32_t> parts_at(const PolygonPlace& place) const;
  SampleTruth truth_at(const Sample& sample, const PolygonPlace& place) const;
  SampleTruth truth_of_area(const Sample& sample, const PolygonPlace& place) const;
  bool is_right(const Sample& sample, const SampleTruth& truth) const;
  bool is_in_range(const Sample& sample) const;
  JudgedSample judge_at(const Sample& sample, const PolygonPlace& place,
                        const SampleTruth& truth) const;
  bool is_near_border(const Sample& sample, JudgedSample& judged) const;
  bool is_near_jump(const Sample& sample, const JudgedSample& judged) const;
};

/// Coplanar parts of the polygon that hold the place, its own first.
std::vector<std::uint32_t> SampleJudge::Data::parts_at(const PolygonPlace& place) const {
  std::vector<std::uint32_t> parts{place.part};
  const Part& own = scene.parts[place.part];
  for (std::uint32_t i = scene.first_part[own.polygon]; i < scene.first_part[own.polygon + 1];
       ++i) {
    if (i != place.part && scene.parts[i].plane == own.plane && places.holds(i, place.point)) {
      parts.push_back(i);
    }
  }
  return parts;
}

SampleTruth SampleJudge::Data::truth_at(const Sample& sample, const PolygonPlace& place) const {
  if (scene.lights[sample.light].has_area()) return truth_of_area(sample, place);
  const PointSight& sight = point_sight(sample.light);
  SampleTruth truth;
  const Side facing = sight.facing(place.part);
  const bool shows =
      facing == Side::kFront || (facing == Side::kBack && scene.parts[place.part].two_sided);
  truth.faces = shows && sample.side.value_or(facing) == facing;
  if (!truth.faces) return truth;
  const PointVisibility seen = sight.at(parts_at(place), place.point);
  truth.share = seen.visibility == Visibility::kShadow ? 0 : 1;
  truth.on_border = seen.visibility == Visibility::kBoundary;
  truth.caster = seen.caster;
  return truth;
}

SampleTruth SampleJudge::Data::truth_of_area(const Sample& sample,
                                             const PolygonPlace& place) const {
  const AreaSight& sight = area_sight(sample.light);
  SampleTruth truth;
  for (const Side side : {Side::kFront, Side::kBack}) {
    if (sample.side.value_or(side) != side) continue;
    AreaPointVisibility seen = sight.at(place.part, side, place.point);
    truth.faces = truth.faces || !seen.behind_light;
    truth.on_border = truth.on_border || seen.jumps;
    truth.share += seen.visible;
    if (!truth.caster) truth.caster = seen.caster;
  }
  return truth;
}

bool SampleJudge::Data::is_in_range(const Sample& sample) const {
  if (!sample.visible) return false;
  if (scene.lights[sample.light].has_area()) return *sample.visible >= 0 && *sample.visible <= 1;
  return *sample.visible == 0 || *sample.visible == 1;
}

bool SampleJudge::Data::is_right(const Sample& sample, const SampleTruth& truth) const {
  if (!is_in_range(sample)) return false;
  if (*sample.visible == truth.share) return true;
  constexpr double kMost = 2;  // no share is farther off, and infinity is no rational
  return scene.lights[sample.light].has_area() &&
         abs(*sample.visible - truth.share) <= std::min(sample.allowed, kMost);
}

JudgedSample SampleJudge::Data::judge_at(const Sample& sample, const PolygonPlace& place,
                                         const SampleTruth& truth) const {
  JudgedSample judged;
  judged.part = place.part;
  judged.polygon = scene.parts[place.part].polygon;
  judged.place = place.point;
  judged.moved = place.distance;
  judged.truth = truth.share;
  judged.caster = truth.caster;
  judged.touches = truth.share == 1 && truth.caster && !scene.lights[sample.light].has_area();
  judged.off = sample.visible ? mpq_class(*sample.visible - truth.share).get_d()
                              : std::numeric_limits<double>::quiet_NaN();
  judged.out_of_range = !is_in_range(sample);
  judged.outcome = judged.out_of_range       ? SampleOutcome::kWrong
                   : truth.on_border         ? SampleOutcome::kOnBorder
                   : is_right(sample, truth) ? SampleOutcome::kRight
                                             : SampleOutcome::kWrong;
  return judged;
}

/// And how far it is from a border, if the light has no area.
bool SampleJudge::Data::is_near_border(const Sample& sample, JudgedSample& judged) const {
  if (scene.lights[sample.light].has_area()) return is_near_jump(sample, judged);
  const PointSight& sight = point_sight(sample.light);
  const Side facing = sight.facing(judged.part);
  const bool shows =
      facing == Side::kFront || (facing == Side::kBack && scene.parts[judged.part].two_sided);
  if (!shows || sample.side.value_or(facing) != facing) return false;
  const bool is_lit = judged.truth == 1;
  // Beyond the polygon, too: its own border may be where a shadow begins.
  const auto is_other = [&](const RationalPoint& point) {
    const SampleTruth truth = truth_at(sample, {judged.part, point, 0, 0});
    return !truth.on_border && (truth.share == 1) != is_lit;
  };
  const BorderDistance border =
      distance_from_border(sight, judged.part, judged.place, is_lit, options.width, is_other);
  judged.from_border = border.at_least;
  if (!judged.caster) judged.caster = border.caster;
  return border.within;
}

/// A share is continuous but where a caster or the light's plane is touched.
bool SampleJudge::Data::is_near_jump(const Sample& sample, const JudgedSample& judged) const {
  if (!(options.width > 0)) return false;
  bool touches = false;
  places.parts_near(judged.place, options.width, [&](std::uint32_t part) {
    touches = touches || (scene.parts[part].casts &&
                          scene.parts[part].plane != scene.parts[judged.part].plane);
  });
  if (!touches) return false;
  const PlaneSteps steps(scene, judged.part);
  const std::vector<RationalPoint> around = points_around(steps, judged.place, options.width);
  return std::ranges::any_of(around, [&](const RationalPoint& point) {
    const SampleTruth truth = truth_at(sample, {judged.part, point, 0, 0});
    return truth.on_border || is_right(sample, truth);
  });
}

SampleJudge::SampleJudge(const PreparedScene& scene, const SampleOptions& options)
    : data_(std::make_unique<Data>(scene, options)) {}
SampleJudge::~SampleJudge() = default;

JudgedSample SampleJudge::judge(const Sample& sample) const {
  const Data& data = *data_;
  std::vector<PolygonPlace> places;
  if (sample.polygon) {
    places.push_back(*data.places.on_polygon(*sample.polygon, sample.point));
  } else {
    places = data.places.all_near(sample.point, data.options.width);
  }
  std::vector<SampleTruth> truths;
  for (const PolygonPlace& place : places) truths.push_back(data.truth_at(sample, place));
  // One that does not face the light counts only where it is nearer than all that do.
  double facing = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (truths[i].faces) facing = std::min(facing, places[i].distance);
  }
  JudgedSample result;
  std::uint32_t candidates = 0;
  bool is_right = false, is_wrong = false, on_border = false;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (!truths[i].faces && places[i].distance >= facing) continue;
    JudgedSample judged = data.judge_at(sample, places[i], truths[i]);
    is_right = is_right || judged.outcome == SampleOutcome::kRight;
    is_wrong = is_wrong || judged.outcome == SampleOutcome::kWrong;
    on_border = on_border || judged.outcome == SampleOutcome::kOnBorder;
    // The nearest stands for all.
    if (++candidates == 1 || judged.moved < result.moved) result = std::move(judged);
  }
  result.candidates = candidates;
  if (is_wrong && (is_right || on_border)) {
    result.outcome = SampleOutcome::kAmbiguous;
  } else if (on_border) {
    result.outcome = SampleOutcome::kOnBorder;
  }
  if (result.outcome != SampleOutcome::kWrong) return result;
  if (data.is_near_border(sample, result) && !result.out_of_range) {
    result.outcome = SampleOutcome::kNearBorder;
  } else if (data.options.clearance > 0 && !result.out_of_range) {
    const SampleCause why = cause(sample, result);
    if (why.clearance.value_or(std::numeric_limits<double>::infinity()) <= data.options.clearance) {
      result.outcome = SampleOutcome::kIllConditioned;
    }
  }
  return result;
}

SampleCause SampleJudge::cause(const Sample& sample, const JudgedSample& judged) const {
  const Data& data = *data_;
  SampleCause result{judged.caster, std::nullopt};
  const PreparedLight& light = data.scene.lights[sample.light];
  // Of what faces away no caster decides.
  if (light.has_area() || (judged.truth == 0 && !judged.caster)) return result;
  const Decision decision = decide(data.scene, light, judged.part, judged.place);
  if (!result.caster) result.caster = decision.caster;
  result.clearance = decision.clearance;
  return result;
}

void SampleJudge::forget_lights() {
  data_->sights = std::vector<Data::LightSights>(data_->scene.lights.size());
}

}  // namespace gnomon::oracle
