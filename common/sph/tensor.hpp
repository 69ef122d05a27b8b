/// Tensors of the plane, of numbers or of lanes.
#pragma once

#include <array>

#include "common/sph/lanes.hpp"

namespace toryu {

/// xx, xy, yx, yy.
template <class T>
using Tensor = std::array<T, 4>;

template <class T>
Tensor<T> product(const Tensor<T>& a, const Tensor<T>& b) {
  return {a[0] * b[0] + a[1] * b[2], a[0] * b[1] + a[1] * b[3], a[2] * b[0] + a[3] * b[2],
          a[2] * b[1] + a[3] * b[3]};
}

/// A symmetric tensor.
template <class T>
struct Symmetric {
  T xx, yy, xy;
  Tensor<T> full() const { return {xx, xy, xy, yy}; }
};

inline Tensor<Lanes> load(const Tensor<Field>& field, std::size_t first) {
  return {load(field[0], first), load(field[1], first), load(field[2], first), load(field[3], first)};
}
inline void store(const Tensor<Lanes>& value, Tensor<Field>& field, std::size_t first) {
  for (std::size_t n = 0; n < value.size(); ++n) store(value[n], field[n], first);
}
inline void resize(Tensor<Field>& field, std::size_t size) {
  for (auto& component : field) component.resize(size, 0.0);
}

inline Symmetric<Lanes> load(const Symmetric<Field>& field, std::size_t first) {
  return {load(field.xx, first), load(field.yy, first), load(field.xy, first)};
}
inline void store(const Symmetric<Lanes>& value, Symmetric<Field>& field, std::size_t first) {
  store(value.xx, field.xx, first);
  store(value.yy, field.yy, first);
  store(value.xy, field.xy, first);
}
inline void resize(Symmetric<Field>& field, std::size_t size) {
  for (auto* component : {&field.xx, &field.yy, &field.xy}) component->resize(size, 0.0);
}

}  // namespace toryu
