// One description of a state for all who keep it. Whatever has a state has one archive(Archive&), which names each of
// its members once; the same call then writes them, reads them back, or looks for one that no state may have.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/files/digest.hpp"

namespace weaveform {

// What a number may be.
struct Bounds {
  double least = std::numeric_limits<double>::lowest();
  double greatest = std::numeric_limits<double>::max();
  bool not_a_number = false;  // allowed too
  [[nodiscard]] bool hold(double value) const {
    return std::isnan(value) ? not_a_number : value >= least && value <= greatest;
  }
};
inline constexpr Bounds not_negative = {.least = 0.0};
inline constexpr Bounds infinite_too = {-std::numeric_limits<double>::infinity(),
                                        std::numeric_limits<double>::infinity()};
inline constexpr Bounds anything = {infinite_too.least, infinite_too.greatest, true};

// `what` names the member for messages.
class Archive {
public:
  Archive() = default;
  virtual ~Archive() = default;
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  virtual void number(const char* what, double& value, Bounds bounds = {}) = 0;
  virtual void count(const char* what, std::int64_t& value, std::int64_t least, std::int64_t most) = 0;
  virtual void flag(const char* what, bool& value) = 0;
  virtual void text(const char* what, std::string& value) = 0;
  // Lists whose length the scene gives: it never changes.
  virtual void numbers(const char* what, std::span<double> values, Bounds bounds = {}) = 0;
  virtual void indices(const char* what, std::span<int> values, int least, int most) = 0;
  // The length of a list that may have from `least` to `most` entries, which the caller then archives one by one.
  [[nodiscard]] virtual std::size_t length(const char* what, std::size_t now, std::size_t least, std::size_t most) = 0;

  // A list of numbers of such a length.
  void list(const char* what, std::vector<double>& values, std::size_t least, std::size_t most, Bounds bounds = {});
};

// Appends to `bytes`; integers and doubles are the machine's own.
class StateWriter : public Archive {
public:
  explicit StateWriter(std::string& bytes) : bytes_(bytes) {}
  void number(const char* what, double& value, Bounds bounds) override;
  void count(const char* what, std::int64_t& value, std::int64_t least, std::int64_t most) override;
  void flag(const char* what, bool& value) override;
  void text(const char* what, std::string& value) override;
  void numbers(const char* what, std::span<double> values, Bounds bounds) override;
  void indices(const char* what, std::span<int> values, int least, int most) override;
  [[nodiscard]] std::size_t length(const char* what, std::size_t now, std::size_t least, std::size_t most) override;

private:
  std::string& bytes_;
};

// Takes from the front of `bytes`. Nothing that the file says is believed: a length is compared with what there may be
// and with what is left before room is made. Throws DamagedState.
class StateReader : public Archive {
public:
  explicit StateReader(std::string_view bytes) : left_(bytes) {}
  [[nodiscard]] std::size_t left() const { return left_.size(); }
  void number(const char* what, double& value, Bounds bounds) override;
  void count(const char* what, std::int64_t& value, std::int64_t least, std::int64_t most) override;
  void flag(const char* what, bool& value) override;
  void text(const char* what, std::string& value) override;
  void numbers(const char* what, std::span<double> values, Bounds bounds) override;
  void indices(const char* what, std::span<int> values, int least, int most) override;
  [[nodiscard]] std::size_t length(const char* what, std::size_t now, std::size_t least, std::size_t most) override;

private:
  void take(void* to, std::size_t size);
  std::string_view left_;
};

// Changes nothing: finds the first member that is out of its bounds.
class StateLook : public Archive {
public:
  // Its name; "" when there is none.
  [[nodiscard]] const std::string& found() const { return found_; }
  void number(const char* what, double& value, Bounds bounds) override;
  void count(const char* /*what*/, std::int64_t& /*value*/, std::int64_t /*least*/, std::int64_t /*most*/) override {}
  void flag(const char* /*what*/, bool& /*value*/) override {}
  void text(const char* /*what*/, std::string& /*value*/) override {}
  void numbers(const char* what, std::span<double> values, Bounds bounds) override;
  void indices(const char* /*what*/, std::span<int> /*values*/, int /*least*/, int /*most*/) override {}
  [[nodiscard]] std::size_t length(const char* /*what*/, std::size_t now, std::size_t /*least*/,
                                   std::size_t /*most*/) override {
    return now;
  }

private:
  std::string found_;
};

// Why bytes are not what a state of this scene wrote.
struct DamagedState {
  std::string why;
};

// The bytes of whatever has an archive().
template <class Kept>
[[nodiscard]] std::string state_bytes(Kept& kept) {
  std::string bytes;
  StateWriter writer(bytes);
  kept.archive(writer);
  return bytes;
}

// Their check sum: two states are the same when theirs are.
template <class Kept>
[[nodiscard]] std::uint64_t state_digest(Kept& kept) {
  return check_sum(state_bytes(kept));
}

}  // namespace weaveform
