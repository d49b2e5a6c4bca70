// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/certificate/decisions.h"

namespace gnomon::report {

namespace {

const char* side_name(Side side) { return side == Side::kBack ? "back" : "front"; }

const char* answer_name(Side side) {
  switch (side) {
    case Side::kFront:
      return "front";
    case Side::kBack:
      return "back";
    case Side::kOn:
      return "on";
  }
  return "?";
}

class DecisionWriter {
 public:
  DecisionWriter(JsonWriter& json, const Explanation& explanation, const std::string& kernel,
                 const NamedScene& named)
      : json_(json), explanation_(explanation), kernel_(kernel), named_(named) {
    for (const Light& light : named.scene->lights) lights_.push_back(light.id);
  }

  void write() {
    json_.begin_object();
    json_.member("differing", explanation_.decisions.size());
    json_.member("answers", explanation_.times());
    write_asked();
    json_.key("groups");
    json_.begin_array();
    for (const DecisionGroup& group : explanation_.groups) write_group(group);
    json_.end_array();
    json_.member("cannot_be_flipped", explanation_.cannot_be_flipped);
    json_.key("flipped");
    json_.begin_array();
    for (const FlippedDecision& flip : explanation_.flipped) write_flip(flip);
    json_.end_array();
    json_.key("together");
    write_effect(explanation_.together);
    json_.key("kernel");
    write_effect(explanation_.kernel);
    json_.end_object();
  }

 private:
  void write_light(const std::optional<std::uint32_t>& light) {
    json_.key("light");
    light ? json_.value(lights_[named_.prepared->lights[*light].light]) : json_.null();
  }
  void write_part(const std::optional<std::uint32_t>& part) {
    json_.key("polygon");
    part ? json_.value(named_.scene->polygons[named_.prepared->parts[*part].polygon].id)
         : json_.null();
  }
  void write_asked() {
    json_.key("asked");
    json_.begin_object(JsonLayout::kInline);
    for (std::size_t i = 0; i < kPredicateCount; ++i) {
      if (explanation_.asked[i] == 0) continue;
      json_.member(name_of(static_cast<Predicate>(i)), explanation_.asked[i]);
    }
    json_.end_object();
  }
  void write_group(const DecisionGroup& group) {
    json_.begin_object(JsonLayout::kInline);
    json_.member("predicate", name_of(group.predicate));
    write_light(group.light);
    write_part(group.part);
    json_.member("decisions", group.decisions);
    json_.member("answers", group.times);
    json_.member("zero", group.on);
    json_.key("ulps");
    if (group.on == group.decisions) {
      json_.null();
    } else {
      json_.begin_array(JsonLayout::kInline);
      json_.value(group.least);
      json_.value(group.most);
      json_.end_array();
    }
    json_.end_object();
  }
  void write_point(std::string_view name, const std::array<double, 3>& point) {
    json_.key(name);
    json_.begin_array(JsonLayout::kInline);
    for (const double x : point) json_.value(x);
    json_.end_array();
  }
  void write_flip(const FlippedDecision& flip) {
    const DifferingDecision& decision = explanation_.decisions[flip.decision];
    json_.begin_object();
    json_.member("predicate", name_of(decision.predicate));
    write_light(decision.light);
    write_part(part_of(decision, *named_.prepared));
    json_.member("ulps", decision.ulps);
    json_.member("exact", answer_name(decision.exact));
    json_.member("kernel", answer_name(decision.tested));
    json_.member("answers", decision.times);
    write_point("position", decision.position);
    json_.member("text", to_sentence(decision, *named_.prepared, kernel_, lights_));
    json_.key("effect");
    write_effect(flip.effect);
    json_.end_object();
  }
  void write_shares(std::string_view name, const SideShares& shares, bool has_area) {
    json_.key(name);
    json_.begin_object(JsonLayout::kInline);
    json_.member("lit", shares.lit);
    if (has_area) {
      json_.member("penumbra", shares.penumbra);
      json_.member("umbra", shares.umbra);
    } else {
      json_.member("shadow", shares.shadow);
    }
    json_.end_object();
  }
  void write_effect(const RunEffect& effect) {
    json_.begin_object(JsonLayout::kInline);
    json_.member("ended", effect.ended);
    json_.member("changed_sides", effect.changed);
    json_.member("classes", effect.classes);
    if (effect.most) {
      const ChangedSide& most = *effect.most;
      const bool has_area = named_.prepared->lights[most.light].has_area();
      json_.key("most");
      json_.begin_object(JsonLayout::kInline);
      write_light(most.light);
      write_part(most.part);
      json_.member("side", side_name(most.side));
      write_shares("before", most.before, has_area);
      write_shares("after", most.after, has_area);
      json_.end_object();
    }
    json_.end_object();
  }

  JsonWriter& json_;
  const Explanation& explanation_;
  const std::string& kernel_;
  const NamedScene& named_;
  std::vector<std::string> lights_;
};

}  // namespace

void write_decisions(JsonWriter& json, const Explanation& explanation, const std::string& kernel,
                     const NamedScene& named) {
  DecisionWriter(json, explanation, kernel, named).write();
}

}  // namespace gnomon::report
