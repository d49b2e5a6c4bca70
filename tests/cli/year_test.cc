// SPDX-License-Identifier: GPL-3.0-or-later
// gnomon year: tables in all formats, held against each other, against `shadows` under the same
// suns, and against what can be worked out by hand; shards, and going on after an interruption.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "run_gnomon.h"

namespace gnomon::test {
namespace {

using testing::HasSubstr;

/// A plate of 1 x 1 at a height of 1 above a ground of 10 x 10, which has no underside.
constexpr const char* kPlate = R"({"format": "gnomon-scene", "version": 1, "name": "plate",
 "vertices": [[-5,-5,0],[5,-5,0],[5,5,0],[-5,5,0], [0,0,1],[1,0,1],[1,1,1],[0,1,1]],
 "polygons": [{"id": "ground", "loop": [0,1,2,3]},
              {"id": "plate, \"thin\"", "loop": [4,5,6,7], "two_sided": true}]})";
const std::vector<std::string> kPhoenix{"--at=33.45,-111.98", "--tz", "-7"};

std::vector<std::string> year(const std::string& scene, std::vector<std::string> more) {
  std::vector<std::string> arguments{"year", scene};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}
std::vector<std::string> phoenix(const std::string& scene, std::vector<std::string> more) {
  more.insert(more.begin(), kPhoenix.begin(), kPhoenix.end());
  return year(scene, more);
}
std::string run(const std::vector<std::string>& arguments) {
  const RunResult done = run_gnomon(arguments);
  EXPECT_EQ(done.status, 0) << done.err;
  return done.out;
}

struct Table {
  std::vector<std::string> times;
  std::vector<std::vector<double>> values;  // sun_x, sun_y, sun_z and the sides
};
/// Of a table none of whose names has a comma within its last columns.
Table table_of(const std::string& text) {
  Table table;
  std::istringstream lines(text);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    table.times.push_back(cell);
    auto& row = table.values.emplace_back();
    while (std::getline(cells, cell, ',')) {
      double value = 0;
      const auto read = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      EXPECT_EQ(read.ptr, cell.data() + cell.size()) << cell;
      row.push_back(value);
    }
  }
  return table;
}

class Year : public testing::Test {
 protected:
  Year() { write_text(scene(), kPlate); }
  std::string scene() const { return file("plate.json"); }
  std::string file(const std::string& name) const { return directory_.file(name); }
  TestDirectory directory_;
};

/// The shadow is the plate, moved by the sun's direction: what of it is on the ground is missing.
TEST_F(Year, IsWhatCanBeWorkedOutByHand) {
  const Table table = table_of(run(phoenix(scene(), {"--from", "03-19", "--to", "03-21"})));
  ASSERT_EQ(table.times.size(), 72u);
  unsigned partly = 0, nights = 0;
  for (const std::vector<double>& row : table.values) {
    const double x = row[0], y = row[1], z = row[2], ground = row[3];
    ASSERT_EQ(row.size(), 6u);
    EXPECT_NEAR(x * x + y * y + z * z, 1, 3e-6);
    if (z <= 0) {
      ++nights;
      EXPECT_EQ(ground, 0);
      EXPECT_EQ(row[4], 0);
      continue;
    }
    const auto overlap = [](double moved) {
      return std::max(0.0, std::min(5.0, 1 - moved) - std::max(-5.0, -moved));
    };
    const double shadow = overlap(x / z) * overlap(y / z) / 100;
    EXPECT_NEAR(ground, 1 - shadow, 1e-14);
    partly += shadow > 0 && shadow < 0.01;
    EXPECT_EQ(row[4], 1);
    EXPECT_EQ(row[5], 0);  // the plate's back
  }
  EXPECT_GT(partly, 0u);
  EXPECT_EQ(nights, 36u);
  EXPECT_EQ(table.times[6], "2025-03-19T06:30:00-07:00");
}

/// The suns of the table as lights of `shadows`: the same numbers to the last digit.
TEST_F(Year, IsWhatShadowsSays) {
  const std::string csv =
      run(phoenix(scene(), {"--from", "06-21", "--to", "06-21", "--step", "20"}));
  const Table table = table_of(csv);
  std::string lights = R"({"format": "gnomon-scene", "version": 1, "lights": [)";
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < table.values.size(); ++i) {
    const auto& row = table.values[i];
    if (row[2] <= 0) continue;
    char text[200];
    std::snprintf(text, sizeof text,
                  R"(%s{"id": "%zu", "type": "directional", "to_light": [%.6f, %.6f, %.6f]})",
                  rows.empty() ? "" : ",", i, row[0], row[1], row[2]);
    lights += text;
    rows.push_back(i);
  }
  write_text(file("suns.json"), lights + "]}");
  run({"shadows", scene(), "--numbers", "decimal", "--lights", file("suns.json"), "--shares",
       file("s.csv")});
  const Table shares = table_of(read_text(file("s.csv")));
  ASSERT_EQ(shares.values.size(), rows.size());
  ASSERT_GT(rows.size(), 30u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = table.values[rows[i]];
    EXPECT_EQ(shares.values[i], std::vector<double>(row.begin() + 3, row.end()));
  }
}

TEST_F(Year, FormatsSayTheSame) {
  const std::vector<std::string> span{"--from", "10-01", "--to", "10-05"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), span.begin(), span.end());
    return run(phoenix(scene(), more));
  };
  const std::string told = with({"-o", file("t.csv")});
  EXPECT_EQ(told, with({"-o", file("t.npy")}));
  EXPECT_EQ(told,
            with({"-o", file("t.nc"), "--hours", file("h.csv"), "--eplus-shading", file("e.csv")}));
  EXPECT_THAT(told, HasSubstr("120 rows, 60 with the sun up, of 3 sides; checksum "));
  const Table csv = table_of(read_text(file("t.csv")));
  ASSERT_EQ(csv.values.size(), 120u);

  const std::string npy = read_text(file("t.npy"));
  ASSERT_EQ(npy.size(), 192 + 120 * 3 * sizeof(double));
  EXPECT_THAT(npy.substr(0, 192), HasSubstr("'shape': (120, 3)"));
  EXPECT_THAT(read_text(file("t.npy.json")), HasSubstr("\"2025-10-01T00:30:00-07:00\""));

  int id = 0, lit = 0, time = 0, side = 0;
  ASSERT_EQ(nc_open(file("t.nc").c_str(), NC_NOWRITE, &id), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(id, "lit", &lit), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(id, "time", &time), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(id, "side", &side), NC_NOERR);
  std::vector<double> values(120 * 3), times(120);
  ASSERT_EQ(nc_get_var_double(id, lit, values.data()), NC_NOERR);
  ASSERT_EQ(nc_get_var_double(id, time, times.data()), NC_NOERR);
  std::array<char*, 3> names{};
  ASSERT_EQ(nc_get_var_string(id, side, names.data()), NC_NOERR);
  EXPECT_STREQ(names[2], "plate, \"thin\"#back");
  nc_free_string(3, names.data());
  ASSERT_EQ(nc_close(id), NC_NOERR);
  EXPECT_EQ(times[0], 1759303800);  // 2025-10-01 07:30 UTC
  with({"-o", file("short.nc"), "--digits", "4"});
  ASSERT_EQ(nc_open(file("short.nc").c_str(), NC_NOWRITE, &id), NC_NOERR);
  ASSERT_EQ(nc_inq_varid(id, "lit", &lit), NC_NOERR);
  std::vector<double> rough(120 * 3);
  ASSERT_EQ(nc_get_var_double(id, lit, rough.data()), NC_NOERR);
  ASSERT_EQ(nc_close(id), NC_NOERR);
  double hours = 0;
  for (std::size_t i = 0; i < 120; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double share = csv.values[i][3 + k];
      double from_npy = 0;
      std::memcpy(&from_npy, npy.data() + 192 + (3 * i + k) * sizeof(double), sizeof(double));
      EXPECT_EQ(share, from_npy);
      EXPECT_EQ(static_cast<float>(share), values[120 * k + i]);
      EXPECT_NEAR(share, rough[120 * k + i], 0.5e-4 * share);
    }
    hours += csv.values[i][3];
  }
  std::istringstream sums(read_text(file("h.csv")));
  std::string line;
  std::getline(sums, line);
  EXPECT_EQ(line, "side,all,01,02,03,04,05,06,07,08,09,10,11,12");
  std::getline(sums, line);
  const std::string ground = line.substr(line.find(',') + 1);
  EXPECT_NEAR(std::stod(ground), hours, 1e-6);
  EXPECT_THAT(read_text(file("h.csv")), HasSubstr("\ndaylight,60,0,0,0,0,0,0,0,0,0,60,0,0\n"));
  const std::string shading = read_text(file("e.csv"));
  EXPECT_EQ(shading.substr(0, shading.find('\n')), "Surface Name,ground,\"plate, \"\"thin\"\"\"");
  EXPECT_THAT(shading, HasSubstr("\n10/01 24:00,0.00000000,0.00000000\n"));
  EXPECT_EQ(std::ranges::count(shading, '\n'), 121);
}

/// A wall of 2 x 2 with a window of 1 x 1 in its hole, under a ledge.
TEST_F(Year, WallsWithTheirWindows) {
  write_text(file("wall.json"), R"({"format": "gnomon-scene", "version": 1,
 "vertices": [[0,0,0],[2,0,0],[2,0,2],[0,0,2], [0.5,0,0.5],[1.5,0,0.5],[1.5,0,1.5],[0.5,0,1.5],
              [0,0,2],[2,0,2],[2,-0.5,2],[0,-0.5,2]],
 "polygons": [{"id": "wall", "loop": [0,1,2,3], "holes": [[7,6,5,4]]},
              {"id": "window", "loop": [4,5,6,7]},
              {"id": "ledge", "loop": [8,9,10,11], "two_sided": true}]})");
  const Table table =
      table_of(run(phoenix(file("wall.json"), {"--gross", "--from", "12-21", "--to", "12-21"})));
  unsigned partly = 0;
  for (const auto& row : table.values) {
    ASSERT_EQ(row.size(), 8u);
    const double wall = row[3], window = row[4], gross = row[7];
    EXPECT_NEAR(gross, (3 * wall + window) / 4, 1e-15);
    partly += gross > 0 && gross < 1;
  }
  EXPECT_GT(partly, 4u);
}

TEST_F(Year, ShardsAddUp) {
  const std::vector<std::string> span{"--from", "02-01", "--to", "02-02"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), span.begin(), span.end());
    return run(phoenix(scene(), more));
  };
  const std::string told = with({"-o", file("whole.csv")});
  EXPECT_THAT(with({"--db", file("0.db"), "--shard", "0/2"}), HasSubstr("24 of 48 rows are done"));
  EXPECT_THAT(with({"--db", file("1.db"), "--shard", "1/2"}), HasSubstr("24 of 48 rows are done"));
  EXPECT_THAT(with({"--db", file("all.db"), "--merge", file("0.db"), "-o", file("merged.csv")}),
              HasSubstr("no table is written before all are"));
  EXPECT_FALSE(std::filesystem::exists(file("merged.csv")));
  EXPECT_EQ(with({"--db", file("all.db"), "--merge", file("1.db"), "-o", file("merged.csv")}),
            told);
  EXPECT_EQ(read_text(file("whole.csv")), read_text(file("merged.csv")));

  const RunResult other =
      run_gnomon(phoenix(scene(), {"--from", "02-01", "--to", "02-03", "--db", file("all.db")}));
  EXPECT_EQ(other.status, 2);
  EXPECT_THAT(other.err, HasSubstr("holds another year: last day: "));
  const RunResult none = run_gnomon(phoenix(scene(), {"--from", "02-01", "--to", "02-02", "--db",
                                                      file("x.db"), "--merge", file("no.db")}));
  EXPECT_EQ(none.status, 2);
  EXPECT_FALSE(std::filesystem::exists(file("no.db")));
}

TEST_F(Year, GoesOnAfterAnInterruption) {
  run({"generate", "city", "--param", "n=400", "-o", file("city.json")});
  const std::vector<std::string> span{"--from", "05-01", "--to", "05-20"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), span.begin(), span.end());
    return phoenix(file("city.json"), more);
  };
  RunOptions stopped;
  stopped.signal = SIGINT;
  stopped.signal_when = [&] { return std::filesystem::exists(file("c.db")); };
  stopped.signal_after = 0.1;
  const RunResult first = run_gnomon(with({"--db", file("c.db"), "-o", file("c.csv")}), stopped);
  EXPECT_FALSE(first.status == 0 && !std::filesystem::exists(file("c.csv")));
  if (first.status != 0) {
    EXPECT_EQ(first.status, 130) << first.err;
    EXPECT_THAT(first.err, HasSubstr("the same command goes on"));
  }
  const std::string told = run(with({"--db", file("c.db"), "-o", file("c.csv")}));
  EXPECT_EQ(told, run(with({"-o", file("whole.csv")})));
  EXPECT_EQ(read_text(file("c.csv")), read_text(file("whole.csv")));
}

TEST_F(Year, TheSunOfEnergyPlusIsComputedOncePerPeriod) {
  const std::vector<std::string> model{"--sun-model", "energyplus", "--average-days", "20",
                                       "--from",      "01-01",      "--to",           "02-09"};
  const Table table = table_of(run(phoenix(scene(), model)));
  ASSERT_EQ(table.values.size(), 40u * 24);
  for (std::size_t hour = 0; hour < 24; ++hour) {
    EXPECT_EQ(table.values[hour], table.values[19 * 24 + hour]);
  }
  EXPECT_NE(table.values[12], table.values[20 * 24 + 12]);
}

TEST_F(Year, PlacesOfFiles) {
  write_text(file("w.epw"), "LOCATION,Town,S,C,x,1,33.45,-111.98,-7.0,337\nDESIGN\n");
  const std::vector<std::string> day{"--from", "03-20", "--to", "03-20"};
  auto with_epw = day, with_at = day;
  with_epw.insert(with_epw.end(), {"--epw", file("w.epw")});
  with_at.insert(with_at.end(), {"--elevation", "337"});
  EXPECT_EQ(run(year(scene(), with_epw)), run(phoenix(scene(), with_at)));
}

/// A building with a north axis: the sun is turned, by `year` and by `certify` of its table. Turned
/// geometry under the world's sun gives the same, but for six digits of the sun.
TEST_F(Year, TheSunIsTurnedForTheBuilding) {
  write_text(file("house.idf"), R"(Version, 23.1;
Building, House, 30;
GlobalGeometryRules, UpperLeftCorner, Counterclockwise, Relative;
Zone, Hall, 0, 0, 0, 0;
BuildingSurface:Detailed, South, Wall, C, Hall, , Outdoors, , , , , 4, 0,0,3, 0,0,0, 8,0,0, 8,0,3;
Shading:Building:Detailed, Ledge, , 4, 0,0,3, 8,0,3, 8,-1,3, 0,-1,3;
)");
  const std::vector<std::string> day{"--from", "02-20", "--to", "02-20"};
  run({"convert", file("house.idf"), file("turned.json")});
  const std::string csv = run(phoenix(file("house.idf"), day));
  const Table own = table_of(csv), world = table_of(run(phoenix(file("turned.json"), day)));
  ASSERT_EQ(own.values.size(), world.values.size());
  unsigned partly = 0;
  for (std::size_t i = 0; i < own.values.size(); ++i) {
    const auto &a = own.values[i], &b = world.values[i];
    const double cosine = std::sqrt(0.75);
    EXPECT_NEAR(a[0], cosine * b[0] - 0.5 * b[1], 2e-6);
    EXPECT_NEAR(a[1], 0.5 * b[0] + cosine * b[1], 2e-6);
    for (std::size_t k = 3; k < a.size(); ++k) EXPECT_NEAR(a[k], b[k], 1e-4) << i << ' ' << k;
    partly += a[3] > 0 && a[3] < 1;
  }
  EXPECT_GT(partly, 3u);
  write_text(file("own.csv"), csv);
  run({"certify", file("house.idf"), "--candidate", file("own.csv")});
}

TEST_F(Year, NightsAndLeapDays) {
  const Table polar =
      table_of(run(year(scene(), {"--at=80,10", "--tz", "1", "--from", "12-20", "--to", "12-21"})));
  ASSERT_EQ(polar.values.size(), 48u);
  for (const auto& row : polar.values) EXPECT_EQ(row[3] + row[4] + row[5], 0);
  const Table leap =
      table_of(run(phoenix(scene(), {"--year", "2024", "--from", "02-28", "--to", "03-01"})));
  EXPECT_EQ(leap.values.size(), 72u);
  EXPECT_EQ(leap.times[24].substr(0, 10), "2024-02-29");
  const Table nepal = table_of(
      run(year(scene(), {"--at=27.7,85.3", "--tz", "5:45", "--from", "02-28", "--to", "02-28"})));
  EXPECT_THAT(nepal.times[0], HasSubstr("+05:45"));
}

TEST_F(Year, WrongOptionsAreOneLine) {
  const auto refused = [&](std::vector<std::string> more, const std::string& words) {
    const RunResult done = run_gnomon(year(scene(), more));
    EXPECT_EQ(done.status, 2) << words << done.err;
    EXPECT_THAT(done.err, HasSubstr(words));
    EXPECT_EQ(done.out, "") << words;
    EXPECT_EQ(std::ranges::count(done.err, '\n'), 1) << done.err;
  };
  refused({}, "no place is known; expected --at LAT,LON and --tz H, --epw FILE");
  refused({"--at=33.45,-111.98"}, "--at without a time zone");
  refused({"--tz", "3"}, "--tz without a place");
  refused({"--at=91,0", "--tz", "0"}, "no latitude");
  refused({"--at=1,2", "--tz", "PST"}, "no time zone");
  refused({"--at=1,2", "--tz", "0", "--epw", "x.epw"}, "two places");
  refused({"--epw", file("absent.epw")}, "absent.epw");
  refused({"--at=1,2", "--tz", "0", "--from", "02-29"}, "not a day of the year 2025");
  refused({"--at=1,2", "--tz", "0", "--from", "05-02", "--to", "05-01"}, "the last day is before");
  refused({"--at=1,2", "--tz", "0", "--step", "7"}, "does not divide a day");
  refused({"--at=1,2", "--tz", "0", "--average-days", "3"}, "--sun-model energyplus too");
  refused({"--at=1,2", "--tz", "0", "--pressure", "900"}, "--refraction too");
  refused({"--at=1,2", "--tz", "0", "--shard", "0/2"}, "--db FILE too");
  refused({"--at=1,2", "--tz", "0", "--db", file("d.db"), "--shard", "2/2"},
          "no share of the rows");
  refused({"--at=1,2", "--tz", "0", "-o", file("t.xlsx")}, "names no format of years");
  refused({"--at=1,2", "--tz", "0", "-o", "/nowhere/t.nc"}, "/nowhere/t.nc");
  refused({"--at=1,2", "--tz", "0", "-o", file("t.csv"), "--hours", "/nowhere/h.csv"},
          "/nowhere/h.csv");
  EXPECT_FALSE(std::filesystem::exists(file("t.csv")));
  refused({"--at=1,2", "--tz", "0", "--db", scene()}, "plate.json: ");
  EXPECT_EQ(read_text(scene()), kPlate);
}

}  // namespace
}  // namespace gnomon::test
