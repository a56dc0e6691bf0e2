// Work on input that cannot be trusted, done by libraries that cannot be trusted with it, in a process of its own.
//
// OpenCASCADE, Gmsh and VTK read whatever they are given; of a damaged file they may crash, go on for ever, or ask for
// all memory. A child process (forked, nothing executed) does the reading and sends back bytes; whatever becomes of it,
// this process goes on and says so in one line. The child has limits of time and memory, writes no file, starts no
// process and opens no connection (core/guard/confine.hpp).
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace weaveform {

struct Guard {
  std::string file;        // what is read; begins the message
  std::string what;        // who reads it, e.g. "the reader of STEP files"
  std::string remedy;      // what the user can do, e.g. "write it again as STL"
  double seconds = 120.0;  // of processor time
  // By the clock; 0: five times the processor's time and 20 s at least, for a busy machine is no fault of the file.
  double clock_seconds = 0.0;
  double reading_seconds = 0.0;  // of processor time until guarded_reading_is_done(); 0: no limit of its own
  double gigabytes = 4.0;        // of address space beyond what this process has; not under the address sanitizer
  std::filesystem::path writable_folder = {};  // "": the child writes nowhere
  int open_file = -1;                          // a descriptor that stays open in the child
  bool may_act = false;                        // the child may write any file and start programs; the limits stay
  // Called in this process about ten times a second while the child works, with the part done by guarded_progress().
  std::function<void(double fraction)> while_it_works = {};
};

// The bytes that `work` returns in the child. Exceptions of ours come back as they were thrown; any other, and the
// child's death, is an InputError that begins with the file. The child has the calling thread alone, for others do not
// survive a fork. Throws FileError when no process can be started.
[[nodiscard]] std::string run_guarded(const Guard& guard, const std::function<std::string()>& work);

// Called by `work` in the child: what is left may take all the time there is.
void guarded_reading_is_done();

// Called by `work` in the child: how much of it is done, 0 to 1. Cheap; without effect when nobody watches.
void guarded_progress(double fraction);

}  // namespace weaveform
