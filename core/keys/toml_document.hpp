// A TOML file as a tree that knows where each value stands, and the list of everything found wrong in it.
#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace weaveform {

// Source name of values that came from the command line ("--set blank.size"), told apart by its beginning.
inline constexpr std::string_view override_mark = "--set ";

// Collects complaints, so that one reading shows every mistake of a file.
class Complaints {
public:
  explicit Complaints(std::string file) : file_(std::move(file)) {}

  // "file:line:column: what", or "--set KEY: what" when the place came from an override.
  void add(const toml::source_region& where, const std::string& what);
  void add(const toml::node& where, const std::string& what) { add(where.source(), what); }
  void add_override(const std::string& key, const std::string& what);

  [[nodiscard]] std::size_t count() const { return found_.size(); }
  // Throws InputError with every complaint, overrides first, then in the order of the file; repeated ones once.
  void throw_if_any() const;

private:
  using Complaint = std::tuple<std::uint32_t, std::uint32_t, std::string>;  // line, column, message
  std::string file_;
  std::vector<Complaint> found_;
};

// Parses TOML; throws InputError "file:line:column: ..." at the first syntax error. Values remember `name` as their
// source.
[[nodiscard]] toml::table parse_toml(const std::string& text, const std::string& name);

}  // namespace weaveform
