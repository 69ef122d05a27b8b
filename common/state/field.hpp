/// Fields of particles, declared once: a field knows what it is called, its unit and what it is to a time
/// step. What a solver does with all of its fields (allocate, sort, write to a checkpoint) it does by walking
/// over them, so that a new field is one line where it is declared and one name where the members of its
/// struct are listed. That list is the struct's `serialize` (serialize.hpp), which does not compile while a
/// name is missing:
///
///     struct Particles {
///       Declared<VecField> x{"position", "m", FieldKind::state};
///       Declared<Field> p{"pressure", "Pa", FieldKind::derived};
///     };
///     template <class Archive>
///     void serialize(Archive& archive, Particles& particles) {
///       auto& [x, p] = particles;
///       archive(x, p);
///     }
#pragma once

#include <cstddef>
#include <type_traits>
#include <vector>

#include "common/sph/points.hpp"
#include "common/sph/tensor.hpp"

namespace toryu {

/// What a field is to a time step.
///
///     state     advances with the time, or is kept from the step before: sorted, and part of a checkpoint
///     derived   found anew from the state, after sorting and reading too: neither
enum class FieldKind { state, derived };

/// When a field is there: in every run, or where it is resized because a term needs it, else without values.
enum class Presence { always, on_demand };

/// Values of the particles (a Field, or an array or tensor of Fields) that know what they are.
template <class Values>
struct Declared : Values {
  Declared(const char* field_name, const char* field_unit, FieldKind field_kind,
           Presence field_presence = Presence::always)
      : name(field_name), unit(field_unit), kind(field_kind), presence(field_presence) {}
  using Values::operator=;
  const char* name;
  const char* unit;
  FieldKind kind;
  Presence presence;
};

template <class T>
inline constexpr bool is_declared_field = false;
template <class Values>
inline constexpr bool is_declared_field<Declared<Values>> = true;

/// Calls visit(field) for each declared field among the members of `state`, in the order of its `serialize`.
/// Members that are structs themselves are not entered: their particles may be others.
template <class State, class Visit>
void for_each_field(State& state, Visit&& visit) {
  const auto visit_field = [&](auto& member) {
    if constexpr (is_declared_field<std::remove_reference_t<decltype(member)>>) visit(member);
  };
  const auto walk = [&](auto&... members) { (visit_field(members), ...); };
  serialize(walk, state);
}

/// Calls visit(component) for each plain Field that `values` consist of.
template <class Visit>
void for_each_component(Field& values, Visit&& visit) {
  visit(values);
}
template <class Visit>
void for_each_component(Symmetric<Field>& values, Visit&& visit) {
  for (Field* component : {&values.xx, &values.yy, &values.xy}) visit(*component);
}
template <class Part, std::size_t count, class Visit>
void for_each_component(std::array<Part, count>& values, Visit&& visit) {
  for (Part& part : values) for_each_component(part, visit);
}

/// Out of line: inlined for each of many fields, it took half of the time that some files take to compile.
[[gnu::noinline]] inline void resize_field(Field& values, std::size_t size) {
  values.reserve(size);  // no more: a vector that grows by itself takes up to twice as much
  values.resize(size, 0.0);
}

/// Gives the fields that are always there `size` values each; new ones are 0.
template <class State>
void resize_fields(State& state, std::size_t size) {
  for_each_field(state, [&](auto& field) {
    if (field.presence == Presence::always)
      for_each_component(field, [&](Field& component) { resize_field(component, size); });
  });
}

/// Gives the fields that are there `size` values each; new ones are 0.
template <class State>
void resize_present_fields(State& state, std::size_t size) {
  for_each_field(state, [&](auto& field) {
    for_each_component(field, [&](Field& component) {
      if (!component.empty()) resize_field(component, size);
    });
  });
}

/// Sorts the `state` fields that are there: element k becomes what stood at order[k], as by `reorder`.
template <class State, class Order>
void reorder_fields(State& state, const Order& order) {
  Field scratch;
  for_each_field(state, [&](auto& field) {
    if (field.kind == FieldKind::state)
      for_each_component(field, [&](Field& component) {
        if (!component.empty()) reorder(component, order, scratch);
      });
  });
}

}  // namespace toryu
