// A text file line by line, with messages that name file and line; numbers strictly read.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace weaveform {

class TextLines {
public:
  explicit TextLines(const std::filesystem::path& file);  // throws FileError
  [[nodiscard]] bool at_end() const { return next_ >= lines_.size(); }
  [[nodiscard]] const std::string& peek() const { return lines_[next_]; }
  const std::string& next();                                            // throws InputError at the end of the file
  [[nodiscard]] int number() const { return static_cast<int>(next_); }  // of the line last taken, from 1
  [[noreturn]] void fail(const std::string& what) const { fail_at(number(), what); }
  [[noreturn]] void fail_at(int line, const std::string& what) const;
  [[nodiscard]] const std::string& name() const { return name_; }
  // The whole word must be the number; `what` names it in the complaint.
  [[nodiscard]] long whole(std::string_view word, const std::string& what) const;
  [[nodiscard]] double real(std::string_view word, const std::string& what) const;

private:
  std::string name_;
  std::vector<std::string> lines_;
  std::size_t next_ = 0;
};

[[nodiscard]] std::vector<std::string_view> words_of(std::string_view line);                   // at blanks
[[nodiscard]] std::vector<std::string_view> fields_of(std::string_view line, char separator);  // trimmed
[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::string upper(std::string_view text);

}  // namespace weaveform
