// What fluid_solver finds wrong with a case, and with a state, word for word.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace {

struct Ending {
  int code;
  std::string last_line;
};

Ending run(const std::string& arguments) {
  const std::string command = "'" FLUID_SOLVER "' '" HYDROSTATIC_TANK "' " + arguments + " 2>&1 >/dev/null";
  FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 1000> line{};
  std::string last;
  while (fgets(line.data(), line.size(), pipe)) last = line.data();
  const int status = pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, last};
}

struct Fault {
  std::string name, setting, text;
};
class FluidFault : public testing::TestWithParam<Fault> {};

TEST_P(FluidFault, HasItsText) {
  const Ending ending = run("--check --set '" + GetParam().setting + "'");
  EXPECT_EQ(ending.last_line, GetParam().text + "\n");
  EXPECT_EQ(ending.code, 2);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, FluidFault,
    testing::Values(
        Fault{"OutOfRange", "fluid.spacing=-1",
              "--set fluid.spacing=-1: error: 'spacing' in [fluid] must be above 0 [m], found -1"},
        Fault{"UnknownKeyOfATerm", "fluid.artificial_viscosity.gamma=1",
              "--set fluid.artificial_viscosity.gamma=1: error: unknown key 'gamma' in "
              "[fluid.artificial_viscosity]; known are 'alpha', 'beta'"},
        Fault{"KeyOfATermWithoutAny", "fluid.held_volume.value=1",
              "--set fluid.held_volume.value=1: error: unknown key 'value' in [fluid.held_volume], which has "
              "no keys"},
        Fault{"MissingKeyOfATerm", "fluid.laminar_viscosity={}",
              "--set fluid.laminar_viscosity={}: error: missing key 'dynamic_viscosity' in "
              "[fluid.laminar_viscosity]: a number [Pa.s] of at least 0, mu (Morris, Fox & Zhu 1997)"},
        Fault{"FitWithoutSlip", "fluid.wall_model={slip=\"free_slip\", extrapolation=\"fit\"}",
              "--set fluid.wall_model={slip=\"free_slip\", extrapolation=\"fit\"}: error: a 'fit' is of what "
              "viscous "
              "terms see at walls: it needs slip = \"no_slip\""},
        Fault{"SlipWithoutViscosity",
              "fluid.artificial_viscosity=false' --set 'fluid.wall_slip={coefficient=1e-7}",
              "--set fluid.wall_slip={coefficient=1e-7}: error: [fluid.wall_slip] needs a medium with a "
              "viscosity, "
              "of which the walls' shear stress comes: [fluid.laminar_viscosity], [fluid.power_law], "
              "[fluid.herschel_bulkley] or [fluid.carreau]"},
        Fault{
            "SlipWithoutBound",
            "fluid.artificial_viscosity=false' --set 'fluid.laminar_viscosity.dynamic_viscosity=1' --set "
            "'fluid.wall_slip={coefficient=1e300}",
            "--set fluid.wall_slip={coefficient=1e300}: error: 'coefficient' in [fluid.wall_slip] must be at "
            "most 1e+06: walls without shear stress are slip = \"free_slip\" of [fluid.wall_model]"},
        Fault{
            "RemovalByAPolymer",
            "wall.0.work_piece=true' --set 'fluid.laminar_viscosity.dynamic_viscosity=1' --set "
            "'fluid.viscoelasticity.mode=[{relaxation_time=1, polymer_viscosity=1}]' --set "
            "'fluid.removal={shear_coefficient=1}",
            "--set fluid.removal={shear_coefficient=1}: error: [fluid.removal] knows the shear stress of the "
            "viscosity alone: it does not go with [fluid.viscoelasticity]"},
        Fault{
            "SlipOfFreeSlip",
            "fluid.artificial_viscosity=false' --set 'fluid.laminar_viscosity.dynamic_viscosity=1' --set "
            "'fluid.wall_model.slip=\"free_slip\"' --set "
            "'fluid.wall_slip={coefficient=1e-7}",
            "--set fluid.wall_slip={coefficient=1e-7}: error: [fluid.wall_slip] acts on the shear stress of "
            "walls "
            "that are no-slip otherwise; under slip = \"free_slip\" there is none: leave one of the two out"},
        Fault{
            "SlipBesideArtificialViscosity",
            "fluid.laminar_viscosity.dynamic_viscosity=1' --set 'fluid.artificial_viscosity.alpha=0.1' --set "
            "'fluid.wall_slip={coefficient=1e-7}",
            "--set fluid.wall_slip={coefficient=1e-7}: error: artificial viscosity brakes the medium at "
            "walls "
            "whatever [fluid.wall_slip] says: leave one of the two out"},
        Fault{"SlipBesideFrictionAsPrinted",
              "wall.0.work_piece=true' --set 'fluid.laminar_viscosity.dynamic_viscosity=1' --set "
              "'fluid.artificial_viscosity=false' --set "
              "'fluid.friction={coefficient=0.1,form=\"as_printed\"}' --set "
              "'fluid.wall_slip={coefficient=1e-7}",
              "--set fluid.wall_slip={coefficient=1e-7}: error: beside [fluid.wall_slip] the friction of a "
              "work piece "
              "is mu_A p: [fluid.friction] takes form = \"normalised\""},
        Fault{"SlipWithoutCoefficient", "fluid.wall_slip={exponent=2}",
              "--set fluid.wall_slip={exponent=2}: error: missing key 'coefficient' in [fluid.wall_slip]: a "
              "number "
              "[m/s/Pa^exponent] of at least 0, b of u_s = b (tau_w - tau_c)^m (Navier 1823); 0: the medium "
              "sticks"},
        Fault{"SlipByNoPower", "fluid.wall_slip={coefficient=1,exponent=0}",
              "--set fluid.wall_slip={coefficient=1,exponent=0}: error: 'exponent' in [fluid.wall_slip] must "
              "be above "
              "0 and up to 10, found 0"},
        Fault{"SlipBelowNothing", "fluid.wall_slip={coefficient=1,threshold=-1}",
              "--set fluid.wall_slip={coefficient=1,threshold=-1}: error: 'threshold' in [fluid.wall_slip] "
              "must be at "
              "least 0 [Pa], found -1"},
        Fault{"RemovalByNoLaw", "wall.0.work_piece=true' --set 'fluid.removal={shear_coefficient=0}",
              "--set fluid.removal={shear_coefficient=0}: error: [fluid.removal] needs a "
              "preston_coefficient, a "
              "shear_coefficient or [fluid.removal.archard]"},
        Fault{"MeanPressureUnderAFreeSurface", "fluid.enclosed_medium.mean_pressure=1",
              "--set fluid.enclosed_medium.mean_pressure=1: error: the fluid has a free surface at the "
              "start, where "
              "its pressure is 0: it is not enclosed"},
        Fault{
            "VolumeUnderAFreeSurface", "fluid.held_volume={}",
            "--set fluid.held_volume={}: error: the fluid has a free surface at the start: nothing holds its "
            "volume"},
        Fault{"VolumeBesidePresses",
              "fluid.held_volume={}' --set 'wall.0.press={force=[[0,1]], direction=\"+y\", travel=[0,1e-9]}",
              "--set fluid.held_volume={}: error: pressed walls, a solid and open ends leave the "
              "medium no "
              "volume of its own: leave it out"},
        Fault{"EnclosedByNothing", "fluid.enclosed_medium={}",
              "--set fluid.enclosed_medium={}: error: without a pressed wall the medium needs a "
              "'mean_pressure' above 0"},
        Fault{"MeanPressureBesidePresses",
              "fluid.enclosed_medium.mean_pressure=1' --set 'wall.0.press={force=[[0,1]], direction=\"+y\", "
              "travel=[0,1e-9]}",
              "--set fluid.enclosed_medium.mean_pressure=1: error: the walls that are pressed set the mean "
              "pressure: leave it out"},
        Fault{"PressByTheMidpointRule",
              "fluid.integrator=midpoint' --set 'wall.0.press={force=[[0,1]], direction=\"+y\", "
              "travel=[0,1e-9]}",
              "--set fluid.integrator=midpoint: error: walls that are pressed go with the 'symplectic' steps "
              "alone: others feed them"},
        Fault{"WrongChoice", "fluid.wall_model.slip=slippery",
              "--set fluid.wall_model.slip=slippery: error: 'slip' in [fluid.wall_model] must be one of "
              "'no_slip', 'free_slip', found 'slippery'"},
        Fault{"ColumnOfTheResults", "fluid.observer=[{name=\"kinetic_energy\",quantity=\"front_x\"}]",
              "--set fluid.observer=[{name=\"kinetic_energy\",quantity=\"front_x\"}]: error: two columns "
              "of the results would be named 'kinetic_energy': an observer, a "
              "region or a wall needs another name"},
        Fault{"ColumnOfTheRemoval",
              "wall.0.work_piece=true' --set 'fluid.friction.coefficient=0.3' --set "
              "'fluid.removal.preston_coefficient=1e-9' --set "
              "'fluid.observer=[{name=\"removed_area\",quantity=\"front_x\"}]",
              "--set fluid.observer=[{name=\"removed_area\",quantity=\"front_x\"}]: error: two columns "
              "of the results would be named 'removed_area': an observer, a "
              "region or a wall needs another name"},
        Fault{"FrictionOnNothing", "fluid.friction.coefficient=0.3",
              "--set fluid.friction.coefficient=0.3: error: there is nothing to rub on: friction acts on a "
              "[[wall]] "
              "with 'work_piece = true' and on the solid of a coupled case"},
        Fault{"RemovalFromNothing", "fluid.removal.preston_coefficient=1e-9",
              "--set fluid.removal.preston_coefficient=1e-9: error: there is nothing to wear: it takes a "
              "[[wall]] with 'work_piece = true' or the solid of a coupled case"},
        Fault{"NameThatNoColumnCanHave", "wall.0.name=\"left,right\"",
              "--set wall.0.name=\"left,right\": error: 'name' in [[wall]] names columns of the results: it "
              "must not be empty nor hold any of , ; [ ] \" or a line break, found 'left,right'"},
        Fault{"ObserverWithoutName", "fluid.observer=[{name=\"\", quantity=\"front_x\"}]",
              "--set fluid.observer=[{name=\"\", quantity=\"front_x\"}]: error: 'name' in "
              "[[fluid.observer]] names columns of the results: it must not be empty nor hold any of , ; [ ] "
              "\" or a line break, found ''"},
        Fault{"NoRegion", "fluid.region=[]",
              "--set fluid.region=[]: error: a fluid needs at least one [[fluid.region]]"},
        Fault{
            "SameObserverTwice",
            "fluid.observer=[{name=\"p\", quantity=\"pressure\"}, {name=\"p\", quantity=\"front_x\"}]",
            "--set fluid.observer=[{name=\"p\", quantity=\"pressure\"}, {name=\"p\", quantity=\"front_x\"}]: "
            "error: two [[fluid.observer]] are named 'p'; names must differ"},
        Fault{
            "FlowRateWithoutBox", "fluid.observer=[{name=\"q\", quantity=\"flow_rate\"}]",
            "--set fluid.observer=[{name=\"q\", quantity=\"flow_rate\"}]: error: a flow rate needs a 'box'"},
        Fault{"LargestVoidWithoutBox", "fluid.observer=[{name=\"q\", quantity=\"largest_void\"}]",
              "--set fluid.observer=[{name=\"q\", quantity=\"largest_void\"}]: error: a largest void needs a "
              "'box'"},
        Fault{"FluidInAWall", "fluid.region.water.box.min=[-0.1,0]",
              "--set fluid.region.water.box.min=[-0.1,0]: error: the fluid's region 'water' overlaps the "
              "wall 'left' "
              "near (-0.05, 0.5) m"},
        Fault{
            "TwoViscosities",
            "fluid.laminar_viscosity.dynamic_viscosity=1' --set 'fluid.power_law={consistency=2, "
            "exponent=0.5, "
            "smallest_viscosity=1, largest_viscosity=9}",
            "--set fluid.power_law={consistency=2, exponent=0.5, smallest_viscosity=1, largest_viscosity=9}: "
            "error: only one of 'laminar_viscosity', 'power_law', 'herschel_bulkley', 'carreau' and 'medium' "
            "may be "
            "given"},
        Fault{
            "BoundsOfTheViscosity",
            "fluid.power_law={consistency=2, exponent=0.5, smallest_viscosity=9, largest_viscosity=1}",
            "--set fluid.power_law={consistency=2, exponent=0.5, smallest_viscosity=9, largest_viscosity=1}: "
            "error: 'largest_viscosity' must be at least 'smallest_viscosity'"},
        Fault{"NoModeOfTheStress", "fluid.viscoelasticity={}",
              "--set fluid.viscoelasticity={}: error: a viscoelastic medium has one to 4 "
              "[[fluid.viscoelasticity.mode]]"},
        Fault{
            "PolymerWithoutSolvent",
            "fluid.viscoelasticity={mode=[{relaxation_time=1, polymer_viscosity=2}]}",
            "--set fluid.viscoelasticity={mode=[{relaxation_time=1, polymer_viscosity=2}]}: error: a polymer "
            "needs a solvent, which damps what its stress does not see: give a [fluid.laminar_viscosity]"},
        Fault{"PolymerAtSlipperyWalls",
              "fluid.viscoelasticity={mode=[{relaxation_time=1, polymer_viscosity=2}]}' --set "
              "'fluid.carreau={zero_shear_viscosity=2, infinite_shear_viscosity=1, relaxation_time=1, "
              "exponent=0.5}' --set 'fluid.wall_model.slip=free_slip",
              "--set fluid.viscoelasticity={mode=[{relaxation_time=1, polymer_viscosity=2}]}: error: walls "
              "take "
              "the polymer's stress along with the fluid's before them: it needs [fluid.wall_model] slip = "
              "\"no_slip\""},
        Fault{"MediumOfNoName", "fluid.medium.name=honey",
              "--set fluid.medium.name=honey: error: 'name' in [fluid.medium] must be one of 'trengove_c11', "
              "'newtonian_1000', 'thinning_1000', found 'honey'"},
        Fault{
            "TemperatureOutsideItsTable", "fluid.temperature={value=330, shift_factors=[[290,2],[310,1]]}",
            "--set fluid.temperature={value=330, shift_factors=[[290,2],[310,1]]}: error: 'value' 330 K lies "
            "outside 'shift_factors', which go from 290 to 310 K: what the medium does there is not known"},
        Fault{"TemperatureWithoutThatOfTheConstants",
              "fluid.temperature={value=300, shift_factors=[[290,5],[310,3]]}",
              "--set fluid.temperature={value=300, shift_factors=[[290,5],[310,3]]}: error: no factor in "
              "'shift_factors' is 1, and none lies on either side of it: the temperature at which the "
              "constants "
              "of the medium were measured must be among the rows"},
        Fault{"TemperatureThatFalls", "fluid.temperature={value=300, shift_factors=[[310,1],[290,2]]}",
              "--set fluid.temperature={value=300, shift_factors=[[310,1],[290,2]]}: error: 'shift_factors' "
              "needs "
              "a row, and temperatures that rise from row to row"},
        Fault{"TemperatureOfNoViscosity", "fluid.temperature={value=300, shift_factors=[[290,2],[310,1]]}",
              "--set fluid.temperature={value=300, shift_factors=[[290,2],[310,1]]}: error: a temperature "
              "changes "
              "a viscosity, and none is given"},
        Fault{"PlateausOfCarreau",
              "fluid.carreau={zero_shear_viscosity=1, infinite_shear_viscosity=2, relaxation_time=1, "
              "exponent=0.5}",
              "--set fluid.carreau={zero_shear_viscosity=1, infinite_shear_viscosity=2, relaxation_time=1, "
              "exponent=0.5}: error: 'infinite_shear_viscosity' must not exceed 'zero_shear_viscosity'; what "
              "thickens "
              "under shear has an exponent above 1"},
        Fault{
            "TermThatImplicitStepsHaveNot",
            "fluid.artificial_viscosity=false' --set 'fluid.density_diffusion=false' --set "
            "'fluid.laminar_viscosity.dynamic_viscosity=100' --set 'fluid.surface_tension.coefficient=1' "
            "--set 'fluid.model=implicit",
            "--set fluid.surface_tension.coefficient=1: error: [fluid.surface_tension] is not part of model "
            "= \"implicit\""},
        Fault{"ImplicitStepsUnderAFreeSurface",
              "fluid.artificial_viscosity=false' --set 'fluid.density_diffusion=false' --set "
              "'fluid.laminar_viscosity.dynamic_viscosity=100' --set 'fluid.model=implicit",
              "--set fluid.model=implicit: error: the fluid has a free surface at the start, and model = "
              "\"implicit\" is for media "
              "that walls or periods enclose"},
        Fault{"ImplicitWallThatTurns",
              "fluid.artificial_viscosity=false' --set 'fluid.density_diffusion=false' --set "
              "'fluid.hydrostatic_start=false' --set 'fluid.laminar_viscosity.dynamic_viscosity=100' --set "
              "'fluid.model=implicit' --set '"
              "wall.floor.motion.rotation={about=[0,0], angular_velocity=[[0,1e-9]]}",
              HYDROSTATIC_TANK
              "/case.toml:14:1: error: the wall 'floor' turns, which is not part of model = \"implicit\""},
        Fault{"ImplicitGravityThatChanges",
              "fluid.artificial_viscosity=false' --set 'fluid.density_diffusion=false' --set "
              "'fluid.hydrostatic_start=false' --set 'fluid.laminar_viscosity.dynamic_viscosity=100' --set "
              "'fluid.model=implicit' --set '"
              "case.gravity_change.acceleration=[[0,1,0]]",
              "--set case.gravity_change.acceleration=[[0,1,0]]: error: gravity that changes is not part of "
              "model = \"implicit\""},
        Fault{"GravityThatDoesNotChange", "case.gravity_change={}",
              "--set case.gravity_change={}: error: a change of gravity needs rows of its 'acceleration', a "
              "'sine' or a 'turning'"},
        Fault{"SolverOfAnotherModel", "fluid.implicit.tolerance=1e-3",
              "--set fluid.implicit.tolerance=1e-3: error: [fluid.implicit] is for model = \"implicit\""},
        Fault{"WallInAWall", "wall.left.box.min=[-0.2,-0.1]",
              "--set wall.left.box.min=[-0.2,-0.1]: error: the wall 'left' overlaps the wall 'floor' near "
              "(-0.1, -0.05) m"},
        Fault{
            "HolesOfOneName",
            "fluid.hole=[{name=\"a\",min=[0.2,0.2],max=[0.4,0.4]},{name=\"a\",min=[0.6,0.6],max=[0.8,0.8]}]",
            "--set "
            "fluid.hole=[{name=\"a\",min=[0.2,0.2],max=[0.4,0.4]},{name=\"a\",min=[0.6,0.6],max=[0.8,0.8]}]: "
            "error: two [[fluid.hole]] are named 'a'; names must differ"},
        Fault{"RegionWithoutParticles",
              "fluid.region=[{name=\"film\",box={min=[0,0],max=[1,0.02]}}]' --set "
              "'fluid.hydrostatic_start=false",
              "--set fluid.region=[{name=\"film\",box={min=[0,0],max=[1,0.02]}}]: error: region 'film' holds "
              "no "
              "particle at this spacing"},
        Fault{"WallWithoutParticles", "wall.left.box.max=[-0.19,1.2]",
              "--set wall.left.box.max=[-0.19,1.2]: error: wall 'left' holds no particle at this spacing"},
        Fault{"StartTooFast", "fluid.region.water.velocity=[40,0]",
              HYDROSTATIC_TANK "/case.toml:24:2: error: cannot start: fluid particle 0 at t = 0 s: speed "
                               "[m/s] = 40, limit 31.3"},
        Fault{"StartTooDense", "fluid.limits.largest_density_change=0.001",
              HYDROSTATIC_TANK "/case.toml:26:1: error: 'sound_speed' 31.3 m/s is too low for fluid at rest "
                               "1 m deep: its density would be "
                               "1009.77 kg/m3 at the bottom, at most 1001 are allowed; ten times the speed "
                               "of a fall through that depth "
                               "is 44.3 m/s"},
        Fault{"SurfaceBelowTheFluid", "fluid.hydrostatic_start.surface_level=-500",
              "--set fluid.hydrostatic_start.surface_level=-500: error: 'surface_level' -500 m lies below "
              "all of "
              "the fluid, which reaches from 0 to 1 m against gravity"},
        Fault{"SoundTooSlow", "fluid.sound_speed=2",
              "--set fluid.sound_speed=2: error: 'sound_speed' 2 m/s is too low for fluid at rest 1 m deep: "
              "its density "
              "would be 1582.65 kg/m3 at the bottom, at most 1300 are allowed; ten times the speed of a fall "
              "through "
              "that depth is 44.3 m/s"},
        Fault{"StartOutsideTheDomain", "fluid.region.water.box.max=[1.0,1.6]",
              HYDROSTATIC_TANK "/case.toml:24:2: error: cannot start: fluid particle 600 at t = 0 s: "
                               "position (0.025, 1.525) [m], "
                               "outside by "
                               "= 0.025, limit the domain of the case"}),
    [](const auto& one) { return one.param.name; });

TEST(FluidCheck, DoesNotLookAtTheSpaceBetweenRegionsThatAreFarApart) {
  // Hours, where it does: 31 s at a thousandth of the distance.
  EXPECT_EQ(run("--check --set 'case.domain={min=[-5e6,-5e6],max=[5e6,5e6]}' --set "
                "'fluid.region=[{name=\"near\",box={min=[0,0],max=[1,1]}},{name=\"far\",box={min=[3e6,0],"
                "max=[3000001,1]}}]'")
                .code,
            0);
}

TEST(FluidRotation, IsRefusedWhereItsPressureIsNotKnown) {
  const std::string flow = "fluid.initial_flow={profile=\"rotation\",speed=1.0,length=1.0}";
  const auto check = [&](const std::string& body) { return run("--check --set '" + flow + "'" + body); };
  EXPECT_EQ(check("").code, 0) << "a square";
  for (const char* body :
       {" --set 'fluid.region.water.box.max=[1.0,0.5]'", " --set fluid.region.water.box.round=true",
        " --set 'fluid.hole=[{min=[0.4,0.4],max=[0.6,0.6]}]'"}) {
    const Ending ending = check(body);
    EXPECT_EQ(ending.code, 2) << body;
    EXPECT_THAT(ending.last_line, testing::HasSubstr("the pressure of a rotation is known of a square alone"))
        << body;
  }
}

TEST(FluidPress, IsRefusedWhereTheSoundSpeedDoesNotBearIt) {
  const auto pressed = [](const std::string& rows) {
    return run(
        "--check --set fluid.integrator=symplectic --set 'wall.floor.press={direction=\"+y\","
        "travel=[0,0.001]," +
        rows + "}'");
  };
  EXPECT_EQ(pressed("pressure=[[0,9810]]").code, 0);
  for (const auto& [rows, told] : std::vector<std::pair<std::string, std::string>>{
           {"pressure=[[0,0],[1,1e300]]", "1e+300 Pa at t = 1 s"}, {"force=[[0,-1e300]]", "Pa at t = 0 s"}}) {
    const Ending ending = pressed(rows);
    EXPECT_EQ(ending.code, 2) << rows;
    EXPECT_THAT(ending.last_line, testing::HasSubstr("error: the press 'floor' is at")) << rows;
    EXPECT_THAT(ending.last_line,
                testing::HasSubstr(told + ": by that the density would change by more than 10 %"))
        << rows;
  }
}

TEST(FluidFailure, NamesParticleTimeValueAndLimit) {
  const auto out =
      std::filesystem::temp_directory_path() / ("toryu_fluid_failure_" + std::to_string(getpid()));
  const Ending ending = run("--threads 1 --out '" + out.string() + "' --set fluid.limits.largest_speed=1e-9");
  std::filesystem::remove_all(out);
  EXPECT_THAT(ending.last_line,
              testing::MatchesRegex("fluid_solver: error: physics failed: fluid particle [0-9]+ at t = "
                                    "[0-9.e-]+ s: speed .m/s. = [0-9.e-]+, limit 1e-09\n"));
  EXPECT_EQ(ending.code, 3);
}

}  // namespace
