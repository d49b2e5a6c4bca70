// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/common/camera_options.h"

#include <cmath>
#include <tuple>
#include <utility>

#include "gnomon/scene/light_arguments.h"
#include "report/pictures/picture.h"
#include "report/text/number_text.h"
#include "scene/base/random.h"

namespace gnomon::cli {
namespace {

/// A coordinate with few digits, so that an eye that nobody asked for needs few bits: a multiple of
/// a power of ten, or for doubles of two, below a thousandth of the scene.
Expected<Number> short_number(double value, double size, NumberMeaning meaning) {
  if (meaning == NumberMeaning::kDouble) {
    const double step = std::exp2(std::floor(std::log2(size / 1000)));
    return Number(std::round(value / step) * step);
  }
  const int exponent = static_cast<int>(std::floor(std::log10(size / 1000)));
  const double step = std::pow(10.0, exponent);
  const auto count = static_cast<std::int64_t>(std::llround(value / step));
  return Number::parse(std::to_string(count) + 'e' + std::to_string(exponent), meaning);
}

std::array<double, 3> nearest(const Position& position) {
  return {position[0].nearest(), position[1].nearest(), position[2].nearest()};
}

}  // namespace

std::vector<CLI::Option*> add_camera_options(CLI::App& command, CameraOptions& options,
                                             const std::string& across, const std::string& down) {
  command
      .add_option("--eye", options.eye,
                  "Where the eye is, exactly as its digits say [above a corner of the scene]")
      ->type_name("x,y,z");
  return {
      command
          .add_option("--look-at", options.look_at, "What it looks at [the middle of the scene]")
          ->type_name("x,y,z"),
      command.add_option("--up", options.up, "What is up [0,0,1]")->type_name("x,y,z"),
      command
          .add_option("--fov", options.field_of_view,
                      "Field of view across the larger side, degrees [shows all of the scene]")
          ->check(CLI::Range(0.1, 179.0))
          ->type_name("F"),
      command.add_option(across, options.width, "Samples in a row")
          ->check(CLI::Range(1u, 1u << 20))
          ->capture_default_str()
          ->type_name("N"),
      command.add_option(down, options.height, "Rows of samples")
          ->check(CLI::Range(1u, 1u << 20))
          ->capture_default_str()
          ->type_name("N")};
}

Expected<ExactCamera> camera_of(const CameraOptions& options, const LoadedScene& loaded) {
  const NumberMeaning meaning = loaded.scene.numbers;
  const report::Camera standard = report::default_camera(loaded.prepared);
  CameraView view{standard.eye,          standard.look_at, standard.up,
                  options.field_of_view, options.width,    options.height};
  for (const auto& [option, text, target] :
       {std::tuple("--look-at", &options.look_at, &view.look_at),
        std::tuple("--up", &options.up, &view.up)}) {
    if (text->empty()) continue;
    const auto point = parse_position(*text, NumberMeaning::kDouble, option);
    if (!point) return tl::unexpected(point.error());
    *target = nearest(*point);
  }
  Position eye;
  if (options.eye.empty()) {
    double size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      size = std::max(size, std::fabs(standard.eye[k] - standard.look_at[k]));
    }
    for (std::size_t k = 0; k < 3; ++k) {
      auto number = short_number(standard.eye[k], size, meaning);
      if (!number) return tl::unexpected(std::move(number.error()));
      eye[k] = *std::move(number);
    }
  } else {
    auto point = parse_position(options.eye, meaning, "--eye");
    if (!point) return tl::unexpected(std::move(point.error()));
    eye = *std::move(point);
  }
  view.eye = nearest(eye);
  if (view.eye != view.look_at && !(view.field_of_view > 0)) {
    view.field_of_view = fitting_field_of_view(loaded.prepared, view);
  }
  if (view.eye == view.look_at) view.field_of_view = 1;  // which make_camera() refuses for the eye
  return make_camera(eye, view);
}

ExactCamera moved_camera(const ExactCamera& camera, const LoadedScene& loaded, std::uint64_t seed) {
  constexpr std::int64_t kSteps = 1000;
  const std::array<double, 3> eye = nearest(camera.eye);
  const std::array<double, 3> middle = report::default_camera(loaded.prepared).look_at;
  double size = 0;
  for (std::size_t k = 0; k < 3; ++k) size = std::max(size, std::fabs(eye[k] - middle[k]));
  Random random(seed);
  ExactCamera moved = camera;
  for (std::size_t k = 0; k < 3; ++k) {
    const double by = size / 16 * static_cast<double>(random.between(-kSteps, kSteps)) / kSteps;
    if (auto number = short_number(eye[k] + by, size, loaded.scene.numbers)) {
      moved.eye[k] = *std::move(number);
    }
  }
  return moved;
}

std::string camera_text(const ExactCamera& camera, const Scene& scene) {
  std::string text = "eye ";
  for (std::size_t k = 0; k < 3; ++k) {
    const auto number = camera.eye[k].to_text(scene.numbers);
    text += (k > 0 ? "," : "") + (number ? *number : report::shortest(camera.eye[k].nearest()));
  }
  for (const auto& [name, vector] : {std::pair("right", &camera.right), std::pair("up", &camera.up),
                                     std::pair("forward", &camera.forward)}) {
    text += std::string(", ") + name + ' ';
    for (std::size_t k = 0; k < 3; ++k) {
      text += (k > 0 ? "," : "") + std::to_string((*vector)[k]);
    }
  }
  return text;
}

}  // namespace gnomon::cli
