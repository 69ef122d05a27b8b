// What is recorded of a work piece's surface, by sums worked by hand.
#include "fluid_solver/surface_record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>

#include "tests/unit/fluid_solver/scenes.hpp"

namespace toryu::fluid {
namespace {

constexpr double d_0 = 0.1, h = 1.2 * d_0, dt = 0.01;
const CubicSpline kernel(h);

struct Medium {
  Vec x, v;
  double p, V;
};

/// A surface particle at the origin that looks upwards, one inside below it, and the medium above.
struct Contacting {
  explicit Contacting(const std::vector<Medium>& medium, const Vec& surface_velocity = Vec::Zero(),
                      const Vec& friction_force = Vec::Zero()) {
    Boundary& body = boundaries.emplace_back();
    body.name = "piece";
    body.place({Vec(0, 0), Vec(0, -d_0)}, {d_0 * d_0, d_0 * d_0}, 1000, 0.3);
    body.make_work_piece({faces_of(Vec(0, d_0)), faces_of(Vec(0, 0))});
    resize(body.friction_force, padded(body.count));
    body.move_to([&](std::uint32_t id) {
      return Kinematics{Vec(0, id == 0 ? 0.0 : -d_0), surface_velocity, Vec::Zero()};
    });
    for (std::size_t k = 0; k < body.count; ++k)
      if (body.id[k] == 0) set(body.friction_force, k, friction_force);
    fluid.count = medium.size();
    for (auto* field : {&fluid.x, &fluid.v}) resize(*field, padded(fluid.count));
    for (auto* field : {&fluid.p, &fluid.V}) field->resize(padded(fluid.count), 0.0);
    for (std::size_t k = 0; k < medium.size(); ++k) {
      set(fluid.x, k, medium[k].x);
      set(fluid.v, k, medium[k].v);
      fluid.p[k] = medium[k].p;
      fluid.V[k] = medium[k].V;
    }
    StripOrder strips(10);
    strips.index(fluid.x[0], fluid.count);
    body.list_for_wall.build(body.x, body.count, fluid.x, strips, 2 * h);
    neighbours.build(fluid.x, fluid.count, fluid.x, strips, 2 * h);
  }
  std::map<std::string, double> after(const Removal& removal, int steps = 1,
                                      std::optional<Sticking> sticks = {}, double p_offset = 0) {
    SurfaceRecord record(removal, sticks);
    record.attach(boundaries);
    EXPECT_EQ(record.size(), 1u);  // the particle inside has no face
    for (int n = 0; n < steps; ++n) record.add(boundaries, fluid, p_offset, neighbours, kernel, dt);
    std::map<std::string, double> values;
    for (const auto& observation : record.observe()) values[observation.name] = observation.value;
    return values;
  }
  std::vector<Boundary> boundaries;
  Particles fluid;
  ClusterList neighbours;
};

const Removal preston{.preston_coefficient = 1e-6, .archard = {}, .roughness = {}};

TEST(SurfaceRecord, PrestonTakesPressureTimesSlidingSpeed) {
  Contacting one({{Vec(0, 0.08), Vec(3, 0.7), 50, 0.01}});
  EXPECT_NEAR(one.after(preston)["removed_depth_mean"], 1e-6 * 50 * 3 * dt,
              1e-15);  // 0.7 is along the normal
  EXPECT_NEAR(one.after(preston, 4)["removed_depth_largest"], 4 * 1e-6 * 50 * 3 * dt, 1e-15);
  EXPECT_NEAR(one.after(preston)["removed_area"], d_0 * 1e-6 * 50 * 3 * dt, 1e-16);
}

TEST(SurfaceRecord, WhereTheMediumSticksTheShearAtTheWallCountsWhateverTheRows) {
  Removal grains = preston;
  grains.grain_length = 0.02;
  const auto flow = [](double y) { return Vec(40 * y - 60 * y * y, 0.3 * y); };  // bent, and along the normal
  const auto medium_at = [&](double y) { return Medium{Vec(0, y + 0.5 * d_0), flow(y), 50, 0.01}; };
  const double expected = 1e-6 * 50 * 40 * 0.02 * dt;
  const Sticking sticks{d_0, [](double) { return 3.0; }};
  for (const double row : {0.12, 0.15}) {  // the first row is what it may
    const Medium first{Vec(0, 0.1), Vec(7, 7), 50, 0.01};
    EXPECT_NEAR(Contacting({first, medium_at(row), medium_at(row + 0.08)})
                    .after(grains, 1, sticks)["removed_depth_mean"],
                expected, 1e-12 * expected)
        << row;
  }
  EXPECT_NEAR(Contacting({medium_at(0.05), medium_at(0.07)}).after(grains, 1, sticks)["removed_depth_mean"],
              expected, 1e-12 * expected)
      << "a film of one row";
  EXPECT_NEAR(Contacting({medium_at(0.05)}).after(grains, 1, sticks)["removed_depth_mean"],
              expected * (40 - 60 * 0.05) / 40, 1e-12 * expected)
      << "one row tells no bend";
}

TEST(SurfaceRecord, TakesSpeedAndStressOfTheSlipLaw) {
  Contacting one({{Vec(0, 0.08), Vec(3, 0), 50, 0.01}});
  Boundary& body = one.boundaries.front();
  resize(body.slip_velocity, padded(body.count));
  body.shear_stress.resize(padded(body.count));
  for (std::size_t k = 0; k < body.count; ++k)
    set(body.slip_velocity, k, Vec(-2, 0)), body.shear_stress[k] = 7;
  const Sticking sticks{d_0, [](double) { return 3.0; }};
  const Removal both{.preston_coefficient = 1e-6, .archard = {}, .roughness = {}, .shear_coefficient = 1e-5};
  const auto seen = one.after(both, 4, sticks);
  EXPECT_NEAR(seen.at("removed_depth_mean"), 4 * 1e-6 * 50 * 2 * dt, 1e-15);
  EXPECT_NEAR(seen.at("shear_depth_mean"), 4 * 1e-5 * 7 * 2 * dt, 1e-15);
  EXPECT_NEAR(seen.at("shear_depth_largest"), 4 * 1e-5 * 7 * 2 * dt, 1e-15);
  const Removal shear{.preston_coefficient = 0, .archard = {}, .roughness = {}, .shear_coefficient = 1e-5};
  EXPECT_NEAR(one.after(shear, 1, sticks).at("removed_depth_mean"), 1e-5 * 7 * 2 * dt, 1e-15);
}

TEST(SurfaceRecord, ShearStressIsOfViscosityAndFriction) {
  const Removal shear{.preston_coefficient = 0,
                      .archard = {},
                      .roughness = {},
                      .shear_coefficient = 1e-5,
                      .grain_length = 0.02};
  const Medium row{Vec(0, 0.1), Vec(2, 0), 50, 0.01};  // 0.05 m before the face
  const double gdot = 2 / 0.05;
  const Sticking sticks{d_0, [&](double rate) { return 0.1 * rate; }};
  EXPECT_NEAR(Contacting({row}).after(shear, 1, sticks)["removed_depth_mean"],
              1e-5 * (0.1 * gdot * gdot) * (0.02 * gdot) * dt, 1e-15);
  EXPECT_NEAR(Contacting({row}, Vec::Zero(), Vec(0.3, 0)).after(shear)["removed_depth_mean"],
              1e-5 * (0.3 / d_0) * 2 * dt, 1e-15)
      << "free slip";
}

TEST(SurfaceRecord, MeansAreWeightedByVolumeAndKernel) {
  const Medium near{Vec(0, 0.06), Vec(2, 0), 40, 0.01}, far{Vec(0.12, 0.12), Vec(5, 0), 100, 0.02};
  const double w_near = 0.01 * kernel.value(0.06), w_far = 0.02 * kernel.value(0.12 * std::sqrt(2.0));
  const double p = (w_near * 40 + w_far * 100) / (w_near + w_far),
               v = (w_near * 2 + w_far * 5) / (w_near + w_far);
  EXPECT_NEAR(Contacting({near, far}).after(preston)["removed_depth_mean"], 1e-6 * p * v * dt, 1e-15);
}

TEST(SurfaceRecord, ContactHasThePressureAtWhichTheMediumIsHeld) {
  Contacting one({{Vec(0, 0.08), Vec(3, 0), 50, 0.01}});
  EXPECT_NEAR(one.after(preston, 1, {}, 150)["removed_depth_mean"], 1e-6 * 200 * 3 * dt, 1e-15);
  EXPECT_EQ(one.after(preston, 1, {}, -60)["removed_depth_mean"], 0);
}

/// A work piece of which one particle looks away from the axis, to a face at r = 0.05, and one towards it.
TEST(SurfaceRecord, AboutAnAxisWeighsItsPointsByTheirRings) {
  Contacting one({{Vec(0, 0.15), Vec(3, 0), 50, 0.01}, {Vec(0, -0.25), Vec(1, 0), 20, 0.01}});
  Boundary& body = one.boundaries.front();
  body.make_work_piece({faces_of(Vec(0, d_0)), faces_of(Vec(0, -d_0))});
  for (std::size_t k = 0; k < body.count; ++k) body.x[1][k] += 1;
  for (std::size_t f = 0; f < one.fluid.count; ++f) one.fluid.x[1][f] += 1;
  SurfaceRecord record(preston, {}, Geometry::axisymmetric);
  record.attach(one.boundaries);
  record.add(one.boundaries, one.fluid, 0, one.neighbours, kernel, dt);
  std::map<std::string, Observation> seen;
  for (const auto& observation : record.observe()) seen[observation.name] = observation;
  const double outer = 2 * std::numbers::pi * 1.05 * d_0, inner = 2 * std::numbers::pi * 0.85 * d_0;
  const double outer_depth = 1e-6 * 50 * 3 * dt, inner_depth = 1e-6 * 20 * 1 * dt;
  const double volume = outer * outer_depth + inner * inner_depth;
  EXPECT_NEAR(seen.at("wetted_area").value, outer + inner, 1e-12);
  EXPECT_EQ(seen.at("wetted_area").unit, "m2");
  EXPECT_NEAR(seen.at("removed_volume").value, volume, 1e-9 * volume);
  EXPECT_EQ(seen.at("removed_volume").unit, "m3");
  EXPECT_NEAR(seen.at("removed_depth_mean").value, volume / (outer + inner), 1e-15);
}

TEST(SurfaceRecord, SlidingIsRelativeToTheSurface) {
  Contacting same({{Vec(0, 0.08), Vec(3, 0), 50, 0.01}}, Vec(3, 0));
  EXPECT_NEAR(same.after(preston)["removed_depth_mean"], 0, 1e-18);
}

TEST(SurfaceRecord, NothingComesOffUnderSuctionOrWithoutContact) {
  EXPECT_EQ(Contacting({{Vec(0, 0.08), Vec(3, 0), -50, 0.01}}).after(preston)["removed_depth_mean"], 0);
  EXPECT_EQ(Contacting({{Vec(0, 0.24), Vec(3, 0), 50, 0.01}}).after(preston)["removed_depth_mean"], 0);
}

TEST(SurfaceRecord, ArchardCountsWherePrestonIsNotGiven) {
  const Removal archard{.preston_coefficient = 0, .archard = Archard{2e-3, 4e8}, .roughness = {}};
  Contacting one({{Vec(0, 0.08), Vec(3, 0), 50, 0.01}});
  EXPECT_NEAR(one.after(archard)["removed_depth_mean"], 2e-3 / 4e8 * 50 * 3 * dt, 1e-20);
}

TEST(SurfaceRecord, ADryFaceDoesNotCount) {
  Contacting one({{Vec(0, 0.16), Vec(3, 0), 50, 0.01}});
  const auto alone = one.after(preston);
  EXPECT_NEAR(alone.at("wetted_length"), d_0, 1e-15);
  one.boundaries.front().make_work_piece(
      {faces_of(Vec(0, d_0)), faces_of(Vec(0, -2 * d_0))});  // the lower one: none in reach
  SurfaceRecord record(preston);
  record.attach(one.boundaries);
  ASSERT_EQ(record.size(), 2u);
  record.add(one.boundaries, one.fluid, 0, one.neighbours, kernel, dt);
  for (const auto& seen : record.observe()) EXPECT_NEAR(seen.value, alone.at(seen.name), 1e-15) << seen.name;
}

TEST(SurfaceRecord, TellsTheDepthsOfBothLaws) {
  const Removal both{.preston_coefficient = 1e-6, .archard = Archard{2e-3, 4e8}, .roughness = {}};
  const auto seen = Contacting({{Vec(0, 0.08), Vec(3, 0), 50, 0.01}}).after(both);
  EXPECT_NEAR(seen.at("removed_depth_mean"), 1e-6 * 50 * 3 * dt, 1e-15);
  EXPECT_NEAR(seen.at("archard_depth_mean"), 2e-3 / 4e8 * 50 * 3 * dt, 1e-20);
  EXPECT_NEAR(seen.at("archard_depth_largest"), 2e-3 / 4e8 * 50 * 3 * dt, 1e-20);
}

TEST(SurfaceRecord, RoughnessDecaysWithTheDepth) {
  const double depth = 1e-6 * 50 * 3 * dt;
  Removal removal = preston;
  removal.roughness = Roughness{.initial = 2e-6, .final = 0.5e-6, .decay_depth = depth};
  Contacting one({{Vec(0, 0.08), Vec(3, 0), 50, 0.01}});
  EXPECT_NEAR(one.after(removal)["roughness_mean"], 0.5e-6 + 1.5e-6 * std::exp(-1), 1e-15);
  EXPECT_NEAR(one.after(removal, 3)["roughness_mean"], 0.5e-6 + 1.5e-6 * std::exp(-3), 1e-15);
}

/// Rows of a dataset of surface.h5.
std::vector<double> read(const std::filesystem::path& path, const std::string& name) {
  const HdfHandle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, path);
  const HdfHandle dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose, name);
  const HdfHandle space(H5Dget_space(dataset), H5Sclose, name);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  return values;
}

TEST(SurfaceRecord, FileHasMeansSinceTheLastRowAndSumsSinceTheStart) {
  const auto out = std::filesystem::path(testing::TempDir()) / "surface_record";
  std::filesystem::create_directories(out);
  Contacting one({{Vec(0, 0.08), Vec(3, 0), 50, 0.01}}, Vec::Zero(), Vec(0.02, 0));
  {
    SurfaceRecord record(preston);
    record.attach(one.boundaries);
    record.open(out);
    record.write(0);
    for (int n = 0; n < 2; ++n) record.add(one.boundaries, one.fluid, 0, one.neighbours, kernel, dt);
    record.write(2 * dt);
    record.add(one.boundaries, one.fluid, 0, one.neighbours, kernel, dt);
    record.write(3 * dt);
  }
  const auto path = out / "surface.h5";
  using testing::DoubleNear;
  using testing::ElementsAre;
  const auto near = [](double value) { return DoubleNear(value, 1e-12 * std::max(1.0, std::abs(value))); };
  EXPECT_THAT(read(path, "time"), ElementsAre(0, 2 * dt, 3 * dt));
  EXPECT_THAT(read(path, "contact_pressure"), ElementsAre(0, near(50), near(50)));
  EXPECT_THAT(read(path, "sliding_speed"), ElementsAre(0, near(3), near(3)));
  EXPECT_THAT(read(path, "shear_stress"), ElementsAre(0, near(0.2), near(0.2)));
  EXPECT_THAT(read(path, "friction_traction"), ElementsAre(0, 0, near(0.2), 0, near(0.2), 0));  // F_s/A_s
  EXPECT_THAT(read(path, "friction_work"), ElementsAre(0, near(0.2 * 3 * 2 * dt), near(0.2 * 3 * 3 * dt)));
  EXPECT_THAT(read(path, "sliding_pressure"), ElementsAre(0, near(150 * 2 * dt), near(150 * 3 * dt)));
  EXPECT_THAT(read(path, "preston_depth"),
              ElementsAre(0, near(1e-6 * 150 * 2 * dt), near(1e-6 * 150 * 3 * dt)));
  EXPECT_THAT(read(path, "normal"), ElementsAre(0, 1));
  EXPECT_THAT(read(path, "area"), ElementsAre(d_0));
}

TEST(SurfaceRecord, FileHasTheDepthOfEachLawThatIsGiven) {
  const auto out = std::filesystem::path(testing::TempDir()) / "surface_record_of_laws";
  std::filesystem::create_directories(out);
  Contacting one({{Vec(0, 0.08), Vec(3, 0), 50, 0.01}});
  const auto recorded = [&](const Removal& removal) {
    SurfaceRecord record(removal);
    record.attach(one.boundaries);
    record.open(out);
    record.add(one.boundaries, one.fluid, 0, one.neighbours, kernel, dt);
    record.write(dt);
  };
  const Archard law{2e-3, 4e8};
  const double by_archard = 2e-3 / 4e8 * 150 * dt, by_preston = 1e-6 * 150 * dt;
  recorded({.preston_coefficient = 1e-6, .archard = law, .roughness = {}});
  EXPECT_NEAR(read(out / "surface.h5", "preston_depth").at(0), by_preston, 1e-9 * by_preston);
  EXPECT_NEAR(read(out / "surface.h5", "archard_depth").at(0), by_archard, 1e-9 * by_archard);
  recorded({.preston_coefficient = 0, .archard = law, .roughness = {}});
  EXPECT_NEAR(read(out / "surface.h5", "archard_depth").at(0), by_archard, 1e-9 * by_archard);
}

}  // namespace
}  // namespace toryu::fluid
