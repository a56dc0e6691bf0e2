// zlib's format by libdeflate: the same to every reader, in half the time. VTK writes the name of the
// class into a file as what it was compressed with, and a compressor of our own keeps that of zlib's.
#pragma once

#include <vtkZLibDataCompressor.h>

#include <memory>

struct libdeflate_compressor;

namespace weaveform {

class QuickCompressor : public vtkZLibDataCompressor {
public:
  static QuickCompressor* New();
  // Bytes that so many may come to at worst.
  size_t GetMaximumCompressionSpace(size_t size) override;

protected:
  QuickCompressor();
  ~QuickCompressor() override = default;
  // How many bytes they are then; 0 where they do not fit into `space`.
  size_t CompressBuffer(const unsigned char* from, size_t size, unsigned char* to, size_t space) override;

private:
  struct Free {
    void operator()(libdeflate_compressor* compressor) const;
  };
  std::unique_ptr<libdeflate_compressor, Free> compressor_;
};

}  // namespace weaveform
