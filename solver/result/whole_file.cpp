#include "solver/result/whole_file.hpp"

#include <fmt/format.h>
#include <vtkErrorCode.h>
#include <vtkXMLWriter.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

#include "mesher/base/error.hpp"
#include "solver/result/vtk_messages.hpp"

namespace weaveform {

namespace {

namespace fs = std::filesystem;

std::string reason_of(int error_number) {
  return error_number == 0 ? "the write came back short" : std::generic_category().message(error_number);
}

FileError cannot_write(const fs::path& file, const std::string& reason) {
  return FileError(
      fmt::format("{}: cannot be written ({}); free space or choose another --output", file.string(), reason));
}

// The same folder as the file, so that the rename cannot cross a file system.
fs::path temporary_name(const fs::path& file) {
  fs::path temporary = file;
  temporary += ".partial";
  return temporary;
}

}  // namespace

void write_whole(const fs::path& file, const std::function<void(const fs::path& temporary)>& write) {
  std::error_code failure;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), failure);
  if (failure) throw cannot_write(file, failure.message());

  const fs::path temporary = temporary_name(file);
  std::error_code unimportant;
  try {
    write(temporary);
  } catch (...) {
    fs::remove(temporary, unimportant);
    throw;
  }
  fs::rename(temporary, file, failure);
  if (failure) {
    fs::remove(temporary, unimportant);
    throw cannot_write(file, failure.message());
  }
}

void write_text_whole(const fs::path& file, std::string_view text) {
  write_whole(file, [&](const fs::path& temporary) {
    errno = 0;
    std::ofstream stream(temporary, std::ios::binary);
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    // close() flushes: a disk that fills up shows itself only here.
    stream.close();
    if (!stream) throw cannot_write(file, reason_of(errno));
  });
}

void write_vtk_whole(const fs::path& file, vtkXMLWriter& writer) {
  write_whole(file, [&](const fs::path& temporary) {
    const VtkMessages kept_off_the_terminal;
    writer.SetDataModeToAppended();
    writer.EncodeAppendedDataOff();
    writer.SetCompressorTypeToNone();
    writer.SetHeaderTypeToUInt64();
    writer.SetFileName(temporary.c_str());
    errno = 0;
    const bool written = writer.Write() == 1;
    const unsigned long error = writer.GetErrorCode();
    if (error == vtkErrorCode::OutOfDiskSpaceError) throw cannot_write(file, "no space left");
    if (!written || error != vtkErrorCode::NoError) throw cannot_write(file, reason_of(errno));
  });
}

std::string read_text(const fs::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (stream) text << stream.rdbuf();
  // An empty file sets failbit on `text` alone; only the input stream tells of a read that failed.
  if (!stream || stream.bad())
    throw FileError(
        fmt::format("{}: cannot be read ({}); check the path and its permissions", file.string(), reason_of(errno)));
  return text.str();
}

}  // namespace weaveform
