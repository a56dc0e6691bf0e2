#include "solver/state/team.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <system_error>
#include <utility>

namespace weaveform {
namespace {

using std::chrono::nanoseconds;

// Between two loops of a step lie a few microseconds, between two steps not many more. A longer wait is one for output,
// or for a thread that does not get to run: spinning would take the time it waits for.
constexpr nanoseconds longest_spin = std::chrono::microseconds(20);
constexpr nanoseconds shortest_spin = std::chrono::microseconds(1);

void pause() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

// True as soon as `met`, false after `patience` without.
template <class Condition>
bool spin(nanoseconds patience, Condition met) {
  if (met()) return true;
  const auto end = std::chrono::steady_clock::now() + patience;
  do {
    for (int k = 0; k < 16; ++k) {
      pause();
      if (met()) return true;
    }
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

constexpr int no_block = std::numeric_limits<int>::max();

std::uint64_t ticket(std::uint32_t round, int block) {
  return (static_cast<std::uint64_t>(round) << 32U) | static_cast<std::uint32_t>(block);
}

}  // namespace

Team::Team(int threads)
    : threads_(std::max(1, threads)),
      patience_(static_cast<unsigned>(threads) > std::thread::hardware_concurrency() ? nanoseconds(0) : longest_spin),
      share_(threads_) {
  try {
    for (int member = 1; member < threads_; ++member) worker_.emplace_back([this, member] { serve(member); });
  } catch (const std::system_error&) {
    // no more threads are to be had: those there are do the blocks of all
  }
}

Team::~Team() {
  ending_.store(true);
  round_.fetch_add(1);
  round_.notify_all();
  for (auto& worker : worker_) worker.join();
}

Team& alone() {
  static Team team(1);  // has no state that a call would touch
  return team;
}

void Team::run_blocks(int blocks, Call call, const void* body) {
  if (worker_.empty() || blocks <= 1 || !together_) {
    for (int block = 0; block < blocks; ++block) call(body, block);
    return;
  }
  begin_round(blocks, call, body);
  take_all(0, round_.load(std::memory_order_relaxed));
  await_end();
  if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

// Nobody has a block in hand here; what is written comes before the tickets that let one be taken.
void Team::begin_round(int blocks, Call call, const void* body) {
  call_ = call;
  body_ = body;
  blocks_ = blocks;
  done_.store(0, std::memory_order_relaxed);
  const std::uint32_t round = round_.load(std::memory_order_relaxed) + 1;
  const auto first = [&](int member) { return static_cast<int>(static_cast<long>(blocks) * member / threads_); };
  for (int member = 0; member < threads_; ++member) {
    // closed first: a latecomer with the last ticket of the round before, who then finds an end moved on, would take it
    // for one more block
    share_[member].next.store(ticket(round, no_block), std::memory_order_relaxed);
    share_[member].end.store(first(member + 1), std::memory_order_release);
    share_[member].next.store(ticket(round, first(member)), std::memory_order_release);
  }
  round_.store(round, std::memory_order_release);
  round_.notify_all();
}

// The member's own share, then the others'. How many blocks it did.
int Team::take_all(int member, std::uint32_t round) {
  int taken = 0;
  for (int k = 0; k < threads_; ++k) {
    Share& share = share_[(member + k) % threads_];
    std::uint64_t next = share.next.load(std::memory_order_acquire);
    for (;;) {
      const int block = static_cast<int>(next & 0xffffffffU);
      if (next >> 32U != round || block >= share.end.load(std::memory_order_acquire)) break;
      if (!share.next.compare_exchange_weak(next, next + 1, std::memory_order_acq_rel, std::memory_order_acquire))
        continue;
      do_block(block);
      ++taken;
      next = share.next.load(std::memory_order_acquire);
    }
  }
  return taken;
}

void Team::do_block(int block) {
  try {
    call_(body_, block);
  } catch (...) {
    const std::lock_guard<std::mutex> guard(error_guard_);
    if (!error_ || block < error_block_) {
      error_ = std::current_exception();
      error_block_ = block;
    }
  }
  // the last one wakes the caller, should it sleep; the team outlives the call, for its end joins the workers
  const int all = blocks_;
  if (done_.fetch_add(1, std::memory_order_acq_rel) + 1 == all) done_.notify_all();
}

void Team::await_end() {
  const auto ended = [&] { return done_.load(std::memory_order_acquire) == blocks_; };
  if (spin(patience_, ended)) return;
  for (int done = done_.load(std::memory_order_acquire); done != blocks_; done = done_.load(std::memory_order_acquire))
    done_.wait(done, std::memory_order_acquire);
}

void Team::serve(int member) {
  nanoseconds patience = patience_;
  std::uint32_t seen = 0;
  for (;;) {
    const auto called = [&] { return round_.load(std::memory_order_acquire) != seen; };
    const bool slept = !spin(patience, called);
    if (slept) round_.wait(seen, std::memory_order_acquire);
    if (ending_.load()) return;
    seen = round_.load(std::memory_order_acquire);
    // who comes too late for a block, again and again, had better leave the core to others
    const bool helped = take_all(member, seen) > 0;
    patience = helped ? std::min(patience_, 2 * patience) : std::min(patience_, std::max(shortest_spin, patience / 2));
  }
}

}  // namespace weaveform
