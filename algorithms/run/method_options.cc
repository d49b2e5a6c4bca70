// SPDX-License-Identifier: LGPL-3.0-or-later
// The table of options of methods, and the words of `--algorithm`.
#include "gnomon/algorithms/method_options.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

namespace gnomon {

namespace {

constexpr std::uint32_t kMostTiles = 1024, kMostRows = 32768;

/// Reads one of the words into `value`.
template <class T, std::size_t N>
bool read_word(T& value, std::string_view text, const std::pair<std::string_view, T> (&words)[N]) {
  for (const auto& [word, meaning] : words) {
    if (word != text) continue;
    value = meaning;
    return true;
  }
  return false;
}

std::string on_or_off(bool value) { return value ? "on" : "off"; }
bool read_switch(bool& value, std::string_view text) {
  return read_word<bool>(value, text, {{"on", true}, {"off", false}});
}

/// A whole number from 1 to `most`.
bool read_number(std::uint32_t& value, std::string_view text, std::uint32_t most) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  if (number < 1 || number > most) return false;
  value = number;
  return true;
}

/// A distance, at most so large that planes at it are on some grid.
bool read_distance(double& value, std::string_view text) {
  constexpr double kMost = 1e15;
  double distance = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), distance);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  if (!(distance >= 0 && distance <= kMost)) return false;
  value = distance;
  return true;
}
std::string distance_text(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

constexpr std::array kOptions = {
    MethodOption{
        .name = "caps",
        .values = "on|off",
        .summary = "volumes end behind the last receiver that they may reach",
        .read = [](MethodOptionValues& v, std::string_view t) { return read_switch(v.caps, t); },
        .text = [](const MethodOptionValues& v) { return on_or_off(v.caps); }},
    MethodOption{.name = "casters",
                 .values = "polygons|solids",
                 .summary = "closed convex solids cast polygon by polygon, or as wholes",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<CastersAre>(
                           v.casters, t,
                           {{"polygons", CastersAre::kPolygons}, {"solids", CastersAre::kSolids}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.casters == CastersAre::kPolygons ? "polygons"
                                                                             : "solids");
                     }},
    MethodOption{
        .name = "cells",
        .values = "on|off",
        .summary = "clip in the cells of a k-d tree of light space",
        .read = [](MethodOptionValues& v, std::string_view t) { return read_switch(v.cells, t); },
        .text = [](const MethodOptionValues& v) { return on_or_off(v.cells); }},
    MethodOption{.name = "count",
                 .values = "eye|z-pass|z-fail",
                 .summary = "where walls are counted from: right from the eye alone, unless "
                            "z-fail has no far plane",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<WallCount>(v.count, t,
                                                   {{"eye", WallCount::kFromEye},
                                                    {"z-pass", WallCount::kZPass},
                                                    {"z-fail", WallCount::kZFail}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.count == WallCount::kFromEye ? "eye"
                                          : v.count == WallCount::kZPass ? "z-pass"
                                                                         : "z-fail");
                     }},
    MethodOption{.name = "cover",
                 .values = "partition|overlay",
                 .summary = "fragments that tile a polygon, or shadows painted over it",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       const std::optional<Cover> cover = cover_by_name(t);
                       if (cover) v.cover = *cover;
                       return cover.has_value();
                     },
                 .text = [](const MethodOptionValues& v) { return std::string(name_of(v.cover)); }},
    MethodOption{.name = "depth",
                 .values = "hidden|facing",
                 .summary = "which faces of an object tell its distance: those that the light does "
                            "not see, as the paper has it, or those that it sees",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<TableDepth>(
                           v.depth, t,
                           {{"hidden", TableDepth::kHidden}, {"facing", TableDepth::kFacing}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.depth == TableDepth::kHidden ? "hidden" : "facing");
                     }},
    MethodOption{.name = "edges",
                 .values = "own|all",
                 .summary = "which edges of a fragment become nodes: its own, or all, as in a "
                            "program that does not know what cut it",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<EdgesInTree>(
                           v.edges, t, {{"own", EdgesInTree::kOwn}, {"all", EdgesInTree::kAll}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.edges == EdgesInTree::kOwn ? "own" : "all");
                     }},
    MethodOption{
        .name = "far",
        .values = "0..1e15",
        .summary = "with z-fail: the plane beyond which no wall is drawn, scene units; 0: none",
        .read = [](MethodOptionValues& v, std::string_view t) { return read_distance(v.far, t); },
        .text = [](const MethodOptionValues& v) { return distance_text(v.far); }},
    MethodOption{
        .name = "hemisphere",
        .values = "one|cube",
        .summary =
            "directions in a table: on one side of the light, or all of them in six pyramids",
        .read =
            [](MethodOptionValues& v, std::string_view t) {
              return read_word<Hemisphere>(
                  v.hemisphere, t, {{"one", Hemisphere::kOne}, {"cube", Hemisphere::kCube}});
            },
        .text =
            [](const MethodOptionValues& v) {
              return std::string(v.hemisphere == Hemisphere::kOne ? "one" : "cube");
            }},
    MethodOption{
        .name = "interleaved",
        .values = "on|off",
        .summary = "receivers go down trees that still grow, in the order of a scene BSP from the "
                   "light's centroid",
        .read = [](MethodOptionValues& v,
                   std::string_view t) { return read_switch(v.interleaved, t); },
        .text = [](const MethodOptionValues& v) { return on_or_off(v.interleaved); }},
    MethodOption{.name = "interpolate",
                 .values = "plane|linear",
                 .summary = "the distance of a face between its edges: by its plane, or linear in "
                            "the angle, which is not exact",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<Interpolation>(
                           v.interpolation, t,
                           {{"plane", Interpolation::kPlane}, {"linear", Interpolation::kLinear}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.interpolation == Interpolation::kPlane ? "plane"
                                                                                   : "linear");
                     }},
    MethodOption{.name = "merge",
                 .values = "siblings|convex|off",
                 .summary = "which fragments become one: children of a split, also neighbours that "
                            "are convex together, none",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<MergeOf>(v.merge, t,
                                                 {{"siblings", MergeOf::kSiblings},
                                                  {"convex", MergeOf::kConvex},
                                                  {"off", MergeOf::kNone}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.merge == MergeOf::kSiblings ? "siblings"
                                          : v.merge == MergeOf::kConvex ? "convex"
                                                                        : "off");
                     }},
    MethodOption{
        .name = "near",
        .values = "0..1e15",
        .summary = "with z-pass: the plane before which no wall is drawn, scene units; 0: none",
        .read = [](MethodOptionValues& v, std::string_view t) { return read_distance(v.near, t); },
        .text = [](const MethodOptionValues& v) { return distance_text(v.near); }},
    MethodOption{
        .name = "neighbours",
        .values = "on|off",
        .summary = "also count by the walls next in depth alone, and tell how often that is wrong",
        .read = [](MethodOptionValues& v,
                   std::string_view t) { return read_switch(v.neighbours, t); },
        .text = [](const MethodOptionValues& v) { return on_or_off(v.neighbours); }},
    MethodOption{.name = "order",
                 .values = "near|file|far",
                 .summary = "which polygons are inserted first: a heuristic",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<InsertionOrder>(v.order, t,
                                                        {{"near", InsertionOrder::kNearFirst},
                                                         {"file", InsertionOrder::kFile},
                                                         {"far", InsertionOrder::kFarFirst}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.order == InsertionOrder::kNearFirst ? "near"
                                          : v.order == InsertionOrder::kFile    ? "file"
                                                                                : "far");
                     }},
    MethodOption{
        .name = "lazy",
        .values = "on|off",
        .summary = "lists of possible casters are made of visible polygons alone",
        .read = [](MethodOptionValues& v, std::string_view t) { return read_switch(v.lazy, t); },
        .text = [](const MethodOptionValues& v) { return on_or_off(v.lazy); }},
    MethodOption{.name = "light-order",
                 .values = "file|facing|moving",
                 .summary = "of lights together: as given, fewest facing polygons first, or those "
                            "that move last",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<LightOrder>(v.light_order, t,
                                                    {{"file", LightOrder::kFile},
                                                     {"facing", LightOrder::kFacing},
                                                     {"moving", LightOrder::kMoving}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.light_order == LightOrder::kFile     ? "file"
                                          : v.light_order == LightOrder::kFacing ? "facing"
                                                                                 : "moving");
                     }},
    MethodOption{.name = "lists",
                 .values = "all|sectors|tiles",
                 .summary = "who is asked for the list of a polygon's possible casters: all "
                            "polygons, those in the same sectors or in the same tiles of what the "
                            "light sees",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<ListsBy>(v.lists, t,
                                                 {{"all", ListsBy::kAll},
                                                  {"sectors", ListsBy::kSectors},
                                                  {"tiles", ListsBy::kTiles}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.lists == ListsBy::kAll       ? "all"
                                          : v.lists == ListsBy::kSectors ? "sectors"
                                                                         : "tiles");
                     }},
    MethodOption{
        .name = "grow",
        .values = "polygons|fragments",
        .summary = "what trees of lights together grow from: the polygons, or what earlier "
                   "lights left of them",
        .read =
            [](MethodOptionValues& v, std::string_view t) {
              return read_word<GrowFrom>(
                  v.grow, t,
                  {{"polygons", GrowFrom::kPolygons}, {"fragments", GrowFrom::kFragments}});
            },
        .text =
            [](const MethodOptionValues& v) {
              return std::string(v.grow == GrowFrom::kPolygons ? "polygons" : "fragments");
            }},
    MethodOption{.name = "outlines",
                 .values = "partial|whole",
                 .summary = "what a solid that is partly in shadow adds to the blots: the outlines "
                            "of what of it is lit, or its own",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<Outlines>(
                           v.outlines, t,
                           {{"partial", Outlines::kPartial}, {"whole", Outlines::kWhole}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.outlines == Outlines::kPartial ? "partial" : "whole");
                     }},
    MethodOption{.name = "pairing",
                 .values = "peaks|signed",
                 .summary = "crossings of loops and rows become spans from the peaks of loops "
                            "downwards, or by their sum",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<Pairing>(
                           v.pairing, t,
                           {{"peaks", Pairing::kPeaks}, {"signed", Pairing::kSigned}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.pairing == Pairing::kPeaks ? "peaks" : "signed");
                     }},
    MethodOption{
        .name = "prune",
        .values = "on|off",
        .summary = "covered polygons cast nothing, volumes inside a later one are dropped",
        .read = [](MethodOptionValues& v, std::string_view t) { return read_switch(v.prune, t); },
        .text = [](const MethodOptionValues& v) { return on_or_off(v.prune); }},
    MethodOption{
        .name = "roots",
        .values = "chosen|fed|outside",
        .summary = "of the scene BSP: chosen for few splits, the first of each subtree in "
                   "order of input, or that which reaches farthest out",
        .read =
            [](MethodOptionValues& v, std::string_view t) {
              return read_word<Roots>(
                  v.roots, t,
                  {{"chosen", Roots::kChosen}, {"fed", Roots::kFed}, {"outside", Roots::kOutside}});
            },
        .text =
            [](const MethodOptionValues& v) {
              return std::string(v.roots == Roots::kChosen ? "chosen"
                                 : v.roots == Roots::kFed  ? "fed"
                                                           : "outside");
            }},
    MethodOption{
        .name = "sectors",
        .values = "on|off",
        .summary = "keep the blots in the cells of a k-d tree of light space",
        .read = [](MethodOptionValues& v, std::string_view t) { return read_switch(v.sectors, t); },
        .text = [](const MethodOptionValues& v) { return on_or_off(v.sectors); }},
    MethodOption{.name = "rows",
                 .values = "1..32768|exact",
                 .summary = "of the angular table: samples near borders are wrong, fewer the more "
                            "rows; or exact, by what lies between two vertices",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       if (t != "exact") return read_number(v.rows, t, kMostRows);
                       v.rows = MethodOptionValues::kExactRows;
                       return true;
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return v.rows == MethodOptionValues::kExactRows ? std::string("exact")
                                                                       : std::to_string(v.rows);
                     }},
    MethodOption{.name = "split",
                 .values = "axis|contour",
                 .summary = "what splits cells: values of an axis, or planes through edges of the "
                            "contour",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<CellSplit>(
                           v.split, t,
                           {{"axis", CellSplit::kAxis}, {"contour", CellSplit::kContour}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.split == CellSplit::kAxis ? "axis" : "contour");
                     }},
    MethodOption{.name = "tiles",
                 .values = "1..1024",
                 .summary = "rows and columns of tiles on each face of the cube",
                 .read = [](MethodOptionValues& v,
                            std::string_view t) { return read_number(v.tiles, t, kMostTiles); },
                 .text = [](const MethodOptionValues& v) { return std::to_string(v.tiles); }},
    MethodOption{.name = "volumes",
                 .values = "chain|polygons",
                 .summary = "walls at the contour of all facing polygons, or around each of them",
                 .read =
                     [](MethodOptionValues& v, std::string_view t) {
                       return read_word<VolumesOf>(
                           v.volumes, t,
                           {{"chain", VolumesOf::kChain}, {"polygons", VolumesOf::kPolygons}});
                     },
                 .text =
                     [](const MethodOptionValues& v) {
                       return std::string(v.volumes == VolumesOf::kChain ? "chain" : "polygons");
                     }},
};

std::string joined(std::span<const std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

}  // namespace

const MethodOption* method_option(std::string_view name) {
  const auto found = std::ranges::find(kOptions, name, &MethodOption::name);
  return found == kOptions.end() ? nullptr : &*found;
}

Expected<MethodSelection> parse_method(std::string_view text, Domain domain) {
  const std::size_t colon = text.find(':');
  const std::string name(text.substr(0, colon));
  const std::optional<MethodId> id = method_by_name(name, domain);
  if (!id) {
    const Domain other =
        domain == Domain::kObjectSpace ? Domain::kImageSpace : Domain::kObjectSpace;
    if (method_by_name(name, other)) {
      return fail(ErrorCode::kUsage, name + " works in " + std::string(name_of(other)),
                  domain == Domain::kObjectSpace ? "gnomon pixels, which samples a picture; here "
                                                   "one of: " +
                                                       method_names({true, true})
                                                 : "one of: " + method_names({true, true}, domain));
    }
    return fail(ErrorCode::kUsage, name + ": no such algorithm",
                "one of: " + method_names({.point = true, .area = true}, domain));
  }
  MethodSelection selection;
  selection.id = *id;
  const Method& method = method_info(*id);
  std::string_view rest = colon == std::string_view::npos ? "" : text.substr(colon + 1);
  if (colon != std::string_view::npos && (rest.empty() || rest.ends_with(','))) {
    return fail(ErrorCode::kUsage, std::string(text) + ": an option is missing at its end",
                name + ":option=value,...");
  }
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    const std::string_view item = rest.substr(0, comma);
    rest = comma == std::string_view::npos ? "" : rest.substr(comma + 1);
    const std::size_t equals = item.find('=');
    const std::string option_name(item.substr(0, equals));
    if (std::ranges::find(method.options, option_name) == method.options.end()) {
      return fail(ErrorCode::kUsage,
                  std::string(text) + ": " + name + " has no option '" + option_name + "'",
                  method.options.empty() ? "no options" : "one of: " + joined(method.options));
    }
    const MethodOption& option = *method_option(option_name);
    const std::string_view value = equals == std::string_view::npos ? "" : item.substr(equals + 1);
    if (!option.read(selection.values, value)) {
      return fail(
          ErrorCode::kUsage,
          std::string(text) + ": '" + std::string(value) + "' is no value of " + option_name,
          std::string(option.values));
    }
  }
  return selection;
}

std::string method_text(MethodId id, const MethodOptionValues& values) {
  const Method& method = method_info(id);
  const MethodOptionValues defaults;
  std::string text(method.name);
  char before = ':';
  for (const std::string_view name : method.options) {
    const MethodOption& option = *method_option(name);
    const std::string value = option.text(values);
    if (value == option.text(defaults)) continue;
    text += before + std::string(name) + '=' + value;
    before = ',';
  }
  return text;
}

}  // namespace gnomon
