#include "common/loop/checkpoints_alone.hpp"

#include "common/error/failure.hpp"
#include "common/run/interruption.hpp"
#include "common/run/log.hpp"

namespace toryu {

CheckpointsAlone::CheckpointsAlone(const Options& options, const Scene& scene, std::string case_text)
    : out_(options.out),
      wanted_(scene.checkpoint_interval > 0 || scene.checkpoint_every > 0),
      case_text_(std::move(case_text)),
      schedule_(scene.checkpoint_interval, scene.checkpoint_every),
      stop_(out_) {
  if (!options.restart) return;
  restart_ = checkpoint_to_restart(out_);
  check_same_case(*restart_, case_text_);
}

void CheckpointsAlone::resume(RunRecord& record) {
  if (!restart_) return;
  record.read_checkpoint(restart_->folder);
  schedule_.note(record.time(), record.wall_time());
}

void CheckpointsAlone::after_step(RunRecord& record) {
  const bool stopped = stop_.found();
  if (stopped) log::warn("the file 'stop' in {} ends the run", out_.string());
  if (stopped || interruption_requested()) {
    at_end(record);
    throw Interrupted();
  }
  if (schedule_.due(record.time(), record.wall_time())) write(record);
}

void CheckpointsAlone::at_end(RunRecord& record) {
  if (wanted_) write(record);
}

void CheckpointsAlone::write(RunRecord& record) {
  std::filesystem::path folder;
  try {
    folder = open_checkpoint(out_);
    record.write_checkpoint(folder);
    complete_checkpoint(folder, record.time(), case_text_, {record.participant()});
    log::info("checkpoint at t = {:g} s in {}", record.time(), folder.string());
  } catch (const std::exception& failure) {
    abandon_checkpoint(folder);
    log::warn("no checkpoint at t = {:g} s: {}; the run goes on", record.time(), failure.what());
  }
  schedule_.note(record.time(), record.wall_time());
}

}  // namespace toryu
