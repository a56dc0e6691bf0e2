// Files as every room reads and writes them.
//
// Output is written whole or not at all: under a temporary name in the same folder, then renamed over the old one. A
// reader therefore never meets half a file, and a full disk leaves the last good one in place. The temporary name
// (.NAME.XXXXXX.partial, the X drawn at random) is made exclusively: it cannot be guessed, and never leads through a
// link to somebody else's file. It is locked (flock) for as long as its writer lives: two programs may write the same
// file or folder at once, the last rename wins, and whoever clears away what a killed one left spares the living.
//
// Input comes from regular files only: a pipe or a device may never end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace weaveform {

enum class Durability {
  process,  // whole whatever becomes of this process
  power,    // whole also when the machine stops: on the disk before the old file goes
};

// Calls write(temporary), where an empty file of that name stands ready, and renames what it left there to `file`; it
// must write into that file and put no other in its place. When
// write throws, the temporary file is removed and the exception passes on. Throws FileError when the folder cannot be
// made or written to, or the file cannot be renamed.
void write_whole(const std::filesystem::path& file,
                 const std::function<void(const std::filesystem::path& temporary)>& write,
                 Durability durability = Durability::process);

// The text becomes the file's whole content. Throws FileError.
void write_text_whole(const std::filesystem::path& file, std::string_view text,
                      Durability durability = Durability::process);

// The error of a file that cannot be written, in the words that all of them use. An `error_number` of 0 is a write that
// came back short.
[[noreturn]] void throw_cannot_write(const std::filesystem::path& file, int error_number);

// Whether `name` is one that write_whole gives to a temporary file; such names stay behind when a run is killed.
[[nodiscard]] bool is_temporary_name(const std::string& name);
// Removes from a folder the temporary files whose writers are dead. Where the file system has no locks nothing tells
// them from others, and they stay.
void clear_temporaries(const std::filesystem::path& folder);

// Waits until a file written earlier is on the disk; says nothing when it cannot.
void settle_on_disk(const std::filesystem::path& file);

// Throws FileError unless `file` is a regular file that can be read (a link to one is one).
void require_regular_file(const std::filesystem::path& file);

// bytes; of text that is read whole: measurements and meshes of other codes, and what people write by hand.
inline constexpr std::uintmax_t most_text = 2'000'000'000, most_written_by_hand = 16'000'000;

// The whole content of a regular file of at most `most` bytes. Throws FileError.
[[nodiscard]] std::string read_text_file(const std::filesystem::path& file, std::uintmax_t most = most_text);

}  // namespace weaveform
