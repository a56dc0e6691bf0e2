#include "solver/element/yarn_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace weaveform {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

using Pieces = std::vector<TangentPiece>;

Pieces tension_pieces(const YarnCard& yarn, const ModelSpec& model) {
  if (model.yarn_law == YarnLaw::card) return yarn.tension.pieces();
  const double slack = model.yarn_law == YarnLaw::slack ? slack_strain(yarn, model) : 0.0;
  const TangentPiece straight = {slack, infinity, {yarn.linear_modulus}};
  return slack > 0.0 ? Pieces{{0.0, slack, {0.0}}, straight} : Pieces{straight};
}

// C(-e) of the card's law in |e|, so that c_n e^n becomes (-1)^n c_n e^n on [-to, -from].
Pieces compression_pieces(const YarnCard& yarn, const ModelSpec& model) {
  if (model.compression_modulus) return {{-infinity, 0.0, {*model.compression_modulus}}};
  if (yarn.compression.pieces().empty()) return {{-infinity, 0.0, {yarn.compression_modulus}}};
  Pieces pieces = yarn.compression.pieces();
  std::reverse(pieces.begin(), pieces.end());
  for (TangentPiece& piece : pieces) {
    std::swap(piece.from, piece.to);
    piece.from = -piece.from;
    piece.to = -piece.to;
    for (std::size_t n = 1; n < piece.coefficient.size(); n += 2) piece.coefficient[n] = -piece.coefficient[n];
  }
  return pieces;
}

TangentLaw joined(Pieces below, const Pieces& above, double scale) {
  below.insert(below.end(), above.begin(), above.end());
  for (TangentPiece& piece : below)
    for (double& coefficient : piece.coefficient) coefficient *= scale;
  return TangentLaw(std::move(below));
}

}  // namespace

double slack_strain(const YarnCard& yarn, const ModelSpec& model) {
  return model.slack.value_or(std::log1p(yarn.crimp));
}

TangentLaw partner_law(const YarnCard& yarn, const ModelSpec& model) {
  return joined(compression_pieces(yarn, model), {{0.0, infinity, {0.0}}}, model.yarn_stiffness_scale);
}

std::array<TangentLaw, 2> yarn_laws(const Card& card, const ModelSpec& model) {
  const bool alone = model.yarn == YarnElement::seatbelt && model.partner == SeatbeltPartner::none;
  std::array<TangentLaw, 2> laws;
  for (std::size_t f = 0; f < laws.size(); ++f) {
    const Pieces below = alone ? Pieces{{-infinity, 0.0, {0.0}}} : compression_pieces(card.yarn[f], model);
    laws[f] = joined(below, tension_pieces(card.yarn[f], model), model.yarn_stiffness_scale);
  }
  return laws;
}

}  // namespace weaveform
