// Every reader of strangers' files, as one function of bytes, for the fuzzer (`./dev fuzz`) and for the replay of its
// corpus in the ordinary tests (tests/robust/fuzz_corpus_test.cpp).
#pragma once

#include <string_view>
#include <vector>

namespace weaveform::fuzz {

struct Target {
  const char* name;  // also of its folder in tests/fuzz/corpus and its dictionary
  // Reads the bytes. An InputError or FileError is an answer and ends here; whatever else leaves is a finding, as is a
  // crash, a hang, or memory out of proportion.
  void (*read)(std::string_view bytes);
};

[[nodiscard]] const std::vector<Target>& targets();

}  // namespace weaveform::fuzz
