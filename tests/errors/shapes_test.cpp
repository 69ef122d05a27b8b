// The exact text of each fault of a shape, and what shapes come to.
#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/bodies.hpp"
#include "common/scene/outline.hpp"
#include "tests/errors/case_text.hpp"

namespace toryu {
namespace {

const std::string tank =
    "[case]\ntitle='A'\nend_time=1\ndomain={min=[-9,-9], max=[9,9]}\n[[wall]]\nname='w'\n";

std::string faults_of(const std::string& shape) {
  return CaseText(tank + shape).scene_faults();
}

TEST(ShapeFaults, None) {
  EXPECT_EQ(faults_of("circle={centre=[0,0], radius=1}\n"), "");
  EXPECT_EQ(faults_of("polygon=[[0,0],[2,0],[2,1]]\nrotate=30\nabout=[1,0]\n"), "");
}

TEST(ShapeFaults, OfNoShapeOrTwo) {
  EXPECT_EQ(
      faults_of(""),
      "case.toml:5:1: error: a shape is missing: a body has one of 'box', 'circle', 'polygon' and 'file'");
  EXPECT_EQ(faults_of("circle={centre=[0,0], radius=1}\nbox={min=[0,0], max=[1,1]}\n"),
            "case.toml:7:1: error: 'box' and 'circle' are both there: a body has one of 'box', 'circle', "
            "'polygon' and 'file'");
  EXPECT_EQ(faults_of("box=false\npolygon=[[0,0],[2,0],[2,1]]\n"), "");
}

TEST(ShapeFaults, OfAMistypedKey) {
  EXPECT_EQ(
      faults_of("circel={centre=[0,0], radius=1}\n"),
      "case.toml:5:1: error: a shape is missing: a body has one of 'box', 'circle', 'polygon' and 'file'\n"
      "case.toml:7:1: error: unknown key 'circel' in [[wall]]; did you mean 'circle'?");
}

TEST(ShapeFaults, OfACircle) {
  EXPECT_EQ(faults_of("circle={centre=[0,0], radius=0}\n"),
            "case.toml:7:23: error: 'radius' in [wall.circle] must be above 0 [m], found 0");
}

TEST(ShapeFaults, OfAPolygonThatCrossesItself) {
  EXPECT_EQ(faults_of("polygon=[[0,0],[2,2],[2,0],[0,2]]\n"),
            "case.toml:7:1: error: 'polygon' crosses or touches itself at (1, 1) m, at its corner 0, counted "
            "from 0");
  EXPECT_EQ(faults_of("polygon=[[0,0],[2,2]]\n"),
            "case.toml:7:1: error: 'polygon' has 2 corners; an outline has at least 3, at its corner 0, "
            "counted from 0");
}

TEST(ShapeFaults, OfHoles) {
  EXPECT_EQ(faults_of("polygon=[[0,0],[4,0],[4,4],[0,4]]\nholes=[[[1,1],[2,1],[2,2]]]\n"), "");
  EXPECT_EQ(faults_of("polygon=[[0,0],[4,0],[4,4],[0,4]]\nholes=[[[5,5],[6,5],[6,6]]]\n"),
            "case.toml:8:1: error: hole 0 of 'polygon', counted from 0, lies outside of it");
  EXPECT_EQ(faults_of("box={min=[0,0], max=[1,1]}\nholes=[[[5,5],[6,5],[6,6]]]\n"),
            "case.toml:8:1: error: 'holes' are those of a 'polygon'");
}

TEST(ShapeFaults, OfCopiesThatOverlap) {
  EXPECT_EQ(faults_of("box={min=[0,0], max=[1,1]}\narray={count=2, translate=[0.5,0.5]}\n"),
            "case.toml:8:1: error: copies overlap or touch: one crosses or touches itself at (0.5, 1) m");
}

TEST(ShapeFaults, OfAWallBeyondTheDomain) {
  EXPECT_EQ(faults_of("circle={centre=[8,0], radius=2}\n"),
            "case.toml:7:1: error: the outline of wall 'w' is not within [case.domain]");
}

/// The same with a file beside the case.
std::string faults_with(const std::string& name, const std::string& text, const std::string& keys = "") {
  const CaseText written(tank + "file='" + name + "'\n" + keys);
  written.add(name, text);
  return written.scene_faults();
}

TEST(ShapeFaults, OfACsv) {
  EXPECT_EQ(faults_with("part.csv", "x[mm],y[mm]\n0,0\n2,0\n2,1\n"), "");
  EXPECT_EQ(faults_with("part.csv", "0,0\n2,0\n2,1\n"),
            "case.toml:7:1: error: 'part.csv': the file does not say its unit in a header such as "
            "'x[mm],y[mm]': give 'unit', one of 'm', 'cm', 'mm', 'um', 'in'");
  EXPECT_EQ(faults_with("part.csv", "0,0\n2,0\n2,1\n", "unit='cm'\n"), "");
  EXPECT_EQ(faults_with("part.csv", "x[mm],y[mm]\n0,0\n2,0\n2,1\n", "unit='cm'\n"),
            "case.toml:8:1: error: the file says its unit is mm: leave 'unit' out");
  EXPECT_EQ(faults_with("part.csv", "x[mm],y[mm]\n0,0\n2,o\n2,1\n"),
            "case.toml:7:1: error: 'part.csv': line 3: 'o' is no number");
  EXPECT_EQ(
      faults_with("part.csv", "x[mm];y[mm]\n0;0\n"),
      "case.toml:7:1: error: 'part.csv': line 1: 1 columns; there are x and y, or ring, x and y; commas "
      "part columns");
  EXPECT_EQ(
      faults_with("part.csv", "x[mm],y[mm]\n0,0\n2000,2000\n2000,0\n0,2000\n"),
      "case.toml:7:1: error: the outline crosses or touches itself at (1, 1) m, at its corner 0, counted "
      "from 0");
}

TEST(ShapeFaults, OfAFileThatIsNotThereOrOfAnotherKind) {
  const CaseText written(tank + "file='prat.csv'\n");
  written.add("part.csv", "");
  EXPECT_EQ(written.scene_faults(),
            "case.toml:7:1: error: no file 'prat.csv' in the folder of the case; did you mean 'part.csv'?");
  EXPECT_EQ(faults_with("part.step", ""), "case.toml:7:1: error: 'part.step' is none of .svg, .dxf and .csv");
  EXPECT_EQ(faults_with("part.csv", "x[m],y[m]\n0,0\n2,0\n2,1\n", "id='a'\n"),
            "case.toml:8:1: error: 'id' is that of an element of an .svg");
  EXPECT_EQ(faults_of("box={min=[0,0], max=[1,1]}\nunit='mm'\n"),
            "case.toml:8:1: error: 'unit' is that of a 'file'");
}

/// The wall of a case.
Box wall_of(const std::string& shape) {
  const CaseText written(tank + shape);
  CaseFile file(written.folder(), {});
  const Scene scene = read_scene(file);
  file.throw_if_faulty();
  return scene.walls[0].box;
}

TEST(Shapes, ThatStayBoxes) {
  const Box box = wall_of("box={min=[0.1,0.2], max=[0.7,0.3]}\n");
  EXPECT_TRUE(box.is_rectangle());
  EXPECT_EQ(box.min, Vec(0.1, 0.2));
  EXPECT_EQ(box.max, Vec(0.7, 0.3));
  // (x, y) -> (-x, y), twice as large, a quarter turn anticlockwise to (-y, x), then by (1, 0)
  const Box moved = wall_of("box={min=[1,2], max=[3,4]}\nmirror='x'\nscale=2\nrotate=90\ntranslate=[1,0]\n");
  EXPECT_TRUE(moved.is_rectangle());
  EXPECT_EQ(moved.min, Vec(-7, -6));
  EXPECT_EQ(moved.max, Vec(-3, -2));
}

TEST(Shapes, OfABoxThatIsTurned) {
  const Box box = wall_of("box={min=[0,0], max=[2,1]}\nrotate=30\n");
  ASSERT_TRUE(box.outline);
  EXPECT_NEAR(box.outline->area(), 2, 1e-12);
  EXPECT_NEAR(box.max[0], 2 * std::cos(M_PI / 6), 1e-12);
  EXPECT_NEAR(box.max[1], 2 * 0.5 + std::cos(M_PI / 6), 1e-12);
  EXPECT_NEAR(box.min[0], -0.5, 1e-12);
  EXPECT_TRUE(box.contains({0.1, 0.1}));
  EXPECT_FALSE(box.contains({-0.4, 0.1}));
}

TEST(ShapeFaults, OfPlacesWhereNothingIsLeft) {
  const std::string square = "polygon=[[1,1],[2,1],[2,2],[1,2]]\n", box = "box={min=[1,1], max=[2,2]}\n",
                    lost = ", mirrored, scaled, rotated and moved, has ";
  EXPECT_THAT(
      faults_of(square + "translate=[1e308,0]\n"),
      testing::HasSubstr("case.toml:7:1: error: 'polygon'" + lost + "the corner (1e+308, 1) m twice"));
  EXPECT_THAT(faults_of(square + "scale=1e-300\nabout=[1,0]\n"),
              testing::HasSubstr("'polygon'" + lost + "the corner (1, 1e-300) m twice"));
  EXPECT_THAT(faults_of(square + "scale=1e308\n"),
              testing::HasSubstr("'polygon'" + lost + "a corner that is no number"));
  EXPECT_THAT(faults_of(box + "translate=[0,1e300]\n"), testing::HasSubstr("'box'" + lost + "the corner"));
  EXPECT_EQ(faults_of(box + "translate=[0,5]\nscale=1e-3\n"), "");
}

TEST(ShapeFaults, OfTurnsInNoDegrees) {
  const std::string square = "polygon=[[1,1],[2,1],[2,2],[1,2]]\n";
  EXPECT_THAT(
      faults_of(square + "rotate=1e308\n"),
      testing::HasSubstr("case.toml:8:1: error: 'rotate' in [[wall]] must be from -360 to 360 [degrees]"));
  EXPECT_THAT(faults_of(square + "array={count=2, rotate=361}\n"), testing::HasSubstr("'rotate'"));
  EXPECT_EQ(faults_of(square + "rotate=-360\n"), "");
}

TEST(Shapes, OfACircleHaveItsAreaAndKeepTheTolerance) {
  const Box disc = wall_of("circle={centre=[1,2], radius=3}\ntolerance=0.01\n");
  ASSERT_TRUE(disc.outline);
  EXPECT_NEAR(disc.outline->area(), 9 * M_PI, 1e-9);
  for (const Vec& corner : disc.outline->rings()[0]) EXPECT_NEAR((corner - Vec(1, 2)).norm(), 3, 0.01);
  EXPECT_LT(disc.outline->rings()[0].size(), 50u);
}

TEST(Shapes, OfAnArrayAreAllCopies) {
  const Box pins = wall_of("circle={centre=[2,0], radius=0.5}\narray={count=4, rotate=90}\n");
  ASSERT_TRUE(pins.outline);
  EXPECT_EQ(pins.outline->rings().size(), 4u);
  EXPECT_NEAR(pins.outline->area(), M_PI, 1e-9);
  EXPECT_TRUE(pins.contains({-2, 0.1}));
  EXPECT_FALSE(pins.contains({0, 0}));
}

TEST(Shapes, OfACsvAreInMetres) {
  const CaseText written(tank + "file='part.csv'\ntranslate=[1,0]\n");
  written.add(
      "part.csv",
      "# a frame\nring,x[cm],y[cm]\n0,0,0\n0,400,0\n0,400,400\n0,0,400\n1,100,100\n1,200,100\n1,200,200\n");
  CaseFile file(written.folder(), {});
  const Box box = read_scene(file).walls[0].box;
  file.throw_if_faulty();
  EXPECT_NEAR(box.outline->area(), 16 - 0.5, 1e-12);
  EXPECT_EQ(box.min, Vec(1, 0));
}

const std::string tank_of_water =
    tank + "circle={centre=[0,0], radius=1}\n[fluid]\nspacing=0.1\n[[fluid.region]]\nname='water'\n";

TEST(Shapes, AreLeftOutOfTheFluidUnlessTheyAreBoxes) {
  const CaseText written(tank_of_water + "box={min=[0,0], max=[3,3]}\n");
  EXPECT_EQ(written.scene_faults(), "");
  CaseFile file(written.folder(), {});
  EXPECT_EQ(left_out_of_fluid(file, read_scene(file)).size(), 1u);
  EXPECT_EQ(CaseText(tank + "box={min=[-1,-1], max=[1,1]}\n[fluid]\nspacing=0.1\n[[fluid.region]]\n"
                            "name='water'\ncircle={centre=[0,0], radius=2}\n")
                .scene_faults(),
            "case.toml:12:1: error: the fluid's region 'water' overlaps the wall 'w' near (-0.963906, "
            "-0.963906) m");
}

TEST(Shapes, ThatOverlapAreFaults) {
  // a roof that dips into the floor by a hundredth along its lower edge, far less than a 32nd of its extent
  const std::string floor = tank + "box={min=[-5,-1], max=[5,0]}\n[fluid]\nspacing=0.05\n";
  const auto roof = [&](double y) {
    return CaseText(floor + fmt::format("[[wall]]\nname='roof'\npolygon=[[-4,4],[-4,{0}],[4,{0}],[4,4]]\n"
                                        "rotate=0\n",
                                        y))
        .scene_faults();
  };
  EXPECT_EQ(roof(-0.004), "");
  EXPECT_THAT(roof(-0.01), testing::HasSubstr("the wall 'roof' overlaps the wall 'w'"));
}

TEST(Shapes, ThatRunIntoEachOtherAreFaults) {
  const std::string ram = tank +
                          "circle={centre=[-3,0], radius=1}\nmotion={velocity=[[0,4,0]]}\n"
                          "[fluid]\nspacing=0.1\n";
  EXPECT_EQ(CaseText(ram + "[[wall]]\nname='post'\ncircle={centre=[4,0], radius=1}\n").scene_faults(), "");
  EXPECT_THAT(CaseText(ram + "[[wall]]\nname='post'\ncircle={centre=[0,0], radius=1}\n").scene_faults(),
              testing::HasSubstr("case.toml:13:1: error: the wall 'post' runs into the wall 'w' at t = 0.2"));
}

TEST(Shapes, AreUsedAsTheyAreGiven) {
  const CaseText written(tank +
                         "polygon=[[0,0],[4,0],[4,4],[0,4]]\nholes=[[[1,1],[2,1],[2,2]]]\nrotate=30\n");
  CaseFile file(written.folder(), {});
  read_scene(file);
  EXPECT_THAT(file.used(), testing::HasSubstr("polygon = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]]\n"
                                              "holes = [[[1.0, 1.0], [2.0, 1.0], [2.0, 2.0]]]\n"
                                              "rotate = 30.0\n"));
  const CaseText again(file.used());
  CaseFile repeated(again.folder(), {});
  read_scene(repeated);
  EXPECT_NO_THROW(repeated.throw_if_faulty());
  EXPECT_EQ(repeated.used(), file.used());
}

TEST(Shapes, OfBoxesAddNothingToTheUsedCase) {
  const CaseText written(tank + "box={min=[0,0], max=[1,1]}\n");
  CaseFile file(written.folder(), {});
  read_scene(file);
  const std::string used = file.used();
  EXPECT_EQ(used.substr(used.find("[[wall]]")),
            "[[wall]]\nname = \"w\"\nwork_piece = false\n\n[wall.box]\nmin = [0.0, 0.0]\nmax = [1.0, "
            "1.0]\nround = false\n");
}

TEST(Shapes, FilesThatTheyNameEnterTheHash) {
  const CaseText written(tank + "file='part.csv'\n");
  const auto hash = [&](const std::string& text) {
    written.add("part.csv", text);
    return CaseFile(written.folder(), {}).hash();
  };
  const auto first = hash("x[m],y[m]\n0,0\n2,0\n2,1\n");
  EXPECT_EQ(hash("x[m],y[m]\n0,0\n2,0\n2,1\n"), first);
  EXPECT_NE(hash("x[m],y[m]\n0,0\n2,0\n2,2\n"), first);
  EXPECT_EQ(CaseFile(written.folder(), {}).named_files(), std::vector<std::string>{"part.csv"});
}

}  // namespace
}  // namespace toryu
