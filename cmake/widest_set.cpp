// Run while configuring: ends with the number of this processor's widest instruction set.
#include "core/instructions/processor.hpp"

int main() {
  return static_cast<int>(weaveform::widest_of_processor());
}
