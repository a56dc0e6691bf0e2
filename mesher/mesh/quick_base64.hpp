// The same characters as vtkBase64OutputStream's, which hands every four of them to the stream alone, in whole buffers.
#pragma once

#include <vtkOutputStream.h>

#include <array>
#include <vector>

namespace weaveform {

class QuickBase64 : public vtkOutputStream {
public:
  static QuickBase64* New();
  // Each returns 1, or 0 where the stream does not take what it is given.
  int StartWriting() override;
  int Write(const void* data, size_t length) override;
  int EndWriting() override;  // pads to four characters

protected:
  QuickBase64() = default;
  ~QuickBase64() override = default;

private:
  int kept_ = 0;  // bytes that make no three yet
  std::array<unsigned char, 3> three_{};
  std::vector<char> characters_;
};

}  // namespace weaveform
