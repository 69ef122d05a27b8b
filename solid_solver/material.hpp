/// The linear elastic constants of the solid and what follows from them.
#pragma once

#include <cmath>

namespace toryu::solid {

/// Isotropic and linear; in plane strain the strain across the plane is zero, the stress is not.
struct ElasticMaterial {
  double density;         ///< of the unloaded solid [kg/m3]
  double youngs_modulus;  ///< [Pa]
  double poissons_ratio;  ///< below 0.5

  double bulk_modulus() const { return youngs_modulus / (3.0 * (1.0 - 2.0 * poissons_ratio)); }  // [Pa]
  double shear_modulus() const { return youngs_modulus / (2.0 * (1.0 + poissons_ratio)); }       // [Pa]
  /// Lame's first constant [Pa].
  double lame_lambda() const { return bulk_modulus() - 2.0 / 3.0 * shear_modulus(); }
  /// Speed of waves that change the volume only [m/s]: the c of the artificial viscosity.
  double bulk_sound_speed() const { return std::sqrt(bulk_modulus() / density); }
  /// Speed of longitudinal waves [m/s]: the fastest, which rules the time step.
  double longitudinal_sound_speed() const {
    return std::sqrt((bulk_modulus() + 4.0 / 3.0 * shear_modulus()) / density);
  }
};

}  // namespace toryu::solid
