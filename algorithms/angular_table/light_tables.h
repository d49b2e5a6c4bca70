// SPDX-License-Identifier: LGPL-3.0-or-later
// The angular tables of one light: one, or one for each of six pyramids around a lamp. All threads
// read them.
#ifndef GNOMON_ALGORITHMS_ANGULAR_TABLE_LIGHT_TABLES_H
#define GNOMON_ALGORITHMS_ANGULAR_TABLE_LIGHT_TABLES_H

#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/angular_table/angular_table.h"
#include "algorithms/angular_table/near_chart.h"
#include "algorithms/pixels/pixel_task.h"

namespace gnomon {

class LightTables {
 public:
  /// `receives`: by parts, those of which a sample may be looked up. Errors: kGeometry, if the
  /// scene is none that the options allow: see solid_checks.h.
  static Expected<LightTables> make(const PixelTask& task, std::uint32_t light,
                                    const std::vector<TableObject>& objects,
                                    const std::vector<bool>& receives);

  const std::vector<AngularTable>& tables() const { return tables_; }
  const NearChart& near(std::size_t t) const { return near_[t]; }
  const std::vector<TableObject>& objects() const { return *objects_; }
  std::uint32_t object_of(std::uint32_t part) const { return object_of_[part]; }
  bool is_sun() const { return is_sun_; }
  void count(WorkCounts& work) const;

 private:
  std::vector<AngularTable> tables_;
  std::vector<NearChart> near_;
  const std::vector<TableObject>* objects_ = nullptr;
  std::vector<std::uint32_t> object_of_;  // by parts
  bool is_sun_ = false;
};

}  // namespace gnomon

#endif  // GNOMON_ALGORITHMS_ANGULAR_TABLE_LIGHT_TABLES_H
