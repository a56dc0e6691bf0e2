#include <fmt/format.h>
#include <chrono>
#include "tests/support/bending_cases.hpp"
using namespace weaveform::test;
int main() {
  for (const auto& c : bending_cases())
    for (auto b : c.benders) {
      fmt::print("{} | {}:", c.name, name_of(b));
      double last = 0;
      for (int n : b == Bender::yarn ? std::vector<int>{8, 16, 32, 64} : std::vector<int>{6, 12, 24}) {
        auto t = std::chrono::steady_clock::now();
        try {
          auto m = c.run(b, n);
          fmt::print(" {}: {:.3e} (x{:.2f}) res {:.1e} {:.2f}s;", n, m.error, last / m.error, m.residual,
                     std::chrono::duration<double>(std::chrono::steady_clock::now() - t).count());
          last = m.error;
        } catch (const std::exception& e) { fmt::print(" {}: {}", n, e.what()); }
      }
      fmt::print("\n");
    }
  for (auto b : {Bender::beam, Bender::rotation_free, Bender::shell}) {
    fmt::print("cut {}:", name_of(b));
    for (int n : {6, 12, 24}) try { auto m = cut_strip(b, n); fmt::print(" {:.3e}", m.error); } catch (const std::exception& e) { fmt::print(" {}: {}", n, e.what()); }
    fmt::print("\n");
  }
}
