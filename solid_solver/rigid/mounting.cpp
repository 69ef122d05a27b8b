#include "solid_solver/rigid/mounting.hpp"

#include <algorithm>

namespace toryu::solid {

bool Mounting::is_fixed(int coordinate) const {
  return std::find(fixed.begin(), fixed.end(), coordinate_names[coordinate]) != fixed.end();
}

void describe(ParameterTable& table, Mounting& m) {
  table.texts("fixed", m.fixed,
              {.help = "what stays as it is; a velocity at the start is left out there",
               .allowed = coordinate_names});
  if (table.wants(m.has_pivot()))
    table.vector(
        "pivot", m.pivot,
        {.unit = "m", .help = "the point that stays where x and y are fixed; absent: the centre of mass"});
  table.vector("stiffness", m.stiffness,
               {.unit = "N/m2", .minimum = 0, .help = "of springs along x and y, per metre of depth"});
  table.vector("damping", m.damping,
               {.unit = "N.s/m2", .minimum = 0, .help = "of dampers along x and y, per metre of depth"});
  table.vector("rest", m.rest, {.unit = "m", .help = "displacement at which these springs bear nothing"});
  table.number("angular_stiffness", m.angular_stiffness,
               {.unit = "N/rad", .minimum = 0, .help = "moment by angle, per metre of depth"});
  table.number("angular_damping", m.angular_damping,
               {.unit = "N.s/rad", .minimum = 0, .help = "moment by angular velocity, per metre of depth"});
  table.number("rest_angle", m.rest_angle,
               {.unit = "rad", .help = "at which the spring that turns bears nothing"});
  table.require(!m.has_pivot() || (m.is_fixed(0) && m.is_fixed(1)), "pivot",
                "a 'pivot' in [solid.mounting] stays: it needs fixed = [\"x\", \"y\"]");
  const Coordinates k = m.stiffnesses(), c = m.dampings();
  for (int n = 0; n <= dim; ++n)
    table.require(!m.is_fixed(n) || (k[n] == 0 && c[n] == 0), "fixed",
                  "in [solid.mounting] neither a spring nor a damper acts on '" + coordinate_names[n] +
                      "', which is fixed");
}

}  // namespace toryu::solid
