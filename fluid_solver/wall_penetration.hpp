/// Particles of the fluid that are inside a wall or the solid. A place is inside where the particles of the
/// boundary fill it, sum_w V_w W(r_w) over 0.75 with a kernel as narrow as their spacing d_w: 0.5 on a face,
/// 0.75 some 0.4 d_w below it, 0.2 where the first row of the fluid stands, 0.3 in a corner.
#pragma once

#include <vector>

#include "fluid_solver/boundary.hpp"
#include "fluid_solver/ranks/ranks.hpp"

namespace toryu::fluid {

struct Penetration {
  std::size_t count = 0;
  std::string boundary = {};  ///< and where the first of them is: of the boundary with most
  Vec place = Vec::Zero();    ///< [m]
};

template <class Archive>
void serialize(Archive& archive, Penetration& found) {
  auto& [count, boundary, place] = found;
  archive(count, boundary, place);
}

/// Needs the lists of the boundaries; none is found before they are built. Of a part of a fluid over `ranks`
/// rank 0 finds what is in the walls of the whole.
Penetration penetration(const Particles& fluid, const std::vector<Boundary>& boundaries,
                        const Ranks* ranks = nullptr);

}  // namespace toryu::fluid
