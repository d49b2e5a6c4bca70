// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <bit>
#include <cstdlib>
#include <optional>
#include <utility>

#include "fuzz/findings/finding_picture.h"
#include "fuzz/zoo/zoo_case.h"
#include "gnomon/algorithms/painters_order.h"
#include "gnomon/result/shared_claims.h"
#include "report/pictures/picture.h"
#include "report/pictures/shaded_picture.h"
#include "report/text/text_sink.h"

namespace gnomon::fuzz {

namespace {

tl::unexpected<Error> shows_nothing(const ZooEntry& entry) {
  return fail(ErrorCode::kUsage, "the scene does not show " + std::string(entry.name),
              "a scene that does, such as one of a hunt");
}

/// The number of an attribute of the first element.
double attribute(const std::string& svg, const std::string& name) {
  const std::size_t at = svg.find(' ' + name + "=\"");
  return at == std::string::npos ? 0 : std::strtod(svg.c_str() + at + name.size() + 3, nullptr);
}

/// Pictures of the same size.
std::string side_by_side(const std::string& left, const std::string& right) {
  const double width = attribute(left, "width"), height = attribute(left, "height");
  const auto placed = [](std::string svg, double x) {
    svg.erase(0, svg.find("<svg"));
    return svg.insert(4, fmt::format(" x=\"{}\"", x));
  };
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\">"
      "\n{2}{3}</svg>\n",
      2 * width, height, placed(left, 0), placed(right, width));
}

Expected<std::string> shadow_picture(const ZooEntry& entry, const Scene& scene,
                                     const ZooCase& zoo_case) {
  const auto wrong = zoo_case.shadows(entry.mistake);
  if (!wrong) return tl::unexpected(wrong.error());
  ShadowOptions exact;
  exact.output.exact_points = exact.output.exact_fractions = true;
  const auto right = compute_shadows(zoo_case.prepared(), exact);
  if (!right) return tl::unexpected(right.error());
  Claims shown = zoo_case.candidate_of(*wrong, entry.mutant());
  const Claims truth = zoo_case.candidate_of(*right, "exact");
  const oracle::Report report = zoo_case.certified(shown);
  if (report.verdict != oracle::Verdict::kFailed || !report.worst) return shows_nothing(entry);
  // Wrong is then what each light has of them all.
  if (shown.combined) shown = shared_claims(shown, scene).front();
  for (std::uint32_t light = 0; light < shown.lights.size(); ++light) {
    if (shown.lights[light].id != report.worst->light) continue;
    const FindingPicture picture(scene, light, report.worst);
    return side_by_side(picture.paint("exact", truth.lights[light], nullptr),
                        picture.paint(entry.mutant(), shown.lights[light], &truth.lights[light]));
  }
  return shows_nothing(entry);
}

Expected<std::string> mesh_picture(const ZooEntry& entry, const Scene& scene,
                                   const ZooCase& zoo_case) {
  const PreparedScene& prepared = zoo_case.prepared();
  for (std::uint32_t light = 0; light < prepared.lights.size(); ++light) {
    const auto wrong = zoo_case.mesh(light, entry.mistake);
    if (!wrong) return tl::unexpected(wrong.error());
    const auto right = zoo_case.mesh(light, Mistake::kNone);
    if (!right) return tl::unexpected(right.error());
    if (zoo_case.check(*wrong).t_vertices == 0) continue;
    report::ShadedPictureOptions options;
    options.picture.camera = report::default_camera(prepared);
    options.picture.width = 480;
    options.picture.height = 420;
    options.picture.fragments = true;
    options.picture.backs = true;
    const auto pieces = back_to_front(prepared, options.picture.camera.eye);
    const auto paint = [&](const ShadingMesh& mesh, std::string title) {
      options.picture.title = std::move(title);
      report::StringSink sink;
      report::paint_shaded_scene(scene, prepared, pieces, mesh, options).write(sink);
      return sink.text();
    };
    return side_by_side(paint(*right, "without T-vertices"), paint(*wrong, entry.mutant()));
  }
  return shows_nothing(entry);
}

/// Samples as squares: the background, then darker the fewer lights reach a sample; what differs
/// from the other picture is in a signal colour.
std::string paint_samples(const std::string& title, const PixelClaims& shown,
                          const PixelClaims& truth) {
  constexpr std::uint32_t kSquare = 18, kTop = 28;
  const std::uint32_t width = shown.camera.width, height = shown.camera.height;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} "
      "{1}\">\n<text x=\"4\" y=\"18\" font-family=\"sans-serif\" font-size=\"12\">{2}</text>\n",
      width * kSquare, height * kSquare + kTop, title);
  const auto colour = [&](std::size_t s) {
    if (shown.polygon[s] != truth.polygon[s] || shown.lit_by[s] != truth.lit_by[s]) {
      return std::string("#d6246e");
    }
    const double lit = std::popcount(shown.lit_by[s]) / static_cast<double>(shown.lights.size());
    return fmt::format("rgb({0},{0},{0})", shown.polygon[s] == PixelClaims::kNothing
                                               ? 245
                                               : 90 + static_cast<int>(120 * lit));
  };
  for (std::size_t s = 0, end = 0; s < shown.polygon.size(); s = end) {
    const std::size_t row_end = (s / width + 1) * width;
    for (end = s + 1; end < row_end && colour(end) == colour(s); ++end) {
    }
    svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n",
                       s % width * kSquare, s / width * kSquare + kTop, (end - s) * kSquare,
                       kSquare, colour(s));
  }
  return svg + "</svg>\n";
}

Expected<std::string> sample_picture(const ZooEntry& entry, const ZooCase& zoo_case) {
  const auto wrong = zoo_case.picture(entry.mistake);
  if (!wrong) return tl::unexpected(wrong.error());
  if (!*wrong) return shows_nothing(entry);
  const PixelClaims& shown = (*wrong)->claims;
  const auto right = zoo_case.picture_from(shown.camera, Mistake::kNone);
  if (!right) return tl::unexpected(right.error());
  return side_by_side(paint_samples("exact", right->claims, right->claims),
                      paint_samples(entry.mutant(), shown, right->claims));
}

}  // namespace

Expected<std::string> zoo_picture(const ZooEntry& entry, const Scene& scene) {
  Expected<PreparedScene> prepared = prepare(scene);
  if (!prepared) return tl::unexpected(prepared.error());
  const ZooCase zoo_case(entry, scene, std::move(*prepared));
  if (zoo_case.makes_pictures()) return sample_picture(entry, zoo_case);
  return entry.mistake == Mistake::kTVerticesLeftIn ? mesh_picture(entry, scene, zoo_case)
                                                    : shadow_picture(entry, scene, zoo_case);
}

}  // namespace gnomon::fuzz
