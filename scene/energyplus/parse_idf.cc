// SPDX-License-Identifier: LGPL-3.0-or-later
// The syntax of IDF: fields between commas, objects up to a semicolon, comments from an exclamation
// mark to the end of the line. Which fields an object has depends on the version of the file.
#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "scene/energyplus/energy_model.h"

namespace gnomon {

namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Takes fields, one after the other.
class IdfTokens {
 public:
  explicit IdfTokens(const EnergyModel& model)
      : model_(model), text_(model.text), at_(byte_order_mark(model.text)) {}

  /// Goes to where the next object begins; false at the end of the file.
  bool to_object() {
    skip_comments();
    return at_ < text_.size();
  }
  std::size_t offset() const { return at_; }

  /// A field, and whether it is the last one of its object.
  Expected<std::pair<EnergyField, bool>> field() {
    skip_comments();
    EnergyField field{{}, at_};
    const std::size_t first = at_;
    while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != ';' && text_[at_] != '!' &&
           text_[at_] != '\n') {
      ++at_;
    }
    std::string_view word = text_.substr(first, at_ - first);
    while (!word.empty() && is_space(word.back())) word.remove_suffix(1);
    field.text = word;
    const std::size_t end = first + word.size();
    skip_comments();
    if (at_ == text_.size()) {
      return model_.error(ErrorCode::kSyntax, "the file ends inside an object",
                          "a semicolon behind its last field", text_.size());
    }
    const char mark = text_[at_];
    if (mark != ',' && mark != ';') {
      return model_.error(ErrorCode::kSyntax, "no comma and no semicolon behind this field",
                          "',' or ';'", end);
    }
    ++at_;
    return std::pair(std::move(field), mark == ';');
  }

 private:
  void skip_comments() {
    while (at_ < text_.size()) {
      if (text_[at_] == '!') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (is_space(text_[at_])) {
        ++at_;
      } else {
        break;
      }
    }
  }

  const EnergyModel& model_;
  std::string_view text_;
  std::size_t at_;
};

/// Words that only the field of the boundary condition holds.
constexpr std::string_view kConditions[] = {"Adiabatic",
                                            "Surface",
                                            "Zone",
                                            "Space",
                                            "Outdoors",
                                            "Foundation",
                                            "Ground",
                                            "GroundFCfactorMethod",
                                            "OtherSideCoefficients",
                                            "OtherSideConditionsModel"};

bool is_condition(const EnergyField& field) {
  if (lower_case(field.text).starts_with("ground")) return true;
  return std::ranges::any_of(kConditions,
                             [&](std::string_view word) { return same_word(word, field.text); });
}

/// Major and minor number as one: 9.6 is 906. Nothing if the file does not say.
std::optional<int> version_number(const std::vector<EnergyField>& fields) {
  if (fields.empty()) return std::nullopt;
  const std::string& text = fields[0].text;
  const char* const end = text.data() + text.size();
  int major = 0, minor = 0;
  const auto parsed = std::from_chars(text.data(), end, major);
  if (parsed.ec != std::errc{} || major > 1000) return std::nullopt;
  if (parsed.ptr != end && *parsed.ptr == '.') std::from_chars(parsed.ptr + 1, end, minor);
  return major * 100 + std::clamp(minor, 0, 99);
}

class IdfFields {
 public:
  void set_version(std::optional<int> version) { version_ = version; }

  /// Fields as they stand in the file, as those of the class: a field that this version lacks is
  /// put in, blank.
  void complete(const EnergyClass& type, std::vector<EnergyField>& fields) const {
    insert_space(type, fields);
    insert_shading_control(type, fields);
  }

 private:
  static std::size_t index_of(const EnergyClass& type, std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(type.fields, name) - type.fields.begin());
  }
  static void insert_blank(std::vector<EnergyField>& fields, std::size_t index) {
    if (index < fields.size()) {
      fields.insert(fields.begin() + static_cast<std::ptrdiff_t>(index), EnergyField{});
    }
  }

  /// Surfaces name a space since 9.6. What stands where then tells it, too.
  void insert_space(const EnergyClass& type, std::vector<EnergyField>& fields) const {
    const std::size_t space = index_of(type, "space_name");
    if (space == type.fields.size() || space >= fields.size()) return;
    bool has_space = version_.value_or(906) >= 906;
    if (type.has_vertices) {
      const bool old_place = is_condition(fields[space]);
      const bool new_place = space + 1 < fields.size() && is_condition(fields[space + 1]);
      if (old_place != new_place) has_space = new_place;
    } else if (!version_) {
      // Up to the last but one: azimuth, tilt, three coordinates, length, height.
      has_space = fields.size() >= type.fields.size();
    }
    if (!has_space) insert_blank(fields, space);
  }

  /// Windows named their shading control up to 8.9.
  void insert_shading_control(const EnergyClass& type, std::vector<EnergyField>& fields) const {
    const std::size_t control = index_of(type, "shading_control_name");
    if (control == type.fields.size()) return;
    bool has_control = version_.value_or(900) < 900;
    if (!version_) {
      has_control = type.has_vertices ? fields.size() % 3 == type.fields.size() % 3
                                      : fields.size() == type.fields.size();
    }
    if (!has_control) insert_blank(fields, control);
  }

  std::optional<int> version_;
};

}  // namespace

Expected<EnergyModel> parse_idf(const std::string& text, const std::string& file) {
  if (auto readable = check_is_text(text, file); !readable) {
    return tl::unexpected(std::move(readable.error()));
  }
  EnergyModel model{text, file, {}};
  std::vector<std::vector<EnergyField>> all_fields;
  IdfFields layout;
  IdfTokens tokens(model);
  while (tokens.to_object()) {
    const std::size_t offset = tokens.offset();
    if (text.compare(offset, 2, "##") == 0) {
      return model.error(ErrorCode::kFormat, "a command of EPMacro",
                         "the IDF that EPMacro makes of this file", offset);
    }
    auto name = tokens.field();
    if (!name) return tl::unexpected(std::move(name.error()));
    const EnergyClass* const type = energy_class(name->first.text);
    std::vector<EnergyField> fields;
    for (bool is_last = name->second; !is_last;) {
      auto field = tokens.field();
      if (!field) return tl::unexpected(std::move(field.error()));
      is_last = field->second;
      if (type != nullptr) fields.push_back(std::move(field->first));
    }
    if (type == nullptr) continue;
    if (type->kind == EnergyKind::kVersion) layout.set_version(version_number(fields));
    EnergyObject object;
    object.type = type;
    object.offset = offset;
    model.objects.push_back(std::move(object));
    all_fields.push_back(std::move(fields));
  }
  // The version may stand anywhere.
  for (std::size_t i = 0; i < model.objects.size(); ++i) {
    EnergyObject& object = model.objects[i];
    layout.complete(*object.type, all_fields[i]);
    const std::size_t count = object.type->fields.size();
    if (object.type->has_vertices && all_fields[i].size() > count) {
      object.vertices.assign(
          std::make_move_iterator(all_fields[i].begin() + static_cast<std::ptrdiff_t>(count)),
          std::make_move_iterator(all_fields[i].end()));
    }
    object.fields = std::move(all_fields[i]);
    object.fields.resize(count);
  }
  return model;
}

}  // namespace gnomon
