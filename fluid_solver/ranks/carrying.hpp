/// Particles on their way from rank to rank, with all of their state.
#pragma once

#include <cstdint>
#include <vector>

#include "fluid_solver/particles.hpp"

namespace toryu::fluid {

/// The particles at `places`, with a field `beside` those of the fluid if there is one, and their places in
/// the whole fluid. Nothing for none.
std::vector<double> packed_particles(Particles& fluid, const VecField* beside,
                                     const std::vector<std::uint32_t>& places,
                                     const std::vector<std::uint32_t>& place_in_whole);

/// Where particles are in the fluid that they have joined.
struct Joined {
  std::vector<std::uint32_t> kept = {};
  std::vector<std::vector<std::uint32_t>> received = {};  ///< by rank, in the order in which it sent them
};

/// The particles `kept`, which are in the order of the whole fluid, and those of the messages of all ranks
/// become the fluid of this one, in that order.
Joined join(Particles& fluid, VecField* beside, const std::vector<std::uint32_t>& kept,
            const std::vector<std::vector<double>>& messages, std::vector<std::uint32_t>& place_in_whole);

}  // namespace toryu::fluid
