// SPDX-License-Identifier: GPL-3.0-or-later
#include "targets/result_shares.h"

#include <fmt/format.h>
#include <rapidjson/document.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "scene/base/text_hash.h"

namespace gnomon::bench {
namespace {

using Json = rapidjson::Value;

/// Results leave out bounds that are closer together than this.
constexpr double kUnwritten = 1e-12;

const Json* member(const Json& object, const char* key) {
  if (!object.IsObject()) return nullptr;
  const auto found = object.FindMember(key);
  return found == object.MemberEnd() ? nullptr : &found->value;
}

std::optional<std::string> text_of(const Json& object, const char* key) {
  const Json* value = member(object, key);
  if (value == nullptr || !value->IsString()) return std::nullopt;
  return std::string(value->GetString(), value->GetStringLength());
}

std::optional<ResultShare> share_of(const Json& polygon) {
  const Json* lit = member(polygon, "lit");
  const Json* fraction = lit == nullptr ? nullptr : member(*lit, "fraction");
  if (fraction == nullptr) return std::nullopt;
  ResultShare share;
  if (fraction->IsString()) {
    share.exact = fraction->GetString();
    return share;
  }
  if (!fraction->IsNumber()) return std::nullopt;
  share.lower = fraction->GetDouble() - kUnwritten;
  share.upper = fraction->GetDouble() + kUnwritten;
  const Json* enclosure = member(*lit, "enclosure");
  if (enclosure == nullptr) return share;
  if (!enclosure->IsArray() || enclosure->Size() != 2 || !(*enclosure)[0].IsNumber() ||
      !(*enclosure)[1].IsNumber()) {
    return std::nullopt;
  }
  share.lower = (*enclosure)[0].GetDouble();
  share.upper = (*enclosure)[1].GetDouble();
  return share;
}

bool add_light(const Json& light, ResultShares& shares) {
  const std::optional<std::string> name = text_of(light, "id");
  const Json* polygons = member(light, "polygons");
  if (!name || polygons == nullptr || !polygons->IsArray()) return false;
  for (const Json& polygon : polygons->GetArray()) {
    const auto id = text_of(polygon, "id"), side = text_of(polygon, "side");
    const std::optional<ResultShare> share = share_of(polygon);
    if (!id || !side || !share) return false;
    shares[fmt::format("{} {} {}", *name, *id, *side)] = *share;
  }
  return true;
}

}  // namespace

std::optional<ResultShares> parse_shares(const std::string& text) {
  rapidjson::Document document;
  document.Parse<rapidjson::kParseFullPrecisionFlag>(text.data(), text.size());
  if (document.HasParseError()) return std::nullopt;
  const Json* lights = member(document, "lights");
  if (lights == nullptr || !lights->IsArray()) return std::nullopt;
  ResultShares shares;
  const bool read = std::ranges::all_of(
      lights->GetArray(), [&](const Json& light) { return add_light(light, shares); });
  if (!read) return std::nullopt;
  return shares;
}

ResultShares read_shares(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::optional<ResultShares> shares = parse_shares(text);
  if (!shares) {
    fmt::print(stderr, "gnomon_bench: {} is no result with lit shares\n", path);
    std::exit(2);
  }
  return std::move(*shares);
}

std::string checksum(const ResultShares& shares) {
  TextHash hash;
  for (const auto& [side, share] : shares) hash.add(fmt::format("{} {}\n", side, share.exact));
  return fmt::format("{:016x}", hash.value());
}

bool bounds_overlap(const ResultShares& a, const ResultShares& b) {
  return std::ranges::equal(a, b, [](const auto& left, const auto& right) {
    return left.first == right.first && left.second.lower <= right.second.upper &&
           right.second.lower <= left.second.upper;
  });
}

}  // namespace gnomon::bench
