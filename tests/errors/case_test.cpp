// The exact text of each kind of fault of a case file and of an override.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "common/case/text_file.hpp"
#include "tests/errors/case_text.hpp"

namespace toryu {
namespace {

struct Fault {
  std::string name, text, expected;
};

std::string repeated(const std::string& text, int times) {
  std::string result;
  for (int i = 0; i < times; ++i) result += text;
  return result;
}

class CaseFault : public testing::TestWithParam<Fault> {};

TEST_P(CaseFault, HasItsText) {
  EXPECT_EQ(CaseText(GetParam().text).faults(), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, CaseFault,
    testing::Values(
        Fault{"None", "[medium]\ndensity = 1000\n[other]\nanything = 1\n", ""},
        Fault{"UnknownKeyNearAnother", "[medium]\n  densty = 1.0\ndensity = 1000\n",
              "case.toml:2:3: error: unknown key 'densty' in [medium]; did you mean 'density'?"},
        Fault{"UnknownKeyNearNone", "[medium]\ndensity = 1\ndrag = { elephant = 1 }\n",
              "case.toml:3:10: error: unknown key 'elephant' in [medium.drag]; known are 'coefficient'"},
        Fault{"UnknownKeyInAnItem",
              "[medium]\ndensity = 1\n[[medium.region]]\nname = 'a'\nbox = {min=[0,0], max=[1,1]}\nnam = 1\n",
              "case.toml:6:1: error: unknown key 'nam' in [[medium.region]]; did you mean 'name'?"},
        Fault{"UnknownSection", "[medium]\ndensity = 1\n[medum]\nx = 1\n",
              "case.toml:3:2: error: unknown section 'medum'; did you mean 'medium'?"},
        Fault{"UnknownSectionNearNone", "[medium]\ndensity = 1\n[[elephant]]\nx = 1\n",
              "case.toml:3:3: error: unknown section 'elephant'; sections are 'medium', 'other'"},
        Fault{"KeyOutsideOfSections", "density = 1\n[medium]\ndensity = 1\n",
              "case.toml:1:1: error: unknown key 'density'; sections are 'medium', 'other'"},
        Fault{"MissingKey", "\n[medium]\n",
              "case.toml:2:2: error: missing key 'density' in [medium]: a number [kg/m3] above 0, at rest"},
        Fault{"MissingSection", "[other]\n",
              "case.toml:1:1: error: missing key 'density' in [medium]: a number [kg/m3] above 0, at rest"},
        Fault{"MissingKeyInAnItem",
              "[medium]\ndensity = 1\n[[medium.region]]\nbox = {min=[0,0], max=[1,1]}\n",
              "case.toml:3:1: error: missing key 'name' in [[medium.region]]: text"},
        Fault{
            "MissingGroup", "[medium]\ndensity = 1\n[[medium.region]]\nname = 'a'\n",
            "case.toml:3:1: error: missing key 'min' in [medium.region.box]: 2 numbers [m], smallest corner\n"
            "case.toml:3:1: error: missing key 'max' in [medium.region.box]: 2 numbers [m], largest corner"},
        Fault{"TextForNumber", "[medium]\ndensity = 'heavy'\n",
              "case.toml:2:1: error: 'density' in [medium] must be a number [kg/m3] above 0, found the text "
              "\"heavy\""},
        Fault{"NumberForInteger", "[medium]\ndensity = 1\nsteps = 1.5\n",
              "case.toml:3:1: error: 'steps' in [medium] must be an integer of at least 1, found the number "
              "1.5"},
        Fault{"NumberForFlag", "[medium]\ndensity = 1\nopen = 1\n",
              "case.toml:3:1: error: 'open' in [medium] must be true or false, found the number 1"},
        Fault{"NumberForText", "[medium]\ndensity = 1\nlabel = 7\n",
              "case.toml:3:1: error: 'label' in [medium] must be text, found the number 7"},
        Fault{"TextForTexts", "[medium]\ndensity = 1\nloads = 'pressure'\n",
              "case.toml:3:1: error: 'loads' in [medium] must be a list of 'pressure', 'viscous', found the "
              "text "
              "\"pressure\""},
        Fault{
            "NumberForSection", "[medium]\ndensity = 1\ndrag = 1\n",
            "case.toml:3:1: error: 'drag' in [medium] must be a section, or false to leave it out, found the "
            "number 1"},
        Fault{"SectionForList", "[medium]\ndensity = 1\n[medium.region]\nname = 'a'\n",
              "case.toml:3:9: error: 'region' in [medium] must be a list of sections [[medium.region]], "
              "found a "
              "section"},
        Fault{"ListForSection", "[[medium]]\ndensity = 1\n",
              "case.toml:1:3: error: 'medium' must be a section, found a list of sections"},
        Fault{"TimeForNumber", "[medium]\ndensity = 12:00:00\n",
              "case.toml:2:1: error: 'density' in [medium] must be a number [kg/m3] above 0, found a date or "
              "time"},
        Fault{"NotAboveMinimum", "[medium]\ndensity = 0\n",
              "case.toml:2:1: error: 'density' in [medium] must be above 0 [kg/m3], found 0"},
        Fault{"OutOfRange", "[medium]\ndensity = 1\nratio = 2.5\n",
              "case.toml:3:1: error: 'ratio' in [medium] must be from 1 to 2, found 2.5"},
        Fault{"BelowMinimum", "[medium]\ndensity = 1\nsteps = 0\n",
              "case.toml:3:1: error: 'steps' in [medium] must be at least 1, found 0"},
        Fault{"TooLargeForAnInteger", "[medium]\ndensity = 1\nsteps = 3000000000\n",
              "case.toml:3:1: error: 'steps' in [medium] must be from -2147483648 to 2147483647, found "
              "3000000000"},
        Fault{"NotFinite", "[medium]\ndensity = inf\nwind = [0, nan]\n",
              "case.toml:2:1: error: 'density' in [medium] must be a finite number [kg/m3], found inf\n"
              "case.toml:3:12: error: 'wind' in [medium] must be a finite number [m/s], found nan"},
        Fault{
            "WrongWord", "[medium]\ndensity = 1\nlaw = 'quadratc'\n",
            "case.toml:3:1: error: 'law' in [medium] must be one of 'linear', 'quadratic', found 'quadratc'; "
            "did you mean 'quadratic'?"},
        Fault{"WrongWordInAList", "[medium]\ndensity = 1\nloads = ['viscous', 'gravity']\n",
              "case.toml:3:21: error: 'loads' in [medium] must be one of 'pressure', 'viscous', found "
              "'gravity'"},
        Fault{"WrongLength", "[medium]\ndensity = 1\nwind = [1, 2, 3]\n",
              "case.toml:3:1: error: 'wind' in [medium] must be 2 numbers [m/s], found a list of 3"},
        Fault{"RowsForAVector", "[medium]\ndensity = 1\nwind = [[0, 1, 2],\n  [1, 2, 3]]\n",
              "case.toml:3:1: error: 'wind' in [medium] must be 2 numbers [m/s], found 2 rows of numbers"},
        Fault{"TableForAVector", "[medium]\ndensity = 1\nwind = { time = [0, 1], value = [0, 2] }\n",
              "case.toml:3:1: error: 'wind' in [medium] must be 2 numbers [m/s], found a section"},
        Fault{"NumberForAVector", "[medium]\ndensity = 1\nwind = 5.5\n",
              "case.toml:3:1: error: 'wind' in [medium] must be 2 numbers [m/s], found the number 5.5"},
        Fault{"WrongElement", "[medium]\ndensity = 1\nwind = [1, 'a']\n",
              "case.toml:3:12: error: 'wind' in [medium] must be a number [m/s], found the text \"a\""},
        Fault{"WrongRow", "[medium]\ndensity = 1\nhistory = [[0, 1],\n  [1]]\n",
              "case.toml:4:3: error: 'history' in [medium] must be rows of 2 numbers (time [s], level [m]), "
              "found a list of 1"},
        Fault{"JointCheck",
              "[medium]\ndensity = 1\n[[medium.region]]\nname = 'a'\nbox = {min=[0,0], max=[1,0]}\n",
              "case.toml:5:19: error: 'max' must exceed 'min' in each direction"},
        Fault{"NoJointCheckOfFaultyKeys",
              "[medium]\ndensity = 1\n[[medium.region]]\nname = 'a'\nbox = {min=[0,0], max=[-1]}\n",
              "case.toml:5:19: error: 'max' in [medium.region.box] must be 2 numbers [m], found a list of 1"},
        Fault{"SyntaxError", "[medium]\ndensity =\n",
              "case.toml:2:10: error: not valid TOML: Error while parsing key-value pair: expected value, "
              "saw '\\n'"},
        Fault{"DuplicateKey", "[medium]\ndensity = 1\ndensity = 2\n",
              "case.toml:3:11: error: not valid TOML: Error while parsing key-value pair: cannot redefine "
              "existing "
              "integer 'density'"},
        Fault{"DuplicateSection", "[medium]\ndensity = 1\n[medium]\n",
              "case.toml:3:1: error: not valid TOML: Error while parsing table header: cannot redefine "
              "existing "
              "table 'medium'"},
        Fault{"ByteOrderMark", "\xEF\xBB\xBF[medium]\ndensity = 0\n",
              "case.toml:2:1: error: 'density' in [medium] must be above 0 [kg/m3], found 0"},
        Fault{"KeyOfManyParts", "[medium]\ndensity = 1\n" + repeated("a.", 100000) + "a = 1\n",
              "case.toml:3:64: error: a key of more than 32 parts"},
        Fault{"HeaderOfManyParts", "[" + repeated("'a' . ", 100000) + "a]\n",
              "case.toml:1:192: error: a key of more than 32 parts"},
        Fault{"InlineKeyOfManyParts", "[medium]\ndensity = 1\ndrag = { " + repeated("a.", 40) + "a = 1 }\n",
              "case.toml:3:73: error: a key of more than 32 parts"},
        Fault{"DotsInTextsAndNumbers",
              "# " + repeated("a.", 99) + "\n[medium]\ndensity = 1\nlabel = '" + repeated("a.", 99) +
                  "'\nwind = [1.0, 1.0]\nhistory = [" + repeated("[0.0, 1.0], ", 99) + "]\n",
              ""},
        Fault{"ManyLevels", "[other]\na = " + repeated("[", 100) + repeated("]", 100) + "\n",
              "case.toml:1:1: error: tables and lists within each other on more than 64 levels"},
        Fault{"ManyBrackets", "a = " + repeated("[", 400) + repeated("]", 400) + "\n",
              "case.toml:1:261: error: not valid TOML: Error while parsing value: exceeded maximum nested "
              "value "
              "depth of 256 (TOML_MAX_NESTED_VALUES)"},
        Fault{"Study", "[study]\ntitle = 'a'\n[medium]\n",
              "case.toml:1:2: error: this is a study, and a program computes a case; ./run.sh (installed: "
              "toryu) runs both"},
        Fault{"AllAtOnceByLine", "[medum]\n[medium]\nratio = 0\nlaw = 1\nsteps = 'two'\n",
              "case.toml:1:2: error: unknown section 'medum'; did you mean 'medium'?\n"
              "case.toml:2:2: error: missing key 'density' in [medium]: a number [kg/m3] above 0, at rest\n"
              "case.toml:3:1: error: 'ratio' in [medium] must be from 1 to 2, found 0\n"
              "case.toml:4:1: error: 'law' in [medium] must be one of 'linear', 'quadratic', found the "
              "number 1\n"
              "case.toml:5:1: error: 'steps' in [medium] must be an integer of at least 1, found the text "
              "\"two\""}),
    name_of<Fault>);

struct OverrideFault {
  std::string name;
  std::vector<std::string> overrides;
  std::string expected;
};

class OverrideFaults : public testing::TestWithParam<OverrideFault> {};

TEST_P(OverrideFaults, HaveTheirText) {
  const CaseText text(
      "[medium]\ndensity = 1\n[[medium.region]]\nname = 'left'\nbox = {min=[0,0], max=[1,1]}\n"
      "[[medium.region]]\nname = 'right'\nbox = {min=[1,0], max=[2,1]}\n");
  EXPECT_EQ(text.faults(GetParam().overrides), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, OverrideFaults,
    testing::Values(
        OverrideFault{"None", {"medium.density=2", "medium.region.left.box.max=[0.5,1]"}, ""},
        OverrideFault{"OfAnother", {"other.densty=1", "other.part.x=1", "other.part.x.y=1"}, ""},
        OverrideFault{
            "UnknownKey",
            {"medium.densty=1"},
            "--set medium.densty=1: error: unknown key 'densty' in [medium]; did you mean 'density'?"},
        OverrideFault{"UnknownSection",
                      {"medum.density=1"},
                      "--set medum.density=1: error: unknown section 'medum'; did you mean 'medium'?"},
        OverrideFault{
            "OutOfRange",
            {"medium.density=-1"},
            "--set medium.density=-1: error: 'density' in [medium] must be above 0 [kg/m3], found -1"},
        OverrideFault{
            "TextForNumber",
            {"medium.density=3O"},
            "--set medium.density=3O: error: 'density' in [medium] must be a number [kg/m3] above 0, "
            "found the text \"3O\""},
        OverrideFault{
            "NoValue", {"medium.density"}, "--set medium.density: error: expected section.key=value"},
        OverrideFault{"ManyParts",
                      {repeated("a.", 40) + "a=1"},
                      "--set " + repeated("a.", 40) + "a=1: error: a key of more than 32 parts"},
        OverrideFault{"EmptyKey", {"medium..x=1"}, "--set medium..x=1: error: expected section.key=value"},
        OverrideFault{
            "NoSuchName",
            {"medium.region.rigt.box.max=[1,2]"},
            "--set medium.region.rigt.box.max=[1,2]: error: no item 'rigt': medium.region has 2 items, "
            "counted from 0, named 'left', 'right'; did you mean 'right'?"},
        OverrideFault{
            "NoSuchNumber",
            {"medium.region.2.box.max=[1,2]"},
            "--set medium.region.2.box.max=[1,2]: error: no item '2': medium.region has 2 items, counted "
            "from 0, named 'left', 'right'"},
        OverrideFault{
            "BelowAValue",
            {"medium.density.x=1"},
            "--set medium.density.x=1: error: 'medium.density' is the number 1, not a section with a key "
            "'x'"},
        OverrideFault{
            "JointCheck",
            {"medium.region.1.box.max=[0,0]"},
            "--set medium.region.1.box.max=[0,0]: error: 'max' must exceed 'min' in each direction"},
        OverrideFault{"RequiredTakenAway",
                      {"medium=false"},
                      "--set medium=false: error: 'medium' must be a section, found false"},
        OverrideFault{"AllInTheirOrder",
                      {"medium.steps=0", "medium.ratio=9"},
                      "--set medium.steps=0: error: 'steps' in [medium] must be at least 1, found 0\n"
                      "--set medium.ratio=9: error: 'ratio' in [medium] must be from 1 to 2, found 9"}),
    name_of<OverrideFault>);

std::string fault_of(const std::filesystem::path& path) {
  try {
    CaseFile file(path, {});
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(CaseFiles, ThatAreNoFiles) {
  const CaseText text("");
  const std::string pipe = text.folder() / "pipe", name(300, 'x');
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(fault_of(pipe), pipe + ": error: is neither a file nor a folder");
  EXPECT_EQ(fault_of("/dev/zero"), "/dev/zero: error: is neither a file nor a folder");
  EXPECT_EQ(fault_of(name), name + ": error: cannot be read: File name too long");
  text.add("large.toml", std::string(largest_case + 1, '#'));
  EXPECT_EQ(fault_of(text.folder() / "large.toml"),
            (text.folder() / "large.toml").string() + ": error: is larger than 4 MB, the most that is read");
}

TEST(CaseFiles, ThatAreNotThere) {
  EXPECT_EQ(fault_of("cases/no_such_case"), "cases/no_such_case: error: no such file or folder");
  const CaseText text("");
  std::filesystem::remove(text.folder() / "case.toml");
  EXPECT_EQ(fault_of(text.folder()), text.folder().string() + ": error: this folder holds no case.toml");
}

TEST(BaseFault, NamesTheFileThatHasIt) {
  const CaseText text("base = 'base.toml'\n[medium]\nratio = 2\ndrag = 1\n");
  text.add("base.toml", "[medium]\n\ndensity = -1\ndrag = { coefficient = 1 }\n");
  EXPECT_EQ(text.faults(),
            "base.toml:3:1: error: 'density' in [medium] must be above 0 [kg/m3], found -1\n"
            "case.toml:4:1: error: 'drag' in [medium] must be a section, or false to leave it out, found the "
            "number 1");
}

TEST(BaseFault, SaysWhatABaseMustBe) {
  const std::string must = "case.toml:1:1: error: 'base' must name a case file beside this one, found ";
  EXPECT_EQ(CaseText("base = 'elsewhere.toml'\n").faults(), must + "the text \"elsewhere.toml\"");
  EXPECT_EQ(CaseText("base = '../case.toml'\n").faults(), must + "the text \"../case.toml\"");
  EXPECT_EQ(CaseText("base = 1\n").faults(), must + "the number 1");
  EXPECT_EQ(CaseText("base = 'case.toml'\n").faults(),
            "case.toml:1:1: error: a case file that others have as their base cannot have one itself");
}

}  // namespace
}  // namespace toryu
