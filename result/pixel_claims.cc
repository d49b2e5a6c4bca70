// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/result/pixel_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <unordered_map>
#include <utility>

#include "result/json_fields.h"

namespace gnomon {
namespace {

/// A whole number of any type, as text says it; none if it is not one.
template <class Integer>
std::optional<Integer> whole(const Json& value) {
  const std::string_view text = JsonFields::number_text(value);
  Integer number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

class PixelReader {
 public:
  PixelReader(const std::string& file, const Scene& scene)
      : fields_(file, scene.numbers), scene_(scene) {
    result_.name = file;
  }

  Expected<PixelClaims> read(std::string_view text) {
    rapidjson::Document document;
    if (auto parsed = fields_.parse(text, document); !parsed) {
      return tl::unexpected(std::move(parsed.error()));
    }
    if (!document.IsObject()) {
      return fields_.wrong(ErrorCode::kFormat, "", JsonFields::form_of(document),
                           "an object of format gnomon-pixels");
    }
    for (const auto step :
         {&PixelReader::head, &PixelReader::camera, &PixelReader::names, &PixelReader::rows}) {
      if (auto done = (this->*step)(document); !done) {
        return tl::unexpected(std::move(done.error()));
      }
    }
    return std::move(result_);
  }

 private:
  Expected<void> head(const Json& document);
  Expected<void> camera(const Json& document);
  Expected<void> names(const Json& document);
  Expected<void> rows(const Json& document);
  Expected<void> row(const Json& runs, std::size_t j);
  Expected<std::uint32_t> size(const Json& document, const char* key) const;
  Expected<void> eye(const Json& camera);
  Expected<void> vector(const Json& camera, const char* key,
                        std::array<std::int32_t, 3>& result) const;
  /// The index of each id of a list among the scene's polygons or lights.
  template <class Named>
  Expected<std::vector<std::uint32_t>> indices(const Json& document, const char* key,
                                               const std::vector<Named>& named,
                                               std::string_view kind) const;

  JsonFields fields_;
  const Scene& scene_;
  PixelClaims result_;
  std::vector<std::uint32_t> polygons_;  // as the file numbers them
};

Expected<void> PixelReader::head(const Json& document) {
  const auto format = fields_.optional_text(document, "format", "");
  if (!format) return tl::unexpected(format.error());
  if (!format->empty() && *format != "gnomon-pixels") {
    return fields_.wrong(ErrorCode::kFormat, "/format", "the format '" + *format + "'",
                         "gnomon-pixels");
  }
  const auto version = fields_.whole_number(document, "version", 1, false, "");
  if (!version) return tl::unexpected(version.error());
  if (version->value_or(1) > 1) {
    return fields_.wrong(ErrorCode::kFormat, "/version", fmt::format("version {}", **version),
                         "version 1");
  }
  for (const auto& [key, text] :
       {std::pair{"geometry", &result_.geometry}, std::pair{"kernel", &result_.kernel},
        std::pair{"algorithm", &result_.algorithm}}) {
    auto own = fields_.optional_text(document, key, "");
    if (!own) return tl::unexpected(std::move(own.error()));
    *text = *std::move(own);
  }
  return {};
}

Expected<std::uint32_t> PixelReader::size(const Json& document, const char* key) const {
  const auto number = fields_.whole_number(document, key, 1, true, "");
  if (!number) return tl::unexpected(number.error());
  if (static_cast<std::uint64_t>(**number) > ImageFrame::kMostSamples) {
    return fields_.wrong(ErrorCode::kLimit, std::string("/") + key,
                         fmt::format("{} samples", **number),
                         fmt::format("at most {} in a picture", ImageFrame::kMostSamples));
  }
  return static_cast<std::uint32_t>(**number);
}

Expected<void> PixelReader::eye(const Json& camera) {
  const auto list = fields_.list(camera, "eye", true, "/camera");
  if (!list) return tl::unexpected(list.error());
  const std::string pointer = "/camera/eye";
  if ((*list)->Size() != 3) {
    return fields_.wrong(ErrorCode::kFormat, pointer,
                         fmt::format("{} coordinates", (*list)->Size()), "three");
  }
  for (rapidjson::SizeType k = 0; k < 3; ++k) {
    const Json& value = (**list)[k];
    std::string_view text = JsonFields::number_text(value);
    if (text.empty()) text = JsonFields::string_text(value);
    const auto number = Number::parse(text, scene_.numbers);
    if (text.empty() || !number) {
      return fields_.wrong(ErrorCode::kNumber, fmt::format("{}/{}", pointer, k),
                           JsonFields::form_of(value), "a coordinate of the eye, as a number");
    }
    result_.camera.eye[k] = *number;
  }
  return {};
}

Expected<void> PixelReader::vector(const Json& camera, const char* key,
                                   std::array<std::int32_t, 3>& result) const {
  const auto list = fields_.list(camera, key, true, "/camera");
  if (!list) return tl::unexpected(list.error());
  const std::string pointer = std::string("/camera/") + key;
  if ((*list)->Size() != 3) {
    return fields_.wrong(ErrorCode::kFormat, pointer, fmt::format("{} components", (*list)->Size()),
                         "three");
  }
  for (rapidjson::SizeType k = 0; k < 3; ++k) {
    const auto number = whole<std::int32_t>((**list)[k]);
    if (!number || std::abs(std::int64_t{*number}) > ImageFrame::kLargestComponent) {
      return fields_.wrong(
          ErrorCode::kNumber, fmt::format("{}/{}", pointer, k), JsonFields::form_of((**list)[k]),
          fmt::format("a whole number from -{0} to {0}", ImageFrame::kLargestComponent));
    }
    result[k] = *number;
  }
  return {};
}

Expected<void> PixelReader::camera(const Json& document) {
  const auto width = size(document, "width");
  if (!width) return tl::unexpected(width.error());
  const auto height = size(document, "height");
  if (!height) return tl::unexpected(height.error());
  result_.camera.width = *width;
  result_.camera.height = *height;
  if (std::uint64_t{*width} * *height > ImageFrame::kMostSamples) {
    return fields_.wrong(ErrorCode::kLimit, "/width",
                         fmt::format("a picture of {} x {} samples", *width, *height),
                         fmt::format("at most {} samples", ImageFrame::kMostSamples));
  }
  const auto camera = fields_.member(document, "camera", true, "");
  if (!camera) return tl::unexpected(camera.error());
  if (!(*camera)->IsObject()) {
    return fields_.wrong(ErrorCode::kFormat, "/camera", JsonFields::form_of(**camera),
                         "an object with eye, right, up and forward");
  }
  if (auto done = eye(**camera); !done) return done;
  for (const auto& [key, vector_of] :
       {std::pair{"right", &result_.camera.right}, std::pair{"up", &result_.camera.up},
        std::pair{"forward", &result_.camera.forward}}) {
    if (auto done = vector(**camera, key, *vector_of); !done) return done;
  }
  return {};
}

template <class Named>
Expected<std::vector<std::uint32_t>> PixelReader::indices(const Json& document, const char* key,
                                                          const std::vector<Named>& named,
                                                          std::string_view kind) const {
  const auto ids = fields_.texts(document, key, true, "");
  if (!ids) return tl::unexpected(ids.error());
  std::unordered_map<std::string_view, std::uint32_t> index_of;
  for (std::uint32_t i = 0; i < named.size(); ++i) index_of.emplace(named[i].id, i);
  std::vector<std::uint32_t> result;
  for (const std::string& id : *ids) {
    const auto found = index_of.find(id);
    if (found == index_of.end()) {
      return fields_.wrong(ErrorCode::kFormat, fmt::format("/{}/{}", key, result.size()),
                           fmt::format("there is no {} '{}' in the scene", kind, id),
                           fmt::format("the id of a {} of the scene", kind));
    }
    result.push_back(found->second);
  }
  return result;
}

Expected<void> PixelReader::names(const Json& document) {
  auto lights = indices(document, "lights", scene_.lights, "light");
  if (!lights) return tl::unexpected(std::move(lights.error()));
  if (lights->size() > PixelClaims::kMostLights) {
    return fields_.wrong(ErrorCode::kLimit, "/lights", fmt::format("{} lights", lights->size()),
                         fmt::format("at most {}", PixelClaims::kMostLights));
  }
  for (std::size_t b = 0; b < lights->size(); ++b) {
    const std::string pointer = fmt::format("/lights/{}", b);
    if (std::find(lights->begin(), lights->begin() + static_cast<std::ptrdiff_t>(b),
                  (*lights)[b]) != lights->begin() + static_cast<std::ptrdiff_t>(b)) {
      return fields_.wrong(ErrorCode::kFormat, pointer, "a light for the second time",
                           "each light once");
    }
    if (scene_.lights[(*lights)[b]].has_area()) {
      return fields_.wrong(ErrorCode::kFormat, pointer, "an area light",
                           "a point or directional light");
    }
  }
  result_.lights = *std::move(lights);
  auto polygons = indices(document, "polygons", scene_.polygons, "polygon");
  if (!polygons) return tl::unexpected(std::move(polygons.error()));
  polygons_ = *std::move(polygons);
  return {};
}

Expected<void> PixelReader::rows(const Json& document) {
  const auto list = fields_.list(document, "rows", true, "");
  if (!list) return tl::unexpected(list.error());
  if ((*list)->Size() != result_.camera.height) {
    return fields_.wrong(ErrorCode::kFormat, "/rows", fmt::format("{} rows", (*list)->Size()),
                         fmt::format("{}, the height", result_.camera.height));
  }
  for (rapidjson::SizeType j = 0; j < (*list)->Size(); ++j) {
    if (auto done = row((**list)[j], j); !done) return done;
  }
  return {};
}

Expected<void> PixelReader::row(const Json& runs, std::size_t j) {
  const std::string pointer = fmt::format("/rows/{}", j);
  if (!runs.IsArray()) {
    return fields_.wrong(ErrorCode::kFormat, pointer, JsonFields::form_of(runs),
                         "a list of runs [count, polygon, lights]");
  }
  const std::size_t width = result_.camera.width;
  std::size_t samples = 0;
  for (rapidjson::SizeType r = 0; r < runs.Size(); ++r) {
    const std::string place = fmt::format("{}/{}", pointer, r);
    const Json& run = runs[r];
    if (!run.IsArray() || run.Size() != 3) {
      return fields_.wrong(
          ErrorCode::kFormat, place,
          run.IsArray() ? fmt::format("a list of {}", run.Size()) : JsonFields::form_of(run),
          "[count, polygon, lights]");
    }
    const auto count = whole<std::uint32_t>(run[0]);
    if (!count || *count == 0 || *count > width - samples) {
      return fields_.wrong(
          ErrorCode::kFormat, place + "/0", JsonFields::form_of(run[0]),
          fmt::format("a count from 1 to {}, what is left of the row", width - samples));
    }
    const auto polygon = whole<std::int64_t>(run[1]);
    if (!polygon || *polygon < -1 || *polygon >= static_cast<std::int64_t>(polygons_.size())) {
      return fields_.wrong(
          ErrorCode::kFormat, place + "/1", JsonFields::form_of(run[1]),
          fmt::format("an index into polygons, below {}, or -1 for nothing", polygons_.size()));
    }
    const auto mask = whole<std::uint64_t>(run[2]);
    const std::size_t lights = result_.lights.size();
    if (!mask || (lights < PixelClaims::kMostLights && *mask >> lights != 0)) {
      return fields_.wrong(ErrorCode::kFormat, place + "/2", JsonFields::form_of(run[2]),
                           fmt::format("bits of the {} lights that reach it", lights));
    }
    const std::uint32_t seen =
        *polygon < 0 ? PixelClaims::kNothing : polygons_[static_cast<std::size_t>(*polygon)];
    result_.polygon.insert(result_.polygon.end(), *count, seen);
    result_.lit_by.insert(result_.lit_by.end(), *count, *mask);
    samples += *count;
  }
  if (samples == width) return {};
  return fields_.wrong(ErrorCode::kFormat, pointer, fmt::format("runs of {} samples", samples),
                       fmt::format("{}, the width", width));
}

}  // namespace

Expected<PixelClaims> parse_pixel_claims(std::string_view text, const std::string& file,
                                         const Scene& scene) {
  return PixelReader(file, scene).read(text);
}

Expected<PixelClaims> read_pixel_claims(const std::string& path, const Scene& scene) {
  const auto text = JsonFields::read_file(path);
  if (!text) return tl::unexpected(text.error());
  return parse_pixel_claims(*text, path, scene);
}

}  // namespace gnomon
