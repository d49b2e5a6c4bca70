// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/files/mesh_text.h"

#include <charconv>
#include <utility>

#include "scene/files/left_out.h"

namespace gnomon {

namespace {

constexpr std::int64_t kMostVertices = 0xfffffffe;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

}  // namespace

std::optional<Token> Tokens::in_line() {
  for (;;) {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    if (at_ == text_.size() || text_[at_] == '\n') return std::nullopt;
    if (text_[at_] == '#') {
      at_ = std::min(text_.find('\n', at_), text_.size());
      return std::nullopt;
    }
    if (continuation_ == Continuation::kBackslash && text_[at_] == '\\') {
      const std::size_t end = text_.find_first_not_of("\r", at_ + 1);
      if (end == std::string_view::npos || text_[end] == '\n') {
        at_ = end == std::string_view::npos ? text_.size() : end + 1;
        continue;
      }
    }
    const std::size_t first = at_;
    while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '\n') {
      // A word may end in the backslash that goes on with the line.
      if (continuation_ == Continuation::kBackslash && text_[at_] == '\\' && at_ > first) break;
      ++at_;
    }
    return Token{text_.substr(first, at_ - first), first};
  }
}

bool Tokens::next_line() {
  while (in_line()) {
  }
  if (at_ == text_.size()) return false;
  ++at_;
  return true;
}

std::optional<Token> Tokens::anywhere() {
  for (;;) {
    if (auto token = in_line()) return token;
    if (!next_line()) return std::nullopt;
  }
}

std::optional<std::int64_t> to_integer(std::string_view text) {
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return std::nullopt;
  }
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

MeshBuilder::MeshBuilder(std::string_view text, const std::string& file, const ReadOptions& options)
    : text_(text),
      file_(file),
      places_(text),
      skip_bad_(options.skip_bad),
      wants_offsets_(options.polygon_offsets || options.skip_bad) {
  scene_.numbers = options.numbers.value_or(NumberMeaning::kDouble);
  scene_.file = file;
  scene_.name = name_from_file(file);
}

tl::unexpected<Error> MeshBuilder::error(ErrorCode code, std::string what, std::string expected,
                                         std::size_t offset) const {
  if (is_binary_) {
    return fail(code, std::move(what) + " (byte " + std::to_string(offset) + ")",
                std::move(expected), ErrorPlace{file_, 0, 0, {}});
  }
  return fail(code, std::move(what), std::move(expected), places_.at(file_, offset));
}

Expected<Number> MeshBuilder::number(const Token& token) {
  bool underflow = false;
  auto parsed = Number::parse(token.text, scene_.numbers, &underflow);
  if (!parsed) {
    return error(parsed.error().code, parsed.error().what, parsed.error().expected, token.offset);
  }
  if (underflow) underflow_.add(token.offset);
  return parsed;
}

tl::unexpected<Error> MeshBuilder::index_error(std::int64_t index, std::uint64_t count,
                                               std::size_t offset) const {
  return error(ErrorCode::kIndex,
               "index " + std::to_string(index + first_index_) + " is not that of a vertex",
               count == 0 ? "vertices"
                          : std::to_string(first_index_) + " to " +
                                std::to_string(static_cast<std::int64_t>(count) - 1 + first_index_),
               offset);
}

Expected<void> MeshBuilder::add_index(std::int64_t index, std::size_t offset) {
  if (index < 0 || index > kMostVertices ||
      static_cast<std::uint64_t>(index) >= expected_vertices_) {
    auto error = index_error(index, expected_vertices_, offset);
    if (!skip_bad_) return error;
    spoil_face(std::move(error.value()));
    return {};
  }
  if (index > greatest_index_) {
    greatest_index_ = index;
    greatest_offset_ = offset;
  }
  indices_.push_back(static_cast<VertexId>(index));
  return {};
}

Expected<void> MeshBuilder::end_face(std::size_t offset) {
  constexpr std::size_t kFewest = 3;
  if (indices_.size() < kFewest && !face_error_) {
    auto too_few = error(ErrorCode::kFormat,
                         "a face of " + std::to_string(indices_.size()) +
                             (indices_.size() == 1 ? " vertex" : " vertices"),
                         "at least 3 vertices", offset);
    if (!skip_bad_) return too_few;
    spoil_face(std::move(too_few.value()));
  }
  if (face_error_) {
    problems_.push_back(
        {static_cast<std::uint32_t>(scene_.polygons.size()), *std::exchange(face_error_, {})});
    indices_.clear();
  }
  if (wants_offsets_) offsets_.push_back(offset);
  Polygon& polygon = scene_.polygons.emplace_back();
  polygon.id = std::to_string(scene_.polygons.size() - 1);
  polygon.loop.assign(indices_.begin(), indices_.end());
  indices_.clear();
  return {};
}

void MeshBuilder::add_bad_vertex(const Error& why) {
  bad_vertices_.emplace(static_cast<VertexId>(vertex_count()), why.what);
  add_vertex({});
}

void MeshBuilder::spoil_face(Error why) {
  if (!face_error_) face_error_ = std::move(why);
}

void MeshBuilder::find_bad_indices() {
  const auto count = static_cast<std::int64_t>(vertex_count());
  if (greatest_index_ < count && bad_vertices_.empty()) return;
  for (std::size_t i = 0; i < scene_.polygons.size(); ++i) {
    for (const VertexId vertex : scene_.polygons[i].loop) {
      const auto bad = bad_vertices_.find(vertex);
      if (vertex < count && bad == bad_vertices_.end()) continue;
      auto problem =
          vertex < count
              ? error(ErrorCode::kNumber,
                      "vertex " + std::to_string(vertex + first_index_) + ": " + bad->second,
                      "finite numbers", offsets_[i])
              : index_error(vertex, vertex_count(), offsets_[i]);
      problems_.push_back({static_cast<std::uint32_t>(i), std::move(problem.value())});
      break;
    }
  }
}

Expected<ReadResult> MeshBuilder::finish() {
  if (skip_bad_) {
    find_bad_indices();
  } else if (greatest_index_ >= static_cast<std::int64_t>(vertex_count())) {
    return index_error(greatest_index_, vertex_count(), greatest_offset_);
  }
  // Bytes of binary data are no lines.
  if (is_binary_) offsets_.clear();
  ReadResult result{std::move(scene_), std::move(warnings_), {}, std::move(offsets_)};
  leave_out(result, std::move(problems_));
  if (result.scene.polygons.empty()) result.warnings.emplace_back("the scene has no polygons");
  underflow_.report(text_, result.warnings);
  return result;
}

}  // namespace gnomon
