// SPDX-License-Identifier: GPL-3.0-or-later
// What the oracle said of pictures: a table for people, and JSON for programs.
#ifndef GNOMON_REPORT_PIXELS_PICTURE_CERTIFICATE_H
#define GNOMON_REPORT_PIXELS_PICTURE_CERTIFICATE_H

#include <optional>
#include <string>
#include <vector>

#include "gnomon/oracle/image.h"
#include "gnomon/scene/scene.h"
#include "report/text/text_sink.h"

namespace gnomon::report {

/// A candidate's picture, judged.
struct JudgedPicture {
  std::string name;               // "plane/zbuffer", or a file
  std::string kernel, algorithm;  // empty if not told
  bool foreign = false;           // read from a file
  bool counts = true;             // for the status: false if nobody asked for this kernel
  bool exact = false;             // an exact kernel: a wrong sample is a bug of ours
  std::string camera;             // as it is exactly
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint32_t> lights;  // indices into Scene::lights
  double cpu_seconds = 0;
  std::string note;   // what is to be known besides
  std::string error;  // why there is no report; empty if there is one
  std::optional<oracle::ImageReport> report;

  bool failed() const { return !report || report->verdict == oracle::Verdict::kFailed; }
  /// An exact kernel that is not what it must be; too many samples on borders are no fault of it,
  /// nor is what the rows of an angular table get wrong.
  bool disagrees() const { return exact && report && report->wrong > report->by_rows; }
};

struct PictureCertificate {
  const Scene* scene = nullptr;
  std::string geometry_digest;
  double clearance = 0;            // scene units, as applied
  std::vector<std::string> moves;  // of the camera, a sentence each
  std::vector<JudgedPicture> pictures;
  bool interrupted = false;  // pictures that were not reached are missing
};

/// For people: lines of at most 100 columns; the worst sample of a picture that failed below it.
std::string picture_certificate_text(const PictureCertificate& certificate);

/// For programs: stable; CPU times only if asked for.
void write_picture_certificate_json(TextSink& sink, const PictureCertificate& certificate,
                                    bool times);

}  // namespace gnomon::report

#endif  // GNOMON_REPORT_PIXELS_PICTURE_CERTIFICATE_H
