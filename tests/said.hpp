#pragma once

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <sstream>
#include <string>

namespace toryu {

/// What the log is told as long as this lives.
class Said {
 public:
  Said() {
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("", std::make_shared<spdlog::sinks::ostream_sink_st>(text_)));
  }
  ~Said() { spdlog::set_default_logger(before_); }
  std::string text() const { return text_.str(); }
  int times(const std::string& words) const {
    int found = 0;
    for (auto at = text().find(words); at != std::string::npos; at = text().find(words, at + 1)) ++found;
    return found;
  }

 private:
  std::ostringstream text_;
  std::shared_ptr<spdlog::logger> before_ = spdlog::default_logger();
};

}  // namespace toryu
