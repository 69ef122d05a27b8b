/// The overrides of `--set`.
///
///     --set fluid.sound_speed=30                   a number, text, flag, list or table, as in the file
///     --set case.title=Gate                        what is not a TOML value is text
///     --set fluid.laminar_viscosity.dynamic_viscosity=1e-3     creates the section, so switches the term on
///     --set fluid.laminar_viscosity=false          takes an optional section away
///     --set wall.0.box.max=[1,2]                   an item of a list by its number, from 0
///     --set fluid.region.water.box.max=[1,2]       or by its name
#pragma once

#include <optional>
#include <string>

#include "common/case/document.hpp"

namespace toryu {

/// Writes one override ("key=value") into `root`, or says what is wrong with it.
std::optional<InputError> apply_override(toml::table& root, const std::string& text);

}  // namespace toryu
