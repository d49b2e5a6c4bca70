// SPDX-License-Identifier: GPL-3.0-or-later
#include "gnomon/oracle/verdict.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <mutex>
#include <set>
#include <unordered_map>
#include <utility>

#include "gnomon/oracle/visibility.h"
#include "gnomon/result/claimed_pieces.h"
#include "gnomon/result/shared_claims.h"
#include "oracle/judge/border_proof.h"
#include "oracle/judge/point_check.h"

namespace gnomon::oracle {

namespace {

/// One comparison to be made.
struct Task {
  std::uint32_t light = 0;
  AnswerEntry entry;
  const ClaimedPolygon* candidate = nullptr;
  ClaimedTerms terms;
};

bool is_class_of(LightState shade, bool area) {
  return shade == LightState::kLit || (shade != LightState::kShadow) == area;
}

class Certifier {
 public:
  /// `problems`: that are known of the candidate.
  Certifier(const ExactAnswer& answer, const Claims& candidate, const CertifyOptions& options,
            std::vector<std::string> problems = {})
      : answer_(answer), candidate_(candidate), options_(options) {
    report_.problems = std::move(problems);
  }

  Report run();

 private:
  void match_light(std::uint32_t light, const ClaimedLight* found);
  void match_lights(const Claims& candidate, Block block);
  bool skips(AnswerEntry& entry, const ClaimedLight& found, bool listed);
  void compare_all();
  ComparisonOptions comparison_options() const;
  bool prove(std::size_t task);
  void look_for_error();
  void sum_up();
  void judge();
  void note_shares();
  bool fails(const PolygonComparison& comparison) const;
  bool fails_beyond_rounding(const PolygonComparison& comparison) const;
  bool is_off_plane(const PolygonComparison& comparison) const;
  void tell_of_rounding();
  std::string excess() const;
  void problem(std::string text) { report_.problems.push_back(std::move(text)); }
  /// "light 'sun'", and the block that tells of it if the lights' own does not.
  static std::string name_of_light(const ClaimedLight& light) {
    return light.block == Block::kLights
               ? fmt::format("light '{}'", light.id)
               : fmt::format("{}, light '{}'", name_of(light.block), light.id);
  }

  const ExactAnswer& answer_;
  const Claims& candidate_;
  const CertifyOptions& options_;
  std::vector<Claims> shared_;  // what the candidate tells of several lights, light by light
  // First part and side of the groups whose tiling by shared fragments is judged: once each.
  std::set<std::pair<std::uint32_t, Side>> tiled_;
  Report report_;
  std::vector<Task> tasks_;
  std::vector<PolygonComparison> comparisons_;
  std::vector<PointCheck> point_checks_;
  std::vector<bool> done_;
};

/// Shared fragments need not list what no light reaches. Where several lights tell of one side, the
/// first that reaches it stands for all in what its fragments cover.
bool Certifier::skips(AnswerEntry& entry, const ClaimedLight& found, bool listed) {
  if (found.block == Block::kLights) return false;
  bool reached = false;
  for (ReceiverGroup& group : entry.groups) {
    reached = reached || group.faces;
    group.optional = group.optional || !group.faces;
    group.tiling = group.faces && tiled_.emplace(group.parts.front(), entry.side).second;
  }
  return !reached && (!listed || found.block == Block::kOverlay);
}

void Certifier::match_light(std::uint32_t light, const ClaimedLight* found) {
  const Scene& scene = answer_.scene();
  const std::string name = name_of_light(*found);
  const std::vector<AnswerEntry>& entries = answer_.entries(light);
  std::map<std::string, std::vector<const ClaimedPolygon*>> by_id;
  for (const ClaimedPolygon& polygon : found->polygons) by_id[polygon.id].push_back(&polygon);
  std::unordered_map<std::string, std::uint32_t> known;
  for (std::uint32_t i = 0; i < scene.polygons.size(); ++i) known.emplace(scene.polygons[i].id, i);
  const bool area = answer_.is_area(light);
  if (found->background && !is_class_of(*found->background, area)) {
    problem(fmt::format("{}: background '{}' is no class of {} light", name,
                        name_of(*found->background), area ? "an area" : "a point or directional"));
  }
  std::unordered_map<std::string, std::size_t> sides;
  for (const AnswerEntry& entry : entries) ++sides[scene.polygons[entry.polygon].id];

  std::map<const ClaimedPolygon*, bool> used;
  for (AnswerEntry entry : entries) {
    const std::string& id = scene.polygons[entry.polygon].id;
    const ClaimedPolygon* match = nullptr;
    const auto place = by_id.find(id);
    if (place != by_id.end()) {
      for (const ClaimedPolygon* polygon : place->second) {
        const bool same_side = polygon->side_given ? polygon->side == entry.side
                                                   : sides[id] == 1 || polygon->side == entry.side;
        if (!same_side) continue;
        if (match) {
          problem(
              fmt::format("{}: polygon '{}' ({}) is listed twice", name, id, name_of(entry.side)));
          used[polygon] = true;
          continue;
        }
        match = polygon;
        used[polygon] = true;
      }
    }
    if (skips(entry, *found, match != nullptr)) continue;
    if (!match && !found->background) {
      if (!options_.subset) {
        problem(fmt::format("{}: polygon '{}' ({}) is missing", name, id, name_of(entry.side)));
      }
      continue;
    }
    tasks_.push_back({light, std::move(entry), match, *found});
  }
  for (const ClaimedPolygon& polygon : found->polygons) {
    bool known_classes = true;
    for (const ClaimedFragment& fragment : polygon.fragments) {
      if (is_class_of(fragment.state, area) || !known_classes) continue;
      known_classes = false;
      problem(fmt::format("{}: polygon '{}' has a fragment of class '{}'; {} was expected", name,
                          polygon.id, name_of(fragment.state),
                          area ? "lit, penumbra or umbra" : "lit or shadow"));
    }
    for (const ToldShare& share : polygon.told) {
      if (is_class_of(share.state, area) || share.value == 0) continue;
      problem(fmt::format("{}: polygon '{}' has a share of class '{}'; {} was expected", name,
                          polygon.id, name_of(share.state),
                          area ? "lit, penumbra or umbra" : "lit or shadow"));
    }
    if (used[&polygon] || found->block == Block::kOverlay) continue;
    const auto place = known.find(polygon.id);
    if (place == known.end()) {
      problem(fmt::format("{}: no polygon '{}' in the scene", name, polygon.id));
      continue;
    }
    // A side that the light does not reach, or a polygon without area: shadow or umbra if anything.
    AnswerEntry entry;
    entry.polygon = place->second;
    entry.side = polygon.side;
    for (const AnswerEntry& other : entries) {
      if (other.polygon == entry.polygon && entry.groups.empty()) entry.groups = other.groups;
    }
    for (ReceiverGroup& group : entry.groups) {
      group.faces = false;
      group.optional = true;
      group.tiling = found->block == Block::kLights;
      group.side = polygon.side;
    }
    if (!entry.groups.empty()) {
      ClaimedTerms terms = *found;
      terms.background.reset();
      tasks_.push_back({light, std::move(entry), &polygon, std::move(terms)});
    }
  }
}

void Certifier::match_lights(const Claims& candidate, Block block) {
  const Scene& scene = answer_.scene();
  const PreparedScene& prepared = answer_.prepared();
  std::vector<std::uint32_t> wanted = options_.lights;
  if (wanted.empty()) {
    for (std::uint32_t i = 0; i < prepared.lights.size(); ++i) wanted.push_back(i);
  }
  std::map<std::string, const ClaimedLight*> by_id;
  for (const std::string& text : candidate.problems) problem(text);
  for (const ClaimedLight& light : candidate.lights) {
    if (!by_id.emplace(light.id, &light).second) {
      problem(fmt::format("light '{}' is listed twice", light.id));
    }
    const bool known = std::any_of(scene.lights.begin(), scene.lights.end(),
                                   [&](const Light& own) { return own.id == light.id; });
    if (!known) problem(fmt::format("no light '{}' in the scene", light.id));
  }
  for (std::uint32_t light : wanted) {
    const std::string& id = scene.lights[prepared.lights[light].light].id;
    const auto place = by_id.find(id);
    if (place == by_id.end()) {
      if (!options_.subset && block == Block::kLights) {
        problem(fmt::format("light '{}' is missing", id));
      }
      continue;
    }
    match_light(light, place->second);
  }
}

ComparisonOptions Certifier::comparison_options() const {
  ComparisonOptions options;
  options.clearance = options_.clearance;
  options.width_resolution = report_.width / 16;
  options.exact_limit = options_.exact_limit;
  options.most_regions = options_.most_regions;
  options.measure_rounding = options_.measure_rounding;
  options.share_tolerance = report_.share_tolerance;
  options.double_tolerance = report_.tolerance;
  return options;
}

/// False if the side must be overlaid.
bool Certifier::prove(std::size_t task) {
  if (!options_.borders || options_.strict || options_.clearance > 0 || options_.leaks) {
    return false;
  }
  const Task& own = tasks_[task];
  // Borders of regions are no shadows of casters.
  if (!answer_.prepared().lights[own.light].region.empty()) return false;
  std::optional<PolygonComparison> bounds =
      prove_by_borders(answer_, own.light, own.entry, own.candidate, own.terms,
                       {.share = report_.tolerance, .width = report_.width});
  if (!bounds || fails(*bounds)) return false;
  comparisons_[task] = std::move(*bounds);
  return true;
}

/// Borders do not tell a right side from one that is all but right. Where no error is known, sides
/// that may have some are overlaid, those with the most room for it first, until one has.
void Certifier::look_for_error() {
  const auto errs = [](const PolygonComparison& own) { return own.regions > 0; };
  if (!report_.problems.empty() || std::ranges::any_of(comparisons_, errs)) return;
  std::vector<std::size_t> doubtful;
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    if (comparisons_[i].by_borders && !comparisons_[i].misclassified.zero) doubtful.push_back(i);
  }
  std::ranges::stable_sort(doubtful, std::greater<>(), [&](std::size_t i) {
    return comparisons_[i].misclassified.fraction.upper;
  });
  const ComparisonOptions own_options = comparison_options();
  for (const std::size_t i : doubtful) {
    if (options_.interrupted && options_.interrupted->load(std::memory_order_relaxed)) {
      report_.interrupted = true;
      return;
    }
    const Task& task = tasks_[i];
    comparisons_[i] =
        compare_entry(answer_, task.light, task.entry, task.candidate, task.terms, own_options);
    if (errs(comparisons_[i])) return;
  }
}

void Certifier::compare_all() {
  const PreparedScene& prepared = answer_.prepared();
  report_.pairs = static_cast<std::uint64_t>(prepared.parts.size()) * prepared.parts.size();
  report_.most_pairs = options_.most_pairs;
  report_.by_points = report_.pairs > options_.most_pairs;
  comparisons_.resize(tasks_.size());
  point_checks_.resize(tasks_.size());
  std::vector<char> done(tasks_.size(), 0);
  std::map<std::uint32_t, VisibilityTest> visibility;
  if (report_.by_points) {
    for (const Task& task : tasks_) {
      if (answer_.is_area(task.light)) continue;
      visibility.try_emplace(task.light, prepared, prepared.lights[task.light]);
    }
  }
  const ComparisonOptions own_options = comparison_options();
  // Fragments' points and as many random ones, each against every part.
  const std::uint64_t point_pairs =
      2 * std::uint64_t{options_.points_a_polygon} * tasks_.size() * prepared.parts.size();
  const std::uint64_t stride =
      1 + point_pairs / std::max<std::uint64_t>(1, options_.most_point_pairs);
  std::mutex mutex;
  std::size_t finished = 0;
  const auto compare_one = [&](std::size_t i) {
    if (options_.interrupted && options_.interrupted->load(std::memory_order_relaxed)) return;
    const Task& task = tasks_[i];
    const bool told = task.candidate != nullptr && !task.candidate->told.empty();
    if (report_.by_points && !(told && (i + options_.seed) % stride == 0)) {
      comparisons_[i].polygon = answer_.scene().polygons[task.entry.polygon].id;
      comparisons_[i].side = task.entry.side;
      comparisons_[i].fragments = task.candidate ? task.candidate->fragments.size() : 0;
      if (!told && (i + options_.seed) % stride == 0) {
        point_checks_[i] =
            check_points(answer_, task.light, task.entry, task.candidate, task.terms,
                         answer_.is_area(task.light) ? nullptr : &visibility.at(task.light),
                         options_.points_a_polygon, options_.seed);
      }
    } else if (!prove(i)) {
      comparisons_[i] =
          compare_entry(answer_, task.light, task.entry, task.candidate, task.terms, own_options);
    }
    done[i] = 1;
    const std::lock_guard lock(mutex);
    ++finished;
    if (options_.progress) {
      options_.progress(static_cast<double>(finished) / static_cast<double>(tasks_.size()));
    }
  };
  tbb::task_arena arena(options_.threads == 0 ? tbb::task_arena::automatic
                                              : static_cast<int>(options_.threads));
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, tasks_.size(), compare_one, tbb::simple_partitioner());
  });
  done_.assign(done.begin(), done.end());
  report_.interrupted = std::find(done_.begin(), done_.end(), false) != done_.end();
  if (!report_.interrupted) look_for_error();
}

bool Certifier::fails(const PolygonComparison& comparison) const {
  return fails_beyond_rounding(comparison) ||
         (options_.strict && (!comparison.rounding.zero || comparison.off_plane.upper > 0));
}

bool Certifier::fails_beyond_rounding(const PolygonComparison& comparison) const {
  // Shares have no loops that could round.
  if (comparison.told_shares > 0) return !comparison.judged_misclassified.zero;
  for (const AreaShare* share : {&comparison.judged_misclassified, &comparison.judged_uncovered,
                                 &comparison.judged_overlapping, &comparison.judged_outside}) {
    if (!share->zero && !(share->fraction.upper <= report_.tolerance)) return true;
  }
  return !(comparison.judged_width.upper <= report_.width) || is_off_plane(comparison);
}

bool Certifier::is_off_plane(const PolygonComparison& comparison) const {
  return !(comparison.judged_off_plane.upper <= report_.width);
}

/// What a failed candidate cannot help, at the polygon that decided.
void Certifier::tell_of_rounding() {
  const PolygonComparison* worst = nullptr;
  bool beyond = false;
  for (const LightComparison& light : report_.lights) {
    for (const PolygonComparison& own : light.polygons) {
      if (!fails(own)) continue;
      const bool own_beyond = fails_beyond_rounding(own);
      const auto width = [](const PolygonComparison& of) { return of.judged_width.upper; };
      if (!worst || (own_beyond && !beyond) ||
          (own_beyond == beyond && width(own) > width(*worst))) {
        worst = &own;
      }
      beyond = beyond || own_beyond;
    }
  }
  if (!worst) return;
  const double radius = worst->rounding_radius;
  const std::string where = fmt::format("polygon '{}'", worst->polygon);
  if (!beyond) {
    report_.reason = fmt::format(
        "failed by doubles' own rounding at this distance from the origin: all error is within "
        "{:.3g} of a border on {}",
        radius, where);
    return;
  }
  // A few roundings, one after the other: what a computation in doubles comes to at best.
  constexpr double kFew = 64;
  if (!(radius > 0) || worst->judged_width.upper > kFew * radius) return;
  report_.notes.push_back(fmt::format(
      "doubles' own rounding at this distance from the origin is {:.3g} on {}: what is so near a "
      "border is excused, error up to {:.3g} wide is not",
      radius, where, worst->judged_width.upper));
}

/// The number that is too large, of the polygon side where it is so most.
std::string Certifier::excess() const {
  std::string text;
  double worst = 0;
  const auto weigh = [&](double value, double limit, const auto& words) {
    if (value <= limit) return;
    const double ratio = limit > 0 ? value / limit : std::numeric_limits<double>::infinity();
    if (!text.empty() && !(ratio > worst)) return;
    worst = ratio;
    text = words();
  };
  for (const LightComparison& light : report_.lights) {
    for (const PolygonComparison& own : light.polygons) {
      if (!fails(own)) continue;
      const std::string where =
          fmt::format("light {}, polygon {} ({})", light.id, own.polygon, name_of(own.side));
      for (const auto& [share, what] : {std::pair{&own.judged_misclassified, "is misclassified"},
                                        {&own.judged_uncovered, "is not covered"},
                                        {&own.judged_overlapping, "is covered more than once"},
                                        {&own.judged_outside, "lies outside of it"}}) {
        weigh(share->zero ? 0 : share->fraction.upper, report_.tolerance,
              [&, what = what, share = share] {
                return fmt::format("{}: {:.3g} of it {}, more than {:.3g}", where,
                                   share->fraction.upper, what, report_.tolerance);
              });
      }
      weigh(own.judged_width.upper, report_.width, [&] {
        return fmt::format("{}: error {:.3g} wide, more than {:.3g}", where, own.judged_width.upper,
                           report_.width);
      });
      if (!is_off_plane(own)) continue;
      weigh(own.judged_off_plane.upper, report_.width, [&] {
        return fmt::format("{}: a vertex {:.3g} off its plane, more than {:.3g}", where,
                           own.judged_off_plane.upper, report_.width);
      });
    }
  }
  return text;
}

void Certifier::sum_up() {
  ComparisonTotals& totals = report_.totals;
  std::optional<std::pair<Block, std::uint32_t>> light;
  // The witness: of a polygon that fails before one that does not, then the widest.
  bool worst_fails = false;
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    const Block block = tasks_[i].terms.block;
    if (light != std::pair(block, tasks_[i].light)) {
      light = {block, tasks_[i].light};
      LightComparison& own = report_.lights.emplace_back();
      own.id = answer_.scene().lights[answer_.prepared().lights[light->second].light].id;
      own.block = block;
    }
    if (!done_[i]) continue;
    const PolygonComparison& own = comparisons_[i];
    ++totals.polygons;
    // What is true is counted once, however often it is told.
    if (block == tasks_.front().terms.block) {
      totals.area =
          totals.area + own.lit.area + own.shadow.area + own.penumbra.area + own.umbra.area;
      totals.lit = totals.lit + own.lit.area;
      totals.shadow = totals.shadow + own.shadow.area;
      totals.penumbra = totals.penumbra + own.penumbra.area;
      totals.umbra = totals.umbra + own.umbra.area;
    }
    totals.missing_umbra = totals.missing_umbra + own.missing_umbra.area;
    totals.misclassified = totals.misclassified + own.misclassified.area;
    totals.uncovered = totals.uncovered + own.uncovered.area;
    totals.overlapping = totals.overlapping + own.overlapping.area;
    totals.outside = totals.outside + own.outside.area;
    totals.ill_conditioned = totals.ill_conditioned + own.ill_conditioned.area;
    totals.rounding = totals.rounding + own.rounding.area;
    const auto raise = [](double& worst, const AreaShare& share) {
      worst = std::max(worst, share.fraction.upper);
    };
    raise(totals.worst_misclassified, own.misclassified);
    raise(totals.worst_uncovered, own.uncovered);
    raise(totals.worst_overlapping, own.overlapping);
    raise(totals.worst_outside, own.outside);
    totals.width = greater_of(totals.width, own.width);
    totals.off_plane = greater_of(totals.off_plane, own.off_plane);
    totals.fragments += own.fragments;
    report_.told_shares += own.told_shares;
    totals.regions += own.regions;
    totals.ill_conditioned_regions += own.ill_conditioned_regions;
    totals.rounding_regions += own.rounding_regions;
    totals.rounding_radius = std::max(totals.rounding_radius, own.rounding_radius);
    totals.invented += own.invented;
    totals.lost += own.lost;
    totals.t_vertices += own.t_vertices;
    totals.self_crossing += own.self_crossing;
    if (own.by_borders && !own.misclassified.zero) ++totals.by_borders;
    report_.oracle_fault = report_.oracle_fault || own.inconsistent;
    const PointCheck& points = point_checks_[i];
    report_.points_checked += points.checked;
    report_.points_wrong += points.wrong;
    report_.points_on_boundary += points.on_boundary;
    if (points.wrong > 0 && !report_.worst) report_.worst = points.worst;
    const bool wrong = own.regions > 0 || points.wrong > 0;
    if (wrong) ++totals.wrong_polygons;
    const bool own_fails = fails(own);
    if (!own.worst.empty()) {
      const Witness& witness = own.worst.front().witness;
      const bool wider = !report_.worst || witness.width.middle() > report_.worst->width.middle();
      if ((own_fails && !worst_fails) || (own_fails == worst_fails && wider)) {
        report_.worst = witness;
        worst_fails = own_fails;
      }
    }
    report_.lights.back().polygons.push_back(std::move(comparisons_[i]));
  }
}

void Certifier::judge() {
  bool identical = true, within = true;
  const PolygonComparison* off_plane = nullptr;
  for (const LightComparison& light : report_.lights) {
    for (const PolygonComparison& own : light.polygons) {
      identical = identical && own.misclassified.zero && own.uncovered.zero &&
                  own.overlapping.zero && own.outside.zero;
      within = within && !fails(own);
      if (is_off_plane(own) &&
          (!off_plane || own.judged_off_plane.upper > off_plane->judged_off_plane.upper)) {
        off_plane = &own;
      }
    }
  }
  const auto failed = [&](std::string reason) {
    report_.verdict = Verdict::kFailed;
    report_.reason = std::move(reason);
  };
  if (report_.oracle_fault) {
    failed("the oracle's overlay contradicts itself; this is a fault of the oracle");
  } else if (!report_.problems.empty()) {
    failed(report_.problems.front() +
           (report_.problems.size() > 1 ? fmt::format(" (and {} more)", report_.problems.size() - 1)
                                        : std::string()));
  } else if (report_.interrupted) {
    failed("interrupted before everything was compared");
  } else if (report_.points_wrong > 0) {
    failed(report_.worst ? report_.worst->text : "a point is wrong");
  } else if (options_.leaks && report_.totals.invented + report_.totals.lost > *options_.leaks) {
    failed(fmt::format("{} regions invented and {} lost, more than {} in all",
                       report_.totals.invented, report_.totals.lost, *options_.leaks));
  } else if (report_.told_shares > 0 && within) {
    report_.verdict = Verdict::kSharesAgree;
    note_shares();
  } else if (report_.by_points && within) {
    report_.verdict = Verdict::kWithinTolerance;
    report_.notes.push_back(fmt::format(
        "{} pairs of parts are above the limit of {}: {} exact points were compared instead",
        report_.pairs, report_.most_pairs, report_.points_checked));
  } else if (identical) {
    report_.verdict = Verdict::kIdentical;
  } else if (within) {
    report_.verdict = Verdict::kWithinTolerance;
  } else {
    report_.verdict = Verdict::kFailed;
    if (report_.worst && !(report_.totals.regions == 0)) {
      report_.reason = report_.worst->text;
    }
    if (report_.reason.empty() && off_plane) {
      report_.reason = fmt::format("a vertex on polygon '{}' is {:.3g} off its plane",
                                   off_plane->polygon, off_plane->judged_off_plane.upper);
    }
    report_.excess = excess();
    tell_of_rounding();
  }
}

void Certifier::note_shares() {
  const auto sides = std::ranges::count_if(
      tasks_, [](const Task& task) { return task.candidate && !task.candidate->told.empty(); });
  std::ptrdiff_t compared = 0;
  for (const LightComparison& light : report_.lights) {
    compared += std::ranges::count_if(
        light.polygons, [](const PolygonComparison& own) { return own.told_shares > 0; });
  }
  std::string note = "only shares are told, and they agree; where on the polygons is not known";
  if (compared < sides) {
    note +=
        fmt::format("; {} pairs of parts are above the limit of {}: {} of {} sides were compared",
                    report_.pairs, report_.most_pairs, compared, sides);
  }
  report_.notes.push_back(std::move(note));
}

Report Certifier::run() {
  report_.candidate = candidate_.name;
  report_.diagonal = scene_diagonal(answer_.prepared());
  report_.tolerance = options_.strict ? 0 : options_.tolerance;
  report_.width = options_.strict ? 0 : options_.width.value_or(1e-9 * report_.diagonal);
  report_.clearance = options_.clearance;
  report_.share_tolerance = options_.strict ? std::optional(0.0) : options_.share_tolerance;
  shared_ = shared_claims(candidate_, answer_.scene());
  if (!candidate_.lights.empty() || shared_.empty()) match_lights(candidate_, Block::kLights);
  for (const Claims& block : shared_) {
    tiled_.clear();
    match_lights(block, block.lights.empty() ? Block::kCombined : block.lights.front().block);
  }
  compare_all();
  sum_up();
  judge();
  return std::move(report_);
}

/// Every piece of a light against the answer of the scene in which it is a light.
Expected<Report> certify_pieces(const ExactAnswer& answer, const Claims& candidate,
                                CertifyOptions options) {
  const auto pieces = scene_of_pieces(answer.scene(), answer.prepared(), candidate);
  if (!pieces) return tl::unexpected(pieces.error());
  const std::vector<std::uint32_t> wanted = std::exchange(options.lights, {});
  for (std::uint32_t light = 0; light < pieces->source.size(); ++light) {
    if (wanted.empty() || std::ranges::find(wanted, pieces->source[light]) != wanted.end()) {
      options.lights.push_back(light);
    }
  }
  const ExactAnswer of_pieces(pieces->scene, pieces->prepared);
  return Certifier(of_pieces, candidate, options, pieces->gaps).run();
}

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kIdentical:
      return "identical";
    case Verdict::kWithinTolerance:
      return "within tolerance";
    case Verdict::kSharesAgree:
      return "shares agree";
    case Verdict::kFailed:
      return "failed";
  }
  return "";
}

double scene_diagonal(const PreparedScene& prepared) {
  std::array<double, 3> low{}, high{};
  bool first = true;
  for (VertexId vertex : prepared.loop_vertices) {
    const std::array<double, 3>& position = prepared.geometry.positions[vertex];
    for (int k = 0; k < 3; ++k) {
      low[k] = first ? position[k] : std::min(low[k], position[k]);
      high[k] = first ? position[k] : std::max(high[k], position[k]);
    }
    first = false;
  }
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

Expected<Report> certify(const ExactAnswer& answer, const Claims& candidate,
                         const CertifyOptions& options) {
  if (!(options.tolerance >= 0) || !(options.share_tolerance.value_or(0) >= 0)) {
    return fail(ErrorCode::kUsage, "tolerance is negative", "a fraction of at least 0");
  }
  if (options.width && !(*options.width >= 0)) {
    return fail(ErrorCode::kUsage, "width is negative", "scene units of at least 0");
  }
  if (!(options.clearance >= 0)) {
    return fail(ErrorCode::kUsage, "clearance is negative", "scene units of at least 0");
  }
  if (has_pieces(candidate)) return certify_pieces(answer, candidate, options);
  return Certifier(answer, candidate, options).run();
}

Expected<Report> certify(const Scene& scene, const PreparedScene& prepared, const Claims& candidate,
                         const CertifyOptions& options) {
  const ExactAnswer answer(scene, prepared);
  return certify(answer, candidate, options);
}

}  // namespace gnomon::oracle
