// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/certify_pixels.h"

#include <algorithm>
#include <utility>

#include "cli/common/exit_status.h"
#include "cli/common/interrupt.h"
#include "cli/common/messages.h"
#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "gnomon/algorithms/pixels.h"
#include "gnomon/oracle/image.h"
#include "gnomon/scene/digest.h"
#include "report/pixels/picture_certificate.h"
#include "report/pixels/pixel_claims_of.h"
#include "report/pixels/rows_of_table.h"
#include "report/text/number_text.h"

namespace gnomon::cli {
namespace {

/// So often the camera is moved where too many samples lie on borders.
constexpr std::uint64_t kMostMoves = 8;

class PictureRun {
 public:
  PictureRun(const PictureCommandOptions& options, const LoadedScene& loaded)
      : options_(options), loaded_(loaded), progress_("certify") {
    certificate_.scene = &loaded.scene;
    certificate_.geometry_digest = geometry_digest(loaded.scene);
    certificate_.clearance = options.clearance;
  }

  /// Errors: those of the file, and of preparing its view.
  Expected<void> run_file(const std::string& file) {
    auto claims = read_pixel_claims(file, loaded_.scene);
    if (!claims) return tl::unexpected(std::move(claims.error()));
    const auto view = prepare_view(loaded_.scene, claims->camera);
    if (!view) {
      Error error = view.error();
      error.where.file = file;
      return tl::unexpected(std::move(error));
    }
    report::JudgedPicture picture;
    picture.name = file;
    picture.kernel = claims->kernel;
    picture.algorithm = claims->algorithm;
    picture.foreign = true;
    if (!claims->geometry.empty() && claims->geometry != certificate_.geometry_digest) {
      picture.note = "its digest says that it was made from another scene: " + claims->geometry;
    }
    // What the rows of a table get wrong is told apart in a file of ours, too.
    const auto method = parse_pixel_method(claims->algorithm);
    return judge(std::move(picture), *view, *claims,
                 method ? report::rows_of_table(*view, *method) : oracle::NearBorder());
  }

  /// All methods on all kernels, by a camera that does not put too many samples on borders.
  Expected<void> run_methods() {
    auto camera = camera_of(options_.camera, loaded_);
    if (!camera) return tl::unexpected(std::move(camera.error()));
    for (std::uint64_t seed = 0;; ++seed) {
      if (seed > 0) move(*camera, seed);
      const auto view = prepare_view(loaded_.scene, *camera);
      if (!view) return tl::unexpected(view.error());
      const std::size_t before = certificate_.pictures.size();
      bool moves = false;
      for (const MethodSelection& method : options_.methods) {
        for (const KernelChoice& kernel : options_.kernels) {
          if (interrupted()) certificate_.interrupted = true;
          if (certificate_.interrupted || moves) break;
          if (auto done = run_method(method, kernel, *view, *camera); !done) return done;
          if (certificate_.interrupted) break;
          const auto& report = certificate_.pictures.back().report;
          // Where samples lie depends on the camera alone.
          moves = seed < kMostMoves && report && !report->interrupted &&
                  report->boundary_share() > oracle::ImageOptions{}.most_boundary;
          if (moves) boundary_share_ = report->boundary_share();
        }
      }
      if (!moves) return {};
      certificate_.pictures.resize(before);
    }
  }

  const report::PictureCertificate& certificate() const { return certificate_; }

  int status() const {
    bool failed = false, disagree = false;
    for (const report::JudgedPicture& picture : certificate_.pictures) {
      if (picture.report && picture.report->interrupted) return kInterruptedStatus;
      disagree = disagree || picture.disagrees();
      failed = failed || (picture.counts && picture.failed());
    }
    if (certificate_.interrupted) return kInterruptedStatus;
    return disagree ? kDisagree : limit_reached_ ? kLimitReached : failed ? kFailed : kDone;
  }

 private:
  void move(ExactCamera& camera, std::uint64_t seed) {
    certificate_.moves.push_back(
        report::percent(boundary_share_) +
        " of the samples lay on borders: the camera was moved a little, by seed " +
        std::to_string(seed));
    camera = moved_camera(camera, loaded_, seed);
  }

  Expected<void> run_method(const MethodSelection& method, const KernelChoice& kernel,
                            const PreparedView& view, const ExactCamera& camera) {
    report::JudgedPicture picture;
    picture.kernel = kernel.name();
    picture.algorithm = method_text(method.id, method.values);
    picture.name = picture.kernel + '/' + picture.algorithm;
    // Distances that are linear in the angle are not exact on any kernel.
    picture.exact = kernel.exact() && method.values.interpolation == Interpolation::kPlane;
    picture.counts = options_.float_counts || kernel.kernel != KernelId::kFloat;
    PixelOptions pixel_options;
    pixel_options.kernel.id = kernel.kernel;
    pixel_options.kernel.identity = kernel.identity;
    pixel_options.kernel.thickness = kernel.thin ? 0 : options_.thickness;
    pixel_options.method = method.id;
    pixel_options.options = method.values;
    pixel_options.lights = loaded_.lights;
    pixel_options.scene = &loaded_.scene;
    pixel_options.jobs = options_.jobs;
    pixel_options.control.interrupted = &interrupted();
    progress_.set_label("kernel " + picture.name);
    pixel_options.control.progress = progress_.callback();
    const auto pixels = compute_pixels(view.scene, view.frame, pixel_options);
    progress_.clear();
    if (!pixels) {
      if (pixels.error().code == ErrorCode::kUsage) return tl::unexpected(pixels.error());
      if (pixels.error().code == ErrorCode::kInterrupted) {
        certificate_.interrupted = true;
        return {};
      }
      const bool refused = pixels.error().code == ErrorCode::kGeometry;
      if (refused && options_.methods.size() == 1) return tl::unexpected(pixels.error());
      if (refused) picture.counts = false;
      // A kernel that cannot finish is a finding about that kernel.
      limit_reached_ = limit_reached_ || pixels.error().code == ErrorCode::kLimit;
      picture.error = (refused ? "refused: " : "") + to_string(pixels.error());
      certificate_.pictures.push_back(std::move(picture));
      return {};
    }
    picture.cpu_seconds = pixels->seconds;
    return judge(std::move(picture), view, report::pixel_claims_of(*pixels, view.scene, camera),
                 report::rows_of_table(view, method));
  }

  Expected<void> judge(report::JudgedPicture picture, const PreparedView& view,
                       const PixelClaims& claims, oracle::NearBorder near_border = {}) {
    picture.camera = camera_text(claims.camera, loaded_.scene);
    picture.width = claims.camera.width;
    picture.height = claims.camera.height;
    picture.lights = claims.lights;
    oracle::ImageOptions image_options;
    image_options.clearance = options_.clearance;
    image_options.strict = options_.strict;
    image_options.interrupted = &interrupted();
    image_options.near_border = std::move(near_border);
    progress_.set_label("judging " + picture.name);
    image_options.progress = progress_.callback();
    auto report = oracle::judge_pixels(view, claims, image_options);
    progress_.clear();
    if (!report) return tl::unexpected(std::move(report.error()));
    picture.report = *std::move(report);
    certificate_.pictures.push_back(std::move(picture));
    return {};
  }

  const PictureCommandOptions& options_;
  const LoadedScene& loaded_;
  ProgressBar progress_;
  report::PictureCertificate certificate_;
  double boundary_share_ = 0;  // of the last camera that was moved
  bool limit_reached_ = false;
};

}  // namespace

int run_certify_pixels(const PictureCommandOptions& options, const LoadedScene& loaded) {
  PictureRun run(options, loaded);
  for (const std::string& file : options.files) {
    if (interrupted()) break;
    if (auto done = run.run_file(file); !done) return report_error(done.error());
  }
  if (!options.methods.empty()) {
    if (auto done = run.run_methods(); !done) return report_error(done.error());
  }
  if (options.json != "-") {
    const std::string text = report::picture_certificate_text(run.certificate());
    if (auto done = write_output({}, text); !done) return report_error(done.error());
  }
  if (!options.json.empty()) {
    auto output = Output::open(options.json);
    if (!output) return report_error(output.error());
    report::write_picture_certificate_json(*output, run.certificate(), options.times);
    if (auto done = output->finish(); !done) return report_error(done.error());
  }
  return run.status();
}

}  // namespace gnomon::cli
