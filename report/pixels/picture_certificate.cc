// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pixels/picture_certificate.h"

#include <algorithm>

#include "report/json/json_writer.h"
#include "report/text/number_text.h"
#include "report/text/table.h"

namespace gnomon::report {
namespace {

std::string polygon_name(const Scene& scene, std::uint32_t polygon) {
  return polygon == PixelClaims::kNothing ? "nothing" : scene.polygons[polygon].id;
}

/// "sample (3, 4) at (1, 2, 0): found box, truly floor is seen".
std::string place_in_words(const Scene& scene, const oracle::WrongSample& wrong) {
  std::string text = "sample (" + std::to_string(wrong.i) + ", " + std::to_string(wrong.j) + ")";
  if (wrong.seen != PixelClaims::kNothing) {
    text += " at (" + rounded(wrong.point[0]) + ", " + rounded(wrong.point[1]) + ", " +
            rounded(wrong.point[2]) + ")";
  }
  if (!wrong.light) {
    text += ": found " + polygon_name(scene, wrong.claimed) + ", truly " +
            polygon_name(scene, wrong.seen) + " is seen";
  } else {
    text += " on polygon " + polygon_name(scene, wrong.seen) + ", light " +
            scene.lights[*wrong.light].id + ": found " + (wrong.claimed_lit ? "lit" : "shadow") +
            ", true " + (wrong.claimed_lit ? "shadow" : "lit");
  }
  if (wrong.caster) text += ", by caster " + scene.polygons[*wrong.caster].id;
  if (wrong.clearance) text += "; clearance " + rounded(*wrong.clearance, 3);
  return text;
}

std::string verdict_of(const JudgedPicture& picture) {
  if (!picture.report) return "no result";
  return picture.report->interrupted ? "interrupted" : name_of(picture.report->verdict);
}

/// "lamp 3, sun 0".
std::string of_lights(const Scene& scene, const JudgedPicture& picture) {
  std::string text;
  for (std::size_t l = 0; l < picture.lights.size(); ++l) {
    text += (l > 0 ? ", " : "") + scene.lights[picture.lights[l]].id + ' ' +
            grouped(picture.report->wrong_of_light[l]);
  }
  return text;
}

std::vector<std::string> row_of(const JudgedPicture& picture) {
  std::string time = "-";
  if (!picture.foreign && picture.error.empty()) {
    time = picture.cpu_seconds < 1 ? rounded(1000 * picture.cpu_seconds, 3) + " ms"
                                   : rounded(picture.cpu_seconds, 3) + " s";
  }
  if (!picture.report) return {picture.name, verdict_of(picture), "-", "-", "-", "-", "-", time};
  const oracle::ImageReport& report = *picture.report;
  return {picture.name,
          verdict_of(picture),
          grouped(report.judged),
          grouped(report.boundary),
          grouped(report.wrong),
          grouped(report.wrong_polygon),
          grouped(report.ill_conditioned),
          time};
}

void add_notes(const Scene& scene, const JudgedPicture& picture, TextTable& table) {
  if (!picture.note.empty()) table.add_note(picture.note);
  if (!picture.error.empty()) {
    table.add_note(picture.error);
    return;
  }
  const oracle::ImageReport& report = *picture.report;
  if (report.wrong > 0 && report.worst) {
    table.add_note("worst: " + place_in_words(scene, *report.worst));
    if (!picture.lights.empty()) table.add_note("wrong by light: " + of_lights(scene, picture));
  } else if (!report.reason.empty()) {
    table.add_note("why: " + report.reason);
  }
  if (report.by_rows > 0) {
    table.add_note(grouped(report.by_rows) + " of the wrong " +
                   (report.by_rows == 1 ? "is" : "are") +
                   " within half a row of an edge of the table");
  }
  if (report.step > 1) {
    table.add_note(
        "one in " + grouped(report.step) + " of its " + grouped(report.samples) +
        " samples was judged: all of them make more pairs of a sample and a polygon than "
        "the limit");
  }
}

class CertificateWriter {
 public:
  CertificateWriter(TextSink& sink, const PictureCertificate& certificate, bool times)
      : json_(sink), certificate_(certificate), scene_(*certificate.scene), times_(times) {}

  void write() {
    json_.begin_object();
    json_.member("format", "gnomon-picture-certificate");
    json_.member("version", 1);
    json_.member("scene", scene_.name);
    json_.member("geometry", certificate_.geometry_digest);
    json_.member("clearance", certificate_.clearance);
    json_.member("interrupted", certificate_.interrupted);
    json_.key("moves");
    json_.begin_array();
    for (const std::string& move : certificate_.moves) json_.value(move);
    json_.end_array();
    json_.key("pictures");
    json_.begin_array();
    for (const JudgedPicture& picture : certificate_.pictures) write(picture);
    json_.end_array();
    json_.end_object();
    json_.finish();
  }

 private:
  void write(const JudgedPicture& picture) {
    json_.begin_object();
    json_.member("name", picture.name);
    json_.member("kernel", picture.kernel);
    json_.member("algorithm", picture.algorithm);
    json_.member("foreign", picture.foreign);
    json_.member("exact", picture.exact);
    json_.member("camera", picture.camera);
    json_.member("width", picture.width);
    json_.member("height", picture.height);
    json_.member("verdict", verdict_of(picture));
    if (times_) json_.member("cpu_seconds", picture.cpu_seconds);
    if (!picture.note.empty()) json_.member("note", picture.note);
    if (!picture.report) {
      json_.member("error", picture.error);
    } else {
      write(picture, *picture.report);
    }
    json_.end_object();
  }
  void write(const JudgedPicture& picture, const oracle::ImageReport& report) {
    if (!report.reason.empty()) json_.member("reason", report.reason);
    json_.member("samples", report.samples);
    json_.member("step", report.step);
    json_.member("judged", report.judged);
    json_.member("boundary", report.boundary);
    json_.member("wrong", report.wrong);
    json_.member("wrong_polygon", report.wrong_polygon);
    json_.member("ill_conditioned", report.ill_conditioned);
    json_.member("by_rows", report.by_rows);
    json_.key("wrong_of_lights");
    json_.begin_object(JsonLayout::kInline);
    for (std::size_t l = 0; l < picture.lights.size(); ++l) {
      json_.member(scene_.lights[picture.lights[l]].id, report.wrong_of_light[l]);
    }
    json_.end_object();
    json_.key("worst");
    report.worst ? write(*report.worst) : json_.null();
  }
  void write(const oracle::WrongSample& wrong) {
    json_.begin_object();
    json_.member("column", wrong.i);
    json_.member("row", wrong.j);
    json_.key("point");
    json_.begin_array(JsonLayout::kInline);
    for (const double x : wrong.point) json_.value(x);
    json_.end_array();
    for (const auto& [key, polygon] :
         {std::pair("found", wrong.claimed), std::pair("true", wrong.seen)}) {
      json_.key(key);
      polygon == PixelClaims::kNothing ? json_.null() : json_.value(scene_.polygons[polygon].id);
    }
    if (wrong.light) {
      json_.member("light", scene_.lights[*wrong.light].id);
      json_.member("found_lit", wrong.claimed_lit);
    }
    if (wrong.caster) json_.member("caster", scene_.polygons[*wrong.caster].id);
    json_.key("clearance");
    wrong.clearance ? json_.value(*wrong.clearance) : json_.null();
    json_.member("text", place_in_words(scene_, wrong));
    json_.end_object();
  }

  JsonWriter json_;
  const PictureCertificate& certificate_;
  const Scene& scene_;
  bool times_;
};

}  // namespace

std::string picture_certificate_text(const PictureCertificate& certificate) {
  const Scene& scene = *certificate.scene;
  std::string text =
      "pictures of " + (scene.name.empty() ? scene.file : scene.name) + ", judged sample by sample";
  if (certificate.clearance > 0) {
    text += "; clearance " + rounded(certificate.clearance, 3) + " apart";
  }
  text += '\n';
  for (const std::string& move : certificate.moves) {
    text += wrapped(move, TextTable::kWidth, 0, 2);
  }
  std::string camera;
  TextTable table({{"candidate", Align::kLeft},
                   {"verdict", Align::kLeft},
                   {"judged", Align::kRight},
                   {"on borders", Align::kRight},
                   {"wrong", Align::kRight},
                   {"of polygon", Align::kRight},
                   {"ill-cond.", Align::kRight},
                   {"time", Align::kRight}});
  for (const JudgedPicture& picture : certificate.pictures) {
    const std::string own = std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                            " samples, " + picture.camera;
    if (own != camera) text += wrapped("camera: " + own, TextTable::kWidth, 0, 2);
    camera = own;
    table.add_row(row_of(picture));
    add_notes(scene, picture, table);
  }
  return text + '\n' + table.to_string();
}

void write_picture_certificate_json(TextSink& sink, const PictureCertificate& certificate,
                                    bool times) {
  CertificateWriter(sink, certificate, times).write();
}

}  // namespace gnomon::report
