// SPDX-License-Identifier: LGPL-3.0-or-later
// Members of JSON objects that this program wrote itself. If one is missing, the text is not what
// it claims to be, and the error says where.
#ifndef GNOMON_SCENE_JSON_JSON_MEMBERS_H
#define GNOMON_SCENE_JSON_JSON_MEMBERS_H

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gnomon/kernel/error.h"
#include "scene/json/json_value.h"

namespace gnomon {

/// Reads members by name. The first that is missing or of another type is kept as the error, with
/// its pointer; what follows it is still read, so that a reader needs to ask only once.
class JsonMembers {
 public:
  /// `expected`: what writes such objects. The object and the text must outlive the reader.
  JsonMembers(const JsonValue& object, std::string file, std::string pointer,
              std::string_view expected)
      : object_(object),
        file_(std::move(file)),
        pointer_(std::move(pointer)),
        expected_(expected) {}

  void read(const char* key, std::string& value);
  void read(const char* key, bool& value);
  void read(const char* key, double& value);
  void read(const char* key, std::optional<double>& value);  // or null
  void read(const char* key, std::uint64_t& value);
  void read(const char* key, std::uint32_t& value);
  void read(const char* key, std::vector<std::string>& value);
  void read(const char* key, std::vector<std::uint16_t>& value);
  /// Leaves the value as it is if there is no such member.
  void read_if_there(const char* key, std::string& value);
  void read_if_there(const char* key, std::optional<double>& value);
  /// A reader of the object there; of an empty one if there is none.
  JsonMembers object(const char* key);
  JsonMembers object_if_there(const char* key);
  /// Readers of the objects of the array there.
  std::vector<JsonMembers> objects(const char* key);

  /// Says that a member is not what it should be.
  void reject(const char* key);
  /// The first error, of this object only.
  const std::optional<Error>& error() const { return error_; }

 private:
  /// Null, and an error, if it is missing.
  const JsonValue* find(const char* key);

  const JsonValue& object_;
  std::string file_, pointer_;
  std::string_view expected_;
  std::optional<Error> error_;
};

}  // namespace gnomon

#endif  // GNOMON_SCENE_JSON_JSON_MEMBERS_H
