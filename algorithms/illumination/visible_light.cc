// SPDX-License-Identifier: LGPL-3.0-or-later
#include "gnomon/algorithms/visible_light.h"

#include <utility>

#include "algorithms/illumination/light_view.h"
#include "algorithms/illumination/visible_pieces.h"

namespace gnomon {

struct LightVisibility::Data {
  Data(const PreparedScene& scene, std::uint32_t light) : view(scene, light) {
    LightPieces whole(view);
    twice_area = whole.twice_area(whole.pieces()[0]);
  }

  LightView view;
  mpq_class twice_area;  // of the light, in its chart

  std::array<mpq_class, 3> in_space(const ExactVector& at) const {
    const Geometry& geometry = view.scene().geometry;
    std::array<mpq_class, 3> result;
    for (std::size_t k = 0; k < 3; ++k) {
      mpq_class offset(at[0] * view.axis(0)[k] + at[1] * view.axis(1)[k], at[2]);
      offset.canonicalize();
      result[k] = geometry.origin[k] + geometry.step * (view.origin()[k] + offset);
    }
    return result;
  }
  mpq_class fraction(LightPieces& pieces) const {
    mpq_class sum;
    for (const LightPieces::Piece& piece : pieces.pieces()) sum += pieces.twice_area(piece);
    return sum / twice_area;
  }
  /// Calls at_receiver(pieces) before casters are asked.
  template <class F>
  LightPieces see(std::uint32_t index, Side side, const std::array<mpq_class, 3>& point,
                  const std::array<mpq_class, 3>* inwards, const F& at_receiver) const {
    const PreparedScene& scene = view.scene();
    const Part& part = scene.parts[index];
    LightPieces pieces(view);
    const std::uint32_t apex = pieces.add_apex(Apex::from(scene.geometry, point));
    std::uint32_t second = 0;
    if (inwards != nullptr) second = pieces.add_apex(Apex::from(scene.geometry, *inwards));
    const std::uint32_t* towards = inwards == nullptr ? nullptr : &second;
    if (!clip_to_receiver(pieces, view, part, side, apex)) {
      pieces.clear();
      return pieces;
    }
    at_receiver(pieces);
    subtract_casters(pieces, view, part, side, apex, towards);
    return pieces;
  }
};

LightVisibility::LightVisibility(const PreparedScene& scene, std::uint32_t light)
    : data_(std::make_unique<Data>(scene, light)) {}
LightVisibility::~LightVisibility() = default;
LightVisibility::LightVisibility(LightVisibility&&) noexcept = default;
LightVisibility& LightVisibility::operator=(LightVisibility&&) noexcept = default;

VisibleLight LightVisibility::at(std::uint32_t part, Side side,
                                 const std::array<mpq_class, 3>& point,
                                 const std::array<mpq_class, 3>* inwards) const {
  VisibleLight result;
  LightPieces pieces = data_->see(part, side, point, inwards, [&](LightPieces& in_front) {
    result.in_front = data_->fraction(in_front);
  });
  result.visible = data_->fraction(pieces);
  for (const LightPieces::Piece& piece : pieces.pieces()) {
    auto& loop = result.fragments.emplace_back();
    for (const std::uint32_t vertex : piece.vertices) {
      loop.push_back(data_->in_space(pieces.exact(vertex)));
    }
  }
  return result;
}

bool LightVisibility::is_deep_umbra(std::uint32_t part, Side side,
                                    const std::array<mpq_class, 3>& point,
                                    const std::array<mpq_class, 3>* inwards) const {
  return data_->see(part, side, point, inwards, [](LightPieces&) {}).empty();
}

}  // namespace gnomon
