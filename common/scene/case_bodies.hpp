/// The bodies that a case speaks of, whoever owns them: walls, regions of the fluid and of the solid, clamps.
#pragma once

#include <string>
#include <vector>

#include "common/scene/meeting.hpp"
#include "common/scene/scene.hpp"

namespace toryu {

struct Body {
  std::string name;  ///< as a sentence calls it
  std::string key;   ///< of its shape in the case file
  Part part;
  const Motion* motion = nullptr;
  bool travels = false;  ///< between the stops of a press
};

/// What a clamp holds of a region.
struct Held : Body {
  std::size_t clamp = 0;  ///< in the list of clamps
};

/// Bodies whose shape is sound: of others their owners tell what is wrong. Motions are those of the scene.
struct CaseBodies {
  CaseBodies(const CaseFile& file, const Scene& scene);

  std::vector<Body> walls;
  std::vector<Body> swept;         ///< walls; where a press moves them, with all that they can sweep over
  std::vector<Body> fluid, solid;  ///< regions less holes
  std::vector<Body> free;          ///< regions of the solid less its clamps
  std::vector<Held> held;          ///< with the motion that the clamp names, if any
};

}  // namespace toryu
