// Writes sample results into the folder given as the only argument, for test_results_are_readable.py.
#include "common/run/provenance.hpp"
#include "tests/unit/common/output/sample_results.hpp"

int main(int, char** argv) {
  using namespace toryu;
  FrameWriter frames(argv[1], "fluid", sample::provenance);
  SeriesWriter series(argv[1], "fluid");
  for (const double time : {0.0, 0.005}) {
    frames.write(time, sample::frame());
    series.write(time, {{"kinetic_energy", "J/m", 0.1 + time}, {"momentum_x", "N.s/m", -1e-300}});
  }
  // As many as make chunks, compressed.
  Frame large;
  FrameField number{"number", "1", "", 1, {}};
  for (int i = 0; i < 40000; ++i) {
    large.positions.insert(large.positions.end(), {i * 0.5, -i * 0.25});
    number.values.push_back(i);
  }
  large.fields = {number};
  FrameWriter(argv[1], "large", sample::provenance).write(0, large);
  write_summary(argv[1], sample::summary());
}
