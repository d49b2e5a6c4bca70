// SPDX-License-Identifier: LGPL-3.0-or-later
// The options of methods: `--algorithm NAME[:option=value,...]`. No option changes a class or an
// area, but for `count` of shadow-polygons, which shows where graphics hardware is wrong, and for
// `rows` and `interpolation` of ridge-edges, which show what a table of rows costs; they change the
// work, and how the answer is put out.
#ifndef GNOMON_ALGORITHMS_METHOD_OPTIONS_H
#define GNOMON_ALGORITHMS_METHOD_OPTIONS_H

#include <cstdint>
#include <string>
#include <string_view>

#include "gnomon/algorithms/method.h"
#include "gnomon/kernel/error.h"
#include "gnomon/result/classes.h"

namespace gnomon {

/// The order in which polygons are inserted where no answer depends on it.
enum class InsertionOrder : std::uint8_t { kNearFirst, kFile, kFarFirst };

/// The order of lights in a pipeline: as they are given; those that fewest polygons face first; or
/// those that move last, and the others so.
enum class LightOrder : std::uint8_t { kFile, kFacing, kMoving };

/// What the shadow volume trees of lights together grow from: the polygons, or the fragments of
/// them that earlier lights have left.
enum class GrowFrom : std::uint8_t { kPolygons, kFragments };

/// What shadow volumes are made of: one of all facing polygons together, with walls at the contour
/// alone, or one of each polygon.
enum class VolumesOf : std::uint8_t { kChain, kPolygons };

/// Where the count of shadow volumes along a ray begins, and with what: with those that hold the
/// eye; with none at the eye or the near plane (z-pass); with those at infinity, or none at the far
/// plane (z-fail).
enum class WallCount : std::uint8_t { kFromEye, kZPass, kZFail };

/// What splits the cells of light space: values of an axis of their chart, or planes through edges
/// of the contour (Sutherland, as Crow 1977 tells of him).
enum class CellSplit : std::uint8_t { kAxis, kContour };

/// What casts: polygons one by one, or closed convex solids as wholes and other polygons one by
/// one.
enum class CastersAre : std::uint8_t { kPolygons, kSolids };

/// Which fragments become one again: the two children of a split; also neighbours that make a
/// convex loop together, whatever split them (Chin & Feiner 1989, sec. 6; Slater 1992, figure 6);
/// none.
enum class MergeOf : std::uint8_t { kSiblings, kConvex, kNone };

/// Which piece becomes the root of a subtree of the scene BSP: of a few that are tried the one that
/// splits least and balances best; the first in the order of input, as polygons are fed to it; or
/// the one whose polygon reaches farthest out (Slater 1992, sec. 6, feeds them so, more or less).
enum class Roots : std::uint8_t { kChosen, kFed, kOutside };

/// Which edges of a fragment become nodes of a tree: those that it has from the scene, or all of
/// them, as in a program that does not know which plane made which edge.
enum class EdgesInTree : std::uint8_t { kOwn, kAll };

/// Who is asked for the list of possible casters of a polygon: all, those in the same leaves of a
/// tree of outlines as the light sees them, or those in the same tiles.
enum class ListsBy : std::uint8_t { kAll, kSectors, kTiles };

/// What a sub-object that is partly in shadow adds to the blots: the outlines of what of it is lit,
/// as Crow (1977) has it, or its whole outline, which then overlaps the blots before it.
enum class Outlines : std::uint8_t { kPartial, kWhole };

/// How crossings of a ridge loop with a row of the angular table become spans: each arc of the loop
/// above the row is a pair, found from its peaks downwards (Thakur, Cheng & Miura, section 3.2), or
/// all crossings are sorted and their senses summed.
enum class Pairing : std::uint8_t { kPeaks, kSigned };

/// Which faces of an object tell how far away it is: those that the light does not see, as the
/// paper has it (section 3.3), or those that it sees.
enum class TableDepth : std::uint8_t { kHidden, kFacing };

/// How the distance of a face is found between its two edges in a row: by its plane, or linear in
/// the angle, as the paper allows for small spans.
enum class Interpolation : std::uint8_t { kPlane, kLinear };

/// How much of all directions tables hold: those on one side of the light, or all of them in six
/// pyramids.
enum class Hemisphere : std::uint8_t { kOne, kCube };

/// Each method reads its own of them (Method::options).
struct MethodOptionValues {
  Cover cover = Cover::kPartition;
  bool prune = true;          // basic, tiling: covered targets cast nothing, volumes may die
  std::uint32_t tiles = 128;  // tiling: so many rows and columns on each face
  InsertionOrder order = InsertionOrder::kNearFirst;  // svbsp-full, zbuffer, ridge-edges
  Roots roots = Roots::kChosen;                       // basic, tiling, svbsp
  bool cells = true;                                  // two-pass: in cells of light space
  CellSplit split = CellSplit::kAxis;                 // sectors
  // svbsp, of lights together:
  LightOrder light_order = LightOrder::kFile;
  GrowFrom grow = GrowFrom::kPolygons;
  // shadow-polygons:
  VolumesOf volumes = VolumesOf::kChain;
  WallCount count = WallCount::kFromEye;
  bool neighbours = false;   // also by those next in depth alone
  double near = 0, far = 0;  // planes that clip walls, scene units from the eye; 0: none
  CastersAre casters = CastersAre::kPolygons;  // receiver, merged
  MergeOf merge = MergeOf::kSiblings;          // svbsp
  EdgesInTree edges = EdgesInTree::kOwn;       // svbsp
  ListsBy lists = ListsBy::kSectors;           // scan-out
  bool lazy = false;                           // scan-out: lists of visible polygons alone
  bool interleaved = false;                    // merged: receivers go down trees that still grow
  bool caps = false;                           // merged: volumes end behind their last receiver
  // blots:
  bool sectors = true;  // the blots and what is to come in cells of light space
  Outlines outlines = Outlines::kPartial;
  // ridge-edges:
  static constexpr std::uint32_t kExactRows = 0;  // no rows: what lies between two vertices
  std::uint32_t rows = 600;                       // of the angular table, or kExactRows
  Pairing pairing = Pairing::kPeaks;
  TableDepth depth = TableDepth::kHidden;
  Interpolation interpolation = Interpolation::kPlane;
  Hemisphere hemisphere = Hemisphere::kOne;
  friend bool operator==(const MethodOptionValues&, const MethodOptionValues&) = default;
};

/// A row of the table of options.
struct MethodOption {
  std::string_view name;     // such as "tiles"
  std::string_view values;   // what it takes, such as "1..1024"
  std::string_view summary;  // a clause
  /// Reads a value; false if it is none of `values`.
  bool (*read)(MethodOptionValues& values, std::string_view text) = nullptr;
  std::string (*text)(const MethodOptionValues& values) = nullptr;
};
/// Null if there is no such option.
const MethodOption* method_option(std::string_view name);

struct MethodSelection {
  MethodId id = MethodId::kAutomatic;
  MethodOptionValues values;
  friend bool operator==(const MethodSelection&, const MethodSelection&) = default;
};

/// NAME[:option=value,...], a method of this domain. Errors: kUsage: no such method (the names that
/// there are), one of the other domain, no such option of it, a value that it does not take.
Expected<MethodSelection> parse_method(std::string_view text, Domain domain = Domain::kObjectSpace);
/// The name, with the options that are not at their defaults.
std::string method_text(MethodId id, const MethodOptionValues& values);

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_METHOD_OPTIONS_H
