#include "post/dic/readers/question.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace weaveform::dic {

void ask(Questions& questions, Question question) {
  const auto same = [&](const Question& other) { return other.key == question.key; };
  if (std::none_of(questions.begin(), questions.end(), same)) questions.push_back(std::move(question));
}

std::string question_line(const Question& question) {
  const auto dot = question.key.find('.');
  return fmt::format("{} set {} of [{}] (--set {}={})", question.text, question.key.substr(dot + 1),
                     question.key.substr(0, dot), question.key, question.example);
}

void throw_if_asked(const Questions& questions) {
  if (questions.empty()) return;
  std::vector<std::string> lines;
  for (const Question& question : questions) lines.push_back(question_line(question));
  throw InputError(lines);
}

}  // namespace weaveform::dic
