// SPDX-License-Identifier: GPL-3.0-or-later
// The module gnomon._native: what the package gnomon is made of. It is private, and thin: names and
// defaults, shapes and docstrings are the package's (python/gnomon).
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <chrono>
#include <utility>

#include "gnomon/scene/digest.h"
#include "python/binding/arrays.h"
#include "python/binding/certify.h"
#include "python/binding/errors.h"
#include "python/binding/interruptible.h"
#include "python/binding/lit_shares.h"
#include "python/binding/loaded_scene.h"
#include "python/binding/shadows.h"
#include "python/binding/year.h"
#include "report/shares/share_columns.h"
#include "report/sides/part_area.h"
#include "suns/position/sun_model.h"
#include "suns/year/year_of_suns.h"

namespace gnomon::python {

namespace {

/// Arrays and words by name.
using Record = nb::typed<nb::dict, nb::str, nb::any>;

/// Scenes never change, but nanobind's holders know no const.
using SceneHandle = std::shared_ptr<LoadedScene>;
SceneHandle handle(LoadedScenePtr scene) { return std::const_pointer_cast<LoadedScene>(scene); }

SceneHandle read_file(const std::string& path, const std::string& numbers, bool two_sided,
                      bool skip_bad, const std::string& lod, bool keep_axes) {
  ReadOptions options;
  if (!numbers.empty()) options.numbers = value_or_raise(meaning_of(numbers, {}));
  options.skip_bad = skip_bad;
  options.lod = lod;
  options.keep_axes = keep_axes;
  return handle(value_or_raise(interruptibly(
      [&](const std::atomic<bool>& stop) { return read(path, options, two_sided, stop); })));
}

SceneHandle from_arrays(const Points& vertices, const Integers& indices, const Integers& offsets,
                        std::vector<std::string> ids, const std::optional<Flags>& casts,
                        bool two_sided, const std::string& numbers, const std::string& name) {
  const SceneArrays arrays{vertices, indices,   offsets, std::move(ids),
                           casts,    two_sided, numbers, name};
  return handle(value_or_raise(
      interruptibly([&](const std::atomic<bool>& stop) { return scene_from(arrays, stop); })));
}

std::vector<std::string> polygon_ids(const LoadedScene& loaded) {
  std::vector<std::string> ids;
  for (const Polygon& polygon : loaded.scene.polygons) ids.push_back(polygon.id);
  return ids;
}

std::vector<std::string> light_ids(const LoadedScene& loaded) {
  std::vector<std::string> ids;
  for (const Light& light : loaded.scene.lights) ids.push_back(light.id);
  return ids;
}

nb::object areas(const LoadedScene& loaded) {
  const report::PolygonAreas areas(loaded.prepared);
  std::vector<double> values;
  for (std::uint32_t i = 0; i < loaded.scene.polygons.size(); ++i) {
    values.push_back(areas.nearest(i));
  }
  const std::size_t count = values.size();
  return to_numpy(std::move(values), {count});
}

std::vector<Light> suns_of(const LoadedScene& loaded, const Points& vectors,
                           const std::string& numbers) {
  const NumberMeaning meaning = value_or_raise(meaning_of(numbers, loaded.scene.numbers));
  return value_or_raise(suns_from(vectors, meaning));
}

nb::object sunlit(const LoadedScene& loaded, const Points& vectors, const std::string& numbers,
                  bool fronts, const RunNames& names) {
  std::vector<Light> lights = suns_of(loaded, vectors, numbers);
  auto shares = value_or_raise(interruptibly([&](const std::atomic<bool>& stop) {
    return lit_shares(loaded, std::move(lights), fronts, names, stop);
  }));
  return to_numpy(std::move(shares.values), {shares.lights, shares.columns});
}

std::vector<std::string> sunlit_exact(const LoadedScene& loaded, const Points& vectors,
                                      const std::string& numbers, bool fronts,
                                      const RunNames& names) {
  std::vector<Light> lights = suns_of(loaded, vectors, numbers);
  return value_or_raise(interruptibly([&](const std::atomic<bool>& stop) {
           return exact_shares(loaded, std::move(lights), fronts, names, stop);
         }))
      .values;
}

/// Seconds since 1970 of a clock of that zone, in UTC.
std::int64_t in_utc(suns::CivilTime time, suns::Minutes zone) {
  return (time.time_since_epoch() - std::chrono::seconds(zone)).count();
}

/// Azimuths, altitudes and millionths of directions, by name.
Record sun_arrays(const std::vector<suns::SunTime>& times) {
  std::vector<double> azimuth, altitude, direction;
  for (const suns::SunTime& sun : times) {
    azimuth.push_back(sun.angles.azimuth);
    altitude.push_back(sun.angles.altitude);
    for (const std::int32_t millionths : sun.direction) direction.push_back(millionths / 1e6);
  }
  nb::dict arrays;
  arrays["azimuth"] = to_numpy(std::move(azimuth), {times.size()});
  arrays["altitude"] = to_numpy(std::move(altitude), {times.size()});
  arrays["direction"] = to_numpy(std::move(direction), {times.size(), 3});
  return arrays;
}

Record year_of(const LoadedScene& loaded, const suns::AskedSuns& asked, bool gross,
               const RunNames& names) {
  Year found = value_or_raise(interruptibly(
      [&](const std::atomic<bool>& stop) { return year(loaded, asked, gross, names, stop); }));
  const suns::Minutes zone = found.asked.place.zone;
  std::vector<std::int64_t> times;
  for (const suns::SunTime& sun : found.times) times.push_back(in_utc(sun.at, zone));
  nb::dict result = sun_arrays(found.times);
  result["time"] = to_numpy(std::move(times), {found.times.size()});
  result["lit"] = to_numpy(std::move(found.lit), {found.times.size(), found.sides.size()});
  result["side"] = found.sides;
  result["geometry"] = found.geometry;
  result["kernel"] = found.kernel;
  result["checksum"] = found.checksum;
  result["latitude"] = found.asked.place.latitude;
  result["longitude"] = found.asked.place.longitude;
  result["zone_minutes"] = zone.count();
  return result;
}

/// `times`: seconds since 1970 in UTC.
Record suns_at_times(double latitude, double longitude, const Integers& times, double elevation,
                     double north, const std::string& model, bool refraction) {
  suns::AskedSuns asked;
  asked.sun_model = model;
  value_or_raise(suns::check_asked_suns(asked));
  suns::YearOptions options;
  options.place.latitude = latitude;
  options.place.longitude = longitude;
  options.place.elevation = elevation;
  value_or_raise(suns::check_place(options.place, "the place"));
  options.model = suns::sun_model_by_name(model).value();
  options.north = north;
  options.refraction = refraction;
  options.air.pressure = suns::standard_pressure(elevation);
  std::vector<suns::CivilTime> civil;
  for (std::size_t i = 0; i < times.shape(0); ++i) {
    civil.emplace_back(std::chrono::seconds(times(i)));
  }
  const auto found = value_or_raise(
      interruptibly([&](const std::atomic<bool>&) { return suns::suns_at(options, civil); }));
  return sun_arrays(found);
}

LightState state_by_name(const std::string& name) {
  const auto state = light_state_by_name(name);
  if (!state) {
    raise(Error{
        ErrorCode::kUsage, {}, "'" + name + "' is no class", "lit, shadow, penumbra or umbra"});
  }
  return *state;
}

Record fragment_arrays(const Shadows& shadows) {
  FragmentArrays arrays = shadows.fragments();
  const std::size_t count = arrays.light.size(), points = arrays.points.size() / 3;
  nb::dict result;
  result["points"] = to_numpy(std::move(arrays.points), {points, 3});
  result["offsets"] = to_numpy(std::move(arrays.offsets), {count + 1});
  result["light"] = to_numpy(std::move(arrays.light), {count});
  result["polygon"] = to_numpy(std::move(arrays.polygon), {count});
  result["caster"] = to_numpy(std::move(arrays.caster), {count});
  result["back"] = to_numpy(std::move(arrays.back), {count});
  result["state"] = to_numpy(std::move(arrays.state), {count});
  return result;
}

std::pair<std::string, std::string> judged(Expected<Judgement>&& judgement) {
  Judgement found = value_or_raise(std::move(judgement));
  return {std::move(found.text), std::move(found.json)};
}

void add_records(nb::module_& module) {
  nb::class_<RunNames>(module, "RunNames")
      .def(nb::init<>())
      .def_rw("kernel", &RunNames::kernel)
      .def_rw("algorithm", &RunNames::algorithm)
      .def_rw("jobs", &RunNames::jobs);
  nb::class_<AskedLights>(module, "AskedLights")
      .def(nb::init<>())
      .def_rw("ids", &AskedLights::ids, nb::arg().none())
      .def_rw("suns", &AskedLights::suns, nb::arg().none())
      .def_rw("points", &AskedLights::points, nb::arg().none())
      .def_rw("areas", &AskedLights::areas)
      .def_rw("numbers", &AskedLights::numbers);
  nb::class_<suns::AskedSuns>(module, "AskedSuns")
      .def(nb::init<>())
      .def_rw("at", &suns::AskedSuns::at)
      .def_rw("tz", &suns::AskedSuns::zone)
      .def_rw("epw", &suns::AskedSuns::weather)
      .def_rw("elevation", &suns::AskedSuns::elevation, nb::arg().none())
      .def_rw("north", &suns::AskedSuns::north, nb::arg().none())
      .def_rw("year", &suns::AskedSuns::year)
      .def_rw("first", &suns::AskedSuns::from)
      .def_rw("last", &suns::AskedSuns::to)
      .def_rw("step", &suns::AskedSuns::step)
      .def_rw("sun_at", &suns::AskedSuns::sun_at)
      .def_rw("sun_model", &suns::AskedSuns::sun_model)
      .def_rw("average_days", &suns::AskedSuns::average_days)
      .def_rw("refraction", &suns::AskedSuns::refraction)
      .def_rw("pressure", &suns::AskedSuns::pressure, nb::arg().none())
      .def_rw("temperature", &suns::AskedSuns::temperature, nb::arg().none());
  nb::class_<Limits>(module, "Limits")
      .def(nb::init<>())
      .def_rw("tolerance", &Limits::tolerance, nb::arg().none())
      .def_rw("width", &Limits::width, nb::arg().none())
      .def_rw("clearance", &Limits::clearance)
      .def_rw("strict", &Limits::strict)
      .def_rw("subset", &Limits::subset)
      .def_rw("jobs", &Limits::jobs);
}

void add_scene(nb::module_& module) {
  nb::class_<LoadedScene>(module, "Scene")
      .def_prop_ro("name", [](const LoadedScene& loaded) { return loaded.scene.name; })
      .def_prop_ro("polygons", &polygon_ids)
      .def_prop_ro("lights", &light_ids)
      .def_prop_ro("sides",
                   [](const LoadedScene& loaded) {
                     return report::ShareColumns(loaded.scene, loaded.prepared).names();
                   })
      .def_prop_ro("areas", &areas)
      .def_prop_ro("geometry",
                   [](const LoadedScene& loaded) { return geometry_digest(loaded.scene); })
      .def_prop_ro(
          "decimal",
          [](const LoadedScene& loaded) { return loaded.scene.numbers == NumberMeaning::kDecimal; })
      .def_ro("left_out", &LoadedScene::left_out)
      .def_ro("warnings", &LoadedScene::warnings)
      .def("sunlit", &sunlit)
      .def("sunlit_exact", &sunlit_exact)
      .def("year", &year_of)
      .def("shadows",
           [](const SceneHandle& scene, const AskedLights& lights, bool fragments, bool exact,
              const RunNames& names) {
             return value_or_raise(interruptibly([&](const std::atomic<bool>& stop) {
               return Shadows::compute(scene, lights, fragments, exact, names, stop);
             }));
           })
      .def("certify", [](const SceneHandle& scene, const AskedLights& lights,
                         const std::string& result, const std::string& name, const Limits& limits) {
        return judged(interruptibly([&](const std::atomic<bool>& stop) {
          return certify(scene, lights, result, name, limits, stop);
        }));
      });
}

void add_shadows(nb::module_& module) {
  nb::class_<Shadows>(module, "Shadows")
      .def_prop_ro("lights", &Shadows::lights)
      .def_prop_ro("sides", &Shadows::sides)
      .def_prop_ro("kernel", &Shadows::kernel)
      .def_prop_ro("algorithm", &Shadows::algorithm)
      .def_prop_ro("has_fragments", &Shadows::has_fragments)
      .def_prop_ro("is_exact", &Shadows::is_exact)
      .def("shares",
           [](const Shadows& shadows, const std::string& state) {
             std::vector<double> values = shadows.shares(state_by_name(state));
             const std::size_t lights = shadows.light_count();
             const std::size_t columns = lights == 0 ? 0 : values.size() / lights;
             return to_numpy(std::move(values), {lights, columns});
           })
      .def("exact_shares",
           [](const Shadows& shadows, const std::string& state) {
             return shadows.exact_shares(state_by_name(state));
           })
      .def("fragments", &fragment_arrays)
      .def("exact_points", &Shadows::exact_points)
      .def("json", &Shadows::json)
      .def("certify", [](const Shadows& shadows, const Limits& limits) {
        return judged(interruptibly(
            [&](const std::atomic<bool>& stop) { return certify(shadows, limits, stop); }));
      });
}

}  // namespace

// NOLINTNEXTLINE: the macro of nanobind
NB_MODULE(_native, module) {
  module.doc() = "Private: use the package gnomon.";
  module.attr("version") = GNOMON_VERSION;
  add_records(module);
  add_scene(module);
  add_shadows(module);
  module.def("read", &read_file);
  module.def("from_arrays", &from_arrays, nb::arg(), nb::arg(), nb::arg(), nb::arg(),
             nb::arg().none(), nb::arg(), nb::arg(), nb::arg());
  module.def("suns_at", &suns_at_times);
}

}  // namespace gnomon::python
