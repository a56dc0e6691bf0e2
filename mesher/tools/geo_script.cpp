#include "mesher/tools/geo_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <vector>

#include "core/error.hpp"
#include "mesher/tools/geo_words.hpp"

namespace weaveform {

namespace {

constexpr std::size_t longest_string = 1000;    // Gmsh takes what follows 1023 characters for commands again
constexpr std::size_t farthest_bracket = 2000;  // tokens
constexpr std::string_view symbols = "~!#%^&*()-+={}[]|:;<>,./?";
constexpr const char* advice =
    "keep to geometry, or give --trust-geo if you know where the script is from and want what it does";

enum class Kind { word, number, string, symbol };
struct Token {
  Kind kind;
  std::string_view text;
  std::size_t at;  // of the script's bytes
};

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Takes the script apart exactly as Gmsh's lexer does.
class Scanner {
public:
  Scanner(std::string_view text, const std::string& file) : text_(text), file_(file), kept_(text) {}

  std::string geometry() {
    split();
    pair_brackets();
    for (std::size_t k = 0; k < token_.size(); ++k) look_at(k);
    if (!complaints_.empty()) throw InputError(complaints_);
    return std::move(kept_);
  }

private:
  [[nodiscard]] char next(std::size_t at) const { return at < text_.size() ? text_[at] : '\0'; }

  void refuse(std::size_t at, const std::string& what) {
    constexpr std::size_t enough = 20;
    if (complaints_.size() >= enough) return;
    std::size_t line = 1, column = 1;
    for (std::size_t k = 0; k < at; ++k) {
      ++column;
      if (text_[k] == '\n') ++line, column = 1;
    }
    complaints_.push_back(fmt::format("{}:{}:{}: {}; {}", file_, line, column, what, advice));
  }

  void blank(std::size_t from, std::size_t to) {
    for (std::size_t k = from; k < to; ++k)
      if (kept_[k] != '\n') kept_[k] = ' ';
  }

  std::size_t end_of_comment(std::size_t at) {
    if (text_[at + 1] == '/') return std::min(text_.find('\n', at), text_.size());
    const std::size_t end = text_.find("*/", at + 2);
    if (end == std::string_view::npos) refuse(at, "this comment has no end");
    return end == std::string_view::npos ? text_.size() : end + 2;
  }

  std::size_t end_of_string(std::size_t at) {
    const std::size_t end = text_.find(text_[at], at + 1);
    if (end == std::string_view::npos || end - at > longest_string ||
        text_.substr(at, end - at).find_first_of(std::string_view("\n\0", 2)) != std::string_view::npos) {
      refuse(at, fmt::format("this text does not end on its line, or is longer than {} characters", longest_string));
      return text_.size();
    }
    token_.push_back({Kind::string, text_.substr(at, end + 1 - at), at});
    return end + 1;
  }

  [[nodiscard]] std::size_t end_of_number(std::size_t at) const {
    while (is_digit(next(at))) ++at;
    if (next(at) == '.') ++at;
    while (is_digit(next(at))) ++at;
    if (next(at) != 'e' && next(at) != 'E') return at;
    const std::size_t digits = next(at + 1) == '+' || next(at + 1) == '-' ? at + 2 : at + 1;
    if (!is_digit(next(digits))) return at;
    at = digits;
    while (is_digit(next(at))) ++at;
    return at;
  }

  void take(Kind kind, std::size_t from, std::size_t to) {
    token_.push_back({kind, text_.substr(from, to - from), from});
  }

  void split() {
    for (std::size_t at = 0; at < text_.size();) {
      const char c = text_[at];
      std::size_t end = at + 1;
      if (c == '/' && (next(at + 1) == '/' || next(at + 1) == '*')) {
        end = end_of_comment(at);
        blank(at, end);
      } else if (c == '"' || c == '\'') {
        end = end_of_string(at);
      } else if (is_letter(c)) {
        while (is_letter(next(end)) || is_digit(next(end))) ++end;
        take(Kind::word, at, end);
      } else if (is_digit(c) || (c == '.' && is_digit(next(at + 1)))) {
        end = end_of_number(at);
        take(Kind::number, at, end);
      } else if (c == '\r' || c == '\f') {
        kept_[at] = ' ';
      } else if (symbols.find(c) != std::string_view::npos) {
        take(Kind::symbol, at, end);
      } else if (c != ' ' && c != '\t' && c != '\n') {
        refuse(at, fmt::format("a byte of value {} has no place in a script", int{static_cast<unsigned char>(c)}));
        return;
      }
      at = end;
    }
  }

  [[nodiscard]] const Token* token(std::size_t k) const { return k < token_.size() ? &token_[k] : nullptr; }
  [[nodiscard]] bool is(std::size_t k, std::string_view text) const {
    return k < token_.size() && token_[k].kind != Kind::string && token_[k].text == text;
  }

  void pair_brackets() {
    after_.assign(token_.size(), 0);
    std::vector<std::size_t> open;
    for (std::size_t n = 0; n < token_.size(); ++n) {
      if (is(n, "(") || is(n, "[") || is(n, "{")) open.push_back(n);
      if (open.empty() || !(is(n, ")") || is(n, "]") || is(n, "}"))) continue;
      after_[open.back()] = n + 1;
      open.pop_back();
    }
  }

  // The place after the bracket that closes the one at k; k itself where there is none, or none that closes within reach.
  [[nodiscard]] std::size_t after_brackets(std::size_t k) const {
    const std::size_t after = k < after_.size() ? after_[k] : 0;
    return after != 0 && after - k <= farthest_bracket ? after : k;
  }

  // What may be assigned to an option is a number: a text names files and programs.
  void look_at_value(std::size_t k, const std::string& option) {
    static constexpr std::string_view functions[] = {"Str", "StrCat", "StrChoice", "StrSub", "StrReplace", "Sprintf"};
    if (is(k, "[")) k = after_brackets(k);
    if (!is(k, "=")) return;
    const Token* value = token(k + 1);
    if (value == nullptr) return;
    bool text = value->kind == Kind::string;
    for (const auto& name : functions) text = text || is(k + 1, name);
    if (text) refuse(value->at, fmt::format("option '{}' takes a text here, which geometry does not need", option));
  }

  void look_at_option(std::size_t k) {
    const std::string_view category = token_[k].text, name = token_[k + 2].text;
    const std::string option = fmt::format("{}.{}", category, name);
    if (!is_harmless_option(category, name))
      refuse(token_[k].at, fmt::format("option '{}' is not about geometry", option));
    else
      look_at_value(k + 3, option);
  }

  void look_at_field(std::size_t k) {
    const std::size_t after = after_brackets(k + 1);
    if (is(k + 1, "[") && is(after, "=") && token(after + 1) != nullptr && !is_field_of_numbers(token_[after + 1].text))
      refuse(token_[after + 1].at, fmt::format("a size field '{}' is not read here", token_[after + 1].text));
    if (is(after, ".") && token(after + 1) != nullptr && token_[after + 1].text != "F")
      look_at_value(after + 2, fmt::format("Field.{}", token_[after + 1].text));
  }

  void look_at(std::size_t k) {
    if (token_[k].kind != Kind::word) return;
    const std::string_view word = token_[k].text;
    const GeoWord kind = kind_of_geo_word(word);
    const bool member = k > 0 && is(k - 1, ".") && !(k > 1 && is(k - 2, "."));
    if (kind == GeoWord::refused && !(member && word == "Color"))
      return refuse(token_[k].at, fmt::format("'{}' does more than describe geometry", word));
    if (word == "Printf" || word == "Error" || word == "Warning") {
      const std::size_t after = after_brackets(k + 1);
      if (after == k + 1) refuse(token_[k].at, fmt::format("'{}' has no brackets that close soon", word));
      if (is(after, ">")) refuse(token_[k].at, fmt::format("'{}' writes a file here", word));
    }
    if (word == "Field") look_at_field(k);
    if (kind == GeoWord::geometry || member) return;
    if (is(k + 1, ".") && token(k + 2) != nullptr && token_[k + 2].kind == Kind::word) return look_at_option(k);
    const bool names_a_macro = k > 0 && (is(k - 1, "Macro") || is(k - 1, "Function") || is(k - 1, "Call"));
    const Token* following = token(k + 1);
    if (following == nullptr || following->kind == Kind::symbol || names_a_macro || may_lead(word) || is(k + 1, "In"))
      return;
    refuse(token_[k].at, fmt::format("'{}' is no geometry command", word));
  }

  std::string_view text_;
  const std::string& file_;
  std::string kept_;
  std::vector<Token> token_;
  std::vector<std::size_t> after_;  // of an opening bracket, the place after the one that closes it; else 0
  std::vector<std::string> complaints_;
};

std::atomic<bool> trusted_scripts{false};

}  // namespace

std::string geometry_script(std::string_view text, const std::string& file) {
  return Scanner(text, file).geometry();
}

void trust_geo_scripts(bool trusted) {
  trusted_scripts = trusted;
}

bool geo_scripts_are_trusted() {
  return trusted_scripts;
}

}  // namespace weaveform
