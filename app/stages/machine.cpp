#include "app/stages/machine.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <system_error>

namespace weaveform {
namespace {

namespace fs = std::filesystem;

constexpr double infinity = std::numeric_limits<double>::infinity();

// The number on the line that begins with `name`, in kB as the kernel gives it.
double kilobytes(const char* file, const std::string& name) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(name)) return std::strtod(line.c_str() + name.size(), nullptr);
  return infinity;
}

double number_in(const fs::path& file) {
  std::ifstream stream(file);
  double number = infinity;
  if (!(stream >> number)) return infinity;  // "max" is no number: no limit
  return number;
}

// Version 2: one line "0::/path" names the group, whose limit and use stand in two files.
double left_by_control_group() {
  std::ifstream lines("/proc/self/cgroup");
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("0::/")) continue;
    double left = infinity;
    const fs::path root = "/sys/fs/cgroup";
    fs::path group = root / line.substr(4);
    for (bool above = true; above; group = group.parent_path()) {
      const double most = number_in(group / "memory.max"), used = number_in(group / "memory.current");
      if (std::isfinite(most) && std::isfinite(used)) left = std::min(left, std::max(0.0, most - used));
      above = group != root && group.has_relative_path();
    }
    return left;
  }
  return infinity;
}

double left_by_limit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return infinity;
  const double pages = number_in("/proc/self/statm");  // the first number: all of the address space
  const double used = std::isfinite(pages) ? pages * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0.0;
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - used);
}

}  // namespace

double available_memory() {
  return std::min({1024.0 * kilobytes("/proc/meminfo", "MemAvailable:"), left_by_control_group(), left_by_limit()});
}

double available_disk(const fs::path& path) {
  std::error_code unknown;
  for (fs::path folder = fs::absolute(path, unknown); !folder.empty(); folder = folder.parent_path()) {
    const fs::space_info space = fs::space(folder, unknown);
    if (!unknown) return static_cast<double>(space.available);
    if (folder == folder.parent_path()) break;
  }
  return infinity;
}

}  // namespace weaveform
