// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/certify_export.h"

#include "cli/commands/certify_report.h"
#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/output.h"
#include "report/exports/result_export.h"
#include "report/exports/verdict_arrays.h"

namespace gnomon::cli {

void add_certify_export_option(CLI::App& command, std::vector<std::string>& files) {
  repeatable(
      command.add_option(
          "--export", files,
          "Write the exact answer with the errors of every run at each polygon side, as .vtp "
          "(VTK,\nParaView; repeatable)"))
      ->type_name("FILE");
}

Expected<void> check_certify_exports(const std::vector<std::string>& files) {
  for (const std::string& file : files) {
    const auto format = report::export_format(file);
    if (format && *format == report::ExportFormat::kVtp) continue;
    ErrorPlace where;
    where.file = file;
    return fail(ErrorCode::kUsage, "errors are not exported to files of this extension", ".vtp",
                where);
  }
  return {};
}

Expected<void> write_certify_exports(const std::vector<std::string>& files,
                                     const LoadedScene& loaded,
                                     const report::Certificate& certificate) {
  if (files.empty() || certificate.interrupted) return {};
  const auto exact = exact_result(loaded);
  if (!exact) return tl::unexpected(exact.error());
  for (const std::string& file : files) {
    auto output = Output::open(file);
    if (!output) return tl::unexpected(std::move(output.error()));
    output->give_up_if(interrupted());
    if (auto done = report::write_verdict_vtp(*output, certificate, *exact); !done) {
      done.error().where.file = file;
      return done;
    }
    if (auto done = output->finish(); !done) return done;
  }
  return {};
}

}  // namespace gnomon::cli
