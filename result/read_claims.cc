// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/result/read_claims.h"

#include <fmt/format.h>

#include <algorithm>

#include "result/json_fields.h"
#include "result/told_shares.h"

namespace gnomon {

namespace {

class Reader {
 public:
  Reader(const std::string& file, const Scene& scene, SharesAlone shares)
      : fields_(file, scene.numbers), shares_(shares) {
    result_.name = file;
  }

  Expected<Claims> read(std::string_view text);

 private:
  /// What a light says of all its polygons; at the top it is said of all lights.
  Expected<void> terms(const Json& object, const std::string& pointer, ClaimedLight& light) const;
  Expected<ClaimedLight> light(const Json& value, const ClaimedLight& for_all,
                               const std::string& pointer) const;
  /// "id" and "side".
  template <class OnePolygon>
  Expected<void> side(const Json& value, const std::string& pointer, OnePolygon& polygon) const;
  Expected<ClaimedPolygon> polygon(const Json& value, const std::string& pointer) const;
  Expected<ClaimedFragment> fragment(const Json& value, const std::string& pointer) const;
  Expected<std::optional<std::vector<SharedPolygon>>> shared(const Json& document,
                                                             Block block) const;
  Expected<SharedFragment> shared_fragment(const Json& value, Block block,
                                           const std::string& pointer) const;

  /// Of a polygon without fragments.
  Expected<void> told_shares(const Json& value, const std::string& pointer,
                             ClaimedPolygon& polygon) const;
  /// What a file that is no result is, as far as its first characters tell.
  Expected<void> check_form(std::string_view text) const;

  JsonFields fields_;
  SharesAlone shares_;
  Claims result_;
};

Expected<ClaimedFragment> Reader::fragment(const Json& value, const std::string& pointer) const {
  ClaimedFragment result;
  const Expected<const Json*> state = fields_.member(value, "class", true, pointer);
  if (!state) return tl::unexpected(state.error());
  const Expected<LightState> known = fields_.state(**state, pointer + "/class");
  if (!known) return tl::unexpected(known.error());
  result.state = *known;
  Expected<ClaimedShape> shape = fields_.shape(value, pointer);
  if (!shape) return tl::unexpected(shape.error());
  static_cast<ClaimedShape&>(result) = std::move(*shape);
  for (const auto& [name, text] :
       {std::pair{"caster", &result.caster}, std::pair{"reason", &result.reason}}) {
    Expected<std::string> own = fields_.optional_text(value, name, pointer);
    if (!own) return tl::unexpected(own.error());
    *text = std::move(*own);
  }
  Expected<std::vector<std::string>> casters = fields_.texts(value, "casters", false, pointer);
  if (!casters) return tl::unexpected(casters.error());
  result.casters = std::move(*casters);
  return result;
}

template <class OnePolygon>
Expected<void> Reader::side(const Json& value, const std::string& pointer,
                            OnePolygon& polygon) const {
  const Expected<std::string> id = fields_.text_member(value, "id", pointer);
  if (!id) return tl::unexpected(id.error());
  polygon.id = *id;
  const Expected<const Json*> side = fields_.member(value, "side", false, pointer);
  if (!side) return tl::unexpected(side.error());
  polygon.side_given = *side != nullptr;
  if (!*side) return {};
  const Expected<std::string> name = fields_.text(**side, pointer + "/side");
  if (!name) return tl::unexpected(name.error());
  const std::optional<Side> known = side_by_name(*name);
  if (!known) {
    return fields_.wrong(ErrorCode::kFormat, pointer + "/side",
                         fmt::format("unknown side \"{}\"", *name), "front or back");
  }
  polygon.side = *known;
  return {};
}

Expected<ClaimedPolygon> Reader::polygon(const Json& value, const std::string& pointer) const {
  ClaimedPolygon result;
  if (const auto read = side(value, pointer, result); !read) return tl::unexpected(read.error());
  result.lit_fraction = fields_.fraction(value, "lit");
  result.shadow_fraction = fields_.fraction(value, "shadow");
  result.penumbra_fraction = fields_.fraction(value, "penumbra");
  result.umbra_fraction = fields_.fraction(value, "umbra");
  const Expected<const Json*> fragments = fields_.list(value, "fragments", false, pointer);
  if (!fragments) return tl::unexpected(fragments.error());
  if (!*fragments) {
    if (const auto read = told_shares(value, pointer, result); !read) {
      return tl::unexpected(read.error());
    }
    return result;
  }
  result.fragments.reserve((*fragments)->Size());
  for (rapidjson::SizeType i = 0; i < (*fragments)->Size(); ++i) {
    Expected<ClaimedFragment> own =
        fragment((**fragments)[i], fmt::format("{}/fragments/{}", pointer, i));
    if (!own) return tl::unexpected(own.error());
    own->level = i;
    result.fragments.push_back(std::move(*own));
  }
  return result;
}

Expected<void> Reader::told_shares(const Json& value, const std::string& pointer,
                                   ClaimedPolygon& polygon) const {
  if (shares_ == SharesAlone::kRefused) {
    return fields_.wrong(
        ErrorCode::kFormat, pointer, "key \"fragments\" is missing",
        "a result written with --fragments; shares alone are judged by 'gnomon certify "
        "--candidate'");
  }
  auto shares = read_told_shares(fields_, value, pointer);
  if (!shares) return tl::unexpected(shares.error());
  if (shares->empty()) {
    return fields_.wrong(ErrorCode::kFormat, pointer,
                         JsonFields::form_of(value) + " has neither fragments nor shares",
                         "\"fragments\", or \"lit\", \"shadow\", \"penumbra\" or \"umbra\"");
  }
  polygon.told = std::move(*shares);
  return {};
}

Expected<void> Reader::terms(const Json& object, const std::string& pointer,
                             ClaimedLight& light) const {
  const auto background = fields_.optional_state(object, "background", pointer);
  if (!background) return tl::unexpected(background.error());
  if (*background) light.background = *background;

  const Expected<std::string> umbra = fields_.optional_text(object, "umbra", pointer);
  if (!umbra) return tl::unexpected(umbra.error());
  if (!umbra->empty() && *umbra != "per-caster") {
    return fields_.wrong(ErrorCode::kFormat, pointer + "/umbra",
                         fmt::format("unknown meaning \"{}\"", *umbra),
                         "\"per-caster\", or no such key");
  }
  light.per_caster_umbra = light.per_caster_umbra || !umbra->empty();

  const Expected<std::string> cover = fields_.optional_text(object, "cover", pointer);
  if (!cover) return tl::unexpected(cover.error());
  if (!cover->empty()) {
    const std::optional<Cover> known = cover_by_name(*cover);
    if (!known) {
      return fields_.wrong(ErrorCode::kFormat, pointer + "/cover",
                           fmt::format("unknown cover \"{}\"", *cover), "partition or overlay");
    }
    light.cover = *known;
  }

  const Expected<const Json*> listed = fields_.list(object, "listed", false, pointer);
  if (!listed) return tl::unexpected(listed.error());
  if (!*listed) return {};
  light.listed.emplace();
  for (rapidjson::SizeType i = 0; i < (*listed)->Size(); ++i) {
    const Expected<LightState> state =
        fields_.state((**listed)[i], fmt::format("{}/listed/{}", pointer, i));
    if (!state) return tl::unexpected(state.error());
    light.listed->push_back(*state);
  }
  return {};
}

Expected<ClaimedLight> Reader::light(const Json& value, const ClaimedLight& for_all,
                                     const std::string& pointer) const {
  ClaimedLight result = for_all;
  Expected<std::string> id = fields_.text_member(value, "id", pointer);
  if (!id) return tl::unexpected(id.error());
  result.id = std::move(*id);
  if (const auto read = terms(value, pointer, result); !read) return tl::unexpected(read.error());
  if (result.background && result.listed) {
    return fields_.wrong(ErrorCode::kFormat, pointer, "both a background and listed classes",
                         "the class of all that no fragment covers, or the classes that are told");
  }
  if (result.cover == Cover::kOverlay && !result.background) {
    return fields_.wrong(ErrorCode::kFormat, pointer, "key \"background\" is missing",
                         "with an overlay, the class of what no loop holds");
  }
  Expected<std::string> piece_of = fields_.optional_text(value, "piece_of", pointer);
  if (!piece_of) return tl::unexpected(piece_of.error());
  result.piece_of = std::move(*piece_of);
  if (!result.piece_of.empty()) {
    Expected<ClaimedShape> piece = fields_.shape(value, pointer);
    if (!piece) return tl::unexpected(piece.error());
    result.piece_loop = std::move(piece->loop);
  }
  const Expected<const Json*> polygons = fields_.list(value, "polygons", true, pointer);
  if (!polygons) return tl::unexpected(polygons.error());
  result.polygons.reserve((*polygons)->Size());
  for (rapidjson::SizeType i = 0; i < (*polygons)->Size(); ++i) {
    Expected<ClaimedPolygon> own =
        polygon((**polygons)[i], fmt::format("{}/polygons/{}", pointer, i));
    if (!own) return tl::unexpected(own.error());
    result.polygons.push_back(std::move(*own));
  }
  result.shares_alone =
      !result.polygons.empty() &&
      std::ranges::none_of(result.polygons, [](const auto& own) { return own.told.empty(); });
  return result;
}

Expected<SharedFragment> Reader::shared_fragment(const Json& value, Block block,
                                                 const std::string& pointer) const {
  SharedFragment result;
  Expected<ClaimedShape> shape = fields_.shape(value, pointer);
  if (!shape) return tl::unexpected(shape.error());
  static_cast<ClaimedShape&>(result) = std::move(*shape);
  const bool combined = block == Block::kCombined;
  using Key = std::tuple<const char*, bool, std::vector<std::string>*>;
  const std::vector<Key> keys = combined
                                    ? std::vector<Key>{{"lit_by", true, &result.lit_by},
                                                       {"penumbra_of", false, &result.penumbra_of}}
                                    : std::vector<Key>{{"dark_for", true, &result.dark_for}};
  for (const auto& [key, required, ids] : keys) {
    Expected<std::vector<std::string>> own = fields_.texts(value, key, required, pointer);
    if (!own) return tl::unexpected(own.error());
    *ids = std::move(*own);
  }
  if (combined) return result;
  const auto level = fields_.whole_number(value, "level", 0, true, pointer);
  if (!level) return tl::unexpected(level.error());
  result.level = static_cast<std::uint64_t>(**level);
  const auto on = fields_.whole_number(value, "on", -1, false, pointer);
  if (!on) return tl::unexpected(on.error());
  if (*on && **on >= 0) result.on = static_cast<std::size_t>(**on);
  return result;
}

Expected<std::optional<std::vector<SharedPolygon>>> Reader::shared(const Json& document,
                                                                   Block block) const {
  const char* key = name_of(block);
  const Expected<const Json*> polygons = fields_.list(document, key, false, "");
  if (!polygons) return tl::unexpected(polygons.error());
  std::optional<std::vector<SharedPolygon>> result;
  if (!*polygons) return result;
  result.emplace();
  const char* list = block == Block::kCombined ? "fragments" : "painted";
  for (rapidjson::SizeType i = 0; i < (*polygons)->Size(); ++i) {
    const Json& value = (**polygons)[i];
    const std::string pointer = fmt::format("/{}/{}", key, i);
    SharedPolygon own;
    if (const auto read = side(value, pointer, own); !read) return tl::unexpected(read.error());
    const Expected<const Json*> fragments = fields_.list(value, list, true, pointer);
    if (!fragments) return tl::unexpected(fragments.error());
    for (rapidjson::SizeType f = 0; f < (*fragments)->Size(); ++f) {
      Expected<SharedFragment> one =
          shared_fragment((**fragments)[f], block, fmt::format("{}/{}/{}", pointer, list, f));
      if (!one) return tl::unexpected(one.error());
      own.fragments.push_back(std::move(*one));
    }
    result->push_back(std::move(own));
  }
  return result;
}

Expected<void> Reader::check_form(std::string_view text) const {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos) return {};
  const std::string_view line = text.substr(start, text.find('\n', start) - start);
  std::string form;
  if (line.find("Surface Name") != std::string_view::npos) {
    form = "a table of surfaces by time (CSV)";
  } else if (line.starts_with("light,") && line.find("visible") != std::string_view::npos) {
    form = "a table of samples (CSV)";
  } else if (line[0] == '<') {
    form = "XML or HTML";
  } else if (result_.name.ends_with(".csv") && line[0] != '{') {
    form = "a table (CSV)";
  }
  if (form.empty()) return {};
  return fields_.wrong(ErrorCode::kFormat, {}, "this is " + form, "a result in JSON, UTF-8");
}

Expected<Claims> Reader::read(std::string_view text) {
  if (const auto known = check_form(text); !known) return tl::unexpected(known.error());
  rapidjson::Document document;
  if (const auto parsed = fields_.parse(text, document); !parsed) {
    return tl::unexpected(parsed.error());
  }
  const Expected<const Json*> format = fields_.member(document, "format", false, "");
  if (!format) return tl::unexpected(format.error());
  if (*format) {
    const Expected<std::string> name = fields_.text(**format, "/format");
    if (!name) return tl::unexpected(name.error());
    if (*name != "gnomon-result") {
      return fields_.wrong(ErrorCode::kFormat, "/format", fmt::format("format is \"{}\"", *name),
                           "\"gnomon-result\"");
    }
  }
  for (const auto& [block, claims] : {std::pair{Block::kCombined, &result_.combined},
                                      std::pair{Block::kOverlay, &result_.overlay}}) {
    auto read = shared(document, block);
    if (!read) return tl::unexpected(read.error());
    *claims = std::move(*read);
  }
  ClaimedLight for_all;
  if (const auto read = terms(document, "", for_all); !read) return tl::unexpected(read.error());
  const bool required = !result_.combined && !result_.overlay;
  if (required && !document.HasMember("lights")) {
    return fields_.wrong(ErrorCode::kFormat, "", "key \"lights\" is missing",
                         "a result; this is " + JsonFields::form_of(document));
  }
  const Expected<const Json*> lights = fields_.list(document, "lights", false, "");
  if (!lights) return tl::unexpected(lights.error());
  for (rapidjson::SizeType i = 0; *lights && i < (*lights)->Size(); ++i) {
    Expected<ClaimedLight> own = light((**lights)[i], for_all, fmt::format("/lights/{}", i));
    if (!own) return tl::unexpected(own.error());
    result_.lights.push_back(std::move(*own));
  }
  finish_told_shares(result_.lights);
  return std::move(result_);
}

}  // namespace

Expected<Claims> parse_claims(std::string_view text, const std::string& file, const Scene& scene,
                              SharesAlone shares) {
  return Reader(file, scene, shares).read(text);
}

Expected<Claims> read_claims(const std::string& path, const Scene& scene, SharesAlone shares) {
  const auto text = JsonFields::read_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_claims(*text, path, scene, shares);
}

}  // namespace gnomon
