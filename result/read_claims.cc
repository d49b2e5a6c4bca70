// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/result/read_claims.h"

#include <fmt/format.h>
#include <rapidjson/document.h>
#include <rapidjson/error/en.h>
#include <rapidjson/memorystream.h>
#include <rapidjson/reader.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

namespace gnomon {

namespace {

using Json = rapidjson::Value;

// Numbers stay text; a mark tells them from strings. No JSON string can be mistaken for one, since
// every string gets the other mark.
constexpr char kNumberMark = 'n', kStringMark = 's';

/// Passes events on to a document, with numbers and strings as marked strings.
template <class Handler>
struct Marker {
  using Ch = char;
  Handler& handler;
  std::string buffer{};

  bool Marked(char mark, const char* text, rapidjson::SizeType length) {
    buffer.assign(1, mark);
    buffer.append(text, length);
    return handler.String(buffer.data(), static_cast<rapidjson::SizeType>(buffer.size()), true);
  }
  bool Null() { return handler.Null(); }
  bool Bool(bool value) { return handler.Bool(value); }
  bool Int(int value) { return handler.Int(value); }
  bool Uint(unsigned value) { return handler.Uint(value); }
  bool Int64(std::int64_t value) { return handler.Int64(value); }
  bool Uint64(std::uint64_t value) { return handler.Uint64(value); }
  bool Double(double value) { return handler.Double(value); }
  bool RawNumber(const char* text, rapidjson::SizeType length, bool) {
    return Marked(kNumberMark, text, length);
  }
  bool String(const char* text, rapidjson::SizeType length, bool) {
    return Marked(kStringMark, text, length);
  }
  bool StartObject() { return handler.StartObject(); }
  bool Key(const char* text, rapidjson::SizeType length, bool copy) {
    return handler.Key(text, length, copy);
  }
  bool EndObject(rapidjson::SizeType count) { return handler.EndObject(count); }
  bool StartArray() { return handler.StartArray(); }
  bool EndArray(rapidjson::SizeType count) { return handler.EndArray(count); }
};

struct Generator {
  std::string_view text;
  rapidjson::ParseResult result{};

  template <class Handler>
  bool operator()(Handler& handler) {
    Marker<Handler> marker{handler};
    rapidjson::MemoryStream stream(text.data(), text.size());
    rapidjson::Reader reader;
    // Iterative: a file nested a million deep is an error, not a stack overflow.
    result = reader.Parse<rapidjson::kParseNumbersAsStringsFlag | rapidjson::kParseIterativeFlag |
                          rapidjson::kParseValidateEncodingFlag>(stream, marker);
    return !result.IsError();
  }
};

class Reader {
 public:
  Reader(std::string file, const Scene& scene) : file_(std::move(file)), scene_(scene) {}

  Expected<Claims> read(std::string_view text);

 private:
  tl::unexpected<Error> wrong(ErrorCode code, const std::string& pointer, std::string what,
                              std::string expected = {}) const {
    return fail(code, std::move(what), std::move(expected), ErrorPlace{file_, 0, 0, pointer});
  }
  tl::unexpected<Error> wrong_place(std::string_view text, std::size_t offset,
                                    std::string what) const;
  Expected<const Json*> member(const Json& object, const char* key, bool required,
                               const std::string& pointer) const;
  Expected<std::string> text_of(const Json& value, const std::string& pointer) const;
  Expected<const Json*> list_of(const Json& object, const char* key, bool required,
                                const std::string& pointer) const;
  Expected<LightState> state_of(const Json& value, const std::string& pointer) const;
  Expected<ClaimedLight> light(const Json& value, const std::string& pointer) const;
  Expected<ClaimedPolygon> polygon(const Json& value, const std::string& pointer) const;
  Expected<ClaimedFragment> fragment(const Json& value, const std::string& pointer) const;
  Expected<mpq_class> coordinate(const Json& value, bool exact, const std::string& pointer) const;
  std::optional<mpq_class> fraction(const Json& polygon, const char* state) const;
  Expected<bool> per_caster(const Json& object, const std::string& pointer) const;

  std::string file_;
  const Scene& scene_;
};

/// [+-]digits[/digits], a positive denominator.
std::optional<mpq_class> parse_rational(std::string_view text) {
  const std::size_t slash = text.find('/');
  std::string_view over = text.substr(0, slash);
  if (!over.empty() && (over[0] == '-' || over[0] == '+')) over.remove_prefix(1);
  const std::string_view under =
      slash == std::string_view::npos ? std::string_view("1") : text.substr(slash + 1);
  const auto is_digits = [](std::string_view digits) {
    return !digits.empty() && digits.size() <= 1'000'000 &&
           digits.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (!is_digits(over) || !is_digits(under)) return std::nullopt;
  const mpz_class denominator{std::string(under), 10};
  if (denominator == 0) return std::nullopt;
  mpq_class value{mpz_class(std::string(over), 10), denominator};
  value.canonicalize();
  if (text[0] == '-') value = -value;
  return value;
}

tl::unexpected<Error> Reader::wrong_place(std::string_view text, std::size_t offset,
                                          std::string what) const {
  offset = std::min(offset, text.size());
  const std::string_view before = text.substr(0, offset);
  ErrorPlace place{file_, 0, 0, {}};
  place.line = 1 + static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t line_start = before.rfind('\n');
  place.column = line_start == std::string_view::npos ? offset + 1 : offset - line_start;
  return fail(ErrorCode::kSyntax, std::move(what), "a result in JSON, UTF-8", std::move(place));
}

Expected<const Json*> Reader::member(const Json& object, const char* key, bool required,
                                     const std::string& pointer) const {
  if (!object.IsObject()) {
    return wrong(ErrorCode::kFormat, pointer, "not an object", "an object");
  }
  const auto place = object.FindMember(key);
  if (place != object.MemberEnd()) return &place->value;
  if (!required) return nullptr;
  return wrong(ErrorCode::kFormat, pointer, fmt::format("key \"{}\" is missing", key));
}

Expected<std::string> Reader::text_of(const Json& value, const std::string& pointer) const {
  if (!value.IsString() || value.GetString()[0] != kStringMark) {
    return wrong(ErrorCode::kFormat, pointer, "not a string", "a string");
  }
  return std::string(value.GetString() + 1, value.GetStringLength() - 1);
}

Expected<const Json*> Reader::list_of(const Json& object, const char* key, bool required,
                                      const std::string& pointer) const {
  Expected<const Json*> found = member(object, key, required, pointer);
  if (found && *found && !(*found)->IsArray()) {
    return wrong(ErrorCode::kFormat, pointer + "/" + key, "not an array", "an array");
  }
  return found;
}

Expected<LightState> Reader::state_of(const Json& value, const std::string& pointer) const {
  Expected<std::string> text = text_of(value, pointer);
  if (!text) return tl::unexpected(text.error());
  if (const auto state = light_state_by_name(*text)) return *state;
  return wrong(ErrorCode::kFormat, pointer, fmt::format("unknown class \"{}\"", *text),
               "lit, shadow, penumbra or umbra");
}

Expected<mpq_class> Reader::coordinate(const Json& value, bool exact,
                                       const std::string& pointer) const {
  if (value.IsString()) {
    const std::string_view text(value.GetString() + 1, value.GetStringLength() - 1);
    if (value.GetString()[0] == kNumberMark) {
      Expected<Number> number = Number::parse(text, scene_.numbers);
      if (number) return number->exact();
      return wrong(number.error().code, pointer, number.error().what, number.error().expected);
    }
    if (exact) {
      if (std::optional<mpq_class> rational = parse_rational(text)) return *rational;
    }
  }
  return wrong(ErrorCode::kNumber, pointer, "not a coordinate",
               exact ? "a number, or a string \"p/q\"" : "a number");
}

std::optional<mpq_class> Reader::fraction(const Json& polygon, const char* state) const {
  const auto entry = polygon.FindMember(state);
  if (entry == polygon.MemberEnd() || !entry->value.IsObject()) return std::nullopt;
  const auto found = entry->value.FindMember("fraction");
  // A number is rounded and claims nothing exactly; a string does.
  if (found == entry->value.MemberEnd() || !found->value.IsString() ||
      found->value.GetString()[0] != kStringMark) {
    return std::nullopt;
  }
  return parse_rational(
      std::string_view(found->value.GetString() + 1, found->value.GetStringLength() - 1));
}

Expected<bool> Reader::per_caster(const Json& object, const std::string& pointer) const {
  const Expected<const Json*> umbra = member(object, "umbra", false, pointer);
  if (!umbra) return tl::unexpected(umbra.error());
  if (!*umbra) return false;
  const Expected<std::string> text = text_of(**umbra, pointer + "/umbra");
  if (!text) return tl::unexpected(text.error());
  if (*text == "per-caster") return true;
  return wrong(ErrorCode::kFormat, pointer + "/umbra", fmt::format("unknown meaning \"{}\"", *text),
               "\"per-caster\", or no such key");
}

Expected<ClaimedFragment> Reader::fragment(const Json& value, const std::string& pointer) const {
  ClaimedFragment result;
  const Expected<const Json*> state = member(value, "class", true, pointer);
  if (!state) return tl::unexpected(state.error());
  const Expected<LightState> known = state_of(**state, pointer + "/class");
  if (!known) return tl::unexpected(known.error());
  result.state = *known;
  Expected<const Json*> loop = list_of(value, "exact_loop", false, pointer);
  if (!loop) return tl::unexpected(loop.error());
  const char* key = "exact_loop";
  result.exact = *loop != nullptr;
  if (!*loop) {
    key = "loop";
    loop = list_of(value, key, true, pointer);
    if (!loop) return tl::unexpected(loop.error());
  }
  for (rapidjson::SizeType i = 0; i < (*loop)->Size(); ++i) {
    const Json& vertex = (**loop)[i];
    const std::string place = fmt::format("{}/{}/{}", pointer, key, i);
    if (!vertex.IsArray() || vertex.Size() != 3) {
      return wrong(ErrorCode::kFormat, place, "not a point", "three coordinates");
    }
    RationalPoint point;
    for (rapidjson::SizeType k = 0; k < 3; ++k) {
      const Expected<mpq_class> found =
          coordinate(vertex[k], result.exact, fmt::format("{}/{}", place, k));
      if (!found) return tl::unexpected(found.error());
      point[k] = *found;
    }
    result.loop.push_back(std::move(point));
  }
  for (const auto& [name, text] :
       {std::pair{"caster", &result.caster}, std::pair{"reason", &result.reason}}) {
    const Expected<const Json*> found = member(value, name, false, pointer);
    if (!found) return tl::unexpected(found.error());
    if (!*found || (*found)->IsNull()) continue;
    const Expected<std::string> own = text_of(**found, pointer + "/" + name);
    if (!own) return tl::unexpected(own.error());
    *text = *own;
  }
  return result;
}

Expected<ClaimedPolygon> Reader::polygon(const Json& value, const std::string& pointer) const {
  ClaimedPolygon result;
  const Expected<const Json*> id = member(value, "id", true, pointer);
  if (!id) return tl::unexpected(id.error());
  const Expected<std::string> text = text_of(**id, pointer + "/id");
  if (!text) return tl::unexpected(text.error());
  result.id = *text;
  const Expected<const Json*> side = member(value, "side", false, pointer);
  if (!side) return tl::unexpected(side.error());
  result.side_given = *side != nullptr;
  if (*side) {
    const Expected<std::string> name = text_of(**side, pointer + "/side");
    if (!name) return tl::unexpected(name.error());
    const std::optional<Side> known = side_by_name(*name);
    if (!known) {
      return wrong(ErrorCode::kFormat, pointer + "/side", fmt::format("unknown side \"{}\"", *name),
                   "front or back");
    }
    result.side = *known;
  }
  result.lit_fraction = fraction(value, "lit");
  result.shadow_fraction = fraction(value, "shadow");
  result.penumbra_fraction = fraction(value, "penumbra");
  result.umbra_fraction = fraction(value, "umbra");
  const Expected<const Json*> fragments = list_of(value, "fragments", false, pointer);
  if (!fragments) return tl::unexpected(fragments.error());
  if (!*fragments) {
    return wrong(ErrorCode::kFormat, pointer, "key \"fragments\" is missing",
                 "a result written with fragments");
  }
  for (rapidjson::SizeType i = 0; i < (*fragments)->Size(); ++i) {
    Expected<ClaimedFragment> own =
        fragment((**fragments)[i], fmt::format("{}/fragments/{}", pointer, i));
    if (!own) return tl::unexpected(own.error());
    result.fragments.push_back(std::move(*own));
  }
  return result;
}

Expected<ClaimedLight> Reader::light(const Json& value, const std::string& pointer) const {
  ClaimedLight result;
  const Expected<const Json*> id = member(value, "id", true, pointer);
  if (!id) return tl::unexpected(id.error());
  const Expected<std::string> text = text_of(**id, pointer + "/id");
  if (!text) return tl::unexpected(text.error());
  result.id = *text;
  const Expected<const Json*> background = member(value, "background", false, pointer);
  if (!background) return tl::unexpected(background.error());
  if (*background) {
    const Expected<LightState> state = state_of(**background, pointer + "/background");
    if (!state) return tl::unexpected(state.error());
    result.background = *state;
  }
  const Expected<bool> own_umbra = per_caster(value, pointer);
  if (!own_umbra) return tl::unexpected(own_umbra.error());
  result.per_caster_umbra = *own_umbra;
  const Expected<const Json*> polygons = list_of(value, "polygons", true, pointer);
  if (!polygons) return tl::unexpected(polygons.error());
  for (rapidjson::SizeType i = 0; i < (*polygons)->Size(); ++i) {
    Expected<ClaimedPolygon> own =
        polygon((**polygons)[i], fmt::format("{}/polygons/{}", pointer, i));
    if (!own) return tl::unexpected(own.error());
    result.polygons.push_back(std::move(*own));
  }
  return result;
}

Expected<Claims> Reader::read(std::string_view text) {
  if (text.empty()) return wrong_place(text, 0, "the file is empty");
  Generator generator{text};
  rapidjson::Document document;
  document.Populate(generator);
  if (generator.result.IsError()) {
    return wrong_place(text, generator.result.Offset(),
                       rapidjson::GetParseError_En(generator.result.Code()));
  }
  Claims result;
  result.name = file_;
  const Expected<const Json*> format = member(document, "format", false, "");
  if (!format) return tl::unexpected(format.error());
  if (*format) {
    const Expected<std::string> name = text_of(**format, "/format");
    if (!name) return tl::unexpected(name.error());
    if (*name != "gnomon-result") {
      return wrong(ErrorCode::kFormat, "/format", fmt::format("format is \"{}\"", *name),
                   "\"gnomon-result\"");
    }
  }
  const Expected<const Json*> background = member(document, "background", false, "");
  if (!background) return tl::unexpected(background.error());
  std::optional<LightState> for_all;
  if (*background) {
    const Expected<LightState> state = state_of(**background, "/background");
    if (!state) return tl::unexpected(state.error());
    for_all = *state;
  }
  const Expected<bool> per_caster_for_all = per_caster(document, "");
  if (!per_caster_for_all) return tl::unexpected(per_caster_for_all.error());
  const Expected<const Json*> lights = list_of(document, "lights", true, "");
  if (!lights) return tl::unexpected(lights.error());
  for (rapidjson::SizeType i = 0; i < (*lights)->Size(); ++i) {
    Expected<ClaimedLight> own = light((**lights)[i], fmt::format("/lights/{}", i));
    if (!own) return tl::unexpected(own.error());
    if (!own->background) own->background = for_all;
    own->per_caster_umbra = own->per_caster_umbra || *per_caster_for_all;
    result.lights.push_back(std::move(*own));
  }
  return result;
}

}  // namespace

Expected<Claims> parse_claims(std::string_view text, const std::string& file, const Scene& scene) {
  return Reader(file, scene).read(text);
}

Expected<Claims> read_claims(const std::string& path, const Scene& scene) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    return fail(ErrorCode::kFile, fmt::format("cannot be opened: {}", std::strerror(errno)), {},
                ErrorPlace{path, 0, 0, {}});
  }
  const std::string text((std::istreambuf_iterator<char>(stream)),
                         std::istreambuf_iterator<char>());
  if (stream.bad()) {
    return fail(ErrorCode::kFile, "cannot be read", {}, ErrorPlace{path, 0, 0, {}});
  }
  return parse_claims(text, path, scene);
}

}  // namespace gnomon
