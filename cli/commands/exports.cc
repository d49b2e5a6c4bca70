// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/commands/exports.h"

#include "cli/common/commands.h"
#include "cli/common/interrupt.h"
#include "cli/common/output.h"
#include "report/exports/result_export.h"

namespace gnomon::cli {

void add_export_option(CLI::App& command, ExportOptions& options) {
  repeatable(command.add_option(
                 "--export", options.files,
                 "Write the fragments for other programs: .vtp (VTK, ParaView), .geojson (shadows "
                 "on level\nground), .glb (a colour a class), .city.json (shares as attributes). "
                 "Without -o no result is written then "
                 "(repeatable)"))
      ->type_name("FILE");
}

Expected<void> check_exports(const ExportOptions& options) {
  for (const std::string& file : options.files) {
    if (auto format = report::export_format(file); !format) {
      return tl::unexpected(std::move(format.error()));
    }
  }
  return {};
}

Expected<void> write_exports(const ExportOptions& options, const LoadedScene& loaded,
                             const ShadowResult& result) {
  for (const std::string& file : options.files) {
    const auto format = report::export_format(file);
    if (!format) return tl::unexpected(format.error());
    auto output = Output::open(file);
    if (!output) return tl::unexpected(std::move(output.error()));
    output->give_up_if(interrupted());
    if (auto done = report::write_export(*output, *format, loaded.scene, loaded.prepared, result);
        !done) {
      done.error().where.file = file;
      return done;
    }
    if (auto done = output->finish(); !done) return done;
  }
  return {};
}

}  // namespace gnomon::cli
