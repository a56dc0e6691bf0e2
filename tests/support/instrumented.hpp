// Whether every access is looked at (sanitizers), which makes inner loops ten times as slow. What takes long repeats itself
// less there, over the same code: figures are looked at by the build that people use.
#pragma once

namespace weaveform::test {

#ifdef WEAVEFORM_INSTRUMENTED
inline constexpr bool instrumented = true;
#else
inline constexpr bool instrumented = false;
#endif

}  // namespace weaveform::test
