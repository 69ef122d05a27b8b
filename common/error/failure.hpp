/// How a program of this project can end, and the exceptions that lead there, but for MachineFailure
/// (machine.hpp). `run_program` (program.hpp) turns each into its exit code and one line of text; nothing
/// else does.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace toryu {

enum class ExitCode {
  done = 0,
  bug = 1,
  bad_input = 2,
  physics_failed = 3,
  peer_lost = 4,
  machine = 5,
  interrupted = 130
};

/// One fault of a case file or of the command line; `line` is 0 where there is none (an option).
struct InputError {
  std::string place;  ///< file name, or the option as it was typed
  int line = 0;
  int column = 0;
  std::string message;  ///< what was found, what is allowed, the nearest right word

  std::string text() const {
    return line > 0 ? fmt::format("{}:{}:{}: error: {}", place, line, column, message)
                    : fmt::format("{}: error: {}", place, message);
  }
};

/// Everything that is wrong with the input, all at once.
class BadInput : public std::runtime_error {
 public:
  explicit BadInput(std::vector<InputError> errors)
      : std::runtime_error(join(errors)), errors_(std::move(errors)) {}
  const std::vector<InputError>& errors() const { return errors_; }

 private:
  static std::string join(const std::vector<InputError>& errors) {
    std::string text;
    for (const auto& error : errors) {
      if (!text.empty()) text += '\n';
      text += error.text();
    }
    return text;
  }
  std::vector<InputError> errors_;
};

/// A fault of the case that code without its file finds: of the item or value at `key`, a path as
/// CaseFile::fault takes it ("fluid.region.water"), or one within the section of the owner, whichever that is
/// (".spacing"). CaseFile::placed tells it at its place.
class BadKey : public BadInput {
 public:
  BadKey(std::string key, std::string message)
      : BadInput({{.place = key, .message = message}}), key_(std::move(key)), message_(std::move(message)) {}
  const std::string& key() const { return key_; }
  const std::string& message() const { return message_; }

 private:
  std::string key_, message_;
};

/// A value left physics: the run stops.
class PhysicsFailure : public std::runtime_error {
 public:
  /// `what` is a noun ("speed", "density"), `particle` its number or -1 for a whole body.
  PhysicsFailure(const std::string& body, long particle, double time, const std::string& quantity,
                 const std::string& value, const std::string& limit)
      : std::runtime_error(
            fmt::format("{} {} at t = {:.6g} s: {} = {}, limit {}", body,
                        particle < 0 ? std::string("body") : fmt::format("particle {}", particle), time,
                        quantity, readable(value), limit)) {}
  /// As told by another process.
  explicit PhysicsFailure(const std::string& told) : std::runtime_error(told) {}

 private:
  /// C writes what is not a number as "nan" or "-nan".
  static std::string readable(const std::string& value) {
    return value.find("nan") == std::string::npos ? value : "not a number";
  }
};

/// Another process died, hung, or never came.
class PeerLost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The user or the system asked to stop.
class Interrupted : public std::runtime_error {
 public:
  explicit Interrupted(const std::string& reason = "interrupted") : std::runtime_error(reason) {}
};

}  // namespace toryu
