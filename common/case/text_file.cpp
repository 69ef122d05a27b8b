#include "common/case/text_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "common/error/failure.hpp"

namespace toryu {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& message) {
  throw BadInput({{.place = file.string(), .message = message}});
}

}  // namespace

bool is_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

std::string read_text(const std::filesystem::path& file, std::uintmax_t largest) {
  if (!is_file(file)) refuse(file, "is no file that can be read");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(file, fmt::format("cannot be read: {}", std::strerror(errno)));
  // One byte more than is allowed, whatever the system says of the size: a file may grow while it is read.
  std::string text(std::min<std::uintmax_t>(std::filesystem::file_size(file), largest) + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (stream.bad()) refuse(file, fmt::format("cannot be read: {}", std::strerror(errno)));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > largest)
    refuse(file, fmt::format("is larger than {} MB, the most that is read", largest / 1'000'000));
  for (const char* mark : {"\xFF\xFE", "\xFE\xFF"})
    if (text.starts_with(mark)) refuse(file, "is UTF-16 text: save it as UTF-8");
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  return text;
}

}  // namespace toryu
