/// One line on standard error that says how far a run is: time, percent, window or step, speed, time left.
#pragma once

#include <chrono>
#include <string>

namespace toryu {

/// "t 0.1230 of 0.4000 s,  30 %, window 12345, 1234 windows/s, 12 s left", after `seconds` of wall time.
std::string progress_line(double time, double end_time, long count, const std::string& unit, double seconds);

class Progress {
 public:
  /// `unit` is what is counted: "step" or "window". On a terminal the line is rewritten in place five times a
  /// second; otherwise a line is written every ten seconds.
  Progress(double end_time, std::string unit);
  ~Progress();
  void update(double time, long count);

 private:
  void print(double time, long count);
  double end_time_;
  std::string unit_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_, last_;
  bool printed_ = false;
};

}  // namespace toryu
