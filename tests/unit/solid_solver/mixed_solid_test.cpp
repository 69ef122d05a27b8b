/// Elastic regions and rigid bodies beside each other: each moves bit by bit as it would alone, and what is
/// said of the whole is the sum.
#include "solid_solver/mixed_solid.hpp"

#include <cmath>
#include <sstream>

#include "samples.hpp"
#include "solid_solver/rigid/rigid_body.hpp"

namespace toryu::solid::of_mixed_solids {
namespace {

/// A plate held at its left end, and a bar of 0.04 x 0.02 m above it, of 500 kg/m3: 0.4 kg/m.
Parameters plate_and_bar() {
  Parameters p = moving_cantilever(4, 0.5);
  p.regions[0].initial_velocity = p.initial_velocity;
  p.initial_velocity.reset();
  p.materials = {{.name = "wood", .elastic = {500, 0, 0}}};
  p.regions.push_back(
      {.name = "bar", .box = {Vec(0.1, 0.1), Vec(0.14, 0.12)}, .material = "wood", .body = "bar"});
  p.bodies = {{"bar", Mounting{.stiffness = Vec(300, 0), .angular_damping = 0.01}}};
  p.observers = {{"tip", Vec(0.08, 0.01)}, {"corner", Vec(0.14, 0.12)}};
  p.loads = {{.name = "pull", .box = {Vec(0.06, 0), Vec(0.08, 0.02)}, .force = Vec(1, 2)},
             {.name = "push", .box = {Vec(0.12, 0.1), Vec(0.14, 0.12)}, .force = Vec(0, -3)}};
  return p;
}
constexpr double m_bar = 0.4;

Scene falling() {
  Scene scene = empty_scene();
  scene.gravity = Vec(1, -10);
  return scene;
}

std::vector<Part> parts_of(const Parameters& p) {
  return build_parts(
      p, [](const std::string& key, const std::string& message) { ADD_FAILURE() << key << ": " << message; });
}

std::string faults(const Parameters& p) {
  std::string said;
  build_parts(p, [&](const std::string& key, const std::string& message) {
    said += (said.empty() ? "" : "\n") + key + ": " + message;
  });
  return said;
}

struct Mixed {
  explicit Mixed(const Parameters& p = plate_and_bar(), const Scene& scene = falling())
      : made(make_solid(parts_of(p), scene)), solid(dynamic_cast<MixedSolid&>(*made)) {}
  std::unique_ptr<Solid> made;
  MixedSolid& solid;
};

double observed_in(const Solid& solid, const std::string& name) {
  for (const auto& observation : solid.observe())
    if (observation.name == name) return observation.value;
  ADD_FAILURE() << "no column " << name;
  return 0;
}

/// Forces and impedances that differ from particle to particle.
InterfaceLoad load_on(std::size_t count) {
  InterfaceLoad load;
  for (std::size_t n = 0; n < count; ++n) {
    const double k = static_cast<double>(n);
    load.pressure.push_back(0);
    load.force.insert(load.force.end(), {0.2 * std::cos(k), 0.2 * std::sin(3 * k)});
    load.impedance.insert(load.impedance.end(), {0.0, 2.0});
    load.velocity.insert(load.velocity.end(), {0.1, -0.2});
  }
  return load;
}

/// The share of a load on the particles from `begin` to `end`.
InterfaceLoad share(const InterfaceLoad& load, std::size_t begin, std::size_t end) {
  InterfaceLoad part;
  for (std::size_t n = begin; n < end; ++n) {
    part.pressure.push_back(load.pressure[n]);
    for (const std::size_t k : {dim * n, dim * n + 1}) {
      part.force.push_back(load.force[k]);
      part.impedance.push_back(load.impedance[k]);
      part.velocity.push_back(load.velocity[k]);
    }
  }
  return part;
}

std::string checkpoint(const Solver& solver) {
  std::ostringstream stream;
  solver.write_state(stream);
  return stream.str();
}

TEST(MixedSolid, GivesEachPartWhatLiesInIt) {
  const auto parts = parts_of(plate_and_bar());
  ASSERT_EQ(parts.size(), 2u);
  const auto& [elastic, plate] = parts[0];
  const auto& [rigid, bar] = parts[1];
  EXPECT_EQ(elastic.formulation, Formulation::total_lagrangian);
  EXPECT_EQ(rigid.formulation, Formulation::rigid);
  EXPECT_EQ(plate.size(), 64u);
  EXPECT_EQ(bar.size(), 32u);
  EXPECT_EQ(bar.first, 64u);
  EXPECT_NEAR(bar.total_mass(), m_bar, 1e-15);
  EXPECT_EQ(elastic.loads[0].name, "pull");
  EXPECT_EQ(rigid.loads[0].name, "push");
  EXPECT_EQ(elastic.loads.size() + rigid.loads.size(), 2u);
  EXPECT_EQ(elastic.observers[0].name, "tip");
  EXPECT_EQ(rigid.observers[0].name, "corner");
  EXPECT_EQ(elastic.observers.size() + rigid.observers.size(), 2u);
}

TEST(MixedSolid, RefusesWhatBothWouldShare) {
  Parameters p = plate_and_bar();
  p.regions[1].box = {Vec(0.08, 0), Vec(0.12, 0.02)};
  p.loads.clear(), p.observers.clear();
  EXPECT_EQ(
      faults(p),
      "solid.region.\"bar\".box: region 'plate' touches or overlaps region 'bar' of the rigid body 'bar': "
      "they are "
      "not joined, and need a gap; what is to move with an elastic solid is a region of it with a stiff "
      "'material'");
  p = plate_and_bar();
  p.loads[0].box = {Vec(0, 0), Vec(1, 1)};
  EXPECT_EQ(
      faults(p),
      "solid.load.\"pull\".box: load 'pull' acts on elastic regions and on rigid bodies: make it of two");
  p = plate_and_bar();
  p.clamps.push_back({"top", {Vec(0, 0.05), Vec(1, 1)}});
  EXPECT_EQ(faults(p),
            "solid.clamp.\"top\".box: clamp 'top' holds no particle of the solid\n"
            "solid.clamp.\"top\".box: clamp 'top' holds 32 particles of rigid bodies, which "
            "[solid.body.mounting] holds");
  p = plate_and_bar();
  p.loads[0].box = {Vec(0.2, 0.2), Vec(1, 1)};
  p.observers[1].stress = true;
  EXPECT_EQ(faults(p),
            "solid.observer.\"corner\".stress: observer 'corner': there is no stress in a rigid body\n"
            "solid.load.\"pull\".box: load 'pull' acts on no particle of the solid");
}

TEST(MixedSolid, TellsOfPartsThatCannotBeFilled) {
  Parameters p = plate_and_bar();
  p.loads.clear(), p.observers.clear(), p.clamps.clear();
  p.spacing = 0.07;
  const std::string said = faults(p);
  EXPECT_NE(said.find("region 'plate' is 1.14 spacings long along x"), std::string::npos) << said;
  EXPECT_NE(said.find("region 'bar' is 0.571 spacings long along x"), std::string::npos) << said;
}

/// Under loads and impedances on its whole interface, with the steps of the faster part.
void moves_as_alone(Formulation formulation) {
  Parameters p = plate_and_bar();
  p.formulation = formulation;
  if (formulation == Formulation::updated_lagrangian) p.hourglass.reset();
  Mixed mixed(p);
  const auto parts = parts_of(p);
  const auto elastic = make_model(parts[0].parameters, parts[0].body, falling());
  const auto rigid = make_model(parts[1].parameters, parts[1].body, falling());
  const Interface all = mixed.solid.interface(0.006);
  const auto of_plate = elastic->interface(0.006).id, of_bar = rigid->interface(0.006).id;
  ASSERT_EQ(all.size(), of_plate.size() + of_bar.size());
  const InterfaceLoad load = load_on(all.size());
  const Vec force = mixed.solid.set_interface_load(all.id, load);
  const Vec apart = elastic->set_interface_load(of_plate, share(load, 0, of_plate.size())) +
                    rigid->set_interface_load(of_bar, share(load, of_plate.size(), all.size()));
  EXPECT_EQ(force, apart);
  for (int n = 0; n < 200; ++n) {
    const double dt = mixed.solid.time_step_limit();
    EXPECT_LE(dt, std::min(elastic->time_step_limit(), rigid->time_step_limit()));
    mixed.solid.advance(dt), elastic->advance(dt), rigid->advance(dt);
  }
  EXPECT_EQ(checkpoint(mixed.solid), checkpoint(*elastic) + checkpoint(*rigid));
  EXPECT_GT(std::abs(observed(*rigid, "bar_angle")), 1e-7);
  EXPECT_EQ(observed_in(mixed.solid, "bar_angle"), observed(*rigid, "bar_angle"));
  EXPECT_EQ(observed_in(mixed.solid, "tip_displacement_y"), observed(*elastic, "tip_displacement_y"));
  EXPECT_EQ(observed_in(mixed.solid, "corner_displacement_y"), observed(*rigid, "corner_displacement_y"));
  const InterfaceMotion motion = mixed.solid.motion(all.id), of_second = rigid->motion(of_bar);
  EXPECT_TRUE(std::equal(of_second.position.begin(), of_second.position.end(),
                         motion.position.begin() + static_cast<long>(dim * of_plate.size())));
  EXPECT_EQ(mixed.solid.excess_impulse().size(), dim * all.size());
  EXPECT_EQ(mixed.solid.work_of_excess_impulse(),
            elastic->work_of_excess_impulse() + rigid->work_of_excess_impulse());
  EXPECT_NE(rigid->work_of_excess_impulse(), 0);
}

TEST(MixedSolid, MovesBitByBitAsItsPartsAlone) {
  moves_as_alone(Formulation::total_lagrangian);
  moves_as_alone(Formulation::updated_lagrangian);
}

TEST(MixedSolid, SaysOfTheWholeWhatBothPartsHold) {
  Parameters p = plate_and_bar();
  p.bodies[0].mounting->angular_damping = 0;
  Mixed mixed(p);
  double t = 0;
  for (int n = 0; n < 400; ++n) {
    const double dt = mixed.solid.time_step_limit();
    mixed.solid.advance(dt);
    t += dt;
  }
  // Along y nothing but gravity and the load of -3 N/m acts on the bar.
  const double v = (-10 - 3 / m_bar) * t;
  EXPECT_NEAR(observed_in(mixed.solid, "bar_velocity_y"), v, 1e-12);
  EXPECT_NEAR(observed_in(mixed.solid, "momentum_y"),
              observed(mixed.solid.elastic(), "momentum_y") + m_bar * v, 1e-12);
  for (const std::string sum : {"kinetic_energy", "potential_energy", "impulse_from_load_y"})
    EXPECT_EQ(observed_in(mixed.solid, sum),
              observed(mixed.solid.elastic(), sum) + observed(mixed.solid.rigid(), sum));
  EXPECT_EQ(mixed.solid.health().kinetic_energy, observed_in(mixed.solid, "kinetic_energy"));
  const double kinetic = observed_in(mixed.solid, "kinetic_energy");
  EXPECT_GT(kinetic, observed(mixed.solid.elastic(), "kinetic_energy"));
  EXPECT_NEAR(observed_in(mixed.solid, "dissipated_energy"), 0, 1e-3 * kinetic);
  int columns = 0;
  for (const auto& observation : mixed.solid.observe()) columns += observation.name == "kinetic_energy";
  EXPECT_EQ(columns, 1);
}

TEST(MixedSolid, ShowsBothPartsInOneFrame) {
  const Mixed mixed;
  const Frame frame = mixed.solid.frame();
  EXPECT_EQ(frame.positions.size(), dim * 96u);
  std::vector<std::string> names;
  for (const FrameField& field : frame.fields) {
    names.push_back(field.name);
    EXPECT_EQ(field.values.size(), static_cast<std::size_t>(field.components) * 96) << field.name;
  }
  EXPECT_EQ(names, (std::vector<std::string>{"velocity", "displacement", "stress", "von_mises_stress",
                                             "pressure", "held", "material", "rigid"}));
  EXPECT_EQ(frame.fields.back().values[63], 0);
  EXPECT_EQ(frame.fields.back().values[64], 1);
}

TEST(MixedSolid, GoesBackAndGoesOnBitByBit) {
  Mixed mixed;
  const auto touched = mixed.solid.interface(0.006).id;
  const auto advance = [&](Solid& solid) {
    solid.set_interface_load(touched, load_on(touched.size()));
    for (int n = 0; n < 40; ++n) solid.advance(solid.time_step_limit());
  };
  advance(mixed.solid);
  mixed.solid.save();
  const std::string start = checkpoint(mixed.solid);
  advance(mixed.solid);
  const std::string first = checkpoint(mixed.solid);
  EXPECT_NE(first, start);
  mixed.solid.restore();
  EXPECT_EQ(checkpoint(mixed.solid), start);
  advance(mixed.solid);
  EXPECT_EQ(checkpoint(mixed.solid), first);
  Mixed other;
  std::istringstream stream(start);
  other.solid.read_state(stream);
  advance(other.solid);
  EXPECT_EQ(checkpoint(other.solid), first);
}

TEST(MixedSolid, EndsTheRunWhereItsPartsMeet) {
  Parameters p = plate_and_bar();
  p.regions[1].box = {Vec(0.02, 0.03), Vec(0.06, 0.05)};
  p.loads.clear(), p.observers.clear();
  Mixed mixed(p);
  std::string said;
  for (int n = 0; n < 20000 && said.empty(); ++n) try {
      mixed.solid.advance(mixed.solid.time_step_limit());
      if (n % 50 == 0) mixed.solid.check(0);
    } catch (const PhysicsFailure& failure) {
      said = failure.what();
    }
  EXPECT_NE(said.find("distance of 'plate' and 'bar'"), std::string::npos) << said;
  EXPECT_NE(said.find("above 0.0025 m: rigid bodies do not push elastic ones"), std::string::npos) << said;
}

TEST(MixedSolid, NumbersTheParticlesOfTheRigidPartBehindTheOthers) {
  Parameters p = plate_and_bar();
  p.limits.speed = 0.6;  // the bar falls faster after 0.04 s
  p.regions[0].initial_velocity.reset();
  p.loads.clear();
  Scene scene = empty_scene();
  scene.gravity = Vec(0, -10);
  p.clamps[0].box.max = Vec(1, 0.05);
  Mixed mixed(p, scene);
  std::string said;
  for (int n = 0; n < 20000 && said.empty(); ++n) try {
      mixed.solid.advance(1e-3);
      mixed.solid.check(0);
    } catch (const PhysicsFailure& failure) {
      said = failure.what();
    }
  long particle = -1;
  std::sscanf(said.c_str(), "solid particle %ld", &particle);
  EXPECT_GE(particle, 64) << said;
  EXPECT_LT(particle, 96) << said;
}

}  // namespace
}  // namespace toryu::solid::of_mixed_solids
