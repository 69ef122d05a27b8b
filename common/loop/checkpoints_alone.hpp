/// The checkpoints of a solver without a partner, which leads and takes part in one process: when they are
/// due, at the end, and where the run is asked to stop.
#pragma once

#include <optional>
#include <string>

#include "common/loop/run_record.hpp"
#include "common/run/options.hpp"
#include "common/run/stop_file.hpp"
#include "common/state/checkpoint.hpp"

namespace toryu {

class CheckpointsAlone {
 public:
  /// `case_text` is the used case. If the options ask to go on, finds the newest checkpoint of the results.
  /// Throws BadInput if there is none or if it is of another case: to be made before anything is written.
  CheckpointsAlone(const Options& options, const Scene& scene, std::string case_text);

  /// Goes on from that checkpoint, if the options ask for it. Throws BadInput if it is of another program or
  /// damaged.
  void resume(RunRecord& record);
  /// After what is due at a time has been written: writes a checkpoint if one is due. Where the run is asked
  /// to stop, by a signal or by the file `stop`, writes a last one and throws Interrupted.
  void after_step(RunRecord& record);
  /// At the end of the run.
  void at_end(RunRecord& record);

 private:
  void write(RunRecord& record);

  std::filesystem::path out_;
  std::optional<Checkpoint> restart_;
  bool wanted_;
  std::string case_text_;
  CheckpointSchedule schedule_;
  StopFile stop_;
};

}  // namespace toryu
