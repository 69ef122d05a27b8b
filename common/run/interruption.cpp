#include "common/run/interruption.hpp"

#include <csignal>

#include "common/error/failure.hpp"

namespace toryu {

namespace {

volatile std::sig_atomic_t requested = 0;

void request(int /*signal*/) {
  if (requested < 2) requested = requested + 1;
}

}  // namespace

void catch_interruptions() {
  requested = 0;
  struct sigaction action = {};
  action.sa_handler = request;
  action.sa_flags = SA_RESTART;  // a half-done write goes on
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    // who started this program ignored it on purpose, as nohup does SIGHUP to outlive the terminal
    if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
}

bool interruption_requested() {
  return requested != 0;
}

void throw_if_interrupted() {
  if (interruption_requested()) throw Interrupted();
}

void throw_if_interrupted_again() {
  if (requested > 1) throw Interrupted();
}

}  // namespace toryu
