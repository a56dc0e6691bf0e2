// Choices by their words, for tests that run over several of them: model.yarn = chosen("truss").
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/keys/choice.hpp"

namespace weaveform::test {

class Chosen {
public:
  explicit Chosen(std::string word) : word_(std::move(word)) {}
  template <NamedChoice Enum>
  operator Enum() const {
    return choice_named<Enum>(word_).value();
  }
  template <NamedChoice Enum>
  operator std::optional<Enum>() const {
    return choice_named<Enum>(word_).value();
  }

private:
  std::string word_;
};

// The value of this name in the table of whichever choice it is given to. Throws when that has none.
[[nodiscard]] inline Chosen chosen(std::string word) {
  return Chosen(std::move(word));
}

}  // namespace weaveform::test
