#include "common/run/log.hpp"

#include <fcntl.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <mutex>
#include <system_error>

#include "common/error/failure.hpp"
#include "common/error/machine.hpp"
#include "common/run/standard_streams.hpp"

namespace toryu {

namespace {

/// A file that several processes append to. spdlog's own file sink writes by stdio, which may cut a line in
/// two; one write(2) to a file opened with O_APPEND does not.
class SharedFileSink final : public spdlog::sinks::base_sink<std::mutex> {
 public:
  explicit SharedFileSink(const std::filesystem::path& file)
      : descriptor_(open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644)) {
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), file.string());
  }
  ~SharedFileSink() override { close(descriptor_); }

 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    if (write(descriptor_, line.data(), line.size()) >= 0 || told_) return;
    told_ = true;
    tell(fmt::format("{}: warning: log.txt lacks lines: {}\n", fmt::to_string(message.logger_name),
                     std::strerror(errno)));
  }
  void flush_() override {}

 private:
  int descriptor_;
  bool told_ = false;  ///< that lines are lost
};

std::shared_ptr<spdlog::sinks::sink> log_file;

}  // namespace

void open_log(const std::string& role, const std::filesystem::path& out, const std::string& level) {
  std::vector<spdlog::sink_ptr> sinks;
  const auto standard_error = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  standard_error->set_level(spdlog::level::warn);
  standard_error->set_pattern("%n: %l: %v");
  sinks.push_back(standard_error);
  log_file = nullptr;
  if (!out.empty()) {
    try {
      std::filesystem::create_directories(out);
      log_file = std::make_shared<SharedFileSink>(out / "log.txt");
    } catch (const std::system_error& error) {
      if (!is_fault_of_path(error.code().value())) throw;
      throw BadInput({{.place = "--out " + out.string(),
                       .message = "no results can be written there: " + error.code().message()}});
    }
    log_file->set_pattern("%Y-%m-%d %H:%M:%S.%e %n %l: %v");
    sinks.push_back(log_file);
  }
  const auto logger = std::make_shared<spdlog::logger>(role, sinks.begin(), sinks.end());
  logger->set_level(spdlog::level::from_str(level));
  spdlog::set_default_logger(logger);
}

void log_error_to_file(const std::string& message) {
  if (log_file) log_file->log({spdlog::default_logger()->name(), spdlog::level::err, message});
}

void log::write(Level level, std::string_view line) {
  constexpr spdlog::level::level_enum of_spdlog[] = {spdlog::level::debug, spdlog::level::info,
                                                     spdlog::level::warn, spdlog::level::err};
  spdlog::default_logger_raw()->log(of_spdlog[static_cast<int>(level)], line);
}

}  // namespace toryu
