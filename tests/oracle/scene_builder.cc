// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene_builder.h"

#include <algorithm>
#include <stdexcept>

#include "gnomon/oracle/witness_check.h"
#include "oracle/geometry/group_overlay.h"

namespace gnomon::oracle {

SceneBuilder& SceneBuilder::polygon(const std::string& id, const std::vector<Triple>& loop,
                                    bool two_sided, bool casts) {
  Polygon polygon;
  polygon.id = id;
  for (const Triple& vertex : loop) {
    polygon.loop.push_back(static_cast<VertexId>(scene_.vertices.size()));
    scene_.vertices.push_back({Number(vertex[0]), Number(vertex[1]), Number(vertex[2])});
  }
  polygon.two_sided = two_sided;
  polygon.casts = casts;
  scene_.polygons.push_back(std::move(polygon));
  return *this;
}

SceneBuilder& SceneBuilder::box(const std::string& id, Triple a, Triple b) {
  polygon(id + ".0",
          {{a[0], a[1], a[2]}, {a[0], b[1], a[2]}, {b[0], b[1], a[2]}, {b[0], a[1], a[2]}});
  polygon(id + ".1",
          {{a[0], a[1], b[2]}, {b[0], a[1], b[2]}, {b[0], b[1], b[2]}, {a[0], b[1], b[2]}});
  polygon(id + ".2",
          {{a[0], a[1], a[2]}, {b[0], a[1], a[2]}, {b[0], a[1], b[2]}, {a[0], a[1], b[2]}});
  polygon(id + ".3",
          {{b[0], b[1], a[2]}, {a[0], b[1], a[2]}, {a[0], b[1], b[2]}, {b[0], b[1], b[2]}});
  polygon(id + ".4",
          {{a[0], b[1], a[2]}, {a[0], a[1], a[2]}, {a[0], a[1], b[2]}, {a[0], b[1], b[2]}});
  polygon(id + ".5",
          {{b[0], a[1], a[2]}, {b[0], b[1], a[2]}, {b[0], b[1], b[2]}, {b[0], a[1], b[2]}});
  return *this;
}

SceneBuilder& SceneBuilder::point(const std::string& id, Triple position) {
  Light light;
  light.id = id;
  light.type = LightType::kPoint;
  light.position = {Number(position[0]), Number(position[1]), Number(position[2])};
  scene_.lights.push_back(std::move(light));
  return *this;
}

SceneBuilder& SceneBuilder::sun(const std::string& id, Triple to_light) {
  point(id, to_light);
  scene_.lights.back().type = LightType::kDirectional;
  return *this;
}

SceneBuilder& SceneBuilder::area(const std::string& id, const std::vector<Triple>& loop) {
  Light light;
  light.id = id;
  light.type = LightType::kArea;
  for (const Triple& vertex : loop) {
    light.loop.push_back({Number(vertex[0]), Number(vertex[1]), Number(vertex[2])});
  }
  scene_.lights.push_back(std::move(light));
  return *this;
}

BuiltScene SceneBuilder::build() const {
  Expected<PreparedScene> prepared = prepare(scene_);
  if (!prepared) throw std::runtime_error(to_string(prepared.error()));
  return {scene_, std::move(*prepared)};
}

std::uint64_t Random::next() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

int Random::integer(int low, int high) {
  return low + static_cast<int>(next() % static_cast<std::uint64_t>(high - low + 1));
}

namespace {

Triple lattice_point(Random& random, int size) {
  const double x = random.integer(0, size), y = random.integer(0, size);
  return {x, y, double(random.integer(0, size))};
}

void add_lattice_polygons(Random& random, int polygons, int size, SceneBuilder& builder) {
  for (int i = 0; i < polygons; ++i) {
    const Triple a = lattice_point(random, size), b = lattice_point(random, size);
    const Triple c = lattice_point(random, size);
    std::vector<Triple> loop{a, b, c};
    if (random.integer(0, 1) == 1) {  // a parallelogram
      loop.push_back({a[0] + c[0] - b[0], a[1] + c[1] - b[1], a[2] + c[2] - b[2]});
    }
    builder.polygon(std::to_string(i), loop, random.integer(0, 2) == 0, random.integer(0, 5) != 0);
  }
}

}  // namespace

BuiltScene lattice_soup(std::uint64_t seed, int polygons, int size) {
  Random random(seed);
  SceneBuilder builder;
  add_lattice_polygons(random, polygons, size, builder);
  builder.point("lamp", lattice_point(random, size));
  builder.sun("sun", {double(random.integer(-3, 3)), double(random.integer(-3, 3)),
                      double(random.integer(1, 4))});
  return builder.build();
}

BuiltScene lattice_area_soup(std::uint64_t seed, int polygons, int size) {
  Random random(seed);
  SceneBuilder builder;
  add_lattice_polygons(random, polygons, size, builder);
  for (;;) {
    const Triple a = lattice_point(random, size), b = lattice_point(random, size);
    const Triple c = lattice_point(random, size);
    const Triple u{b[0] - a[0], b[1] - a[1], b[2] - a[2]}, v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    if (u[0] * v[1] == u[1] * v[0] && u[1] * v[2] == u[2] * v[1] && u[0] * v[2] == u[2] * v[0]) {
      continue;
    }
    std::vector<Triple> loop{a, b, c};
    if (random.integer(0, 1) == 1)
      loop.push_back({a[0] + v[0] - u[0], a[1] + v[1] - u[1], a[2] + v[2] - u[2]});
    builder.area("panel", loop);
    return builder.build();
  }
}

RationalPoint at(double x, double y, double z) {
  return {mpq_class(x), mpq_class(y), mpq_class(z)};
}

namespace {

using Loop = std::vector<ChartPoint>;

/// The part of a convex counter-clockwise loop with sign * line >= 0; empty without area.
Loop half(const Loop& loop, const ChartLine& line, int sign) {
  Loop result;
  bool inside = false;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const ChartPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
    const int here = sign * sign_at(line, a), next = sign * sign_at(line, b);
    inside = inside || here > 0;
    if (here >= 0) result.push_back(a);
    if (here * next < 0) result.push_back(meet(line, line_through(a, b)));
  }
  return inside ? result : Loop{};
}

}  // namespace

Claims exact_candidate(const ExactAnswer& answer) {
  Claims candidate;
  candidate.name = "exact";
  const PreparedScene& prepared = answer.prepared();
  for (std::uint32_t light = 0; light < prepared.lights.size(); ++light) {
    ClaimedLight found;
    found.id = answer.scene().lights[prepared.lights[light].light].id;
    found.per_caster_umbra = answer.is_area(light);
    for (const AnswerEntry& entry : answer.entries(light)) {
      ClaimedPolygon polygon;
      polygon.id = answer.scene().polygons[entry.polygon].id;
      polygon.side = entry.side;
      for (const ReceiverGroup& group : entry.groups) {
        if (group.optional) continue;
        for (std::uint32_t part : group.parts) {
          const Chart chart(support_of(prepared, part));
          Loop whole;
          for (const Integers3& vertex : grid_loop(prepared, part)) {
            whole.push_back(chart.at(vertex));
          }
          if (orientation(whole[0], whole[1], whole[2]) < 0) {
            std::reverse(whole.begin(), whole.end());
          }
          const auto add = [&](const Loop& loop, LightState shade, const std::string& caster) {
            ClaimedFragment fragment;
            fragment.state = shade;
            fragment.caster = caster;
            fragment.exact = true;
            for (const ChartPoint& point : loop) {
              fragment.loop.push_back(chart.lift_to_scene(prepared.geometry, point));
            }
            polygon.fragments.push_back(std::move(fragment));
          };
          const bool area = answer.is_area(light);
          if (!group.faces) {
            add(whole, area ? LightState::kUmbra : LightState::kShadow, {});
            polygon.fragments.back().reason = area                   ? "behind-light"
                                              : group.light_in_plane ? "light-in-plane"
                                                                     : "faces-away";
            continue;
          }
          // What one loop leaves of each of `rest`; what it takes is added.
          const auto take = [&](const Loop& piece, LightState shade, const std::string& caster,
                                std::vector<Loop>& rest) {
            std::vector<Loop> left;
            for (Loop loop : rest) {
              std::vector<Loop> outside;
              for (std::size_t i = 0; i < piece.size() && !loop.empty(); ++i) {
                const ChartLine line = line_through(piece[i], piece[(i + 1) % piece.size()]);
                Loop beyond = half(loop, line, -1);
                if (!beyond.empty()) outside.push_back(std::move(beyond));
                loop = half(loop, line, 1);
              }
              if (!loop.empty()) add(loop, shade, caster);
              left.insert(left.end(), outside.begin(), outside.end());
            }
            rest = std::move(left);
          };
          const auto id_of = [&](std::uint32_t caster) {
            return answer.scene().polygons[prepared.parts[caster].polygon].id;
          };
          std::vector<Loop> lit{whole};
          if (area) {
            const AreaShade& shade = answer.area_shade(light, part, group.side);
            if (!shade.behind.empty()) {
              const std::size_t before = polygon.fragments.size();
              take(shade.behind, LightState::kUmbra, {}, lit);
              for (std::size_t f = before; f < polygon.fragments.size(); ++f) {
                polygon.fragments[f].reason = "behind-light";
              }
            }
            for (const ShadowPiece& piece : shade.umbra) {
              take(piece.loop, LightState::kUmbra, id_of(piece.caster), lit);
            }
            for (const ShadowPiece& piece : shade.penumbra) {
              take(piece.loop, LightState::kPenumbra, id_of(piece.caster), lit);
            }
          } else {
            for (const ShadowPiece& piece : answer.shadows(light, part)) {
              take(piece.loop, LightState::kShadow, id_of(piece.caster), lit);
            }
          }
          for (const Loop& loop : lit) add(loop, LightState::kLit, {});
        }
      }
      found.polygons.push_back(std::move(polygon));
    }
    candidate.lights.push_back(std::move(found));
  }
  return candidate;
}

const std::vector<Triple> kFloor{{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}};
const std::vector<Triple> kPanel{{-1, -1, 4}, {-1, 1, 4}, {1, 1, 4}, {1, -1, 4}};

ClaimedFragment rectangle(LightState state, double x0, double y0, double x1, double y1, double z) {
  ClaimedFragment fragment;
  fragment.state = state;
  fragment.exact = true;
  fragment.loop = {at(x0, y0, z), at(x1, y0, z), at(x1, y1, z), at(x0, y1, z)};
  return fragment;
}

ClaimedFragment& fragment_of(Claims& claims, std::size_t polygon, LightState state) {
  for (ClaimedFragment& own : claims.lights[0].polygons[polygon].fragments) {
    if (own.state == state) return own;
  }
  throw std::runtime_error("no fragment of that class");
}

Report certified(const BuiltScene& built, const Claims& claims, const CertifyOptions& options) {
  Expected<Report> report = certify(built.scene, built.prepared, claims, options);
  if (!report) throw std::runtime_error(to_string(report.error()));
  return std::move(*report);
}

std::string first_finding(const BuiltScene& built, const Claims& claims) {
  const WitnessReport report = check_witnesses(built.scene, built.prepared, claims);
  return report.findings.empty() ? "" : report.findings[0].text;
}

}  // namespace gnomon::oracle
