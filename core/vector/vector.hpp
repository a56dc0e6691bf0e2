// Small vectors: points and directions in the plane and in space, as arrays, so that files and buffers hold them as
// they are. Sums run from the first component to the last.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace weaveform {

using Vec2 = std::array<double, 2>;
using Vec3 = std::array<double, 3>;

template <std::size_t N>
[[nodiscard]] inline std::array<double, N> plus(std::array<double, N> a, const std::array<double, N>& b) {
  for (std::size_t c = 0; c < N; ++c) a[c] += b[c];
  return a;
}

template <std::size_t N>
[[nodiscard]] inline std::array<double, N> minus(std::array<double, N> a, const std::array<double, N>& b) {
  for (std::size_t c = 0; c < N; ++c) a[c] -= b[c];
  return a;
}

template <std::size_t N>
[[nodiscard]] inline std::array<double, N> scaled(std::array<double, N> a, double factor) {
  for (double& component : a) component *= factor;
  return a;
}

template <std::size_t N>
[[nodiscard]] inline double dot(const std::array<double, N>& a, const std::array<double, N>& b) {
  double sum = a[0] * b[0];
  for (std::size_t c = 1; c < N; ++c) sum += a[c] * b[c];
  return sum;
}

[[nodiscard]] inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The component out of the plane.
[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b) {
  return a[0] * b[1] - a[1] * b[0];
}

// Of a matrix by its rows.
[[nodiscard]] inline Vec3 times(const std::array<Vec3, 3>& rows, const Vec3& a) {
  return {dot(rows[0], a), dot(rows[1], a), dot(rows[2], a)};
}

[[nodiscard]] inline double length(const Vec2& a) {
  return std::hypot(a[0], a[1]);
}

[[nodiscard]] inline double length(const Vec3& a) {
  return std::hypot(a[0], a[1], a[2]);
}

// The same from the sum of squares: a few times faster, a bit or two rounder, and neither for giants nor for dwarfs.
template <std::size_t N>
[[nodiscard]] inline double plain_length(const std::array<double, N>& a) {
  return std::sqrt(dot(a, a));
}

template <std::size_t N>
[[nodiscard]] inline double distance(const std::array<double, N>& a, const std::array<double, N>& b) {
  return length(minus(a, b));
}

// Each component over the same number.
template <std::size_t N>
[[nodiscard]] inline std::array<double, N> divided(std::array<double, N> a, double by) {
  for (double& component : a) component /= by;
  return a;
}

// Of length 1; a vector without length gives no numbers.
template <std::size_t N>
[[nodiscard]] inline std::array<double, N> unit(const std::array<double, N>& a) {
  return divided(a, length(a));
}

// Twice the area of the triangle a, b, c: > 0 when they turn counter-clockwise.
[[nodiscard]] inline double turn_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  return cross(minus(b, a), minus(c, a));
}

}  // namespace weaveform
