// Which program this is, so that a log or a result folder says what made it.
#pragma once

namespace weaveform {

// "weaveform VERSION (commit COMMIT, COMPILER, BUILD TYPE, INSTRUCTION SET)"; "-dirty" after a commit means uncommitted
// changes. The set is that of the inner loops (core/instructions). Throws InputError as instructions() does.
[[nodiscard]] const char* version_line();

}  // namespace weaveform
