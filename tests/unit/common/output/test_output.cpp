#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "common/error/failure.hpp"
#include "common/error/machine.hpp"
#include "common/output/atomic_file.hpp"
#include "common/output/hdf5_file.hpp"
#include "common/output/hdf5_series.hpp"
#include "common/run/provenance.hpp"
#include "tests/unit/common/output/sample_results.hpp"

/// HDF5 loses some memory where it cannot close a file for want of room.
extern "C" const char*
__lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier): so it is called
  return "leak:libhdf5";
}

namespace toryu {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Output : public testing::Test {
 protected:
  Output() {
    fs::remove_all(out);
    fs::create_directories(out);
  }
  ~Output() override { fs::remove_all(out); }

  std::string text(const std::string& name) const {
    std::ostringstream content;
    content << std::ifstream(out / name).rdbuf();
    return content.str();
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(out))
      if (entry.is_regular_file()) names.push_back(entry.path().lexically_relative(out));
    std::sort(names.begin(), names.end());
    return names;
  }

  fs::path out = fs::path(testing::TempDir()) / ("output_" + std::to_string(getpid()));
};

TEST_F(Output, EachFrameIsAFileAndALineOfTheSeries) {
  FrameWriter writer(out, "fluid", sample::provenance);
  writer.write(0.0, sample::frame());
  writer.write(0.005, sample::frame());
  writer.complete();
  EXPECT_THAT(files(), ElementsAre("fluid.hdf.series", "frames/fluid_000000.hdf", "frames/fluid_000001.hdf"));
  EXPECT_EQ(text("fluid.hdf.series"),
            "{ \"file-series-version\": \"1.0\", \"files\": [\n"
            "  { \"name\": \"frames/fluid_000000.hdf\", \"time\": 0 },\n"
            "  { \"name\": \"frames/fluid_000001.hdf\", \"time\": 0.005 }\n] }\n");
}

TEST_F(Output, AFrameOfAFaultyFieldLeavesNoFile) {
  FrameWriter writer(out, "fluid", sample::provenance);
  Frame frame = sample::frame();
  frame.fields[0].values.pop_back();
  EXPECT_THROW(writer.write(0.0, frame), std::logic_error);
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Output, AnHdfFileStaysOnceItIsClosed) {
  {
    HdfFile file(out / "a.h5");
    file.dataset("/x", std::vector<double>{1, 2}, 1, Stored::float64);
    EXPECT_THAT(files(), ElementsAre("a.h5.part"));
    file.close();
  }
  EXPECT_THAT(files(), ElementsAre("a.h5.part"));
}

TEST_F(Output, AFolderThatCannotBeWrittenIsNamed) {
  try {
    HdfFile file(out / "absent" / "a.h5");
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr((out / "absent" / "a.h5.part").string()));
  }
}

TEST_F(Output, ASeriesIsSeenWhileItGrowsAndNamedAtTheEnd) {
  {
    SeriesWriter series(out, "solid");
    series.write(0.0, {{"tip_x", "m", 0.1}, {"energy", "J/m", 2}});
    EXPECT_THAT(files(), ElementsAre("solid.csv.part"));
    series.write(0.1 + 0.2, {{"tip_x", "m", 1.0 / 3.0}, {"energy", "J/m", -1e-20}});
  }
  EXPECT_THAT(files(), ElementsAre("solid.csv"));
  EXPECT_EQ(text("solid.csv"),
            "time[s],tip_x[m],energy[J/m]\n0,0.1,2\n0.30000000000000004,0.3333333333333333,-1e-20\n");
}

TEST_F(Output, ASeriesWithoutRowsLeavesNothing) {
  { SeriesWriter series(out, "solid"); }
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Output, ARowOfAnotherLengthIsABug) {
  SeriesWriter series(out, "solid");
  series.write(0.0, {{"tip_x", "m", 0.1}});
  EXPECT_THROW(series.write(0.1, {}), std::logic_error);
}

TEST_F(Output, ASeriesThatGotColumnsSinceACheckpointGoesOnFromItAllTheSame) {
  SeriesWriter::State then;
  {
    SeriesWriter series(out, "solid");
    series.write(0.0, {{"a", "m", 1}});
    series.write(0.1, {{"a", "m", 2}});
    then = series.state();
    series.write(0.2, {{"a", "m", 3}});
  }
  for (int k = 0; k < 2; ++k) {  // the second time as after a kill before the next checkpoint
    SeriesWriter series(out, "solid");
    series.resume(then);
    series.write(0.2, {{"b", "m", 5}, {"a", "m", 4}});
  }
  EXPECT_EQ(text("solid.csv"), "time[s],a[m],b[m]\n0,1,nan\n0.1,2,nan\n0.2,4,5\n");
  {
    SeriesWriter series(out, "solid");
    series.resume(then);
    series.write(0.2, {{"a", "m", 4}});
  }
  EXPECT_EQ(text("solid.csv"), "time[s],a[m],b[m]\n0,1,nan\n0.1,2,nan\n0.2,4,nan\n");
}

TEST_F(Output, ASeriesThatLacksRowsIsNotGoneOnWith) {
  SeriesWriter::State then;
  {
    SeriesWriter series(out, "solid");
    series.write(0.0, {{"a", "m", 1}});
    series.write(0.1, {{"a", "m", 2}});
    then = series.state();
  }
  std::ofstream(out / "solid.csv", std::ios::trunc) << "time[s],a[m]\n0,1\n0.1";
  {
    SeriesWriter series(out, "solid");
    EXPECT_THAT([&] { series.resume(then); },
                testing::ThrowsMessage<BadInput>(HasSubstr("it has 1 row, and had 2 at the checkpoint")));
  }
  EXPECT_EQ(text("solid.csv"), "time[s],a[m]\n0,1\n0.1");
  EXPECT_THAT(files(), ElementsAre("solid.csv"));
}

/// A series file in HDF5 of numbers 0, 1, 2, ...
struct Numbers {
  explicit Numbers(const fs::path& path) : file(path) { file.series("x", "m", {}); }
  void append(std::initializer_list<double> values) {
    for (const double& x : values) file.append({&x});
  }
  HdfSeriesFile file;
};

std::vector<double> numbers_in(const fs::path& path) {
  const HdfHandle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "file");
  const HdfHandle dataset(H5Dopen2(file, "x", H5P_DEFAULT), H5Dclose, "x");
  const HdfHandle space(H5Dget_space(dataset), H5Sclose, "x");
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  return values;
}

TEST_F(Output, AnHdfSeriesThatIsNotGoneOnWithStaysAsItIs) {
  const fs::path path = out / "a.h5";
  Numbers(path).append({0, 1, 2});
  { Numbers refused(path); }
  EXPECT_THAT(numbers_in(path), ElementsAre(0, 1, 2));
  EXPECT_THAT(files(), ElementsAre("a.h5"));
}

TEST_F(Output, AnHdfSeriesGoesOnWhereReadingItBackWasCutShort) {
  const fs::path path = out / "a.h5";
  Numbers(path).append({0, 1, 2});
  std::ofstream(out / "a.h5.rows.part") << "half";
  {
    Numbers numbers(path);
    numbers.file.resume({2});
    numbers.append({7});
  }
  EXPECT_THAT(numbers_in(path), ElementsAre(0, 1, 7));
  Numbers more(path);
  EXPECT_THAT([&] { more.file.resume({4}); },
              testing::ThrowsMessage<BadInput>(HasSubstr("'x' in it has no more than 3 rows")));
  EXPECT_THAT(files(), ElementsAre("a.h5"));
}

TEST_F(Output, AnHdfSeriesThatIsDamagedIsNotGoneOnWith) {
  std::ofstream(out / "a.h5") << "no HDF5";
  Numbers numbers(out / "a.h5");
  EXPECT_THAT([&] { numbers.file.resume({1}); },
              testing::ThrowsMessage<BadInput>(HasSubstr("cannot go on: it is no HDF5 file")));
}

TEST_F(Output, TheSummaryEscapesTextAndKeepsFloatsFloats) {
  write_summary(out, sample::summary());
  const std::string summary = text("fluid_summary.toml");
  EXPECT_THAT(summary, HasSubstr("exit_code = 3\n"));
  EXPECT_THAT(summary,
              HasSubstr(R"(end_reason = "particle 7: \"speed\" = 1e3\n\u0009beyond C:\\limit \u0001")"));
  EXPECT_THAT(summary, HasSubstr("simulated_time = 2.0  # s\n"));
  EXPECT_THAT(summary, HasSubstr("\"wall tank_floor\" = 320\n"));
  EXPECT_THAT(summary, HasSubstr("smallest_time_step = inf"));
  EXPECT_THAT(files(), ElementsAre("fluid_summary.toml"));
}

/// A file on a full disk: what is written to /dev/full finds no room.
class FullDisk : public Output {
 protected:
  void fill(const std::string& name) const {
    fs::create_directories((out / name).parent_path());
    fs::create_symlink("/dev/full", out / name);
  }
  template <class Write>
  void expect_no_room(const std::string& name, const Write& write) const {
    fill(name);
    EXPECT_THAT(write,
                testing::ThrowsMessage<MachineFailure>(testing::AllOf(
                    HasSubstr((out / name).string()), HasSubstr("No space left on device; make room"))));
    EXPECT_FALSE(fs::exists(out / fs::path(name).replace_extension())) << "it is not whole";
  }
};

TEST_F(FullDisk, IsTheCauseWhereAFileCannotBeWritten) {
  expect_no_room("used_case.toml.part", [&] { write_atomically(out / "used_case.toml", "a = 1\n"); });
  expect_no_room("fluid.csv.part", [&] {
    SeriesWriter series(out, "fluid");
    series.write(0, {{"a", "m", 1.0}});
    series.complete();
  });
  expect_no_room("a.h5.part", [&] {
    HdfFile file(out / "a.h5");
    file.group("/a");
    file.close();
  });
  expect_no_room("rows.h5.rows.part", [&] {
    HdfSeriesFile file(out / "rows.h5");
    file.series("time", "s", {});
    const double time = 0;
    file.append({&time});
  });
}

TEST_F(FullDisk, CostsNoRowsWhereTheFileOfThemFindsNoRoom) {
  fill("a.h5.part");
  HdfSeriesFile file(out / "a.h5");
  file.series("time", "s", {});
  const double time = 0.5;
  file.append({&time});
  EXPECT_THROW(file.complete(), MachineFailure);
  EXPECT_EQ(fs::file_size(out / "a.h5.rows.part"), sizeof time);
  EXPECT_FALSE(fs::exists(fs::symlink_status(out / "a.h5.part"))) << "it is of no use";
}

TEST_F(Output, RowsOfNoPointAtAllAreWritten) {
  HdfSeriesFile file(out / "a.h5");
  file.series("time", "s", {});
  file.series("depth", "m", {0});
  const double time = 0.5;
  file.append({&time, &time});
  EXPECT_NO_THROW(file.complete());
  EXPECT_TRUE(fs::exists(out / "a.h5"));
}

TEST_F(Output, AFolderThatWasRemovedIsTheCauseAndNoSilentLoss) {
  SeriesWriter series(out, "fluid");
  series.write(0, {{"a", "m", 1.0}});
  HdfSeriesFile file(out / "a.h5");
  file.series("time", "s", {});
  const double time = 0;
  file.append({&time});
  fs::remove_all(out);
  EXPECT_THAT([&] { series.complete(); }, testing::ThrowsMessage<MachineFailure>(
                                              HasSubstr("the folder was removed or moved in mid-run")));
  EXPECT_THROW(file.complete(), MachineFailure);
}

}  // namespace
}  // namespace toryu
