// Bytes as a file, for readers that take a path; in memory where the system has such a folder.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace weaveform::fuzz {

class ScratchFile {
public:
  // `name` with its ending, by which some readers go.
  ScratchFile(const std::string& name, std::string_view bytes) : file_(folder() / name) {
    std::ofstream(file_, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  ~ScratchFile() {
    std::error_code unimportant;
    std::filesystem::remove(file_, unimportant);
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return file_; }

  // One a process, gone with it.
  [[nodiscard]] static const std::filesystem::path& folder() {
    struct Folder {
      std::filesystem::path path;
      Folder() {
        const std::filesystem::path memory = "/dev/shm";
        const auto parent = std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
        path = parent / ("weaveform_fuzz_" + std::to_string(getpid()));
        std::filesystem::create_directories(path);
      }
      ~Folder() {
        std::error_code unimportant;
        std::filesystem::remove_all(path, unimportant);
      }
      Folder(const Folder&) = delete;
      Folder& operator=(const Folder&) = delete;
    };
    static const Folder folder;
    return folder.path;
  }

private:
  std::filesystem::path file_;
};

}  // namespace weaveform::fuzz
