/// Motion from nowhere. Terms without a potential (artificial stress, the rates of an updated Lagrangian
/// form) and steps that are too long can feed a body energy for ever, while its bonds and all its values look
/// whole.
#pragma once

namespace toryu::solid {

class EnergyWatch {
 public:
  /// The body moves with `kinetic` [J per metre depth]; `given` is what it started with and what loads and
  /// the fluid have given it since: all that it could have in motion if it held nothing by deformation. Warns
  /// in the log when it has more, by 2 % of the most that it has had, and whenever that has doubled.
  void look(double kinetic, double given, double time);
  /// Of the most that it has had, at any look.
  double largest_gain() const { return largest_gain_; }

 private:
  double most_ = 0, largest_gain_ = 0, told_ = 0;
};

}  // namespace toryu::solid
