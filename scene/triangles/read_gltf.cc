// SPDX-License-Identifier: LGPL-3.0-or-later
// The reader of glTF 2.0, JSON or binary: triangles of the meshes that the nodes of its scene name,
// placed exactly. What is no triangle, and what moves, is left out and told of.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "scene/base/text_file.h"
#include "scene/files/json_dialect.h"
#include "scene/files/readers.h"
#include "scene/files/scene_builder.h"
#include "scene/files/usable_id.h"
#include "scene/triangles/binary_floats.h"
#include "scene/triangles/gltf_file.h"
#include "scene/triangles/gltf_matrix.h"

namespace gnomon {

namespace {

/// Instances multiply what a small file holds.
constexpr std::size_t kMostTriangles = 50'000'000;

/// A node that waits for its turn, in the axes of its parents.
struct PlacedNode {
  JsonNode node;
  GltfMatrix around;
};

class GltfReader {
 public:
  GltfReader(const JsonTape& tape, std::string_view binary, const std::string& file,
             const ReadOptions& options)
      : tape_(tape), file_(tape, binary, file), builder_(file, options, NumberMeaning::kDouble) {}

  Expected<ReadResult> read();
  /// Had a coordinate to be rounded to be a double?
  bool is_rounded() const { return rounded_ != 0; }

 private:
  Expected<void> check_root(const JsonNode& root) const;
  Expected<std::vector<PlacedNode>> roots(const JsonNode& root) const;
  Expected<void> read_nodes(std::vector<PlacedNode> waiting);
  Expected<void> read_mesh(const JsonNode& node, const JsonNode& number, const GltfMatrix& matrix);
  Expected<void> read_primitive(const JsonNode& primitive, const std::string& name,
                                const GltfMatrix& matrix);
  Expected<std::vector<std::uint32_t>> corners(const JsonNode& primitive, std::size_t mode,
                                               std::size_t vertices) const;
  Expected<VertexId> vertex(const GltfAccessor& positions, std::size_t index,
                            const GltfMatrix& matrix, const JsonNode& primitive);
  void warn();

  const JsonTape& tape_;
  GltfFile file_;
  SceneBuilder builder_;
  std::map<std::string, std::size_t> counts_;  // of triangles, by the name of their node
  std::size_t rounded_ = 0, turned_ = 0, passed_over_ = 0, skinned_ = 0, morphed_ = 0;
  double stretch_ = 0;
};

std::string text_member(const JsonNode& node, std::string_view key) {
  const auto found = node.find(key);
  return found && found->is_string() ? found->string() : std::string();
}

Expected<void> GltfReader::check_root(const JsonNode& root) const {
  if (!root.is_object()) return tape_.wrong_kind(root, "glTF: an object");
  const auto asset = root.find("asset");
  if (!asset) return tape_.missing(root, "asset", "an object with the version");
  if (!asset->is_object()) return tape_.wrong_kind(*asset, "an object with the version");
  const auto version = asset->find("version");
  if (!version) return tape_.missing(*asset, "version", "\"2.0\"");
  if (!version->is_string() || !version->string().starts_with("2.")) {
    return tape_.error(*version, ErrorCode::kFormat, "glTF of another version", "\"2.0\"");
  }
  const auto required = root.find("extensionsRequired");
  if (!required || !required->is_array()) return {};
  constexpr std::string_view kGeometry[] = {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                            "KHR_meshopt_compression", "KHR_mesh_quantization",
                                            "EXT_mesh_gpu_instancing"};
  for (JsonNode at = required->begin(); at != required->end(); at = at.next()) {
    for (const std::string_view name : kGeometry) {
      if (!at.is_text(name)) continue;
      return tape_.error(at, ErrorCode::kFormat,
                         "the extension " + std::string(name) + " is not read here",
                         "the file without it: positions as plain floats");
    }
  }
  return {};
}

/// The nodes of the scene that the file says, or of its first; all that have no parent if it has no
/// scenes.
Expected<std::vector<PlacedNode>> GltfReader::roots(const JsonNode& root) const {
  std::vector<PlacedNode> result;
  const auto add_all = [&](const JsonNode& list) -> Expected<void> {
    if (!list.is_array()) return tape_.wrong_kind(list, "an array of indices of nodes");
    for (JsonNode at = list.begin(); at != list.end(); at = at.next()) {
      const auto node = file_.element(at, "nodes");
      if (!node) return tl::unexpected(node.error());
      result.push_back({*node, GltfMatrix::identity()});
    }
    return {};
  };
  const auto scenes = root.find("scenes");
  if (scenes) {
    if (!scenes->is_array()) return tape_.wrong_kind(*scenes, "an array of scenes");
    const auto chosen = root.find("scene");
    Expected<JsonNode> scene = scenes->begin();
    if (chosen) scene = file_.element(*chosen, "scenes");
    if (!scene) return tl::unexpected(scene.error());
    if (scenes->size() == 0) return result;
    if (!scene->is_object()) return tape_.wrong_kind(*scene, "a scene: an object");
    if (const auto nodes = scene->find("nodes")) {
      if (auto done = add_all(*nodes); !done) return tl::unexpected(std::move(done.error()));
    }
    return result;
  }
  const auto nodes = root.find("nodes");
  if (!nodes) return result;
  if (!nodes->is_array()) return tape_.wrong_kind(*nodes, "an array of nodes");
  std::vector<JsonNode> all;
  std::vector<bool> is_child(nodes->size(), false);
  for (JsonNode node = nodes->begin(); node != nodes->end(); node = node.next()) {
    if (!node.is_object()) return tape_.wrong_kind(node, "a node: an object");
    all.push_back(node);
    const auto children = node.find("children");
    if (!children || !children->is_array()) continue;
    for (JsonNode at = children->begin(); at != children->end(); at = at.next()) {
      const auto child = file_.index(at);
      if (child && *child < is_child.size()) is_child[*child] = true;
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!is_child[i]) result.push_back({all[i], GltfMatrix::identity()});
  }
  return result;
}

Expected<void> GltfReader::read_nodes(std::vector<PlacedNode> waiting) {
  std::ranges::reverse(waiting);
  std::map<std::uint32_t, bool> met;  // by the place of the node
  while (!waiting.empty()) {
    const PlacedNode here = std::move(waiting.back());
    waiting.pop_back();
    const JsonNode& node = here.node;
    if (!met.emplace(node.index(), true).second) {
      return tape_.error(node, ErrorCode::kFormat, "a node of two parents, or its own ancestor",
                         "a tree of nodes");
    }
    auto placement = gltf_placement(node);
    if (!placement) return tl::unexpected(std::move(placement.error()));
    if (placement->is_rounded) ++turned_;
    stretch_ = std::max(stretch_, placement->stretch);
    const GltfMatrix matrix = placement->matrix.is_identity() ? here.around
                              : here.around.is_identity()     ? placement->matrix
                                                          : here.around.after(placement->matrix);
    if (node.find("skin")) ++skinned_;
    if (const auto mesh = node.find("mesh")) {
      if (auto done = read_mesh(node, *mesh, matrix); !done) return done;
    }
    const auto children = node.find("children");
    if (!children) continue;
    if (!children->is_array()) return tape_.wrong_kind(*children, "an array of indices of nodes");
    const std::size_t first = waiting.size();
    for (JsonNode at = children->begin(); at != children->end(); at = at.next()) {
      const auto child = file_.element(at, "nodes");
      if (!child) return tl::unexpected(child.error());
      waiting.push_back({*child, matrix});
    }
    std::reverse(waiting.begin() + static_cast<std::ptrdiff_t>(first), waiting.end());
  }
  return {};
}

Expected<void> GltfReader::read_mesh(const JsonNode& node, const JsonNode& number,
                                     const GltfMatrix& matrix) {
  const auto mesh = file_.element(number, "meshes");
  if (!mesh) return tl::unexpected(mesh.error());
  std::string name = usable_id(text_member(node, "name"));
  if (name.empty()) name = usable_id(text_member(*mesh, "name"));
  if (name.empty()) name = "mesh " + std::string(number.number());
  const auto primitives = mesh->find("primitives");
  if (!primitives) return tape_.missing(*mesh, "primitives", "an array of primitives");
  if (!primitives->is_array()) return tape_.wrong_kind(*primitives, "an array of primitives");
  for (JsonNode at = primitives->begin(); at != primitives->end(); at = at.next()) {
    if (!at.is_object()) return tape_.wrong_kind(at, "a primitive: an object");
    if (auto done = read_primitive(at, name, matrix); !done) return done;
  }
  return {};
}

/// The vertices of its triangles, three each: of a list (mode 4), a strip (5) or a fan (6).
Expected<std::vector<std::uint32_t>> GltfReader::corners(const JsonNode& primitive,
                                                         std::size_t mode,
                                                         std::size_t vertices) const {
  std::vector<std::uint32_t> indices;
  if (const auto number = primitive.find("indices")) {
    const auto list = file_.indices(*number);
    if (!list) return tl::unexpected(list.error());
    const std::size_t size = list->component_type == 5121   ? 1
                             : list->component_type == 5123 ? 2
                                                            : 4;
    indices.reserve(list->count);
    for (std::size_t i = 0; i < list->count; ++i) {
      indices.push_back(
          static_cast<std::uint32_t>(little_endian(list->bytes, i * list->stride, size)));
    }
  } else {
    for (std::size_t i = 0; i < vertices; ++i) indices.push_back(static_cast<std::uint32_t>(i));
  }
  constexpr std::size_t kList = 4, kStrip = 5;
  if (mode == kList) {
    if (indices.size() % 3 != 0) {
      return tape_.error(primitive, ErrorCode::kFormat,
                         "triangles of " + std::to_string(indices.size()) + " corners",
                         "three for each");
    }
    return indices;
  }
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
    const std::size_t odd = i % 2;
    const auto triangle = mode == kStrip
                              ? std::array{indices[i], indices[i + 1 + odd], indices[i + 2 - odd]}
                              : std::array{indices[i + 1], indices[i + 2], indices[0]};
    result.insert(result.end(), triangle.begin(), triangle.end());
  }
  return result;
}

Expected<VertexId> GltfReader::vertex(const GltfAccessor& positions, std::size_t index,
                                      const GltfMatrix& matrix, const JsonNode& primitive) {
  if (index >= positions.count) {
    return tape_.error(
        primitive, ErrorCode::kIndex, "index " + std::to_string(index) + " is not that of a vertex",
        positions.count == 0 ? "vertices" : "0 to " + std::to_string(positions.count - 1));
  }
  Position position;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float value = little_endian_float(positions.bytes, index * positions.stride + 4 * axis);
    if (!std::isfinite(value)) {
      return tape_.error(primitive, ErrorCode::kNumber,
                         "vertex " + std::to_string(index) + " has a coordinate that is no number",
                         "finite numbers");
    }
    position[axis] = Number(static_cast<double>(value));
  }
  if (!matrix.is_identity()) position = matrix.apply(position);
  for (const Number& coordinate : position) {
    if (!coordinate.is_double()) ++rounded_;
  }
  auto id = builder_.vertex(position);
  if (!id) return tape_.error(primitive, id.error().code, id.error().what, id.error().expected);
  return id;
}

Expected<void> GltfReader::read_primitive(const JsonNode& primitive, const std::string& name,
                                          const GltfMatrix& matrix) {
  const auto mode = file_.count(primitive, "mode");
  if (!mode) return tl::unexpected(mode.error());
  constexpr std::size_t kTriangles = 4, kFan = 6;
  const std::size_t drawn = mode->value_or(kTriangles);
  if (drawn > kFan) {
    return tape_.error(primitive, ErrorCode::kFormat, "primitives of mode " + std::to_string(drawn),
                       "0 to 6");
  }
  if (drawn < kTriangles) {
    ++passed_over_;
    return {};
  }
  if (primitive.find("targets")) ++morphed_;
  const auto attributes = primitive.find("attributes");
  if (!attributes) return tape_.missing(primitive, "attributes", "an object with POSITION");
  if (!attributes->is_object()) return tape_.wrong_kind(*attributes, "an object with POSITION");
  const auto number = attributes->find("POSITION");
  if (!number) return tape_.missing(*attributes, "POSITION", "the index of an accessor");
  const auto positions = file_.positions(*number);
  if (!positions) return tl::unexpected(positions.error());
  bool two_sided = false;
  std::string kind;
  if (const auto material = primitive.find("material")) {
    const auto found = file_.element(*material, "materials");
    if (!found) return tl::unexpected(found.error());
    const auto sides = found->find("doubleSided");
    two_sided = sides && sides->kind() == JsonKind::kTrue;
    kind = usable_text(text_member(*found, "name"));
  }
  const auto list = corners(primitive, drawn, positions->count);
  if (!list) return tl::unexpected(list.error());
  const bool mirrors = matrix.mirrors();
  std::size_t& count = counts_[name];
  for (std::size_t i = 0; i < list->size(); i += 3) {
    if (builder_.polygon_count() >= kMostTriangles) {
      return tape_.error(primitive, ErrorCode::kLimit, "too many triangles, of all nodes together",
                         "at most 50 millions");
    }
    const std::string id = name + "/" + std::to_string(count++);
    std::vector<VertexId> loop;
    Expected<void> done;
    for (std::size_t c = 0; c < 3 && done; ++c) {
      auto corner = vertex(*positions, (*list)[i + c], matrix, primitive);
      if (corner) {
        loop.push_back(*corner);
      } else {
        done = tl::unexpected(std::move(corner.error()));
      }
    }
    if (!done) {
      if (!builder_.skips_bad()) return done;
      builder_.add_bad(id, primitive.offset(), std::move(done.error()));
      continue;
    }
    if (mirrors) std::swap(loop[1], loop[2]);
    Polygon& polygon = builder_.add_renamed(id, primitive.offset());
    polygon.loop = std::move(loop);
    if (two_sided) polygon.two_sided = true;
    builder_.put_into_groups(usable_text(name), kind);
  }
  return {};
}

void GltfReader::warn() {
  builder_.warn_of(passed_over_, "primitive", "primitives",
                   " of points or lines ignored: they have no surface");
  builder_.warn_of(skinned_, "node has", "nodes have",
                   " a skin: the mesh counts as it stands, unbent");
  builder_.warn_of(morphed_, "primitive has", "primitives have",
                   " morph targets, which are not applied");
  if (const auto moving = tape_.root().find("animations"); moving && moving->is_array()) {
    builder_.warn_of(moving->size(), "animation", "animations",
                     " left out: nodes stand where the file puts them");
  }
  if (turned_ != 0) {
    builder_.warn(fmt::format(
        "{} by quaternions of rounded numbers: as exactly as those say, lengths by up to {:.1g} of "
        "themselves",
        counted_as(turned_, "node is turned", "nodes are turned"), stretch_));
  }
}

Expected<ReadResult> GltfReader::read() {
  const JsonNode root = tape_.root();
  if (auto done = check_root(root); !done) return tl::unexpected(std::move(done.error()));
  if (auto done = file_.open(); !done) return tl::unexpected(std::move(done.error()));
  auto first = roots(root);
  if (!first) return tl::unexpected(std::move(first.error()));
  if (auto done = read_nodes(*std::move(first)); !done) {
    return tl::unexpected(std::move(done.error()));
  }
  warn();
  builder_.write_extra("gltf", {});
  return builder_.finish();
}

}  // namespace

Likeness looks_like_gltf(std::string_view text) {
  return json_dialect(text) == SceneFormat::kGltf ? Likeness::kCertain : Likeness::kNone;
}

Likeness looks_like_glb(std::string_view text) {
  return text.starts_with("glTF") ? Likeness::kCertain : Likeness::kNone;
}

Expected<ReadResult> read_gltf(const std::string& text, const std::string& file,
                               const ReadOptions& options) {
  const auto chunks = gltf_chunks(text, file);
  if (!chunks) return tl::unexpected(chunks.error());
  if (auto readable = check_is_utf8(chunks->json, file); !readable) {
    return tl::unexpected(std::move(readable.error()));
  }
  const auto tape = JsonTape::parse(chunks->json, file);
  if (!tape) return tl::unexpected(tape.error());
  GltfReader doubles(*tape, chunks->binary, file, options);
  auto result = doubles.read();
  if (result && doubles.is_rounded() && !options.numbers) {
    ReadOptions decimals = options;
    decimals.numbers = NumberMeaning::kDecimal;
    result = GltfReader(*tape, chunks->binary, file, decimals).read();
    if (result) {
      result->warnings.emplace_back(
          "the numbers are decimals, since doubles do not hold where nodes stand exactly");
    }
  }
  // Bytes of binary data are no lines.
  if (result && text.starts_with("glTF")) result->polygon_offsets.clear();
  return result;
}

}  // namespace gnomon
