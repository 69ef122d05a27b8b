/// Where the open ends of channels lie: the line across the channel, and the layer of particles beyond it.
#pragma once

#include <optional>
#include <vector>

#include "common/scene/meeting.hpp"
#include "fluid_solver/parameters.hpp"
#include "fluid_solver/start_checks.hpp"

namespace toryu::fluid {

/// The line of an open end, as seen from the fluid.
struct Section {
  Vec origin = Vec::Zero();                         ///< its end `from` [m]
  Vec along = Vec::UnitX(), inward = Vec::UnitY();  ///< unit vectors: to the other end, into the fluid
  double length = 0, depth = 0;                     ///< of the line, and of the layer beyond it [m]

  double distance(const Vec& x) const { return inward.dot(x - origin); }  ///< below 0: beyond the line [m]
  double place(const Vec& x) const { return along.dot(x - origin); }      ///< from `from` [m]
  bool spans(const Vec& x) const { return place(x) >= 0 && place(x) < length; }
  Vec point(double place, double distance) const { return origin + place * along + distance * inward; }
  Box layer() const;
};

/// How deep the layers are [m]: twice as far as lists of neighbours reach, so that whoever is seen from the
/// fluid has all of its own neighbours.
double layer_depth(const Parameters& parameters);

/// None where there is fluid on neither side of the line, or on both.
std::optional<Section> section_of(const OpenEnd& end, const Parameters& parameters);

/// Those of all ends that have one, inlets first.
std::vector<Section> sections_of(const Parameters& parameters);

/// Fills the layers too: as regions behind those of the case.
Parameters with_layers(Parameters parameters);

/// What does not go with open ends, and lines that are misplaced; `solid` are the bodies of a coupled case.
std::vector<StartFault> open_end_faults(const Parameters& parameters, const Scene& scene,
                                        const std::vector<Part>& solid = {});

/// A sentence for each inlet whose mean speed at the start is another than that of the fluid before it by
/// more than a hundredth of the sound speed.
std::vector<std::string> abrupt_inlets(const Parameters& parameters);

}  // namespace toryu::fluid
