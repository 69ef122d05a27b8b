// A solid in space that repeats itself. Places and spacings are binary fractions, so that a body that is
// moved is the same body to the last bit.
#include <cmath>
#include <functional>
#include <map>

#include "common/scene/outline.hpp"
#include "samples.hpp"
#include "solid_solver/periodic_space.hpp"

namespace toryu::solid {
namespace periodic_test {

constexpr double d_0 = 1.0 / 64, length = 16 * d_0, thickness = 8 * d_0;

Scene repeating(Periodic periodic = Periodic::x) {
  Scene scene;
  scene.domain = {Vec(0, -1), Vec(length, 1)};
  scene.periodic = periodic;
  return scene;
}

/// A plate from x = `begin` to `end`, in two halves.
Parameters plate(double begin, double end) {
  Parameters p = free_plate(4);
  p.spacing = d_0;
  const double middle = 0.5 * (begin + end);
  p.regions = {{"left", {Vec(begin, 0), Vec(middle, thickness)}},
               {"right", {Vec(middle, 0), Vec(end, thickness)}}};
  return p;
}

/// The same, whose halves are thrown at each other and past each other.
Parameters thrown(double begin, double end) {
  Parameters p = plate(begin, end);
  p.regions[0].initial_velocity = InitialVelocity{.velocity = Vec(1, 0.5)};
  p.regions[1].initial_velocity = InitialVelocity{.velocity = Vec(-1, 0)};
  return p;
}

std::unique_ptr<SolidModel> model_in(const Scene& scene, const Parameters& p) {
  const auto fault = [](const std::string& key, const std::string& text) { ADD_FAILURE() << key << text; };
  return make_model(p, build_body(p, fault, Period(scene).shifts()), scene);
}

std::vector<Vec> displacements(const SolidModel& model) {
  std::vector<Vec> u;
  for (std::size_t i = 0; i < model.particle_count(); ++i) u.push_back(model.displacement(i));
  return u;
}

double largest(const std::vector<Vec>& u) {
  double found = 0;
  for (const Vec& u_i : u) found = std::max(found, u_i.norm());
  return found;
}

double largest_difference(const std::vector<Vec>& u, const std::vector<Vec>& w) {
  double found = 0;
  for (std::size_t i = 0; i < u.size(); ++i) found = std::max(found, (u[i] - w[i]).norm());
  return found;
}

TEST(PeriodicSolid, DoesNotKnowWhereTheSeamIs) {
  // Lists are in another order, so sums differ in their last bits, some 1e-16 of the stress a step. The limit
  // of the step is an estimate that depends on the order more than that: so the step is given.
  const auto run = [](Periodic periodic, double begin) {
    auto model = model_in(repeating(periodic), thrown(begin, begin + length));
    for (int n = 0; n < 200; ++n) model->advance(1e-4);
    return displacements(*model);
  };
  const auto here = run(Periodic::x, 0), there = run(Periodic::x, 4 * d_0), ends = run(Periodic::none, 0);
  EXPECT_GT(largest(here), 1e-3);
  EXPECT_LT(largest_difference(here, there), 1e-12 * largest(here));
  EXPECT_GT(largest_difference(here, ends), 0.1 * largest(here)) << "a plate with ends moves otherwise";
}

TEST(PeriodicSolid, KeepsItsMomentumAndEnergy) {
  Parameters p = thrown(0, length);
  p.time_step_share = 0.1;  // the jump has all frequencies
  const auto model = model_in(repeating(), p);
  const double x = observed(*model, "momentum_x"), y = observed(*model, "momentum_y"),
               start = observed(*model, "kinetic_energy");
  run_to(*model, 0.02);
  EXPECT_NEAR(observed(*model, "momentum_x"), x, 1e-12 * y);
  EXPECT_NEAR(observed(*model, "momentum_y"), y, 1e-12 * y);
  EXPECT_LT(std::abs(observed(*model, "dissipated_energy")), 2e-3 * start) << "of the leapfrog's steps";
}

TEST(PeriodicSolid, OfAPlateWithoutEndsShearsUnderItsWeight) {
  // G u'' = -rho g, u = 0 on the clamp's face and u' = 0 at the top: u = rho g/G (h y - y^2/2)
  Parameters p = plate(0, length);
  p.clamps = {{"floor", {Vec(-1, -1), Vec(1, d_0)}}};
  p.damping = Damping{.rate = 700};
  Scene scene = repeating();
  scene.gravity = Vec(0.1, 0);  // the strain is so small that its square is nothing
  const auto model = model_in(scene, p);
  run_to(*model, 0.15);
  std::map<double, double> of_row;
  const double h = thickness - d_0, factor = 1000 * 0.1 / p.material.shear_modulus();
  for (std::size_t i = 0; i < model->particle_count(); ++i) {
    const double y = model->body().X[i][1] - d_0;
    const double u = y > 0 ? factor * (h * y - 0.5 * y * y) : 0.0;
    EXPECT_NEAR(model->displacement(i)[0], u, 0.02 * factor * 0.5 * h * h) << y / d_0;
    EXPECT_LT(std::abs(model->displacement(i)[1]), 1e-4 * factor * h * h) << "no row rises";
    const double first = of_row.try_emplace(y, model->displacement(i)[0]).first->second;
    EXPECT_NEAR(model->displacement(i)[0], first, 1e-12 * factor * h * h) << "all of a row move alike";
  }
}

TEST(PeriodicSolid, HasNoFaceWhereItGoesOn) {
  const auto area = [](const Interface& interface) {
    Vec sum = Vec::Zero();
    for (std::size_t n = 0; n < interface.size(); ++n) sum += vector_of(interface.area_vector, n).cwiseAbs();
    return sum;
  };
  EXPECT_LT((area(model_in(repeating(), plate(0, length))->interface(1)) - Vec(0, 2 * length)).norm(), 1e-15);
  EXPECT_LT(
      (area(model_in(repeating(), plate(d_0, length))->interface(1)) - Vec(2 * thickness, 2 * (length - d_0)))
          .norm(),
      1e-15);
  Parameters outlined = plate(0, length);
  for (Region& region : outlined.regions) region.box = box_of(outline_of(region.box));
  EXPECT_LT((area(model_in(repeating(), outlined)->interface(1)) - Vec(0, 2 * length)).norm(), 1e-14);
}

TEST(PeriodicSolid, IsNotJoinedAcrossAGap) {
  const auto run = [](Periodic periodic) {
    auto model = model_in(repeating(periodic), thrown(d_0, length));
    run_to(*model, 0.002);
    return displacements(*model);
  };
  EXPECT_EQ(run(Periodic::x), run(Periodic::none))
      << "bitwise: pairs across a spacing of nothing have no weight";
}

TEST(PeriodicSolid, TravelsOnAndIsShownInTheDomain) {
  Parameters p = plate(0, length);
  p.initial_velocity = InitialVelocity{.velocity = Vec(3, 0)};
  p.bonds = BondLimits{};
  const auto model = model_in(repeating(), p);
  run_to(*model, 0.25);
  model->check(0.25);
  const Frame frame = model->frame();
  for (std::size_t i = 0; i < model->particle_count(); ++i) {
    EXPECT_NEAR(model->displacement(i)[0], 0.75, 1e-12) << "three times round";
    EXPECT_NEAR(frame.positions[dim * i], model->body().X[i][0], 1e-12);
  }
  EXPECT_NEAR(model->motion({0}).position[0], model->body().X[0][0] + 0.75, 1e-12);
  EXPECT_NEAR(observed(*model, "largest_stretch"), 1, 1e-12);
  EXPECT_NEAR(observed(*model, "smallest_stretch"), 1, 1e-12);
}

TEST(PeriodicSolid, KnowsBondsAcrossTheSeam) {
  Parameters p = plate(0, length);
  const Bonds bonds(model_in(repeating(), p)->body(), BondLimits{});
  auto x = model_in(repeating(), p)->body().X;
  for (Vec& x_i : x)
    if (x_i[0] < d_0) x_i[0] -= 0.5 * d_0;
  EXPECT_NEAR(bonds.stretches(x).smallest, 0.5, 1e-12) << "the first column comes nearer to the last";
  EXPECT_NEAR(bonds.stretches(x).largest, 1.5, 1e-12);
}

/// Two blocks of 4 x 4 particles, `begin` [m] the left side of the left one, that fly at each other over a
/// step of the floor below them.
std::vector<Vec> after_contacts(double begin, bool touch) {
  const Vec side = Vec::Constant(4 * d_0);
  const Vec left(begin, 0.5 * d_0), right(begin + 5 * d_0, d_0);
  Parameters p = free_plate(4);
  p.spacing = d_0;
  p.regions = {{"left", {left, left + side}, InitialVelocity{.velocity = Vec(3, -2)}},
               {"right", {right, right + side}, InitialVelocity{.velocity = Vec(-2, -1)}}};
  if (touch) p.wall_contact = p.body_contact = Contact{};
  Scene scene = repeating();
  scene.walls = {{"step", {Vec(begin - d_0, -3 * d_0), Vec(begin + 10 * d_0, 0)}, {}}};
  const auto model = model_in(scene, p);
  double most = 0;
  for (int n = 0; n < 200; ++n) {
    model->advance(1e-4);
    if (touch) most = std::max(most, observed(*model, "contact_energy"));
  }
  if (touch) {
    EXPECT_GT(most, 1e-2);
  }
  return displacements(*model);
}

TEST(PeriodicSolid, TouchesWallsAndBodiesAcrossTheSeam) {
  const auto within = after_contacts(3 * d_0, true), apart = after_contacts(3 * d_0, false);
  EXPECT_GT(largest_difference(within, apart), 0.1 * largest(within)) << "they do touch";
  for (const double begin : {9 * d_0, 12 * d_0, 14 * d_0})  // body against body, either against the step
    EXPECT_LT(largest_difference(within, after_contacts(begin, true)), 1e-11 * largest(within))
        << begin / d_0;
}

/// A rigid block of 4 x 4 particles, `begin` [m] its left side, that falls on a floor and slides along it,
/// out of the domain.
std::unique_ptr<SolidModel> slid_rigid_block(double begin) {
  Parameters p;
  p.formulation = Formulation::rigid;
  p.material = {1000, 0, 0};
  p.spacing = d_0;
  p.regions = {{"block", {Vec(begin, 0.5 * d_0), Vec(begin + 4 * d_0, 4.5 * d_0)}}};
  p.initial_velocity = InitialVelocity{.velocity = Vec(1, -0.5)};
  p.wall_contact = Contact{.modulus = 1e5};
  Scene scene = repeating();
  scene.gravity = Vec(0, -10);
  scene.walls = {{"floor", {Vec(0, -3 * d_0), Vec(length, 0)}, {}}};
  auto model = model_in(scene, p);
  for (int n = 0; n < 1000; ++n) model->advance(5e-4);
  return model;
}

TEST(PeriodicSolid, IsHeldByAFloorWhenItIsRigidToo) {
  const auto within = slid_rigid_block(0);
  EXPECT_GT(within->displacement(0)[0], length) << "it has gone round";
  EXPECT_GT(within->displacement(0)[1], -d_0) << "and lies on the floor";
  EXPECT_GT(within->impulses().walls[1], 0);
  for (const double begin : {8 * d_0, 14 * d_0})
    EXPECT_LT(largest_difference(displacements(*within), displacements(*slid_rigid_block(begin))), 1e-9)
        << begin / d_0;
}

std::vector<std::string> faults(const std::function<void(Parameters&, Scene&)>& change) {
  Parameters p = plate(0, length);
  Scene scene = repeating();
  change(p, scene);
  std::vector<std::string> said;
  for (const auto& [key, message] : periodic_faults(p, scene)) said.push_back(key + ": " + message);
  return said;
}

using Said = std::vector<std::string>;

TEST(PeriodicSolid, SaysWhatItDoesNotGoWith) {
  EXPECT_EQ(faults([](Parameters&, Scene&) {}), Said{});
  EXPECT_EQ(faults([](Parameters& p, Scene& scene) {
              p.formulation = Formulation::updated_lagrangian;
              scene.periodic = Periodic::none;
            }),
            Said{});
  EXPECT_EQ(
      faults([](Parameters& p, Scene&) {
        p.formulation = Formulation::updated_lagrangian;
        p.detachment = Detachment{};
        p.clamps = {{.name = "still", .box = {}},
                    {.name = "turning", .box = {}, .motion = Motion{.rotation = Rotation{}}}};
      }),
      (Said{
          "solid.formulation: only a solid by \"total_lagrangian\" or \"rigid\" can be in space that repeats "
          "itself ([case] periodic)",
          "solid.detachment: particles that come off are not looked for in space that repeats itself ([case] "
          "periodic)",
          "solid.clamp.1: clamps do not turn in space that repeats itself ([case] periodic)"}));
  EXPECT_EQ(
      faults([](Parameters& p, Scene&) {
        p = plate(length, 2 * length);
        p.smoothing_ratio = 4.5;
      }),
      (Said{"case.periodic: the domain repeats itself in x after 0.25 m, which is shorter than 0.28125 m, "
            "twice the reach of the solid's particles",
            "solid.region.0.box: the middle of region 'left' lies outside [case.domain], at x = 0.3125 m: "
            "move it by whole periods",
            "solid.region.1.box: the middle of region 'right' lies outside [case.domain], at x = 0.4375 "
            "m: move it by whole periods"}));
}

TEST(PeriodicSolid, DoesNotTurnARigidBodyWithoutEnds) {
  const Said refused{
      "solid.mounting: a rigid body that meets its image across a side of [case.domain] has no ends and "
      "cannot turn: give it fixed = [\"angle\"]"};
  const auto rigid = [](double begin, double end, const std::vector<std::string>& fixed) {
    return faults([&](Parameters& p, Scene&) {
      p = plate(begin, end);
      p.formulation = Formulation::rigid;
      p.mounting = Mounting{.fixed = fixed};
    });
  };
  EXPECT_EQ(rigid(0, length, {}), refused);
  EXPECT_EQ(rigid(4 * d_0, length + 4 * d_0, {"x", "y"}), refused);
  EXPECT_EQ(rigid(0, length, {"angle"}), Said{});
  EXPECT_EQ(rigid(4 * d_0, length, {}), Said{}) << "not as long as the period";
  EXPECT_EQ(faults([](Parameters& p, Scene&) { p.formulation = Formulation::rigid; }), refused)
      << "without a mounting";
}

}  // namespace periodic_test
}  // namespace toryu::solid
