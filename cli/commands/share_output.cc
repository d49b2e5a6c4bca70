// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/share_output.h"

#include <utility>

#include "cli/common/output.h"
#include "gnomon/scene/digest.h"

namespace gnomon::cli {

Expected<ShareOutput> ShareOutput::open(const std::filesystem::path& file,
                                        const LoadedScene& loaded, KernelId kernel) {
  const auto format = report::share_format(file);
  if (!format) {
    return fail(ErrorCode::kUsage, "--shares " + file.string() + ": its ending names no format",
                "FILE.csv or FILE.npy");
  }
  auto output = OutputFile::open(file);
  if (!output) return tl::unexpected(std::move(output.error()));
  ShareOutput shares(file, loaded, std::move(*output), kernel, *format);
  if (auto written = shares.output_.write(shares.table_.head(loaded.lights.size())); !written) {
    return tl::unexpected(std::move(written.error()));
  }
  return shares;
}

bool ShareOutput::add(const LightResult& light) {
  if (failure_) return false;
  if (auto written = output_.write(table_.row(light)); !written) {
    failure_ = std::move(written.error());
    return false;
  }
  ++lights_;
  return true;
}

Expected<void> ShareOutput::finish() {
  if (failure_) return tl::unexpected(*failure_);
  const std::size_t asked = loaded_->lights.size();
  if (lights_ == 0 && asked > 0) return fail(ErrorCode::kInterrupted, "interrupted");
  if (lights_ < asked && format_ == report::ShareFormat::kNpy) {
    if (auto written = output_.write_over_start(table_.head(lights_)); !written) return written;
  }
  if (auto done = output_.commit(); !done) return done;
  if (format_ == report::ShareFormat::kNpy) {
    report::StringSink names;
    table_.write_names(names, kernel_, geometry_digest(loaded_->scene), file_.filename().string());
    if (auto done = write_output(file_.string() + ".json", names.text()); !done) return done;
  }
  if (lights_ == asked) return {};
  return fail(ErrorCode::kInterrupted, "interrupted: " + file_.string() + " has " +
                                           std::to_string(lights_) + " of " +
                                           std::to_string(asked) + " lights");
}

}  // namespace gnomon::cli
