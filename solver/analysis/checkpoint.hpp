// checkpoint.bin: everything that a stopped or killed analysis needs to go on with the same bits.
//
//   "weaveform checkpoint 10\n"   magic and format
//   u64 size of the file, u64 check sum (XXH3) of all that follows
//   identity of the run (identity.hpp)
//   the state, as whatever has one archives it (solver/state/archive.hpp)
// Integers and doubles are the machine's own. The file is written whole, on disk before the one before it goes.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "solver/analysis/identity.hpp"
#include "solver/state/archive.hpp"

namespace weaveform {

// Takes the state through an archive, which writes, reads or looks at it.
using ArchiveState = std::function<void(Archive&)>;

enum class CheckSum { compared, ignored };  // ignored: for those who look for what a forged file could do

// The file's bytes.
[[nodiscard]] std::string checkpoint_bytes(const Identity& identity, const ArchiveState& state);
// Reads the state back. `name` stands for the file in messages. Throws FileError when the bytes are no checkpoint of
// this format, are damaged or do not fit the state; InputError when they are another run's, with what differs.
void read_checkpoint(std::string_view bytes, const Identity& identity, const ArchiveState& state,
                     const std::string& name, CheckSum check = CheckSum::compared);

// The first member of the state that is not a number, or out of its bounds; "" when there is none.
[[nodiscard]] std::string unsound_member(const ArchiveState& state);

// "NAME: damaged checkpoint (WHY); ...".
[[noreturn]] void throw_damaged_checkpoint(const std::string& name, const std::string& why);

}  // namespace weaveform
