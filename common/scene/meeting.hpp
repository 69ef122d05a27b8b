/// Where two bodies are in one place, at rest and as rigid bodies move by prescription.
#pragma once

#include <optional>
#include <vector>

#include "common/scene/scene.hpp"

namespace toryu {

/// What lies in all boxes of `within` and in none of `without`. Two of them joined are what both share.
struct Part {
  std::vector<Box> within, without;
};

/// The box that holds a part; its corners are out of order if there is nothing.
Box bounds_of(const Part& part);

/// A place that a part has, if it is more than `tolerance` [m] wide there. Where boxes are round, one that is
/// narrower than a 32nd of its extent may be missed; along outlines, one that is shorter than a 32nd of an
/// edge.
std::optional<Vec> place_in(const Part& part, double tolerance);

struct Meeting {
  double time;  ///< [s]
  Vec place;    ///< [m]
};

/// Two parts of rigid bodies; without a motion they stand still.
struct Pair {
  const Part &a, &b;
  const Motion *motion_a = nullptr, *motion_b = nullptr;
};

/// When and where the two first share more than `tolerance` [m], from t = 0 to `end_time` [s]. `period` [m]:
/// after which space repeats itself along each axis; 0: never. Of two of which one turns and one has holes
/// or is not convex, only how they lie at the start is looked at.
std::optional<Meeting> first_meeting(const Pair& pair, double tolerance, double end_time, const Vec& period);

}  // namespace toryu
