#include "mesher/mesh/quick_compressor.hpp"

#include <gtest/gtest.h>
#include <vtkNew.h>

#include <cstring>
#include <random>
#include <vector>

namespace weaveform {
namespace {

using Bytes = std::vector<unsigned char>;

Bytes noise_of(std::size_t count) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<double> values(count);
  for (double& value : values) value = number(generator);
  Bytes bytes(count * sizeof(double));
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

Bytes packed_quickly(const Bytes& bytes) {
  const vtkNew<QuickCompressor> quick;
  Bytes result(quick->GetMaximumCompressionSpace(bytes.size()));
  result.resize(quick->Compress(bytes.data(), bytes.size(), result.data(), result.size()));
  return result;
}

class QuickCompressorOf : public testing::TestWithParam<Bytes> {};

TEST_P(QuickCompressorOf, WhatItPacksZlibUnpacks) {
  const Bytes &bytes = GetParam(), small = packed_quickly(bytes);
  Bytes again(bytes.size());
  const vtkNew<vtkZLibDataCompressor> zlib;
  EXPECT_EQ(zlib->Uncompress(small.data(), small.size(), again.data(), again.size()), bytes.size());
  EXPECT_EQ(again, bytes);
}

// Noise does not pack; a block of VTK's is 32 kB.
INSTANTIATE_TEST_SUITE_P(Contents, QuickCompressorOf,
                         testing::Values(Bytes(1, 7), Bytes(32768, 0), noise_of(4096), noise_of(1), noise_of(100000)));

TEST(QuickCompressor, RepetitionTakesLessRoom) {
  EXPECT_LT(packed_quickly(Bytes(32768, 3)).size(), 300U);
}

TEST(QuickCompressor, WhatDoesNotFitIsNotWritten) {
  const vtkNew<QuickCompressor> quick;
  const Bytes noise = noise_of(512);
  Bytes small(64);
  EXPECT_EQ(quick->Compress(noise.data(), noise.size(), small.data(), small.size()), 0U);
}

// Readers look there for how to unpack it.
TEST(QuickCompressor, FilesNameTheFormatZlibs) {
  const vtkNew<QuickCompressor> quick;
  EXPECT_STREQ(quick->GetClassName(), "vtkZLibDataCompressor");
}

}  // namespace
}  // namespace weaveform
