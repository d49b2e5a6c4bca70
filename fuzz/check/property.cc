// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/check/property.h"

#include <algorithm>
#include <array>

namespace gnomon::fuzz {

namespace {

constexpr std::array kProperties = {
    PropertyInfo{Property::kCrash, "no-crash", "the subject ends by itself, with an answer"},
    PropertyInfo{Property::kBudget, "budget", "it needs no more time and memory than it is given"},
    PropertyInfo{Property::kRefusal, "no-refusal", "it accepts every scene that can be prepared"},
    PropertyInfo{Property::kOracle, "oracle", "its result is what the oracle says"},
    PropertyInfo{Property::kAgreement, "exact-agreement",
                 "exact kernels and algorithms give the same fractions, bit for bit"},
    PropertyInfo{Property::kMetamorphic, "metamorphic",
                 "relations between a scene and one made from it hold"},
    PropertyInfo{Property::kClaims, "claims",
                 "tiling, witnesses and fractions hold one by one, without the oracle's regions"},
    PropertyInfo{Property::kRoundTrip, "round-trip",
                 "scene and result read back as they were written"},
    PropertyInfo{Property::kPreparation, "preparation",
                 "the prepared scene is what the definitions say"},
    PropertyInfo{Property::kSelf, "oracle-itself", "the oracle does not contradict itself"},
    PropertyInfo{Property::kWritten, "written-doubles",
                 "an exact result, written as doubles and read back, passes verify and certify"},
    PropertyInfo{Property::kBorders, "borders",
                 "the verdict on a rounded result by borders is the one by measuring"},
    PropertyInfo{Property::kTogether, "lights-together",
                 "the lights that reach each fragment are those that the oracle says, one by one"},
};

}  // namespace

std::span<const PropertyInfo> properties() { return kProperties; }

std::string_view id_of(Property property) {
  return kProperties[static_cast<std::size_t>(property)].id;
}

std::optional<Property> property_by_id(std::string_view id) {
  for (const PropertyInfo& info : kProperties) {
    if (info.id == id) return info.property;
  }
  return std::nullopt;
}

std::string Failure::signature() const {
  return short_signature() + (cause.empty() ? "" : ":" + cause);
}

std::string Failure::short_signature() const {
  return std::string(id_of(property)) + ':' + disagreement + ':' + subject;
}

const Failure* CaseReport::find(const Failure& wanted) const {
  const auto at =
      std::ranges::find_if(failures, [&](const Failure& failure) { return failure.alike(wanted); });
  return at == failures.end() ? nullptr : &*at;
}

}  // namespace gnomon::fuzz
