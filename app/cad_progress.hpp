// The progress of reading CAD, which may take long, on standard error.
#pragma once

namespace weaveform {

// From now on, for the whole program: a bar for each file that takes longer than a second. --quiet takes it back.
void show_cad_progress(bool shown);

}  // namespace weaveform
