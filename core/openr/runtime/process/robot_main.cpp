// The process in which the program of one robot runs: reads sensor frames from its link, answers each with an order
// frame. Started by RobotProcess, not by hand.
#include <fcntl.h>
#include <malloc.h>
#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <sys/personality.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "core/openr/link_stream.h"
#include "core/openr/runtime/objects/system.h"
#include "core/openr/runtime/process/confine.h"
#include "core/openr/runtime/process/console.h"
#include "core/openr/runtime/process/faults.h"
#include "core/spec/error.h"

namespace {

using namespace btr::openr;

struct Arguments {
  std::string stick, design = "ERS-7";
  int link = -1, methodLimit_s = 10;
};

bool read(int argc, char** argv, Arguments& arguments) {
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i], value = argv[i + 1];
    if (name == "--stick")
      arguments.stick = value;
    else if (name == "--design")
      arguments.design = value;
    else if (name == "--link")
      arguments.link = std::atoi(value.c_str());
    else if (name == "--method-limit")
      arguments.methodLimit_s = std::max(1, std::atoi(value.c_str()));
    else
      return false;
  }
  return argc % 2 == 1 && !arguments.stick.empty() && arguments.link >= 0;
}

/// Memory lies at the same addresses each time, so that programs that print or sort them do the same each time.
void fixAddresses(char** argv) {
  const int now = personality(0xffffffff);
  if (now < 0 || (now & ADDR_NO_RANDOMIZE) != 0 || std::getenv("BTR_OPENR_FIXED") != nullptr) return;
  if (personality(static_cast<unsigned long>(now | ADDR_NO_RANDOMIZE)) < 0) return;
  setenv("BTR_OPENR_FIXED", "1", 1);  // once is enough, whatever came of it
  execv("/proc/self/exe", argv);
}

/// Nothing of the simulator's reaches the program: no other file, no variable of its environment.
void quietPlace(int link) {
  close_range(static_cast<unsigned>(link) + 1, ~0u, 0);
  clearenv();
  setenv("TZ", "UTC", 1);
  const int nothing = open("/dev/null", O_RDWR);
  for (const int standard : {0, 1, 2}) dup2(nothing, standard);
  const rlimit noCore{0, 0}, memory{rlim_t{4} << 30, rlim_t{4} << 30}, file{rlim_t{256} << 20, rlim_t{256} << 20};
  setrlimit(RLIMIT_CORE, &noCore);
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_FSIZE, &file);  // many times a memory stick
  signal(SIGXFSZ, SIG_IGN);        // what is too large is not written
  signal(SIGPIPE, SIG_IGN);
  signal(SIGINT, SIG_IGN);  // the simulator ends us
}

/// The simulator's end is ours, even while a program waits for something that never comes.
void* watchSimulator(void* link) {
  pollfd one{static_cast<int>(reinterpret_cast<std::intptr_t>(link)), 0, 0};  // hanging up alone
  while (poll(&one, 1, -1) <= 0) {
  }
  syscall(SYS_exit_group, 0);  // of this process alone: exit() ends a method
  return nullptr;
}

/// A thread that only waits. No signal is its own: faults and time limits concern the program's.
void endWithSimulator(int link) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  constexpr std::size_t stack = 65536;
  pthread_attr_setstacksize(&attributes, stack);
  pthread_attr_setdetachstate(&attributes, PTHREAD_CREATE_DETACHED);
  pthread_t thread;
  pthread_create(&thread, &attributes, watchSimulator, reinterpret_cast<void*>(static_cast<std::intptr_t>(link)));
  pthread_attr_destroy(&attributes);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

void refuse(int link, const std::string& what) {
  std::vector<std::uint8_t> bytes;
  if (receiveMessage(link, bytes) != Passed::whole) return;
  OrderFrame orders;
  orders.ended = Ended{Ended::Why::refused, "", "", what};
  sendMessage(link, bytesOf(orders));
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  if (!read(argc, argv, arguments)) {
    std::fprintf(stderr, "openr_robot runs the OPEN-R program of one robot; it is started by btr and uchilsim\n");
    return 2;
  }
  fixAddresses(argv);
  mallopt(M_MMAP_MAX, 0);  // all of the heap is in one place, behind this program: see CMakeLists.txt
  quietPlace(arguments.link);
  fcntl(arguments.link, F_SETFD, FD_CLOEXEC);
  const bool confined = confine(arguments.stick);
  endWithSimulator(arguments.link);  // confined as this thread is
  System* system = nullptr;
  try {
    system = new System(robotDesign(arguments.design), arguments.stick);  // never deleted: modules live as long as we
    if (!confined)
      system->say("",
                  "this kernel does not keep programs on their stick (Landlock, Linux 5.13 or later): OPEN-R's own "
                  "functions alone do");
    openStreams();
    watchFaults(arguments.link, arguments.methodLimit_s);
    system->load();
    faultIsSettled();
  } catch (const std::exception& error) {
    refuse(arguments.link, error.what());
    return 1;
  }
  std::vector<std::uint8_t> bytes;
  while (receiveMessage(arguments.link, bytes) == Passed::whole) {
    OrderFrame orders;
    try {
      orders = system->step(sensorFrameFrom(bytes.data(), bytes.size()));
    } catch (const std::exception& error) {
      orders.ended = Ended{Ended::Why::refused, "", "", error.what()};
    }
    const bool over = orders.ended.has_value();
    const std::vector<std::uint8_t> answer = bytesOf(orders);
    faultIsSettled();
    if (sendMessage(arguments.link, answer) != Passed::whole || over) break;
  }
  // Without the modules' destructors: a program that has crashed may have left them nothing to destroy.
  quick_exit(0);
}
