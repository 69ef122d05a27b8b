#include "common/run/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>

#include "common/case/case_file.hpp"
#include "common/case/nearest_word.hpp"
#include "common/error/failure.hpp"

namespace toryu {

namespace {

const std::vector<std::string> log_levels = {"trace", "debug", "info", "warn", "error", "off"};

/// Values as typed. They are checked here and not by CLI11, which stops at the first fault.
struct Typed {
  std::string case_path, out, record, start_frames, end_time, threads = "0", log_level = "info";
  std::vector<std::string> overrides;
  TypedNetwork network;
  bool check = false, outlook = false, columns = false, describe = false, print_case = false,
       resolved = false, restart = false, overwrite = false;
  bool can_checkpoint = false, version = false, help = false;
};

/// Whether a program answers with what another run recorded.
bool replays(const std::string& role) {
  return role.starts_with("replayed_");
}

void declare(CLI::App& app, const std::string& role, Typed& typed) {
  app.set_help_flag("");
  app.allow_extras();
  app.add_option("CASE", typed.case_path, "A case.toml, or a folder that holds one");
  app.add_option("--out", typed.out, "Folder of the results (default: out/<name of the case>)")
      ->type_name("DIR");
  app.add_option("--set", typed.overrides,
                 "Another value of the case: fluid.sound_speed=30, wall.floor.box.max=[1,0]; "
                 "false takes an optional section away (repeatable)")
      ->allow_extra_args(false)
      ->type_name("SECTION.KEY=VALUE");
  app.add_option("--end-time", typed.end_time, "Short for --set case.end_time=SECONDS")->type_name("SECONDS");
  app.add_option("--threads", typed.threads, "Threads at most; as many as pay compute (default 0: all cores)")
      ->type_name("N");
  app.add_option("--log-level", typed.log_level, "trace, debug, info (default), warn, error or off")
      ->type_name("LEVEL");
  app.add_option("--peers", typed.network.peers,
                 "All hosts of a coupled run, this one among them, for programs that are on several")
      ->type_name("A,B,C");
  app.add_option("--interface", typed.network.interface,
                 "Network interface to use, its name or address (default: the one that leads to the peers)")
      ->type_name("NAME");
  app.add_option("--domain", typed.network.domain,
                 "Ports of a coupled run, for a firewall: between hosts 7410 + 250 N to 7429 + 250 N of UDP "
                 "(default: by chance)")
      ->type_name("N");
  app.add_option("--lost-after", typed.network.lost_after,
                 "Silence after which a program that is not seen to run counts as lost (default 3)")
      ->type_name("SECONDS");
  app.add_option("--secure", typed.network.secure,
                 "Folder of identities: only programs with one of its CA take part in a coupled run")
      ->type_name("DIR");
  app.add_flag(
      "--collected", typed.network.collected,
      "Parts of checkpoints are brought from host to host while the run waits, as run.sh --host does");
  if (replays(role))
    app.add_option("--record", typed.record, "Results of the run that is replayed")->type_name("DIR");
  app.add_flag("--check", typed.check, "Check the case, compute nothing");
  app.add_flag("--outlook", typed.outlook, "With --check: make some steps, and tell what a run would take");
  app.add_flag("--columns", typed.columns, "With --check: list the columns of the series that a run writes");
  app.add_option("--start-frames", typed.start_frames, "With --check: write the particles at the start there")
      ->type_name("DIR");
  app.add_flag("--describe", typed.describe,
               "Print the parameters of a case with units, defaults and ranges");
  app.add_flag("--restart", typed.restart, "Go on from the newest checkpoint in the folder of the results");
  app.add_flag("--overwrite", typed.overwrite, "Replace the results that the folder holds");
  app.add_flag("--print-case", typed.print_case,
               "Print the case as it is read, with its base and the values of --set, as TOML");
  app.add_flag(
      "--resolved", typed.resolved,
      "Print the same as JSON with its kind, its files, the points of its references and the place of "
      "every key");
  app.add_flag("--can-checkpoint", typed.can_checkpoint,
               "Print whether the program can write a checkpoint: yes or no");
  app.add_flag("--version", typed.version, "Print the version and the commit");
  app.add_flag("--help", typed.help, "Print this help");
}

std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

/// Arguments that CLI11 could not place. The value of a mistyped option lands among the plain ones, so those
/// are reported only where no option is unknown.
std::vector<InputError> extra_faults(const CLI::App& app) {
  std::vector<InputError> unknown, plain;
  for (const auto& argument : app.remaining()) {
    if (!argument.starts_with("-")) {
      plain.push_back({.place = argument, .message = "one argument too many; there is one CASE"});
      continue;
    }
    const auto names = option_names(app);
    const std::string hint = did_you_mean(argument.substr(0, argument.find('=')), names);
    unknown.push_back(
        {.place = argument, .message = "unknown option" + (hint.empty() ? "; see --help" : hint)});
  }
  return unknown.empty() ? plain : unknown;
}

/// CLI11 would take the next argument for the value of "--out=". An empty one counts as none given: a run
/// with
/// "--secure ''" would not be secured.
void refuse_empty_values(const std::vector<std::string>& arguments) {
  const std::string* before = nullptr;
  for (const auto& argument : arguments) {
    if (argument.empty())
      throw BadInput({{.place = before ? *before + " ''" : "''", .message = "has no value"}});
    if (argument.starts_with("--") && argument.find('=') == argument.size() - 1)
      throw BadInput({{.place = argument, .message = "has no value"}});
    before = &argument;
  }
}

std::optional<int> thread_count(const std::string& text) {
  int threads = 0;
  const auto end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, threads);
  if (error != std::errc() || rest != end || threads < 0) return std::nullopt;
  return threads;
}

}  // namespace

Options parse_options(const std::string& role, const std::vector<std::string>& arguments) {
  refuse_empty_values(arguments);
  CLI::App app("", role);
  Typed typed;
  declare(app, role, typed);
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::ParseError& error) {
    throw BadInput({{.place = role, .message = error.what()}});
  }

  Options options;
  options.overrides = typed.overrides;
  options.log_level = typed.log_level;
  options.check = typed.check;
  options.outlook = typed.check && typed.outlook;
  options.columns = typed.check && typed.columns;
  if (typed.check) options.start_frames = typed.start_frames;
  options.describe = typed.describe;
  options.restart = typed.restart;
  options.overwrite = typed.overwrite;
  options.print_case = typed.print_case;
  options.resolved = typed.resolved;
  std::vector<InputError> faults = extra_faults(app);
  if (const auto threads = thread_count(typed.threads))
    options.threads = *threads;
  else
    faults.push_back({.place = "--threads " + typed.threads, .message = "must be an integer of at least 0"});
  if (replays(role) && typed.record.empty() && !typed.describe)
    faults.push_back({.place = role, .message = "no --record given; see --help"});
  options.record = typed.record;
  options.network = read_network(typed.network, faults);
  if (options.restart && options.overwrite)
    faults.push_back(
        {.place = "--restart", .message = "goes on with results that --overwrite would replace"});
  if (std::find(log_levels.begin(), log_levels.end(), typed.log_level) == log_levels.end())
    faults.push_back(
        {.place = "--log-level " + typed.log_level,
         .message = "must be one of " + quoted_list(log_levels) + did_you_mean(typed.log_level, log_levels)});
  if (!typed.end_time.empty()) options.overrides.push_back("case.end_time=" + typed.end_time);
  try {
    if (!typed.case_path.empty())
      options.case_path = find_case_file(typed.case_path);
    else if (!typed.describe && faults.empty())
      faults.push_back({.place = role, .message = "no CASE given; see --help"});
  } catch (const BadInput& error) {
    faults.insert(faults.end(), error.errors().begin(), error.errors().end());
  }
  if (!faults.empty()) throw BadInput(faults);
  options.out = typed.out;
  if (typed.out.empty() && !options.case_path.empty()) options.out = "out/" + case_name(options.case_path);
  return options;
}

std::string help_text(const std::string& role) {
  CLI::App app("", role);
  Typed typed;
  declare(app, role, typed);
  return app.help();
}

}  // namespace toryu
