/// The log of a program: `log.txt` in the results and, from warnings on, standard error. spdlog writes it;
/// its header stays in log.cpp, for each call that instantiates it costs a second of compilation.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace toryu {

/// Writes to `log.txt` in `out` (appended, lines tagged with time and role, each line whole even if several
/// processes write at once) and, from warnings on, to standard error. With an empty `out` there is no file.
void open_log(const std::string& role, const std::filesystem::path& out, const std::string& level);
/// Writes an error to the log file alone, for what standard error shows in another form.
void log_error_to_file(const std::string& message);

namespace log {

enum class Level { debug, info, warning, error };
void write(Level level, std::string_view line);

template <class... T>
void debug(fmt::format_string<T...> format, T&&... values) {
  write(Level::debug, fmt::vformat(format, fmt::make_format_args(values...)));
}
template <class... T>
void info(fmt::format_string<T...> format, T&&... values) {
  write(Level::info, fmt::vformat(format, fmt::make_format_args(values...)));
}
template <class... T>
void warn(fmt::format_string<T...> format, T&&... values) {
  write(Level::warning, fmt::vformat(format, fmt::make_format_args(values...)));
}
template <class... T>
void error(fmt::format_string<T...> format, T&&... values) {
  write(Level::error, fmt::vformat(format, fmt::make_format_args(values...)));
}

}  // namespace log

}  // namespace toryu
