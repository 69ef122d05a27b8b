#include "fluid_solver/implicit/implicit_twin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "fluid_solver/implicit/implicit_faults.hpp"

namespace toryu::fluid {

namespace {

/// Largest over mean speed between plates, of a Newtonian medium.
constexpr double peak_share = 1.5;

/// Of a medium between pistons that are pressed. What drives it is the force of the presses; where walls move
/// as prescribed it is what they do to the medium while it does not yet yield, some ten times as much. The
/// drop of cases/abrasive_throat/implicit_pressed.toml changes by 0.1 % from 1e-5 to 1e-2.
constexpr double tolerance_of_pressed = 1e-3;

/// Of the pressure drop. Presses hold the mean, so that the outlet has half of the drop less than this, and
/// single pressures swing by a fifth of it: by 0.65 what is behind the throat of that case pairs.
constexpr double background_of_pressed = 0.8;

}  // namespace

std::optional<Parameters> implicit_twin(const Parameters& as_read, const Scene& scene) {
  if (!as_read.similarity || scene.geometry != Geometry::plane) return {};
  const SimilarMedium similar = similar_medium(as_read);
  Parameters twin = as_read;
  twin.model = Model::implicit;
  twin.similarity.reset();
  twin.density_diffusion.reset();
  twin.time_step_share = 2;
  twin.implicit = ImplicitSolver{.expected_speed = peak_share * as_read.similarity->mean_speed};
  const bool is_pressed =
      std::any_of(scene.walls.begin(), scene.walls.end(), [](const Wall& wall) { return wall.press; });
  if (is_pressed) twin.implicit->tolerance = tolerance_of_pressed;
  twin.sound_speed = similar.sound_speed * std::sqrt(similar.density / as_read.density);
  if (!twin.background_pressure)
    twin.background_pressure =
        is_pressed ? BackgroundPressure{.pressure = background_of_pressed * similar.pressure_drop}
                   : similar_background(similar);
  if (!implicit_faults(twin, scene, false).empty()) return {};
  return twin;
}

std::string keys_of_twin(const Parameters& twin) {
  return fmt::format(
      "model = \"implicit\", similarity = false, sound_speed = {:.4g}, background_pressure = {{ pressure = "
      "{:.4g} }}, kernel = \"{}\", smoothing_ratio = {:g}, time_step_share = {:g}, implicit = {{ "
      "expected_speed = {:.4g}, tolerance = {:g} }}",
      twin.sound_speed, twin.background_pressure->pressure,
      twin.kernel == KernelForm::wendland_c2 ? "wendland_c2" : "cubic_spline", twin.smoothing_ratio,
      twin.time_step_share, twin.implicit->expected_speed, twin.implicit->tolerance);
}

}  // namespace toryu::fluid
