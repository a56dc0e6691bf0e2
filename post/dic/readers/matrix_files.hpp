// Names of matrix files: MatchID, Ncorr and OpenCorr write one matrix of numbers for each component of each stage, and
// only the file's name tells which it is: "stage1_U[mm].csv", "stage1_V[mm].csv"; "plot_u_dic_3.csv",
// "plot_v_dic_3.csv"; "disp_x.csv", "disp_y.csv".
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace weaveform::dic {

struct MatrixName {
  std::string before, after;  // of the component in the name, without the unit
  char component = 'u';       // 'u', 'v', 'w', 'x' or 'y'
  std::string unit;           // "mm"; "" when the name has none
};

// Nothing when no word of the name is a component.
[[nodiscard]] std::optional<MatrixName> matrix_name(const std::filesystem::path& file);

// The file beside `file` with another component of the same stage; "" when there is none.
[[nodiscard]] std::filesystem::path sister_of(const std::filesystem::path& file, char component);

// Of files that are matrices of one stage only the one of u is kept (it stands for all), put in the place of the first;
// `listed` tells which were named one by one: others in a folder with matrices of u and v are dropped (strains, notes).
[[nodiscard]] std::vector<std::filesystem::path> stages_of_matrices(const std::vector<std::filesystem::path>& files,
                                                                    const std::vector<bool>& listed);

}  // namespace weaveform::dic
