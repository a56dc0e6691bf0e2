// Which program this is, so that a log or a result folder says what made it.
#pragma once

namespace weaveform {

// "weaveform VERSION (commit COMMIT, COMPILER, BUILD TYPE)"; "-dirty" after a commit means uncommitted changes.
[[nodiscard]] const char* version_line();

}  // namespace weaveform
