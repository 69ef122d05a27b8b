/// Preloaded into a program, this runs its `main` many times, at a small part of the price of a start each:
/// what precedes `main`, such as loading the libraries, happens once. A fork of that process runs `main` for
/// some requests, until one of them ends it; then comes the next fork.
///
/// On the socket FORK_SERVER a request is one packet, texts that end with zero: the folder to work in, the
/// files for standard output and standard error, and the arguments with the program's name first. The answers
/// are the process id and, when `main` has ended, its status as waitpid tells it.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace {

using Main = int (*)(int, char**, char**);
Main program_main = nullptr;

constexpr int runs_per_fork = 50;
enum class State { idle, busy, over };

void open_as(int descriptor, const char* path, int flags) {
  const int opened = open(path, flags, 0600);
  if (opened < 0 || dup2(opened, descriptor) < 0) _exit(127);
  close(opened);
}

int run(std::vector<char*> texts, char** environment) {
  if (chdir(texts[0]) != 0) _exit(127);
  open_as(0, "/dev/null", O_RDONLY);
  open_as(1, texts[1], O_WRONLY | O_CREAT | O_TRUNC);
  open_as(2, texts[2], O_WRONLY | O_CREAT | O_TRUNC);
  const int count = static_cast<int>(texts.size()) - 3;
  texts.push_back(nullptr);
  const int code = program_main(count, texts.data() + 3, environment);
  std::cout.flush();
  std::fflush(nullptr);
  return code;
}

/// What a fork does.
void serve_some(int server, volatile State& state, char** environment) {
  std::string packet(65536, '\0');
  const pid_t self = getpid();
  for (int n = 0; n < runs_per_fork; ++n) {
    const ssize_t length = recv(server, packet.data(), packet.size(), 0);
    if (length <= 0) {
      state = State::over;
      return;
    }
    state = State::busy;
    send(server, &self, sizeof self, 0);
    std::vector<char*> texts;
    for (ssize_t k = 0; k < length; ++k)
      if (k == 0 || packet[k - 1] == '\0') texts.push_back(&packet[k]);
    const int status = W_EXITCODE(run(texts, environment), 0);
    state = State::idle;
    send(server, &status, sizeof status, 0);
  }
}

int serve(int argc, char** argv, char** environment) {
  const char* number = std::getenv("FORK_SERVER");
  if (number == nullptr) return program_main(argc, argv, environment);
  const int server = std::atoi(number);
  auto& state = *static_cast<volatile State*>(
      mmap(nullptr, sizeof(State), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  while (state != State::over) {
    const pid_t process = fork();
    if (process == 0) {
      serve_some(server, state, environment);
      return 0;
    }
    int status = 0;
    waitpid(process, &status, 0);
    if (state != State::busy) continue;
    state = State::idle;
    send(server, &status, sizeof status, 0);
  }
  return 0;
}

}  // namespace

/// What the C library calls to start a program.
extern "C" int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                                 void (*rtld_fini)(), void* stack_end) {
  program_main = main;
  const auto next = reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return next(serve, argc, argv, init, fini, rtld_fini, stack_end);
}
