#pragma once
#include <SQLiteCpp/SQLiteCpp.h>
#include <grp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace btr {

/// Runs each work in a process of its own, all side by side and as a user without special rights if asked for. Returns
/// what they say: an answer, "THROWN: …", or "DIED" for one that does not come to its end. No database may be open in
/// this process.
inline std::vector<std::string> inProcesses(const std::vector<std::function<std::string()>>& works,
                                            bool ordinaryUser = false) {
  struct Child {
    pid_t id;
    int answers;
  };
  std::vector<Child> children;
  for (const auto& work : works) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    const pid_t child = fork();
    if (child == 0) {
      close(ends[0]);
      std::string answer;
      constexpr unsigned nobody = 65534;
      if (ordinaryUser && geteuid() == 0 &&
          (setgroups(0, nullptr) != 0 || setgid(nobody) != 0 || setuid(nobody) != 0)) {
        answer = "RIGHTS CANNOT BE GIVEN UP";
      } else {
        try {
          answer = work();
        } catch (const std::exception& error) {
          answer = std::string("THROWN: ") + error.what();
        }
      }
      const bool written = write(ends[1], answer.data(), answer.size()) == static_cast<ssize_t>(answer.size());
      _exit(written ? 0 : 1);
    }
    close(ends[1]);
    children.push_back({child, ends[0]});
  }
  std::vector<std::string> answers;
  for (const Child& child : children) {
    std::string answer;
    char buffer[4096];
    for (ssize_t count; (count = read(child.answers, buffer, sizeof buffer)) > 0;)
      answer.append(buffer, static_cast<std::size_t>(count));
    close(child.answers);
    int status = 0;
    waitpid(child.id, &status, 0);
    answers.push_back(status == 0 ? answer : "DIED");
  }
  return answers;
}

inline std::string inAnotherProcess(const std::function<std::string()>& work, bool ordinaryUser = false) {
  return inProcesses({work}, ordinaryUser)[0];
}

/// SQLite's own full check, through a connection of its own.
inline std::string integrityOf(const std::string& path) {
  SQLite::Database database(path, SQLite::OPEN_READWRITE, 5000);
  const std::string foreignKeys =
      SQLite::Statement(database, "PRAGMA foreign_key_check").executeStep() ? "foreign keys" : "";
  return foreignKeys + database.execAndGet("PRAGMA integrity_check(1)").getString();
}

}  // namespace btr
