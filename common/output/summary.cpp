#include <fmt/format.h>

#include <string_view>

#include "common/output/atomic_file.hpp"
#include "common/output/results.hpp"
#include "common/run/provenance.hpp"

namespace toryu {

namespace {

/// A basic string of TOML 1.0.
std::string toml_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (c == '\n')
      out += "\\n";
    else if (code < 0x20 || code == 0x7f)
      out += fmt::format("\\u{:04x}", code);
    else
      out += c;
  }
  return out + '"';
}

/// A float of TOML 1.0: it has a point or an exponent, or is nan or inf.
std::string toml_float(double value) {
  const std::string text = fmt::format("{}", value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

}  // namespace

void write_summary(const std::filesystem::path& out, const Summary& summary) {
  std::string text;
  const auto line = [&](std::string_view key, const std::string& value, std::string_view unit = "") {
    text += fmt::format("{} = {}{}{}\n", key, value, unit.empty() ? "" : "  # ", unit);
  };
  line("participant", toml_text(summary.participant));
  line("exit_code", std::to_string(static_cast<int>(summary.exit_code)));
  line("end_reason", toml_text(summary.end_reason));
  line("simulated_time", toml_float(summary.simulated_time), "s");
  line("wall_time", toml_float(summary.wall_time), "s");
  line("waiting_time", toml_float(summary.waiting_time), "s, of the wall time");
  line("processor_time", toml_float(summary.processor_time), "s, of all threads");
  line("steps", std::to_string(summary.steps));
  line("smallest_time_step", toml_float(summary.smallest_time_step), "s");
  line("largest_time_step", toml_float(summary.largest_time_step), "s");
  line("time_step_rule", toml_text(summary.time_step_rule));

  text += "\n[provenance]\n";
  line("version", toml_text(summary.provenance.version));
  line("commit", toml_text(summary.provenance.commit));
  line("compiler", toml_text(summary.provenance.compiler));
  line("flags", toml_text(summary.provenance.flags));
  line("cpu", toml_text(summary.provenance.cpu));
  line("threads", std::to_string(summary.provenance.threads));

  text += "\n[particles]\n";
  for (const auto& [name, count] : summary.particles) line(toml_text(name), std::to_string(count));
  text += "\n[figures]\n";
  for (const auto& [name, value] : summary.figures) line(toml_text(name), toml_float(value));
  for (const auto& term : summary.terms) {
    text += "\n[[term]]\n";
    line("name", toml_text(term.name));
    line("formula", toml_text(term.formula));
    line("source", toml_text(term.source));
    line("parameters", toml_text(term.parameters));
  }
  for (const auto& part : summary.parts) {
    text += "\n[[part]]\n";
    line("name", toml_text(part.name));
    line("seconds", toml_float(part.seconds));
    line("calls", std::to_string(part.calls));
  }
  std::filesystem::create_directories(out);
  write_atomically(out / (summary.participant + "_summary.toml"), text);
}

}  // namespace toryu
