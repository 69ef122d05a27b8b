/// Where two bodies are in one place of which one turns.
#pragma once

#include "common/scene/meeting.hpp"

namespace toryu {

/// Whether two that turn can be looked at: not those with holes, nor outlines that are not convex.
bool can_turn_with(const Pair& pair);

/// Whether the circles that hold the two ever overlap.
bool may_meet_turning(const Pair& pair, double tolerance, double end_time);

/// As `first_meeting`, of convex outlines without holes, looked at whenever either may have moved by
/// `tolerance` [m]; of long runs at a hundred thousand times. What is round counts as the polygon in it.
std::optional<Meeting> first_turning_meeting(const Pair& pair, double tolerance, double end_time);

}  // namespace toryu
