#include "mesher/tools/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>

#include "core/error.hpp"
#include "core/files/files.hpp"
#include "core/files/text_words.hpp"
#include "core/vector/vector.hpp"

namespace weaveform {

namespace {

// Binary STL: 80 bytes of anything, the number of facets, then each facet as 12 floats (normal, three corners) and two
// bytes of anything. Little endian, as this machine must be.
constexpr std::size_t header_size = 84, facet_size = 50, normal_size = 12;

constexpr const char* write_again = "write it again as text or binary STL";

class Collector {
public:
  explicit Collector(const std::string& name) : name_(name) {}

  // `place` of the file, e.g. ":12" for its line.
  void add(const std::array<Vec3, 3>& corners, const std::string& place = "") {
    ++facets_;
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      for (const double x : corners[k])
        if (!(std::abs(x) <= farthest_corner))
          throw InputError(fmt::format("{}{}: facet {} has a corner at {}, which is no place within {:g} mm; {}", name_,
                                       place, facets_, x, farthest_corner, write_again));
      const auto [found, is_new] = index_.emplace(corners[k], static_cast<int>(list_.point.size()));
      if (is_new) list_.point.push_back(corners[k]);
      triangle[k] = found->second;
    }
    list_.triangle.push_back(triangle);
  }
  [[nodiscard]] std::size_t facets() const { return facets_; }
  TriangleList take() {
    if (list_.triangle.empty()) throw InputError(fmt::format("{}: no facet in it; {}", name_, write_again));
    return std::move(list_);
  }

private:
  const std::string& name_;
  std::size_t facets_ = 0;
  std::map<Vec3, int> index_;
  TriangleList list_;
};

std::size_t announced_facets(std::string_view bytes) {
  std::uint32_t count = 0;
  if (bytes.size() >= header_size) std::memcpy(&count, bytes.data() + header_size - sizeof count, sizeof count);
  return count;
}

TriangleList parse_binary(std::string_view bytes, const std::string& name) {
  const std::size_t count = announced_facets(bytes);
  if (bytes.size() < header_size || count > (bytes.size() - header_size) / facet_size)
    throw InputError(
        fmt::format("{}: not an STL surface, or cut short: its header announces {} facets and {} bytes "
                    "follow; {}",
                    name, count, bytes.size() - std::min(bytes.size(), header_size), write_again));
  Collector found(name);
  for (std::size_t k = 0; k < count; ++k) {
    std::array<float, 9> x{};
    std::memcpy(x.data(), bytes.data() + header_size + k * facet_size + normal_size, sizeof x);
    found.add({Vec3{x[0], x[1], x[2]}, Vec3{x[3], x[4], x[5]}, Vec3{x[6], x[7], x[8]}});
  }
  return found.take();
}

// The words of a text and the lines they stand on.
class StlWords {
public:
  StlWords(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  [[nodiscard]] bool at_end() {
    while (at_ < text_.size() && is_blank(text_[at_])) line_ += text_[at_++] == '\n' ? 1 : 0;
    return at_ == text_.size();
  }
  // In small letters.
  std::string next() {
    if (at_end()) fail("it ends inside a facet; it may have been cut short");
    const std::size_t from = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return lower(text_.substr(from, at_ - from));
  }
  void pass_line() { at_ = std::min(text_.find_first_of("\r\n", at_), text_.size()); }
  void expect(const std::string& wanted) {
    std::string word = next();
    if (word == "end" && wanted.starts_with("end")) word += next();  // "end loop"
    if (word != wanted) fail(fmt::format("'{}' where '{}' belongs", word.substr(0, 40), wanted));
  }
  double number() {
    const std::string word = next();
    std::string_view digits = word;
    if (digits.starts_with("+")) digits.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::result_out_of_range) value = std::numeric_limits<double>::infinity();
    if (digits.empty() || error == std::errc::invalid_argument || end != digits.data() + digits.size())
      fail(fmt::format("'{}' is no number", word.substr(0, 40)));
    return value;
  }
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}:{}: not an STL surface: {}; {}", name_, line_, what, write_again));
  }
  [[nodiscard]] std::string place() const { return fmt::format(":{}", line_); }

private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 1;
};

void parse_facet(StlWords& words, Collector& found) {
  words.expect("normal");
  for (int k = 0; k < 3; ++k) (void)words.next();  // not used; some programs write nan for slivers
  words.expect("outer");
  words.expect("loop");
  std::array<Vec3, 3> corners{};
  for (Vec3& corner : corners) {
    words.expect("vertex");
    for (double& x : corner) x = words.number();
  }
  found.add(corners, words.place());
  words.expect("endloop");
  words.expect("endfacet");
}

TriangleList parse_text(std::string_view text, const std::string& name) {
  StlWords words(text, name);
  Collector found(name);
  bool open = false;
  while (!words.at_end()) {
    const std::string word = words.next();
    if (word == "facet" && open)
      parse_facet(words, found);
    else if (word == "solid" || word == "endsolid" || (word == "end" && open))
      open = word == "solid", words.pass_line();  // a name of any words
    else if (open || word == "facet")
      words.fail(fmt::format("'{}' where {} belongs", word.substr(0, 40), open ? "a facet or endsolid" : "solid"));
    else
      words.pass_line();  // comments, and whatever else programs write around a solid
  }
  if (open) words.fail("no endsolid; it may have been cut short");
  return found.take();
}

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // UTF-8

// A line of it begins with "solid", and nothing up to there is a byte that no text has. A header of a binary file that
// begins so is followed by such bytes before long.
bool is_text(std::string_view bytes) {
  constexpr std::size_t farthest = 1 << 16, looked_at = 512;
  const std::string_view head = bytes.substr(0, farthest);
  const auto no_text = [](unsigned char c) { return c < ' ' && c != '\t' && c != '\n' && c != '\r' && c != '\f'; };
  const auto first = std::find_if(head.begin(), head.end(), no_text);
  const auto clean = static_cast<std::size_t>(first - head.begin());
  std::string text = lower(head.substr(0, clean));
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  for (std::size_t at = 0; at < text.size(); at = text.find_first_of("\r\n", at)) {
    at = text.find_first_not_of(" \t\r\n\f", at);
    if (at == std::string::npos) return false;
    if (text.compare(at, 5, "solid") == 0) return clean == head.size() || clean > at + looked_at;
  }
  return false;
}

}  // namespace

TriangleList parse_stl(std::string_view bytes, const std::string& name) {
  // "solid" begins many binary files too; the size tells for certain
  const bool binary_size =
      bytes.size() > header_size && bytes.size() - header_size == announced_facets(bytes) * facet_size;
  if (binary_size || !is_text(bytes)) return parse_binary(bytes, name);
  if (bytes.starts_with(byte_order_mark)) bytes.remove_prefix(byte_order_mark.size());
  return parse_text(bytes, name);
}

TriangleList read_stl(const std::filesystem::path& file) {
  return parse_stl(read_text_file(file), file.string());
}

void require_sound(const TriangleList& list, const std::string& where) {
  const auto points = static_cast<int>(list.point.size());
  for (std::size_t t = 0; t < list.triangle.size(); ++t)
    for (const int n : list.triangle[t]) {
      if (n < 0 || n >= points)
        throw InputError(fmt::format("{}: triangle {} names a point that is not there; {}", where, t + 1, write_again));
      for (const double x : list.point[static_cast<std::size_t>(n)])
        if (!(std::abs(x) <= farthest_corner))
          throw InputError(fmt::format("{}: triangle {} has a corner at {}, which is no place within {:g} mm; {}",
                                       where, t + 1, x, farthest_corner, write_again));
    }
}

}  // namespace weaveform
