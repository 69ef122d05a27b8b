/// The bodies of a case as all participants see them: which of them are in one place.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/scene/scene.hpp"

namespace toryu {

/// Adds a fault of `file` for each two bodies of the case (fluid, solid, walls, clamps) that overlap at the
/// start, but for those that the fluid leaves out by itself, and for each wall that runs into another or into
/// a clamp by the end of the run. Bodies may touch. A clamp may lie in a wall, which is what holds it: it
/// moves as the wall does. Looks into [fluid] and [solid] wherever their shapes are sound: what else is wrong
/// there their owners tell.
void check_bodies(CaseFile& file, const Scene& scene);

/// The walls and regions of the solid that the fluid leaves out by itself at the start: all that are given by
/// an outline. Boxes it must be told to leave out, by a [[fluid.hole]], so that a slip of the pen is seen.
std::vector<Box> left_out_of_fluid(const CaseFile& file, const Scene& scene);

/// How each [[solid.clamp]] moves: as the [[motion]] that it names, or as the wall that holds it.
std::vector<std::optional<Motion>> clamp_motions(const CaseFile& file, const Scene& scene);

/// A line for each motion of walls and clamps until the end of the run: how far, how fast, with which
/// acceleration.
std::vector<std::string> motion_lines(const CaseFile& file, const Scene& scene);

/// A sentence for each region of the fluid that stands off a wall or the solid by less than a spacing: it
/// does not rest on what it seems to touch.
std::vector<std::string> gap_warnings(const CaseFile& file, const Scene& scene);

/// A sentence for each two walls of which one turns and which are too intricate for `check_bodies`.
std::vector<std::string> unknown_meetings(const CaseFile& file, const Scene& scene);

/// A sentence for each wall that comes to where the solid is at the start while nothing makes them touch. Of
/// one that turns it says that this is not looked at.
std::vector<std::string> passage_warnings(const CaseFile& file, const Scene& scene);

}  // namespace toryu
