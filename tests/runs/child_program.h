#pragma once
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

namespace btr {

/// Starts btr with these words, its standard output thrown away: a process to be killed.
inline pid_t startBtr(std::vector<std::string> words) {
  const pid_t pid = fork();
  if (pid == 0) {
    if (!freopen("/dev/null", "w", stdout)) _exit(98);
    std::vector<char*> arguments{const_cast<char*>("btr")};
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    execv(BTR_PROGRAM, arguments.data());
    _exit(99);
  }
  return pid;
}

/// Its exit code once it has ended, −n if signal n ended it.
inline int endOf(pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

}  // namespace btr
