// From the columns of a test file to the curve of one specimen: in mm and N (or what else is measured), sorted, without
// missing rows, cut where the specimen broke. What was done is noted; what cannot be right is an InputError that asks.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fabric/identify/fit_spec.hpp"
#include "fabric/identify/unit.hpp"

namespace weaveform::identify {

// One measured quantity: which column, in which unit, and the keys of the fit file that say so.
struct Channel {
  Quantity quantity = Quantity::length;
  std::string name;  // "displacement", in messages and keys: name_column, name_unit, name_factor
  std::string column;
  std::string unit;
  double factor = 1.0;  // of the user, on top of the unit's
};

struct Curve {
  std::string specimen;            // file, or file and name of the specimen in it
  std::vector<double> x, y;        // rising x, each value once
  std::vector<std::string> notes;  // what was done to the rows, in sentences
};

// Rows as read, in the project's units, to a curve. Throws InputError: too few points, a cyclic test, negative loads.
[[nodiscard]] Curve prepared_curve(Curve raw, const Channel& x, const Channel& y);

// The curves of all specimens of a test, one or more for each of its files, in order. Complaints of all files at once.
[[nodiscard]] std::vector<Curve> load_curves(const TestSpec& test, const std::filesystem::path& fit_file,
                                             const Channel& x, const Channel& y);

// The same before any preparation: rows of every specimen as recorded, in the project's units, with the index of its
// file. Whatever `use` complains about is collected over all of them.
void for_each_specimen(const TestSpec& test, const std::filesystem::path& fit_file, const Channel& x, const Channel& y,
                       const std::function<void(Curve raw, std::size_t file)>& use);
// Rows without a value left out, in the order of recording. Throws InputError: too few.
[[nodiscard]] Curve complete_rows(Curve raw);
// Messages name the whole path; the report names the file as the fit file does.
[[nodiscard]] std::string name_beside(const std::string& specimen, const std::filesystem::path& fit_file);

[[nodiscard]] Channel displacement_channel(const TestSpec& test);
[[nodiscard]] Channel force_channel(const TestSpec& test);

}  // namespace weaveform::identify
