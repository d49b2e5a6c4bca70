// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/json/steps_json.h"

namespace gnomon::report {

StepsJson::StepsJson(TextSink& sink, const Scene& scene, const PreparedScene& prepared,
                     const ResultJsonOptions& options)
    : json_(sink), scene_(scene), prepared_(prepared), options_(options) {
  json_.begin_object();
  json_.member("format", "gnomon-steps");
  json_.member("version", 1);
  json_.member("scene", scene.name);
  json_.key("steps");
  json_.begin_array();
}

void StepsJson::add(const ShadowResult& result, const std::vector<std::uint32_t>& moved) {
  json_.begin_object();
  json_.key("moved");
  json_.begin_array();
  for (const std::uint32_t index : moved) {
    const Light& light = scene_.lights[prepared_.lights[index].light];
    json_.begin_object(JsonLayout::kInline);
    json_.member("id", light.id);
    json_.key(light.is_directional() ? "to_light" : "position");
    json_.begin_array(JsonLayout::kInline);
    for (const Number& coordinate : light.position) json_.value(coordinate.nearest());
    json_.end_array();
    json_.end_object();
  }
  json_.end_array();
  const TogetherCounts& counts = result.together;
  json_.key("work");
  json_.begin_object(JsonLayout::kInline);
  json_.member("trees_built", counts.trees_built);
  json_.member("trees", counts.trees);
  json_.member("filters", counts.filters);
  json_.member("filters_from_nothing", counts.filters_from_nothing);
  json_.end_object();
  json_.key("result");
  write_result_object(json_, scene_, prepared_, result, options_);
  json_.end_object();
}

void StepsJson::finish() {
  json_.end_array();
  json_.end_object();
  json_.finish();
}

}  // namespace gnomon::report
