// SPDX-License-Identifier: GPL-3.0-or-later
// What must hold of every scene, and what is said where it does not. A failure is told apart by its
// property, its subject, its class and its cause: shrinking keeps all four, campaigns count by
// them.
#ifndef GNOMON_FUZZ_CHECK_PROPERTY_H
#define GNOMON_FUZZ_CHECK_PROPERTY_H

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::fuzz {

enum class Property : std::uint8_t {
  kCrash,        // the process ends by a signal, an exception, or without an answer
  kBudget,       // it needs more time, memory or fragments than it was given
  kRefusal,      // a scene that can be prepared is refused
  kOracle,       // the result is not what the oracle says
  kAgreement,    // exact kernels and algorithms give the same fractions, bit for bit
  kMetamorphic,  // relations between a scene and one made from it
  kClaims,       // the result's own claims (tiling, witnesses, fractions) hold
  kRoundTrip,    // scene and result read back as they were written
  kPreparation,  // the prepared scene is what the definitions say
  kSelf,         // the oracle does not contradict itself
  kWritten,      // exact results written as doubles and read back pass every judge
  kBorders,      // success proven by borders is success measured
  kTogether,     // several lights together have the classes that each has alone
};

struct PropertyInfo {
  Property property = Property::kCrash;
  std::string_view id;  // such as "exact-agreement"
  std::string_view meaning;
};

/// In order of the enumeration.
std::span<const PropertyInfo> properties();
std::string_view id_of(Property property);
std::optional<Property> property_by_id(std::string_view id);

struct Failure {
  Property property = Property::kCrash;
  std::string subject;  // name_of(Subject)
  std::string
      disagreement;  // its class: "misclassified", "uncovered", "signal 11", a relation's id
  std::string light, polygon;  // where, if somewhere
  std::string text;            // one sentence
  double width = 0;            // of the widest region of error, scene units; 0: none
  double share = 0;            // of a polygon's area that is wrong, 0..1
  std::string cause = {};      // what it comes from (cause.h); empty: unknown

  /// The same property, subject, class and, if known of both, cause: what a smaller scene has to
  /// show.
  bool alike(const Failure& other) const {
    return property == other.property && subject == other.subject &&
           disagreement == other.disagreement &&
           (cause == other.cause || cause.empty() || other.cause.empty());
  }
  /// "PROPERTY:CLASS:SUBJECT", and ":CAUSE" if it is known.
  std::string signature() const;
  /// The same without the cause.
  std::string short_signature() const;
};

/// What a check of one scene found, and what it did.
struct CaseReport {
  std::vector<Failure> failures;
  std::string digest;                 // of all exact fractions; empty if no exact kernel ran
  std::vector<std::string> subjects;  // that were run
  std::uint32_t polygons = 0, lights = 0;
  std::uint64_t fragments = 0;  // of the first subject
  std::uint64_t area_lights = 0;
  std::uint64_t claims_checked = 0;  // results whose claims were checked one by one

  const Failure* find(const Failure& wanted) const;
};

}  // namespace gnomon::fuzz

#endif  // GNOMON_FUZZ_CHECK_PROPERTY_H
