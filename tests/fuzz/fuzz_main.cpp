// libFuzzer's two functions. The target is named by the environment, so that one program serves all of them:
//   WEAVEFORM_FUZZ_TARGET=scene weaveform_fuzz [libFuzzer's options and corpus folders]
// Without a name, or with a wrong one, it lists the names and ends.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/fuzz/targets.hpp"

namespace {

const weaveform::fuzz::Target* chosen = nullptr;

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  const char* name = std::getenv("WEAVEFORM_FUZZ_TARGET");
  for (const auto& target : weaveform::fuzz::targets())
    if (name != nullptr && std::strcmp(target.name, name) == 0) chosen = &target;
  if (chosen != nullptr) return 0;
  for (const auto& target : weaveform::fuzz::targets()) std::puts(target.name);
  std::exit(name == nullptr ? 0 : 2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  chosen->read({reinterpret_cast<const char*>(data), size});
  return 0;
}
