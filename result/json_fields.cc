// SPDX-License-Identifier: LGPL-3.0-or-later
#include "result/json_fields.h"

#include <fmt/format.h>
#include <rapidjson/error/en.h>
#include <rapidjson/memorystream.h>
#include <rapidjson/reader.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <numeric>
#include <utility>

namespace gnomon {

namespace {

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

}  // namespace

namespace {

constexpr std::size_t kShortDigits = 18;  // below 2^60

/// Requires: digits alone, at most kShortDigits.
std::uint64_t short_number(std::string_view digits) {
  std::uint64_t value = 0;
  for (const char digit : digits) value = 10 * value + static_cast<std::uint64_t>(digit - '0');
  return value;
}

bool is_digits(std::string_view text) {
  return !text.empty() && text.size() <= 1'000'000 &&
         std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::optional<mpq_class> parse_rational(std::string_view text) {
  const std::size_t slash = text.find('/');
  std::string_view over = text.substr(0, slash);
  if (!over.empty() && (over[0] == '-' || over[0] == '+')) over.remove_prefix(1);
  const std::string_view under =
      slash == std::string_view::npos ? std::string_view("1") : text.substr(slash + 1);
  if (!is_digits(over) || !is_digits(under)) return std::nullopt;
  std::optional<mpq_class> value(std::in_place);
  if (over.size() <= kShortDigits && under.size() <= kShortDigits) {
    const std::uint64_t numerator = short_number(over), denominator = short_number(under);
    if (denominator == 0) return std::nullopt;
    const std::uint64_t common = denominator == 1 ? 1 : std::gcd(numerator, denominator);
    mpq_set_ui(value->get_mpq_t(), numerator / common, denominator / common);
  } else {
    value->get_num() = mpz_class(std::string(over), 10);
    value->get_den() = mpz_class(std::string(under), 10);
    if (value->get_den() == 0) return std::nullopt;
    value->canonicalize();
  }
  if (text[0] == '-') mpq_neg(value->get_mpq_t(), value->get_mpq_t());
  return value;
}

tl::unexpected<Error> JsonFields::wrong(ErrorCode code, const std::string& pointer,
                                        std::string what, std::string expected) const {
  return fail(code, std::move(what), std::move(expected), ErrorPlace{file_, 0, 0, pointer});
}

Expected<void> JsonFields::parse(std::string_view text, rapidjson::Document& document) const {
  if (text.empty()) return wrong_place(text, 0, "the file is empty");
  Generator generator{text};
  document.Populate(generator);
  if (!generator.result.IsError()) return {};
  return wrong_place(text, generator.result.Offset(),
                     rapidjson::GetParseError_En(generator.result.Code()));
}

Expected<std::string> JsonFields::read_file(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    return fail(ErrorCode::kFile, fmt::format("cannot be opened: {}", std::strerror(errno)), {},
                ErrorPlace{path, 0, 0, {}});
  }
  std::string text;
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  do {
    const std::size_t size = text.size();
    text.resize(size + kBlock);
    stream.read(text.data() + size, static_cast<std::streamsize>(kBlock));
    text.resize(size + static_cast<std::size_t>(stream.gcount()));
  } while (stream);
  if (stream.bad()) {
    return fail(ErrorCode::kFile, "cannot be read", {}, ErrorPlace{path, 0, 0, {}});
  }
  return text;
}

tl::unexpected<Error> JsonFields::wrong_place(std::string_view text, std::size_t offset,
                                              std::string what) const {
  offset = std::min(offset, text.size());
  const std::string_view before = text.substr(0, offset);
  ErrorPlace place{file_, 0, 0, {}};
  place.line = 1 + static_cast<std::uint64_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t line_start = before.rfind('\n');
  place.column = line_start == std::string_view::npos ? offset + 1 : offset - line_start;
  return fail(ErrorCode::kSyntax, std::move(what), "a result in JSON, UTF-8", std::move(place));
}

Expected<const Json*> JsonFields::member(const Json& object, const char* key, bool required,
                                         const std::string& pointer) const {
  if (!object.IsObject()) {
    return wrong(ErrorCode::kFormat, pointer, "not an object", "an object");
  }
  const auto place = object.FindMember(key);
  if (place != object.MemberEnd()) return &place->value;
  if (!required) return nullptr;
  return wrong(ErrorCode::kFormat, pointer, fmt::format("key \"{}\" is missing", key));
}

Expected<std::string> JsonFields::text(const Json& value, const std::string& pointer) const {
  if (!value.IsString() || value.GetString()[0] != kStringMark) {
    return wrong(ErrorCode::kFormat, pointer, "not a string", "a string");
  }
  return std::string(value.GetString() + 1, value.GetStringLength() - 1);
}

Expected<const Json*> JsonFields::list(const Json& object, const char* key, bool required,
                                       const std::string& pointer) const {
  Expected<const Json*> found = member(object, key, required, pointer);
  if (found && *found && !(*found)->IsArray()) {
    return wrong(ErrorCode::kFormat, pointer + "/" + key, "not an array", "an array");
  }
  return found;
}

Expected<LightState> JsonFields::state(const Json& value, const std::string& pointer) const {
  const Expected<std::string> name = text(value, pointer);
  if (!name) return tl::unexpected(name.error());
  if (const auto state = light_state_by_name(*name)) return *state;
  return wrong(ErrorCode::kFormat, pointer, fmt::format("unknown class \"{}\"", *name),
               "lit, shadow, penumbra or umbra");
}

Expected<mpq_class> JsonFields::coordinate(const Json& value, bool exact) const {
  if (value.IsString()) {
    const std::string_view text(value.GetString() + 1, value.GetStringLength() - 1);
    if (value.GetString()[0] == kNumberMark) {
      Expected<Number> number = Number::parse(text, numbers_);
      if (number) return number->exact();
      return wrong(number.error().code, {}, number.error().what, number.error().expected);
    }
    if (exact) {
      if (std::optional<mpq_class> rational = parse_rational(text)) return std::move(*rational);
    }
  }
  return wrong(ErrorCode::kNumber, {}, "not a coordinate",
               exact ? "a number, or a string \"p/q\"" : "a number");
}

Expected<std::string> JsonFields::text_member(const Json& object, const char* key,
                                              const std::string& pointer) const {
  const Expected<const Json*> found = member(object, key, true, pointer);
  if (!found) return tl::unexpected(found.error());
  return text(**found, pointer + '/' + key);
}

Expected<std::string> JsonFields::optional_text(const Json& object, const char* key,
                                                const std::string& pointer) const {
  const Expected<const Json*> found = member(object, key, false, pointer);
  if (!found) return tl::unexpected(found.error());
  if (!*found || (*found)->IsNull()) return std::string();
  return text(**found, pointer + '/' + key);
}

Expected<std::vector<std::string>> JsonFields::texts(const Json& object, const char* key,
                                                     bool required,
                                                     const std::string& pointer) const {
  const Expected<const Json*> found = list(object, key, required, pointer);
  if (!found) return tl::unexpected(found.error());
  std::vector<std::string> result;
  for (rapidjson::SizeType i = 0; *found && i < (*found)->Size(); ++i) {
    Expected<std::string> own = text((**found)[i], fmt::format("{}/{}/{}", pointer, key, i));
    if (!own) return tl::unexpected(own.error());
    result.push_back(std::move(*own));
  }
  return result;
}

Expected<std::optional<std::int64_t>> JsonFields::whole_number(const Json& object, const char* key,
                                                               std::int64_t least, bool required,
                                                               const std::string& pointer) const {
  const Expected<const Json*> found = member(object, key, required, pointer);
  if (!found) return tl::unexpected(found.error());
  if (!*found) return std::optional<std::int64_t>();
  constexpr std::int64_t kMost = std::int64_t{1} << 53;
  if ((*found)->IsString() && (*found)->GetString()[0] == kNumberMark) {
    const std::string_view digits((*found)->GetString() + 1, (*found)->GetStringLength() - 1);
    const std::optional<mpq_class> value = parse_rational(digits);
    if (value && *value >= mpq_class(static_cast<long>(least)) &&
        *value <= mpq_class(static_cast<long>(kMost))) {
      return std::optional<std::int64_t>(value->get_num().get_si());
    }
  }
  return wrong(ErrorCode::kNumber, pointer + '/' + key, "not a whole number in its range",
               fmt::format("a whole number of at least {}", least));
}

Expected<std::optional<LightState>> JsonFields::optional_state(const Json& object, const char* key,
                                                               const std::string& pointer) const {
  const Expected<const Json*> found = member(object, key, false, pointer);
  if (!found) return tl::unexpected(found.error());
  if (!*found) return std::optional<LightState>();
  const Expected<LightState> own = state(**found, pointer + '/' + key);
  if (!own) return tl::unexpected(own.error());
  return std::optional<LightState>(*own);
}

Expected<RationalLoop> JsonFields::loop(const Json& array, bool exact,
                                        const std::string& pointer) const {
  RationalLoop result;
  if (!array.IsArray()) return wrong(ErrorCode::kFormat, pointer, "not an array", "an array");
  result.resize(array.Size());
  for (rapidjson::SizeType i = 0; i < array.Size(); ++i) {
    const Json& vertex = array[i];
    if (!vertex.IsArray() || vertex.Size() != 3) {
      return wrong(ErrorCode::kFormat, fmt::format("{}/{}", pointer, i), "not a point",
                   "three coordinates");
    }
    for (rapidjson::SizeType k = 0; k < 3; ++k) {
      Expected<mpq_class> found = coordinate(vertex[k], exact);
      if (!found) {
        // The place is put together only where it is told.
        found.error().where.pointer = fmt::format("{}/{}/{}", pointer, i, k);
        return tl::unexpected(found.error());
      }
      result[i][k] = std::move(*found);
    }
  }
  return result;
}

Expected<ClaimedShape> JsonFields::shape(const Json& object, const std::string& pointer) const {
  ClaimedShape result;
  Expected<const Json*> outer = list(object, "exact_loop", false, pointer);
  if (!outer) return tl::unexpected(outer.error());
  result.exact = *outer != nullptr;
  const std::string key = result.exact ? "exact_loop" : "loop";
  if (!result.exact) {
    outer = list(object, "loop", true, pointer);
    if (!outer) return tl::unexpected(outer.error());
  }
  Expected<RationalLoop> own = loop(**outer, result.exact, pointer + '/' + key);
  if (!own) return tl::unexpected(own.error());
  result.loop = std::move(*own);
  const char* holes_key = result.exact ? "exact_holes" : "holes";
  const Expected<const Json*> holes = list(object, holes_key, false, pointer);
  if (!holes) return tl::unexpected(holes.error());
  for (rapidjson::SizeType i = 0; *holes && i < (*holes)->Size(); ++i) {
    Expected<RationalLoop> hole =
        loop((**holes)[i], result.exact, fmt::format("{}/{}/{}", pointer, holes_key, i));
    if (!hole) return tl::unexpected(hole.error());
    result.holes.push_back(std::move(*hole));
  }
  return result;
}

std::optional<mpq_class> JsonFields::fraction(const Json& polygon, const char* state) const {
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

std::string_view JsonFields::number_text(const Json& value) {
  if (!value.IsString() || value.GetString()[0] != kNumberMark) return {};
  return {value.GetString() + 1, value.GetStringLength() - 1};
}

std::string_view JsonFields::string_text(const Json& value) {
  if (!value.IsString() || value.GetString()[0] != kStringMark) return {};
  return {value.GetString() + 1, value.GetStringLength() - 1};
}

std::string JsonFields::form_of(const Json& value) {
  constexpr std::size_t kMostText = 40, kMostKeys = 6;
  if (value.IsNull()) return "null";
  if (value.IsBool()) return value.GetBool() ? "true" : "false";
  if (value.IsArray()) return "an array";
  if (value.IsString()) {
    const std::string text(value.GetString() + 1, value.GetStringLength() - 1);
    const std::string start = text.size() > kMostText ? text.substr(0, kMostText) + "..." : text;
    return value.GetString()[0] == kNumberMark ? "the number " + start
                                               : "the text \"" + start + '"';
  }
  if (value.MemberCount() == 0) return "an empty object";
  std::string keys;
  std::size_t count = 0;
  for (const auto& member : value.GetObject()) {
    if (++count > kMostKeys) return "an object with " + keys + ", ...";
    keys += fmt::format("{}\"{}\"", keys.empty() ? "" : ", ", member.name.GetString());
  }
  return "an object with " + keys;
}

}  // namespace gnomon
