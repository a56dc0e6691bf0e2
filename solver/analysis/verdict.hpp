// How far a run can be trusted, judged at every row of history: the energy balance, kinetic against internal energy,
// folded cells.
#pragma once

#include <string>

#include "mesher/scene/scene.hpp"
#include "solver/analysis/balance.hpp"
#include "solver/result/fields.hpp"
#include "solver/state/archive.hpp"

namespace weaveform {

class Verdict {
public:
  Verdict(const Scene& scene, double duration) : scene_(scene), duration_(duration) {}

  // A row whose energies are known. Gives what ends the run, in words; "" when it goes on.
  [[nodiscard]] std::string judge(const EnergyBalance& balance, double time);
  void count_folded(const Fields& fields);

  [[nodiscard]] double worst_error() const { return worst_error_; }  // 1; of the balance, after the start
  [[nodiscard]] double worst_ratio() const { return worst_ratio_; }  // 1; kinetic/internal, likewise
  [[nodiscard]] int folded() const { return folded_; }               // greatest number at any row
  void archive(Archive& archive);

private:
  [[nodiscard]] double travelled(double time) const;

  const Scene& scene_;
  double duration_;  // s
  double worst_error_ = 0.0, worst_ratio_ = 0.0;
  int folded_ = 0;
};

}  // namespace weaveform
