/// Open ends of channels: fluid comes in with a velocity and leaves against a pressure.
///
/// Beyond the line of an end lies a layer of particles that are fluid to all sums over pairs, but that do not
/// answer to them: they move at right angles to the line, and what they show follows from the fluid before it
/// (Lastiwka, Basa & Quinlan 2009; Tafuni, Dominguez, Vacondio & Crespo 2018). With s into the fluid and u
/// the velocity along s, means over the channel's width of the particles nearer than the kernel's support
/// give p(s) = p_0 + g s by a fit, and u_0. Of an inlet with the given velocity U(y, t), and of an outlet
/// with the given pressure P(t),
///
///     a = (p_0 - P)/(2 rho c) - (u_0 - U)/2,     a' = a - A,     dA/dt = K a',     K = c/(4 L)
///     inlet:   u = U(y) - a'(s),                      p = p_0 + g s + rho c [a'(s) - a']
///     outlet:  u = u_0(y) + a' - a'(s),               p = P + g s + rho c a'(s)
///
/// P of an inlet is rho c [U(t) - U(t - L/c)], the pressure that accelerates a channel of the length L, and
/// -U of an outlet the discharge of all inlets over the width of all outlets: so a ramp is no wave. u_0(y) is
/// found row by row. a is the wave of sound that runs out through the line, and a'(s) what it was when it
/// passed the place of the means, a time -s/c and more ago: the layer carries it on. What is fast in it, a',
/// leaves: the end answers as if the channel went on. What is slow is held: the velocity of the inlet and the
/// pressure of the outlet are those that are given, within some 1/K (Rudy & Strikwerda 1980; Poinsot & Lele
/// 1992). Of a pulse of length l some l/(4 L) comes back, L the length of the fluid along s, and what the
/// means miss of one of few spacings: in all 4 % of one of 8 spacings and a tenth of L
/// (tests/validation/open_channel_test.cpp). A mean over the width is what tells sound from flow: of a flow
/// it is the discharge, which eddies that leave do not change. g is held over 1/K, too.
///
/// Whoever crosses the line changes sides when the lists of neighbours are built, and no earlier. Rows of a
/// layer that run inward are filled up then: a new particle comes a spacing behind the last one, as soon as
/// there is room before the far end of the layer. Who passes the far end is taken away.
///
/// What an end does to the fluid is counted so that sums close: with m_j a_j the forces of all pairs on the
/// layer's particles, the fluid gets -sum_j m_j a_j of them, and what crosses brings its momentum. Walls
/// beside a layer push on its particles, too: their force contains that, and the end's takes it away.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/run/solver.hpp"
#include "fluid_solver/open_ends/section.hpp"
#include "fluid_solver/particles.hpp"
#include "fluid_solver/terms/equation_of_state.hpp"

namespace toryu::fluid {

/// Means over the line, of the fluid before it.
struct SectionMeans {
  double pressure = 0, gradient = 0;  ///< p_0 above the background [Pa], its slope g [Pa/m]
  double place = 0;                   ///< of who is in the mean [m]
  double velocity = 0;                ///< u_0, into the fluid [m/s]
};

/// The line y(x) = mean + slope (x - mean of x) through weighted values.
struct LineSums {
  double w = 0, x = 0, x2 = 0, y = 0, xy = 0;
  void add(double w_i, double x_i, double y_i) {
    w += w_i, x += w_i * x_i, x2 += w_i * x_i * x_i, y += w_i * y_i, xy += w_i * x_i * y_i;
  }
  double mean() const { return w > 0 ? y / w : 0; }
  double mean_x() const { return w > 0 ? x / w : 0; }
  /// 0 where the mean square of x about its mean is no more than `least_spread`.
  double slope(double least_spread) const {
    if (w == 0) return 0;
    const double spread = x2 / w - mean_x() * mean_x();
    return spread > least_spread ? (xy / w - mean_x() * mean()) / spread : 0;
  }
  double at(double x_0, double least_spread) const { return mean() + slope(least_spread) * (x_0 - mean_x()); }
};

/// a' at a time.
struct PassingWave {
  double time = 0, wave = 0;  ///< [s], [m/s]
};
template <class Archive>
void serialize(Archive& archive, PassingWave& passing) {
  auto& [time, wave] = passing;
  archive(time, wave);
}

class OpenEnds {
 public:
  /// What is known of one end at a time.
  struct State {
    bool begun = false;                     ///< whether A and g are there
    double slow_wave = 0;                   ///< A [m/s]
    double gradient = 0;                    ///< g [Pa/m]
    SectionMeans means = {};                ///< of the last evaluation
    double wave = 0;                        ///< a of it [m/s]
    std::vector<PassingWave> passing = {};  ///< for as long as it crosses the layer
    Vec force = Vec::Zero();                ///< sum_j m_j a_j of it without gravity [N per metre]
    double power = 0, pressure_power = 0;   ///< which that is, and what compression takes [W per metre]
    double layer_mass = 0;                  ///< [kg per metre]
    // since the start, into the fluid
    double mass = 0, work = 0;  ///< [kg per metre], [J per metre]
    Vec impulse = Vec::Zero();  ///< [N.s per metre]
  };
  /// Parameters without the layers.
  OpenEnds(const Parameters& parameters, const EquationOfState& equation_of_state);

  /// Says of each particle of a fluid that has been filled whether it is in a layer.
  void assign_layers(Particles& fluid);
  /// Lets those change sides who have crossed, new ones in and old ones out. `energy(k)` is that of particle
  /// k over its mass [m2/s2]. To be called before lists are built, and `find` after that.
  template <class EnergyOf>
  void exchange(Particles& fluid, EnergyOf&& energy) {
    find_crossings(fluid);
    for (const Crossing& crossing : crossings_) {
      State& state = state_[crossing.end];
      const double mass = crossing.sign * fluid.m[crossing.particle];
      state.mass += mass;
      state.impulse += mass * at(fluid.v, crossing.particle);
      state.work += mass * energy(crossing.particle);
    }
    rearrange(fluid);
  }
  /// Finds who is in each layer and near each line.
  void find(const Particles& fluid);
  /// Gives the layers their velocity and density at `time` [s], with the gravity of then [m/s2].
  void impose(Particles& fluid, double time, const Vec& gravity);
  /// Notes what pairs did to the layers in the evaluation that is just done, and takes it from them.
  void take_rates(Particles& fluid, bool velocity, bool density);
  /// Has `off_surface` 0 in the layers, so that what moves or corrects particles leaves them as they are.
  void exclude_from_corrections(Particles& fluid) const;
  /// Counts it for a step of `dt` [s].
  void count(double dt);

  std::size_t size() const { return sections_.size(); }
  const std::string& name(std::size_t end) const { return names_[end]; }
  const Section& section(std::size_t end) const { return sections_[end]; }
  const State& state(std::size_t end) const { return state_[end]; }
  bool is_inlet(std::size_t end) const { return end < inlets_.size(); }
  double layer_mass() const;
  /// Columns of an end.
  std::vector<Observation> observe(std::size_t end) const;
  /// Which of `points` is the first in a layer, if any is.
  std::optional<Vec> first_in_layer(const std::vector<Vec>& points) const;

  template <class Archive>
  friend void serialize(Archive& archive, OpenEnds& ends) {
    archive(ends.state_, ends.next_id_);
  }

 private:
  struct Crossing {
    std::uint32_t particle;
    std::size_t end;
    double sign;  ///< 1 into the fluid
  };
  struct New {
    std::uint32_t like;  ///< among those that are kept, whose state it has
    std::size_t end;
    Vec place;  ///< [m]
  };
  struct Last {
    bool there = false;
    std::uint32_t kept = 0;
    double distance = 0;  ///< [m]
  };
  void find_crossings(const Particles& fluid);
  void find_new(const Particles& fluid);
  void rearrange(Particles& fluid);
  SectionMeans means(const Particles& fluid, std::size_t end) const;
  void note_passing(std::size_t end, double time, double wave);
  void find_velocities(const Particles& fluid, std::size_t end);
  double velocity_before(std::size_t end, double place) const;
  /// The pressure that gravity adds across the channel, from its middle to `x` [Pa].
  double weight_across(std::size_t end, const Vec& x) const;
  double expected_pressure(std::size_t end, double time) const;
  double given_mean(std::size_t end, double time) const;

  std::vector<Section> sections_;
  std::vector<std::string> names_;
  std::vector<Inlet> inlets_;
  std::vector<Outlet> outlets_;
  std::vector<double> transits_;  ///< L/c of each [s]
  EquationOfState equation_of_state_;
  Vec gravity_ = Vec::Zero();  ///< as the layers were imposed last
  double support_, skin_, spacing_;

  std::vector<State> state_;
  std::uint32_t next_id_ = 0;
  // by end, as found
  std::vector<std::vector<std::uint32_t>> layer_, near_;
  std::vector<std::vector<double>> velocities_;  ///< before the middle of each row of the line [m/s]
  // kept for their memory
  std::vector<LineSums> sums_;
  std::vector<Crossing> crossings_;
  std::vector<New> new_;
  std::vector<Last> last_;  ///< of the rows of an end
  std::vector<std::uint32_t> kept_;
  std::vector<double> cell_;  ///< area of a new particle [m2]
};

template <class Archive>
void serialize(Archive& archive, OpenEnds::State& state) {
  auto& [begun, slow_wave, gradient, means, wave, passing, force, power, pressure_power, layer_mass, mass,
         work, impulse] = state;
  archive(begun, slow_wave, gradient, means.pressure, means.gradient, means.place, means.velocity, wave,
          passing, force, power, pressure_power, layer_mass, mass, work, impulse);
}

}  // namespace toryu::fluid
