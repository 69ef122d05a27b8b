/// Checkpoints: folders `checkpoint/000001` in the results, each with a part of every participant and a
/// manifest, which gets its name last:
///
///     checkpoint/000012/fluid.state   solid.state   coupler.state   case.toml   manifest.toml
///
/// A checkpoint without a manifest does not exist. One process leads: the coupler, or the solver of a run
/// alone. It opens a checkpoint, lets every participant write its part of the same moment, and completes it,
/// whereupon all but the newest two are removed. A part that cannot be written costs the checkpoint, not the
/// run.
///
/// A part begins with what made it: program, version, build, instruction set, precision. It is read by the
/// same program on a machine of the same kind, since only there the same bits come out; any number of threads
/// will do.
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "common/run/options.hpp"

namespace toryu {

/// What wrote a checkpoint, and of what.
struct CheckpointManifest {
  long number = 0;
  double time = 0;  ///< simulated [s]
  std::vector<std::string> parts;
};

/// A whole checkpoint.
struct Checkpoint {
  std::filesystem::path folder;
  CheckpointManifest manifest;
};

/// The newest whole checkpoint in the results `out`, if there is one. Throws BadInput if a manifest cannot be
/// read.
std::optional<Checkpoint> newest_checkpoint(const std::filesystem::path& out);
/// The same, or BadInput that says what there is instead.
Checkpoint checkpoint_to_restart(const std::filesystem::path& out);

/// Makes the folder of the next checkpoint in `out`, with a number beyond that of the folder `last`, which
/// may be gone: what others wrote for that one may come late. Throws MachineFailure if that fails.
std::filesystem::path open_checkpoint(const std::filesystem::path& out,
                                      const std::filesystem::path& last = {});
/// Writes the case and the manifest, which makes the checkpoint whole, and removes all but the newest two.
/// `case_text` is the used case (CaseFile::used). Throws MachineFailure, naming the file, if that fails.
void complete_checkpoint(const std::filesystem::path& folder, double time, const std::string& case_text,
                         const std::vector<std::string>& parts);
/// Removes what is there of a checkpoint that will not become whole.
void abandon_checkpoint(const std::filesystem::path& folder) noexcept;

/// Who writes a part, and alone can go on from it.
struct Author {
  std::string program;
  std::string sources = {};  ///< a sum over the text of a program that is not compiled
};

/// Writes the part `name` ("fluid") of the program `author` ("fluid_solver") into `folder`: what `write` puts
/// into the stream. The file gets its name when it is on the disk.
/// Throws MachineFailure, naming the file and the reason, if that fails.
void write_part(const std::filesystem::path& folder, const std::string& name, const Author& author,
                const std::function<void(std::ostream&)>& write);
/// Reads a part. Throws BadInput if it was written by another program, version or target (with what differs),
/// or if it is damaged.
void read_part(const std::filesystem::path& folder, const std::string& name, const Author& author,
               const std::function<void(std::istream&)>& read);

/// Throws BadInput that names every key in which `case_text` differs from the case of the checkpoint, except
/// what a restart may change: end time, intervals, observers, references, title, time limit of the coupling.
void check_same_case(const Checkpoint& checkpoint, const std::string& case_text);

/// Makes `options.out` the folder of this run, for the lead, whose series is `participant`.csv. Throws
/// BadInput if it holds the results of an earlier run, unless the options say what is to become of them: a
/// run that overwrites them takes their checkpoints away, lest it be restarted from them.
void claim_folder(const Options& options, const std::string& participant);

/// When the lead wants a checkpoint.
class CheckpointSchedule {
 public:
  /// `interval` of simulated time and `every` of wall time [s]; 0: never.
  CheckpointSchedule(double interval, double every) : interval_(interval), every_(every) {}
  /// Whether one is due at `time` [s] of the run, `wall_time` [s] since the program began.
  bool due(double time, double wall_time) const;
  /// One was written, or is there, at that time.
  void note(double time, double wall_time);

 private:
  double interval_, every_;
  double last_ = 0, last_wall_ = 0;
};

}  // namespace toryu
