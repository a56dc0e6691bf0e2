// The numbers of a Gmsh file, in text or binary, one after another. In text a record is a line and its numbers must be
// on it; in binary records follow each other without a mark.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace weaveform {

class MshData {
public:
  explicit MshData(const std::filesystem::path& file);  // throws FileError

  void set_binary(bool swapped) {
    binary_ = true;
    swapped_ = swapped;
  }
  [[nodiscard]] bool binary() const { return binary_; }
  [[nodiscard]] const std::string& name() const { return name_; }

  // The next whole line of text, trimmed. Throws InputError at the end of the file.
  std::string_view text_line();
  [[nodiscard]] bool at_end() const { return next_ >= text_.size(); }

  // Before the numbers of a record (text: its line is taken); after them nothing may be left on the line.
  void begin_record();
  void end_record();
  // A number of the record: in binary of 4 bytes, of 8 bytes without a sign, of 8 bytes floating.
  long integer(const char* what);
  long size(const char* what);
  double real(const char* what);
  // size(), or in text and with four bytes integer(), no less than 0 and no more than a file can hold.
  long count(const char* what, bool four_bytes = false);
  void skip(std::size_t bytes, const char* what);  // in binary

  // "file:line" of the line last taken, in binary "file, byte N", then the words.
  [[noreturn]] void fail(const std::string& what) const;
  [[nodiscard]] int line() const { return binary_ ? 0 : line_; }

private:
  std::string_view word(const char* what);
  template <class Value>
  Value bytes(const char* what);

  std::string name_, text_;
  std::size_t next_ = 0;
  int line_ = 0;
  std::string_view record_;  // what is left of the line at hand
  bool binary_ = false, swapped_ = false;
};

}  // namespace weaveform
