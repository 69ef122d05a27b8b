#include "solid_solver/parameters.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace toryu::solid {
namespace {

const std::string plate = R"([solid]
density = 1000.0
youngs_modulus = 2e6
poissons_ratio = 0.4
spacing = 0.005
[[solid.region]]
name = "plate"
box = { min = [0.0, 0.0], max = [0.2, 0.02] }
)";

class SolidSection : public testing::Test {
 protected:
  SolidSection()
      : folder_(std::filesystem::temp_directory_path() /
                ("toryu_solid_section_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~SolidSection() override { std::filesystem::remove_all(folder_); }

  Parameters read(const std::string& text, const std::vector<std::string>& overrides = {}) {
    std::ofstream(folder_ / "case.toml") << text;
    CaseFile file(folder_, overrides);
    Parameters parameters;
    file.read("solid", parameters, "an elastic body");
    file.throw_if_faulty();
    used_ = file.used();
    described_ = file.description();
    return parameters;
  }
  std::string faults(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
      read(text, overrides);
    } catch (const BadInput& error) {
      std::string message = error.what();
      const std::string path = folder_.string() + "/";
      for (std::size_t at; (at = message.find(path)) != std::string::npos;) message.erase(at, path.size());
      return message;
    }
    return "";
  }
  std::filesystem::path folder_;
  std::string used_, described_;
};

TEST_F(SolidSection, GivesRegionsMaterialsOfTheirOwn) {
  const std::string made = plate +
                           "material = 'steel'\n[[solid.region]]\nname = 'base'\n"
                           "box = { min = [0.0, -0.02], max = [0.2, 0.0] }\n";
  const std::string steel =
      "[[solid.material]]\nname = 'steel'\ndensity = 7800.0\nyoungs_modulus = 2e11\npoissons_ratio = 0.3\n";
  const Parameters p = read(made + steel);
  EXPECT_EQ(p.materials_of_regions(), (std::vector<std::uint32_t>{1, 0}));
  EXPECT_EQ(p.all_materials()[1].elastic.density, 7800);
  EXPECT_NEAR(p.fastest_sound(), std::sqrt(2e11 * 0.7 / (1.3 * 0.4) / 7800), 1e-9 * p.fastest_sound());
  EXPECT_EQ(p.material_in_contact().density, 1000) << "of the lightest";
  EXPECT_EQ(p.material_in_contact().youngs_modulus, 2e6) << "of the softest";
  const std::string used = used_;
  EXPECT_NE(used.find("material = \"steel\""), std::string::npos) << used;
  read(used);
  EXPECT_EQ(used_, used) << "what is written reads as it was";
}

TEST_F(SolidSection, RefusesMaterialsThatAreNotThere) {
  const std::string steel =
      "[[solid.material]]\nname = 'steel'\ndensity = 7800.0\nyoungs_modulus = 2e11\npoissons_ratio = 0.3\n";
  EXPECT_EQ(faults(plate + "material = 'stel'\n" + steel),
            "case.toml:9:1: error: no [[solid.material]] is named 'stel'; did you mean 'steel'?");
  EXPECT_EQ(faults(plate + "material = 'steel'\n"),
            "case.toml:9:1: error: no [[solid.material]] is named 'steel'; there is none");
  EXPECT_EQ(faults(plate + steel + steel),
            "case.toml:15:1: error: two [[solid.material]] are named 'steel'; names must differ");
  EXPECT_EQ(faults(plate + "[[solid.material]]\nname = 'lead'\ndensity = 11000.0\npoissons_ratio = 0.4\n"),
            "case.toml:9:1: error: missing key 'youngs_modulus' in [[solid.material]] 'lead'");
  EXPECT_EQ(
      faults(plate + steel, {"solid.formulation=updated_lagrangian"}),
      "case.toml:9:1: error: [[solid.material]] is for formulation = \"total_lagrangian\" or \"rigid\"; the "
      "updated form has one material");
}

TEST_F(SolidSection, NamesSeveralRigidBodies) {
  const std::string rigid = "[solid]\nformulation = 'rigid'\ndensity = 1000.0\nspacing = 0.005\n";
  const std::string region =
      "[[solid.region]]\nname = 'plate'\nbox = { min = [0.0, 0.0], max = [0.2, 0.02] }\n";
  const std::string flap = "[[solid.body]]\nname = 'flap'\nmounting = { fixed = ['x'] }\n";
  EXPECT_EQ(read(rigid + region + "body = 'flap'\n" + flap).bodies[0].mounting->fixed.size(), 1u);
  EXPECT_EQ(faults(rigid + region + "body = 'flab'\n" + flap),
            "case.toml:8:1: error: no [[solid.body]] is named 'flab'; did you mean 'flap'?\n"
            "case.toml:9:1: error: no [[solid.region]] has body = \"flap\"");
  EXPECT_EQ(faults(rigid + region + flap),
            "case.toml:5:1: error: region 'plate' needs a 'body': there are 'flap'\n"
            "case.toml:8:1: error: no [[solid.region]] has body = \"flap\"");
  EXPECT_EQ(
      faults(rigid + "mounting = {}\n" + region + "body = 'flap'\n" + flap),
      "case.toml:5:1: error: [solid.mounting] is of a rigid body that is the only one: each [[solid.body]] "
      "has its own [solid.body.mounting]");
}

TEST_F(SolidSection, TakesRigidBodiesBesideElasticRegions) {
  const std::string box =
      "[[solid.region]]\nname = 'box'\nbody = 'float'\nmaterial = 'wood'\n"
      "box = { min = [0.0, 0.1], max = [0.2, 0.12] }\n";
  const std::string wood = "[[solid.material]]\nname = 'wood'\ndensity = 600.0\n";
  const std::string body = "[[solid.body]]\nname = 'float'\n";
  const Parameters p = read(plate + box + wood + body);
  EXPECT_TRUE(p.is_mixed());
  EXPECT_EQ(p.regions[1].body, "float");
  const std::string used = used_;
  read(used);
  EXPECT_EQ(used_, used);
  EXPECT_FALSE(read(plate).has_rigid_bodies());
  EXPECT_EQ(faults(plate + "material = 'wood'\n" + box + wood + body),
            "case.toml:15:1: error: missing key 'youngs_modulus' in [[solid.material]] 'wood'\n"
            "case.toml:15:1: error: missing key 'poissons_ratio' in [[solid.material]] 'wood'");
  EXPECT_EQ(faults(plate + box + wood + "youngs_modulus = 1e9\npoissons_ratio = 0.3\n" + body),
            "case.toml:14:1: error: a material of a rigid body has a density alone");
  EXPECT_EQ(
      faults(plate + "body = 'float'\n" + box + wood + body),
      "case.toml:18:9: error: every region belongs to a rigid [[solid.body]]: give [solid] formulation = "
      "\"rigid\"");
  EXPECT_EQ(faults(plate + "body = 'float'\n"),
            "case.toml:9:1: error: no [[solid.body]] is named 'float'; there is none");
  EXPECT_EQ(
      faults(plate + box + wood + body + "[solid.wall_contact]\n"),
      "case.toml:19:8: error: [solid.wall_contact] of a rigid body needs a 'modulus' [Pa] in the place of "
      "its bulk modulus");
  EXPECT_EQ(faults(plate + box + wood + body + "[solid.mounting]\n"),
            "case.toml:19:8: error: [solid.mounting] is of a rigid body that is the only one: each "
            "[[solid.body]] has its own [solid.body.mounting]");
  EXPECT_EQ(faults(plate + box + "initial_velocity = { velocity = [1, 0] }\n" + wood + body),
            "case.toml:14:1: error: all regions of a rigid body move as one: it has [solid.initial_velocity] "
            "alone");
  EXPECT_EQ(faults(plate + "initial_velocity = { velocity = [1, 0] }\n" + box + wood + body), "");
}

TEST_F(SolidSection, RefusesTwoObserversOfOneName) {
  const std::string observer = "[[solid.observer]]\nname = 'tip'\npoint = [0.1, 0.01]\n";
  EXPECT_EQ(faults(plate + observer), "");
  EXPECT_EQ(faults(plate + observer + observer),
            "case.toml:13:1: error: two [[solid.observer]] are named 'tip'; names must differ");
}

TEST_F(SolidSection, TakesDefaultsAndLeavesModelsOff) {
  const Parameters p = read(plate);
  EXPECT_EQ(p.formulation, Formulation::total_lagrangian);
  EXPECT_DOUBLE_EQ(p.h(), 1.3 * 0.005);
  EXPECT_FALSE(p.hourglass || p.artificial_viscosity || p.artificial_stress || p.damping || p.wall_contact);
  EXPECT_DOUBLE_EQ(p.material.bulk_modulus(), 2e6 / (3 * (1 - 2 * 0.4)));
  EXPECT_DOUBLE_EQ(p.material.shear_modulus(), 2e6 / (2 * 1.4));
}

TEST_F(SolidSection, IsTheSameWhenReadFromWhatWasUsed) {
  read(plate, {"solid.hourglass.coefficient=1.2", "solid.artificial_viscosity.alpha=0.3"});
  const std::string used = used_;
  const Parameters again = read(used);
  EXPECT_EQ(again.hourglass->coefficient, 1.2);
  EXPECT_EQ(again.artificial_viscosity->alpha, 0.3);
  EXPECT_EQ(used_, used);
}

TEST_F(SolidSection, RefusesTermsOfTheOtherFormulation) {
  EXPECT_EQ(
      faults(plate + "[solid.artificial_stress]\nepsilon = 0.3\n"),
      "case.toml:9:8: error: [solid.artificial_stress] is for formulation = \"updated_lagrangian\" only");
  EXPECT_EQ(faults(plate + "[solid.hourglass]\n", {"solid.formulation=updated_lagrangian"}),
            "case.toml:9:8: error: [solid.hourglass] is for formulation = \"total_lagrangian\" only");
  EXPECT_EQ(faults("[solid]\ngradients = \"renormalised\"\n" + plate.substr(8)),
            "case.toml:2:1: error: 'gradients' in [solid] is for formulation = \"updated_lagrangian\" only; "
            "the other "
            "always renormalises");
  EXPECT_EQ(
      faults("[solid]\ncourant_number = 0.5\n" + plate.substr(8)),
      "case.toml:2:1: error: 'courant_number' in [solid] is for formulation = \"updated_lagrangian\" only; "
      "the other finds its limit");
}

TEST_F(SolidSection, ARubberTakesThePlaceOfTheElasticConstants) {
  const std::string rubber =
      "[solid.yeoh]\nc_10 = 0.5e6\nc_20 = -0.1e6\nc_30 = 0.04e6\nbulk_modulus = 20e6\n";
  std::string bare = plate + rubber;
  for (const std::string line : {"youngs_modulus = 2e6\n", "poissons_ratio = 0.4\n"})
    bare.erase(bare.find(line), line.size());
  for (const std::string& text : {plate + rubber, bare}) {
    const Parameters p = read(text);
    EXPECT_NEAR(p.material.shear_modulus() / 1e6, 1.0, 1e-14);
    EXPECT_NEAR(p.material.bulk_modulus() / 20e6, 1.0, 1e-14);
    EXPECT_EQ(used_.find("youngs_modulus"), std::string::npos) << "only what is used stands in the used case";
    EXPECT_EQ(read(used_).material.bulk_modulus(), p.material.bulk_modulus());
  }
  EXPECT_EQ(
      faults(plate + rubber, {"solid.yeoh.alpha=2e6", "solid.yeoh.beta=1"}),
      "--set solid.yeoh.alpha=2e6: error: 'alpha' in [solid.yeoh] must be below 2.24 c_10: above it the "
      "rubber gives way");
  EXPECT_EQ(faults(plate + rubber, {"solid.yeoh.alpha=1e5"}),
            "case.toml:9:8: error: 'beta' in [solid.yeoh] must be above 0 where there is an 'alpha'");
  EXPECT_EQ(faults(plate + rubber, {"solid.yeoh.c_20=-0.3e6"}),
            "--set solid.yeoh.c_20=-0.3e6: error: 'c_20' in [solid.yeoh] must be above -sqrt(3 c_10 c_30): "
            "below it "
            "the rubber gives way");
  EXPECT_EQ(
      faults(plate, {"solid.law=neo_hookean", "solid.formulation=updated_lagrangian"}),
      "--set solid.law=neo_hookean: error: 'law' and [solid.yeoh] are for formulation = \"total_lagrangian\" "
      "only; the other has Hooke's law");
}

const std::string rigid_plate = R"([solid]
formulation = "rigid"
density = 1000.0
spacing = 0.005
[[solid.region]]
name = "plate"
box = { min = [0.0, 0.0], max = [0.2, 0.02] }
)";

TEST_F(SolidSection, ARigidBodyHasADensityAndAMounting) {
  const Parameters p = read(rigid_plate + R"([solid.mounting]
fixed = ["x"]
stiffness = [0, 3]
rest = [0, 0.1]
angular_damping = 2
)");
  EXPECT_EQ(p.mounting->fixed, std::vector<std::string>{"x"});
  EXPECT_EQ(p.mounting->stiffnesses(), Coordinates(0, 3, 0));
  EXPECT_EQ(p.mounting->rests(), Coordinates(0, 0.1, 0));
  EXPECT_EQ(p.mounting->dampings(), Coordinates(0, 0, 2));
  EXPECT_FALSE(p.mounting->has_pivot());
  EXPECT_EQ(p.largest_speed(), std::numeric_limits<double>::infinity());
  const std::string used = used_;
  EXPECT_EQ(used.find("youngs_modulus"), std::string::npos);
  EXPECT_EQ(used.find("pivot"), std::string::npos);
  EXPECT_NE(described_.find("  pivot              none "), std::string::npos);
  read(used);
  EXPECT_EQ(used_, used);
}

TEST_F(SolidSection, ARigidBodyRefusesWhatDeforms) {
  EXPECT_EQ(faults("[solid]\nyoungs_modulus = 2e6\n" + rigid_plate.substr(8)),
            "case.toml:2:1: error: a rigid body has a density alone: formulation = \"rigid\" takes no "
            "'youngs_modulus'");
  EXPECT_EQ(faults("[solid]\npoissons_ratio = 0.0\n" + rigid_plate.substr(8)),
            "case.toml:2:1: error: a rigid body has a density alone: formulation = \"rigid\" takes no "
            "'poissons_ratio'");
  EXPECT_EQ(
      faults(rigid_plate + "[[solid.clamp]]\nname = 'root'\nbox = { min = [0, 0], max = [0.1, 1] }\n"),
      "case.toml:8:9: error: [[solid.clamp]] holds particles of a solid that deforms; what holds a body of "
      "formulation = \"rigid\" is [solid.mounting]");
  for (const std::string key : {"hourglass", "artificial_viscosity", "body_contact", "detachment", "bonds"})
    EXPECT_EQ(faults(rigid_plate + "[solid." + key + "]\n"),
              "case.toml:8:8: error: '" + key +
                  "' in [solid] is for a solid that deforms, not for formulation = \"rigid\"");
  EXPECT_EQ(faults(rigid_plate + "[solid.initial_velocity]\nprofile = 'bar_mode_1'\nvelocity = [1, 0]\n"),
            "case.toml:8:8: error: a rigid body starts with profile = \"uniform\", or with \"linear\" and "
            "gradient = [[0, -w], [w, 0]], a turn");
  EXPECT_EQ(
      faults(rigid_plate + "[solid.wall_contact]\n"),
      "case.toml:8:8: error: [solid.wall_contact] of a rigid body needs a 'modulus' [Pa] in the place of its "
      "bulk modulus");
  EXPECT_EQ(faults(rigid_plate + "[[solid.observer]]\nname = 'tip'\npoint = [0.1, 0.01]\nstress = true\n"),
            "case.toml:11:1: error: there is no stress in a body of formulation = \"rigid\"");
  EXPECT_EQ(
      faults(plate + "[solid.mounting]\n"),
      "case.toml:9:8: error: [solid.mounting] is for formulation = \"rigid\" only; what deforms is held by "
      "[[solid.clamp]]");
}

TEST_F(SolidSection, AMountingThatCannotBeIsRefused) {
  EXPECT_EQ(faults(rigid_plate + "[solid.mounting]\nfixed = ['z']\n"),
            "case.toml:9:10: error: 'fixed' in [solid.mounting] must be one of 'x', 'y', 'angle', found 'z'; "
            "did you mean 'x'?");
  EXPECT_EQ(faults(rigid_plate + "[solid.mounting]\nfixed = ['x']\npivot = [0, 0]\n"),
            "case.toml:10:1: error: a 'pivot' in [solid.mounting] stays: it needs fixed = [\"x\", \"y\"]");
  EXPECT_EQ(
      faults(rigid_plate + "[solid.mounting]\nfixed = ['x']\nstiffness = [1, 0]\n"),
      "case.toml:9:1: error: in [solid.mounting] neither a spring nor a damper acts on 'x', which is fixed");
  EXPECT_EQ(faults(rigid_plate + "[solid.mountin]\n"),
            "case.toml:8:8: error: unknown key 'mountin' in [solid]; did you mean 'mounting'?");
}

TEST_F(SolidSection, LooksForWhatIsDetachedFromAClampOnly) {
  EXPECT_EQ(
      faults(plate + "[solid.detachment]\n"),
      "case.toml:9:8: error: [solid.detachment] needs a [[solid.clamp]]: detached is what no chain joins "
      "to one");
  const Parameters p =
      read(plate +
           "[solid.detachment]\n[[solid.clamp]]\nname = \"root\"\nbox = { min = [0, 0], max = [0.01, 1] }\n");
  EXPECT_EQ(p.detachment->interval, 1e-3);
}

TEST_F(SolidSection, NeedsARegionAndAPositiveDensity) {
  const std::string rest = "youngs_modulus = 2e6\npoissons_ratio = 0.4\nspacing = 0.005\n";
  EXPECT_EQ(faults("[solid]\ndensity = -1.0\n" + rest),
            "case.toml:2:1: error: 'density' in [solid] must be above 0 [kg/m3], found -1");
  EXPECT_EQ(faults("[solid]\ndensity = 1.0\n" + rest),
            "case.toml:1:2: error: [solid] needs at least one [[solid.region]]");
}

}  // namespace
}  // namespace toryu::solid
