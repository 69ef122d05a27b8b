/// Places in the whole fluid, found by all ranks together.
#pragma once

#include <mpi.h>

#include <cstdint>
#include <vector>

#include "common/sph/strip_order.hpp"
#include "fluid_solver/particles.hpp"

namespace toryu::fluid {

/// `place_in_whole` of the `own` particles of each rank becomes that in the whole fluid, as `strips` sort it.
/// Sorting keeps the order of ties, so it must tell the places before. Those of a rank are in that order.
void number(MPI_Comm communicator, const Particles& fluid, const StripOrder& strips,
            const std::vector<std::uint32_t>& own, std::vector<std::uint32_t>& place_in_whole);

}  // namespace toryu::fluid
