/// Motion from nowhere. Terms without a potential (artificial stress, the rates of an updated Lagrangian
/// form) and steps that are too long can feed a body energy for ever, while its bonds and all its values look
/// whole.
#pragma once

namespace toryu::solid {

struct EnergyWatch {
  double most = 0;          ///< kinetic energy, at any check [J per metre depth]
  double largest_gain = 0;  ///< of the most, at any check
  double warned = 0;        ///< of this gain

  /// The body moves with `kinetic` [J per metre depth]; `given` is what it started with and what loads and
  /// the fluid have given it since: all that it could have in motion if it held nothing by deformation. Warns
  /// in the log when it has more, by 2 % of the most that it has had, and whenever that has doubled. A body
  /// that never had more than `rounding` is at rest: what it seems to gain is the rounding of its positions.
  void warn_of_gain(double kinetic, double given, double rounding, double time);
};
template <class Archive>
void serialize(Archive& archive, EnergyWatch& watch) {
  auto& [most, largest_gain, warned] = watch;
  archive(most, largest_gain, warned);
}

}  // namespace toryu::solid
