// Gmsh's library is loaded when geometry is first read, not when the program starts: it brings forty libraries along,
// which cost each start 50 ms of processor time, and most runs read no geometry.
#pragma once

namespace weaveform {

// Before anything of gmsh.h is called; it stays loaded. Throws FileError when the library is not there.
void load_gmsh();

}  // namespace weaveform
