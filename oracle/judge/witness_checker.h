// SPDX-License-Identifier: GPL-3.0-or-later
// The checker behind witness_check.h. What it needs of a polygon side is found in witness_check.cc;
// a side whose loops are all exact is then proved in integers (witness_proved.cc), or checked in
// rational numbers (witness_exact.cc), one with // rounded loops in the frame of its plane, within
// the tolerance (witness_rounded.cc).
#ifndef GNOMON_ORACLE_JUDGE_WITNESS_CHECKER_H
#define GNOMON_ORACLE_JUDGE_WITNESS_CHECKER_H

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gnomon/oracle/compare.h"
#include "gnomon/oracle/witness_check.h"
#include "oracle/geometry/rounding.h"
#include "oracle/judge/family_shades.h"
#include "oracle/judge/light_volumes.h"
#include "oracle/judge/side_proof.h"
#include "oracle/judge/witness_pieces.h"

namespace gnomon::oracle {

/// A convex piece of a rounded fragment in the frame of its plane, or of what none covers.
struct FlatPiece {
  const ClaimedFragment* fragment = nullptr;  // null: what none covers
  std::size_t index = 0;                      // of the fragment in its polygon
  PlanarLoop loop;                            // counter-clockwise
  std::vector<PlanarLine> lines;
  PlanarBox box;

  FlatPiece(const ClaimedFragment* claimed, std::size_t number, PlanarLoop own);
};

class WitnessChecker {
 public:
  WitnessChecker(const Scene& scene, const PreparedScene& prepared, const Claims& candidate,
                 const WitnessOptions& options);

  /// `problems`: that are known of the candidate.
  WitnessReport run(const std::vector<std::string>& problems = {});

 private:
  using Families = std::map<PlaneId, std::vector<std::uint32_t>>;
  using ClassSet = std::array<bool, 4>;  // by LightState
  using Loops = std::vector<PlanarLoop>;

  /// Coplanar parts of one polygon, and how its side is seen by the light.
  struct Family {
    const ClaimedPolygon& polygon;
    const std::vector<std::uint32_t>& parts;
    FamilyShades shades;
    long double radius = 0;  // of rounding; 0 if all loops are exact
    long double lost = 0;    // area that fragments which rounded to a line or a point may have had
  };
  /// The family whose plane a fragment is nearest to.
  struct Nearest {
    const std::vector<std::uint32_t>* parts = nullptr;  // none if there are no families
    PlaneId plane = 0;
    mpq_class distance;   // squared
    bool around = false;  // a part of it is around the fragment's middle
  };
  /// A piece of error that is no rounding, until the whole side is known.
  struct Excess {
    ErrorKind kind = ErrorKind::kMisclassified;
    long double area = 0;
    bool wide = false;  // than the comparison excuses
    std::string text;
    std::optional<std::uint64_t> fragment;
  };

  // What is where, and what is missing.
  void violation(const std::string& polygon, std::string text,
                 std::optional<std::uint64_t> fragment = {});
  void check_claims(const Claims& claims, Block block);
  void check_light(const ClaimedLight& light);
  /// Adds their sides, each once.
  void check_polygons(const std::vector<const ClaimedPolygon*>& polygons,
                      std::set<std::pair<std::string, Side>>& sides);
  void check_missing(const std::set<std::string>& polygons,
                     const std::set<std::pair<std::string, Side>>& sides);
  void check_polygon(const ClaimedPolygon& polygon);
  /// Of a polygon without fragments.
  void check_share(const ClaimedPolygon& polygon, std::uint32_t index);
  /// False, with the violation told, if nothing can be said of the fragment.
  bool can_be_judged(const ClaimedPolygon& polygon, std::size_t index);
  /// Parts whose plane a result lists on this side, by family; and others it may list there.
  Families families_on(std::uint32_t polygon, Side side, std::set<PlaneId>& optional) const;
  std::vector<Side> listed_sides(std::uint32_t polygon) const;
  /// The classes that what no fragment covers may have; nothing if fragments must cover everything.
  std::optional<ClassSet> left_out() const;
  /// Those that a fragment's class stands for, if it has no witness.
  std::optional<ClassSet> classes_without_witness(LightState state) const;
  bool is_wrong(LightState state, const ClassSet& allowed) const;
  bool is_told(LightState state) const;
  /// Whether this family's tiling is judged by these fragments, and not by others.
  bool tiles(const Family& family);
  bool shadow_reason_holds(std::uint32_t part, Side side, const ClaimedFragment& fragment) const;
  /// Of a fragment with rounded loops.
  bool is_outside_but_for_rounding(const Family& family, const ClaimedFragment& fragment) const;
  /// `behind`: all of the fragment is behind the light.
  bool area_reason_holds(const Family& family, const ClaimedFragment& fragment, bool behind);
  /// The caster that a fragment names; none, with the violation told, if the scene has none such.
  std::optional<std::uint32_t> named_caster(const ClaimedPolygon& polygon, std::size_t index);
  /// The caster that is to shadow a fragment under a point or directional light; none if its reason
  /// holds, or if what it says is wrong, with the violation told, or if it says nothing and need
  /// not.
  std::optional<std::uint32_t> caster_to_check(const Family& family,
                                               const ClaimedFragment& fragment, std::size_t index);
  /// Those that a fragment names to be its witness together. None, with the violation told, if the
  /// scene does not have one of them, or if none is named.
  std::vector<std::uint32_t> named_casters(const ClaimedPolygon& polygon, std::size_t index);
  bool is_facing(std::uint32_t part, Side side) const;
  bool is_facing(const Family& family) const {
    return is_facing(family.parts.front(), family.polygon.side);
  }
  bool has_all_parts(const Family& family) const;
  bool is_interrupted() const;
  bool stopped();
  void tell_progress();
  const std::string& id_of(std::uint32_t part) const {
    return scene_.polygons[prepared_.parts[part].polygon].id;
  }

  // All loops exact: nothing may be off by anything.
  bool is_exact(const ClaimedPolygon& polygon) const;
  /// By signs of integers: what usually holds is proved there, and only what is not is looked at in
  /// rational numbers. May be called from several threads. Requires: is_exact().
  bool is_proved(const ClaimedPolygon& polygon);
  /// Of the fragments in the plane of parts.
  bool is_proved(const ClaimedPolygon& polygon, const std::vector<std::uint32_t>& parts,
                 SideProof& proof) const;
  bool is_proved(const ClaimedFragment& fragment, std::size_t index, bool faces,
                 SideProof& proof) const;
  /// The plane that a fragment lies in; none if it lies in none or in several.
  std::optional<PlaneId> plane_of(const ClaimedFragment& fragment, const Families& families) const;
  void count_proved(const ClaimedPolygon& polygon);
  void check_exact_side(const ClaimedPolygon& polygon, const Families& families,
                        const std::set<PlaneId>& optional);
  Nearest nearest_family(const ClaimedFragment& fragment, const Families& families) const;
  Nearest distance_to(const ClaimedFragment& fragment, PlaneId plane,
                      const std::vector<std::uint32_t>& parts) const;
  /// A fragment in convex pieces; none, with the violation told, if it cannot be judged.
  std::vector<Piece> exact_pieces(const ClaimedPolygon& polygon, std::size_t index,
                                  const Nearest& family);
  void check_exact_family(Family& family, std::vector<Piece>& pieces);
  void check_exact_tiling(Family& family, std::vector<Piece>& pieces);
  void check_exact_overlaps(Family& family, std::vector<Piece>& pieces);
  bool overlap(Piece& a, Piece& b, const Family& family) const;
  /// All of a piece is on the outer side of the wall that the line is of, or on it.
  bool is_outside(const Piece& piece, const PlanarLine& line, const space::HalfSpace& wall,
                  const Family& family) const;
  bool is_inside(const Piece& piece, const PlanarLine& line, const space::HalfSpace& wall,
                 const Family& family) const;
  void check_exact_piece(Family& family, const Piece& piece);
  void check_exact_lit(Family& family, const Piece& piece);
  void check_exact_shade(Family& family, const Piece& piece);
  void check_exact_casters(Family& family, const Piece& piece);
  void check_exact_area_shade(Family& family, const Piece& piece);
  /// False, with the violation told, if a fragment that is not umbra sees less than it claims.
  bool is_seen_exactly(Family& family, const Piece& piece);
  /// Of a piece without a witness: that every point of it has one of the classes.
  void check_exact_classes(Family& family, const Piece& piece, const ClassSet& allowed);
  /// `rest`: the area that no piece covers.
  void check_exact_fractions(const Family& family, const std::vector<Piece>& pieces,
                             const mpq_class& rest);

  // Rounded loops: within the tolerance, and rounding excused.
  void check_rounded_side(const ClaimedPolygon& polygon, const Families& families,
                          const std::set<PlaneId>& optional);
  std::vector<FlatPiece> flat_pieces(const ClaimedPolygon& polygon, std::size_t index,
                                     Family& family);
  std::size_t nearest_of(const ClaimedFragment& fragment,
                         const std::vector<std::unique_ptr<Family>>& families) const;
  void check_rounded_family(Family& family, std::vector<FlatPiece>& pieces);
  void check_rounded_tiling(Family& family, const std::vector<FlatPiece>& pieces);
  void check_rounded_overlaps(Family& family, std::vector<FlatPiece>& pieces);
  void check_rounded_piece(Family& family, const FlatPiece& piece);
  void check_rounded_outside(Family& family, const FlatPiece& piece);
  void check_rounded_lit(Family& family, const FlatPiece& piece, Shades& shades, const char* text);
  void check_rounded_shade(Family& family, const FlatPiece& piece);
  void check_rounded_area_shade(Family& family, const FlatPiece& piece);
  bool is_seen_roughly(Family& family, const FlatPiece& piece);
  /// What of loops no part of the casters hides.
  void check_hidden(Family& family, const FlatPiece& piece, Loops loops,
                    std::span<const std::uint32_t> casters, Shades& shades,
                    const std::function<std::string()>& text);
  std::array<Loops, 4> loops_of_classes(Family& family, const PlanarLoop& loop);  // by LightState
  void check_rounded_classes(Family& family, const FlatPiece& piece, const ClassSet& allowed,
                             const std::vector<FlatPiece>& pieces);
  void check_rounded_fractions(const Family& family, const std::vector<FlatPiece>& pieces,
                               long double rest);
  /// Error that is no rounding is kept until the side is settled. `more`: borders besides those of
  /// the piece.
  void add_error(const Family& family, const FlatPiece& piece, ErrorKind kind, const Loops& error,
                 const std::string& text, std::vector<Border> more = {});
  std::vector<Border> borders_of(const Family& family, const FlatPiece& piece) const;
  /// Tells of all that is above the tolerance on a side of that area.
  void settle(const ClaimedPolygon& polygon, long double area);

  const Scene& scene_;
  const PreparedScene& prepared_;
  const Claims& candidate_;
  const WitnessOptions& options_;
  double diagonal_ = 0, width_ = 0;
  bool exact_ = false;  // all loops of the candidate claim to be, or have to be
  std::map<std::string, std::uint32_t> polygon_index_;
  std::string light_id_;
  std::optional<LightVolumes> light_;
  ClaimedTerms terms_;  // of the light
  // First part and side of the families whose tiling by shared fragments is judged: once each.
  std::set<std::pair<std::uint32_t, Side>> tiled_;
  std::vector<Excess> excesses_;  // of the side
  std::size_t polygons_ = 0;      // for the progress
  std::atomic<std::size_t> polygons_done_ = 0;
  WitnessReport report_;
};

}  // namespace gnomon::oracle

#endif  // GNOMON_ORACLE_JUDGE_WITNESS_CHECKER_H
