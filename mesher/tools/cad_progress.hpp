// How far OpenCASCADE has come, told to the process that waits. In its module only (opencascade.hpp).
#pragma once

#include <Message_ProgressIndicator.hxx>
#include <Message_ProgressRange.hxx>

#include "mesher/tools/opencascade.hpp"

namespace weaveform {

// As the program that loaded the module gave them.
inline GuardSigns& guard_signs() {
  static GuardSigns signs;
  return signs;
}

// Shares of the whole work: to read a file into a shape, the rest to make triangles.
inline constexpr double reading_share = 0.5;

class CadProgress {
public:
  CadProgress(double from, double to) : indicator_(new Indicator(from, to)) {}
  [[nodiscard]] Message_ProgressRange start() { return indicator_->Start(); }

private:
  class Indicator : public Message_ProgressIndicator {
  public:
    Indicator(double from, double to) : from_(from), to_(to) {}

  private:
    void Show(const Message_ProgressScope& /*any*/, const Standard_Boolean /*forced*/) override {
      guard_signs().progress(from_ + (to_ - from_) * GetPosition());
    }
    double from_, to_;
  };
  Handle(Indicator) indicator_;
};

}  // namespace weaveform
