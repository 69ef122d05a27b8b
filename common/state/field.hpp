/// Fields of particles, declared once: a field knows what it is called, its unit and what it is to a time
/// step. What a solver does with all of its fields (allocate, sort, write to a checkpoint) it does by walking
/// over them, so that a new field is one line where it is declared and one name where the fields are listed;
/// that list does not compile while a name is missing.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "common/sph/points.hpp"

namespace toryu {

/// What a field is to a time step.
///
///     state     advances with the time, or is kept from the step before: sorted, and part of a checkpoint
///     derived   found anew from the state before anything reads it: neither
enum class FieldKind { state, derived };

/// When a field is there.
enum class Presence { always, on_demand };

/// Values of the particles (a Field, VecField or TensorField) that know what they are.
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

}  // namespace toryu
