/// Particle positions as lanes read them: one field a coordinate, padded to whole lanes.
#pragma once

#include <array>

#include "common/sph/lanes.hpp"
#include "common/vector.hpp"

namespace toryu {

using VecField = std::array<Field, dim>;
using VecLanes = std::array<Lanes, dim>;
using TensorField = std::array<VecField, dim>;
using TensorLanes = std::array<VecLanes, dim>;

TORYU_INLINE VecLanes load(const VecField& field, std::size_t first) {
  VecLanes value;
  for (int a = 0; a < dim; ++a) value[a] = load(field[a], first);
  return value;
}
TORYU_INLINE void store(const VecLanes& value, VecField& field, std::size_t first) {
  for (int a = 0; a < dim; ++a) store(value[a], field[a], first);
}
TORYU_INLINE TensorLanes load(const TensorField& field, std::size_t first) {
  TensorLanes value;
  for (int a = 0; a < dim; ++a) value[a] = load(field[a], first);
  return value;
}
TORYU_INLINE void store(const TensorLanes& value, TensorField& field, std::size_t first) {
  for (int a = 0; a < dim; ++a) store(value[a], field[a], first);
}
inline void resize(VecField& field, std::size_t size, double value = 0.0) {
  for (auto& component : field) component.resize(size, value);
}
inline void resize(TensorField& field, std::size_t size) {
  for (auto& row : field) resize(row, size);
}
inline Vec at(const VecField& field, std::size_t i) {
  Vec value;
  for (int a = 0; a < dim; ++a) value[a] = field[a][i];
  return value;
}
inline void set(VecField& field, std::size_t i, const Vec& value) {
  for (int a = 0; a < dim; ++a) field[a][i] = value[a];
}

TORYU_INLINE VecLanes shifted(const VecLanes& x, const Vec& shift) {
  VecLanes moved;
  for (int a = 0; a < dim; ++a) moved[a] = x[a] + shift[a];
  return moved;
}

TORYU_INLINE VecLanes zero_vector() {
  VecLanes zero;
  for (auto& component : zero) component = 0.0;
  return zero;
}

TORYU_INLINE TensorLanes zero_tensor() {
  TensorLanes zero;
  for (auto& row : zero) row = zero_vector();
  return zero;
}

TORYU_INLINE Lanes trace(const TensorLanes& t) {
  Lanes sum = t[0][0];
  for (int a = 1; a < dim; ++a) sum += t[a][a];
  return sum;
}

TORYU_INLINE VecLanes product(const Lanes& factor, const VecLanes& vector) {
  VecLanes scaled;
  for (int a = 0; a < dim; ++a) scaled[a] = factor * vector[a];
  return scaled;
}

TORYU_INLINE Lanes dot(const VecLanes& a, const VecLanes& b) {
  Lanes sum = a[0] * b[0];
  for (int k = 1; k < dim; ++k) sum += a[k] * b[k];
  return sum;
}

/// Puts values into a new order: element k becomes what stood at order[k]. The padding repeats the last one,
/// so that idle lanes hold finite values.
template <class T, class Allocator, class Order>
void reorder(std::vector<T, Allocator>& values, const Order& order, std::vector<T, Allocator>& scratch) {
  scratch.reserve(values.capacity());
  scratch.resize(values.size());
  for (std::size_t k = 0; k < order.size(); ++k) scratch[k] = values[order[k]];
  if (!order.empty())
    for (std::size_t k = order.size(); k < scratch.size(); ++k) scratch[k] = scratch[order.size() - 1];
  values.swap(scratch);
}

}  // namespace toryu
