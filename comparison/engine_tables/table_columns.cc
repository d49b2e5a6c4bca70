// SPDX-License-Identifier: GPL-3.0-or-later
#include "comparison/engine_tables/table_columns.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "scene/files/usable_id.h"

namespace gnomon::comparison {

namespace {

constexpr std::string_view kBack = "#back", kGross = "#gross";

/// Letters of ASCII alone, as EnergyPlus compares names.
std::string folded(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  });
  return text;
}

/// As an id of a polygon, with what names one of its sides after it.
std::string usable_side_name(std::string_view name) {
  for (const std::string_view ending : {kBack, kGross}) {
    if (!name.ends_with(ending)) continue;
    return usable_id(name.substr(0, name.size() - ending.size())) + std::string(ending);
  }
  return usable_id(name);
}

struct NamedSide {
  TableSide side;
  std::string name;
  std::optional<std::uint32_t> column;
};

std::vector<NamedSide> sides_of(const Scene& scene) {
  std::vector<NamedSide> sides;
  for (std::uint32_t i = 0; i < scene.polygons.size(); ++i) {
    const Polygon& polygon = scene.polygons[i];
    const auto add = [&](const TableSide& side) {
      sides.push_back({side, side_name(scene, side), {}});
    };
    add({i, Side::kFront});
    if (scene.is_two_sided(polygon)) add({i, Side::kBack});
    if (!polygon.holes.empty()) add({i, Side::kFront, true});
  }
  return sides;
}

class Matching {
 public:
  Matching(const std::vector<std::string>& names, const Scene& scene)
      : names_(&names), sides_(sides_of(scene)), found_(names.size()) {}

  /// Gives the columns that have no side yet the sides that have no column, by the name that
  /// `name_of` makes of each, where one of each kind alone has that name.
  template <class NameOfColumn, class NameOfSide>
  void match(NameOfColumn name_of_column, NameOfSide name_of_side) {
    struct Named {
      std::optional<std::size_t> side;
      std::optional<std::uint32_t> column;
      bool several = false;
    };
    std::unordered_map<std::string, Named> known;
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      if (sides_[i].column) continue;
      Named& named = known[name_of_side(sides_[i].name)];
      named.several = named.several || named.side;
      named.side = i;
    }
    for (std::uint32_t column = 0; column < names_->size(); ++column) {
      if (found_[column]) continue;
      const auto place = known.find(name_of_column((*names_)[column]));
      if (place == known.end()) continue;
      place->second.several = place->second.several || place->second.column;
      place->second.column = column;
    }
    for (const auto& [name, named] : known) {
      if (named.several || !named.column || !named.side) continue;
      sides_[*named.side].column = named.column;
      found_[*named.column] = *named.side;
    }
  }

  TableColumns result() const {
    TableColumns columns;
    for (std::uint32_t column = 0; column < found_.size(); ++column) {
      if (!found_[column]) {
        columns.unknown.push_back(column);
        continue;
      }
      columns.matched.push_back({sides_[*found_[column]].side, column});
    }
    for (const NamedSide& side : sides_) {
      if (!side.column && !side.side.gross) columns.untold.push_back(side.side);
    }
    return columns;
  }

 private:
  const std::vector<std::string>* names_;
  std::vector<NamedSide> sides_;
  std::vector<std::optional<std::size_t>> found_;  // by column: the side
};

}  // namespace

std::string side_name(const Scene& scene, const TableSide& side) {
  const std::string& id = scene.polygons[side.polygon].id;
  return id + std::string(side.gross                 ? kGross
                          : side.side == Side::kBack ? kBack
                                                     : std::string_view());
}

TableColumns match_columns(const std::vector<std::string>& names, const Scene& scene) {
  const auto same = [](const std::string& name) { return name; };
  const auto as_side = [](const std::string& name) { return folded(usable_side_name(name)); };
  const auto mirrored = [](const std::string& name) {
    constexpr std::string_view kMirrored = "MIR-";
    std::string text = folded(usable_side_name(name));
    return text.starts_with(kMirrored) ? text.substr(kMirrored.size()) + folded(std::string(kBack))
                                       : std::string();
  };
  Matching matching(names, scene);
  matching.match(same, same);
  matching.match(usable_side_name, same);
  matching.match(as_side, folded);
  matching.match(mirrored, folded);
  return matching.result();
}

}  // namespace gnomon::comparison
