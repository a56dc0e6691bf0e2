// A few threads that share out the blocks of a loop, kept for a whole analysis.
//
// A thread takes the blocks of its own share first, then those that others have not begun: a thread that does not get
// to run, because the machine is busy, costs its help and holds nobody up. Who computes a block never shows in the
// results as long as a block writes only what is its own. Threads that wait spin for some microseconds, then sleep.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <type_traits>
#include <vector>

namespace weaveform {

class Team {
public:
  // `threads` of 1 or less: the caller alone. Where the system grants fewer, the team is smaller.
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  // As asked for: into how many blocks a loop is best cut.
  [[nodiscard]] int threads() const { return threads_; }

  // Calls work(block) once for each block from 0 to `blocks` - 1 and returns when all are done. What a block throws is
  // thrown here, after the others; of several the one of the lowest block. Not to be called from within a block.
  template <class Work>
  void run(int blocks, Work&& work) {
    using Body = std::remove_reference_t<Work>;
    run_blocks(
        blocks, [](const void* body, int block) { (*static_cast<Body*>(const_cast<void*>(body)))(block); },
        std::addressof(work));
  }

  // False: the caller does all blocks until told otherwise, and the others sleep.
  void set_together(bool together) { together_ = together; }

private:
  using Call = void (*)(const void* body, int block);
  // The blocks of one thread, [next, end). `next` carries the round in its upper half, so that who comes late takes
  // nothing of a later round by mistake.
  struct alignas(64) Share {
    std::atomic<std::uint64_t> next = 0;
    std::atomic<int> end = 0;
  };

  void run_blocks(int blocks, Call call, const void* body);
  void begin_round(int blocks, Call call, const void* body);
  void serve(int member);
  int take_all(int member, std::uint32_t round);
  void do_block(int block);
  void await_end();

  int threads_;
  std::chrono::nanoseconds patience_;  // of spinning
  std::vector<Share> share_;
  std::vector<std::thread> worker_;
  Call call_ = nullptr;
  const void* body_ = nullptr;
  int blocks_ = 0;
  bool together_ = true;
  std::mutex error_guard_;
  std::exception_ptr error_;
  int error_block_ = 0;
  alignas(64) std::atomic<std::uint32_t> round_ = 0;
  alignas(64) std::atomic<int> done_ = 0;
  std::atomic<bool> ending_ = false;
};

// The caller alone: for whoever has no team.
[[nodiscard]] Team& alone();

}  // namespace weaveform
