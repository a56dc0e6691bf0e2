// What a file does not tell and its user has not said: asked for, all of it at once, each with the key that answers it.
#pragma once

#include <string>
#include <vector>

namespace weaveform::dic {

struct Question {
  std::string text;     // "stage.csv: column 'x' is in pixels: how many mm is one pixel?"
  std::string key;      // "measurement.pixel_size"; of the settings
  std::string example;  // "0.05"; as it stands behind --set KEY=
};
using Questions = std::vector<Question>;

// Adds the question unless its key is asked for already.
void ask(Questions& questions, Question question);

// "TEXT set NAME of [TABLE] (--set KEY=EXAMPLE)"
[[nodiscard]] std::string question_line(const Question& question);

// Throws InputError with a line for each question, when there are any.
void throw_if_asked(const Questions& questions);

}  // namespace weaveform::dic
