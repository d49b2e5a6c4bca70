// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scene/radiance/rad_transform.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "scene/base/text_file.h"
#include "scene/model/decimal_arithmetic.h"
#include "scene/model/decimal_vector.h"

namespace gnomon {

namespace {

constexpr std::uint64_t kMostRepetitions = 100'000;

Number one() { return Number::from_short_decimal(1, 0); }

}  // namespace

RadTransform::RadTransform() {
  for (std::size_t i = 0; i < 3; ++i) rows_[i][i] = one();
}

Position RadTransform::apply_to_direction(const Position& direction) const {
  Position result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      result[i] = decimal_sum(result[i], decimal_product(rows_[i][k], direction[k]));
    }
  }
  return result;
}

Position RadTransform::apply(const Position& position) const {
  Position result = apply_to_direction(position);
  for (std::size_t i = 0; i < 3; ++i) result[i] = decimal_sum(result[i], rows_[i][3]);
  return result;
}

RadTransform RadTransform::then(const RadTransform& outer) const {
  RadTransform result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      Number& number = result.rows_[i][j];
      number = j == 3 ? outer.rows_[i][3] : Number();
      for (std::size_t k = 0; k < 3; ++k) {
        number = decimal_sum(number, decimal_product(outer.rows_[i][k], rows_[k][j]));
      }
    }
  }
  result.mirrors_ = mirrors_ != outer.mirrors_;
  result.error_ = std::max(error_, outer.error_);
  result.stretch_ = std::max(stretch_, outer.stretch_);
  return result;
}

void RadTransform::move(const Position& by) {
  for (std::size_t i = 0; i < 3; ++i) rows_[i][3] = decimal_sum(rows_[i][3], by[i]);
}

void RadTransform::scale(const Number& factor) {
  for (auto& row : rows_) {
    for (Number& number : row) number = decimal_product(number, factor);
  }
  if (factor.sign() < 0) mirrors_ = !mirrors_;
}

void RadTransform::mirror(std::size_t axis) {
  for (Number& number : rows_[axis]) number = negated_decimal(number);
  mirrors_ = !mirrors_;
}

void RadTransform::turn(std::size_t axis, const Number& degrees) {
  const decimals::Angle angle = decimals::angle_of(degrees);
  const std::size_t y = (axis + 1) % 3, z = (axis + 2) % 3;
  for (std::size_t j = 0; j < 4; ++j) {
    const Number a = rows_[y][j], b = rows_[z][j];
    rows_[y][j] =
        decimal_difference(decimal_product(a, angle.cosine), decimal_product(b, angle.sine));
    rows_[z][j] = decimal_sum(decimal_product(a, angle.sine), decimal_product(b, angle.cosine));
  }
  if (!angle.is_rounded) return;
  error_ = std::max(error_, angle.error);
  stretch_ = std::max(stretch_, std::abs(angle.stretch));
}

bool is_xform(const std::vector<std::string>& words) {
  if (words.empty() || words[0] != "xform") return false;
  return std::none_of(words.begin(), words.end(), [](const std::string& word) {
    return word.find_first_of("|<>;&`$()*?{}~\"'\\") != std::string::npos;
  });
}

namespace {

/// Reads words from left to right.
class XformReader {
 public:
  explicit XformReader(const std::vector<std::string>& words) : words_(words) {}

  Expected<XformCommand> read();

 private:
  Expected<void> option(const std::string& name);
  Expected<Number> number();
  Expected<std::uint64_t> repetitions();
  /// Carries the options since the last -i or -a out, so often.
  Expected<void> finish_part();

  const std::vector<std::string>& words_;
  std::size_t at_ = 1;
  XformCommand command_{{RadTransform()}, {}, {}, {}};
  RadTransform part_;
  std::uint64_t times_ = 1;
  bool is_array_ = false;  // times_ instances, moved 0, 1, 2, ... times
};

Expected<Number> XformReader::number() {
  if (at_ >= words_.size()) {
    return fail(ErrorCode::kFormat, "xform ends where a number should be", "a number");
  }
  return Number::parse(words_[at_++], NumberMeaning::kDecimal);
}

Expected<std::uint64_t> XformReader::repetitions() {
  if (at_ >= words_.size()) {
    return fail(ErrorCode::kFormat, "xform ends where a number should be", "a count");
  }
  const std::string& text = words_[at_++];
  std::uint64_t value = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec != std::errc{} || parsed.ptr != text.data() + text.size() ||
      value > kMostRepetitions) {
    return fail(ErrorCode::kFormat, quoted_text(text) + " repetitions",
                "a count of at most 100000");
  }
  return value;
}

Expected<void> XformReader::finish_part() {
  std::vector<RadTransform> powers = {RadTransform()};
  for (std::uint64_t i = 0; i < times_; ++i) powers.push_back(powers.back().then(part_));
  if (is_array_) {
    powers.pop_back();
  } else {
    powers.erase(powers.begin(), powers.end() - 1);
  }
  if (command_.placements.size() * powers.size() > kMostRepetitions) {
    return fail(ErrorCode::kLimit, "an array of too many instances", "at most 100000");
  }
  std::vector<RadTransform> all;
  for (const RadTransform& before : command_.placements) {
    for (const RadTransform& power : powers) all.push_back(before.then(power));
  }
  command_.placements = std::move(all);
  part_ = RadTransform();
  return {};
}

Expected<void> XformReader::option(const std::string& name) {
  if (name == "-t") {
    Position by;
    for (Number& coordinate : by) {
      auto value = number();
      if (!value) return tl::unexpected(std::move(value.error()));
      coordinate = *std::move(value);
    }
    part_.move(by);
    return {};
  }
  if (name == "-s") {
    const auto factor = number();
    if (!factor) return tl::unexpected(factor.error());
    if (factor->is_zero()) {
      return fail(ErrorCode::kFormat, "xform scales by 0", "another factor");
    }
    part_.scale(*factor);
    return {};
  }
  if (name == "-e" || name == "-c") return {};  // whether commands are carried out: they are not
  if (name == "-n" || name == "-m") {
    if (at_ >= words_.size()) return fail(ErrorCode::kFormat, name + " without a name", "a name");
    if (name == "-n") {
      command_.prefix = words_[at_++] + ".";
    } else {
      command_.modifier = words_[at_++];
    }
    return {};
  }
  if (name == "-i" || name == "-a") {
    if (auto done = finish_part(); !done) return done;
    const auto times = repetitions();
    if (!times) return tl::unexpected(times.error());
    times_ = *times;
    is_array_ = name == "-a";
    return {};
  }
  constexpr std::string_view kAxes = "xyz";
  const std::size_t axis = name.size() == 3 ? kAxes.find(name[2]) : kAxes.npos;
  if (axis != kAxes.npos && name[1] == 'm') {
    part_.mirror(axis);
    return {};
  }
  if (axis != kAxes.npos && name[1] == 'r') {
    const auto degrees = number();
    if (!degrees) return tl::unexpected(degrees.error());
    part_.turn(axis, *degrees);
    return {};
  }
  return fail(
      ErrorCode::kFormat, "the option " + quoted_text(name) + " of xform",
      "-t, -s, -rx, -ry, -rz, -mx, -my, -mz, -i, -a, -n and -m; 'xform -e FILE' carries all out");
}

Expected<XformCommand> XformReader::read() {
  while (at_ < words_.size() && words_[at_].starts_with("-")) {
    const std::string name = words_[at_++];
    if (auto done = option(name); !done) return tl::unexpected(std::move(done.error()));
  }
  if (auto done = finish_part(); !done) return tl::unexpected(std::move(done.error()));
  command_.files.assign(words_.begin() + static_cast<std::ptrdiff_t>(at_), words_.end());
  if (command_.files.empty()) {
    return fail(ErrorCode::kFormat, "xform without a file", "a file beside this one");
  }
  return std::move(command_);
}

}  // namespace

Expected<XformCommand> parse_xform(const std::vector<std::string>& words) {
  return XformReader(words).read();
}

}  // namespace gnomon
