// The lines of an Abaqus input file with the files it names, as one stream: comments gone, continued keyword lines
// joined, *INCLUDE followed.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/exchange/weave_lines.hpp"

namespace weaveform {

struct InpSource {
  int file = 0;  // place in InpLines::files
  int line = 0;  // from 1
};

struct InpKeyword {
  std::string name;                              // in capitals and without blanks: "*ENDPART"
  std::map<std::string, std::string> parameter;  // names in capitals, values as written without their quotes
  InpSource at;
  [[nodiscard]] bool has(const std::string& key) const { return parameter.count(key) != 0; }
  [[nodiscard]] std::string value(const std::string& key) const {
    const auto found = parameter.find(key);
    return found == parameter.end() ? "" : found->second;
  }
};

class InpLines {
public:
  explicit InpLines(const std::filesystem::path& file);  // throws FileError

  // The next keyword; data lines before it are passed over. Nothing at the end. Throws InputError when the file does
  // not begin with one.
  [[nodiscard]] std::optional<InpKeyword> next_keyword();
  // The next data line of the block at hand; false at a keyword or the end.
  bool next_data(std::string& line);
  // Its fields; of a line that ends with a comma and has fewer than `least`, with those of the lines after it.
  bool next_fields(std::vector<std::string>& fields, std::size_t least = 0);
  [[nodiscard]] InpSource at() const { return at_; }  // of the line last taken

  // A file of data lines that comes before those of the block (INPUT=); asked for before any of them is taken. Throws
  // FileError, InputError.
  void enter_data(const InpKeyword& keyword);

  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }
  [[nodiscard]] const std::vector<NumberedLine>& weave() const { return weave_; }
  [[noreturn]] void fail(const std::string& what) const { fail(at_, what); }
  [[noreturn]] void fail(const InpSource& at, const std::string& what) const;
  [[nodiscard]] long whole(std::string_view word, const char* what) const;
  [[nodiscard]] double real(std::string_view word, const char* what) const;

private:
  struct OpenFile {
    int file = 0;
    std::filesystem::path path;
    std::vector<std::string> lines;
    std::size_t next = 0;
    bool data_only = false;
  };
  struct Line {
    InpSource at;
    std::string text;
    bool keyword = false;
  };
  void enter(const std::string& name, const InpSource& from, const std::string& what, bool data_only);
  void open(const std::filesystem::path& path, const std::string& shown, bool data_only);
  bool fill();  // makes ahead_ hold a line; false at the end
  [[nodiscard]] InpKeyword keyword_of(const Line& line) const;

  std::vector<OpenFile> open_;  // the innermost last
  std::vector<std::string> files_;
  std::vector<NumberedLine> weave_;
  std::optional<Line> ahead_;
  InpSource at_;
  std::uintmax_t bytes_ = 0;  // of all files together
  bool begun_ = false;
};

}  // namespace weaveform
