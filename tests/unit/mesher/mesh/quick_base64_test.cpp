#include "mesher/mesh/quick_base64.hpp"

#include <gtest/gtest.h>
#include <vtkBase64OutputStream.h>
#include <vtkNew.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace weaveform {
namespace {

std::vector<unsigned char> random_bytes(int count) {
  std::mt19937 generator(7);
  std::vector<unsigned char> bytes(count);
  for (auto& byte : bytes) byte = static_cast<unsigned char>(generator());
  return bytes;
}

// The bytes in pieces of these lengths, over and over.
std::string text_of(vtkOutputStream* stream, const std::vector<unsigned char>& bytes, const std::vector<int>& pieces) {
  std::ostringstream text;
  stream->SetStream(&text);
  EXPECT_EQ(stream->StartWriting(), 1);
  std::size_t at = 0;
  for (std::size_t k = 0; at < bytes.size(); ++k) {
    const std::size_t length = std::min<std::size_t>(pieces[k % pieces.size()], bytes.size() - at);
    EXPECT_EQ(stream->Write(bytes.data() + at, length), 1);
    at += length;
  }
  EXPECT_EQ(stream->EndWriting(), 1);
  return text.str();
}

TEST(QuickBase64, WritesWhatVtkWrites) {
  const vtkNew<QuickBase64> quick;
  const vtkNew<vtkBase64OutputStream> vtk;
  for (const int count : {0, 1, 2, 3, 4, 5, 6, 100, 12345, 65536})
    for (const auto& pieces : std::vector<std::vector<int>>{{1}, {2}, {3}, {1, 2, 5}, {8, 1000, 1}, {32768}}) {
      const auto bytes = random_bytes(count);
      EXPECT_EQ(text_of(quick, bytes, pieces), text_of(vtk, bytes, pieces)) << count << " bytes, from " << pieces[0];
    }
}

TEST(QuickBase64, EveryPairOfBytesIsItsOwn) {
  const vtkNew<QuickBase64> quick;
  const vtkNew<vtkBase64OutputStream> vtk;
  std::vector<unsigned char> bytes;
  for (int high = 0; high < 256; ++high)
    for (int low = 0; low < 256; ++low)
      bytes.insert(bytes.end(), {static_cast<unsigned char>(high), static_cast<unsigned char>(low)});
  EXPECT_EQ(text_of(quick, bytes, {32768}), text_of(vtk, bytes, {32768}));
}

TEST(QuickBase64, SaysWhenTheStreamTakesNothing) {
  const vtkNew<QuickBase64> quick;
  std::ostringstream broken;
  broken.setstate(std::ios::badbit);
  quick->SetStream(&broken);
  EXPECT_EQ(quick->StartWriting(), 1);
  const auto bytes = random_bytes(4);
  EXPECT_EQ(quick->Write(bytes.data(), bytes.size()), 0);
  EXPECT_EQ(quick->EndWriting(), 0);
}

}  // namespace
}  // namespace weaveform
