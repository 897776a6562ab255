#pragma once
#include <QByteArray>
#include <QString>
#include <vector>

namespace btr::ui {

/// An element of an array job, or a machine of a job of ranks.
struct JobPart {
  QString name;                ///< element: "worn knee, seed 3"; ranks: the machine
  QString state, host;         ///< of an element
  double share = -1;           ///< of an element, 0 to 1
  double trialsPerSecond = 0;  ///< 0: not known
  QString note;                ///< why it failed, or what it waits for
  int workers = 0;             ///< of a machine, with what it did so far:
  long pieces = 0, trials = 0, lost = 0;
};

/// A job on several machines as btr tells it.
struct JobStatus {
  enum class Kind { array, ranks };
  Kind kind = Kind::array;
  QString what, into;           ///< of an array: "compare", "grid" or "gap prove"; the database or folder that collects
  bool isSlurms = false;        ///< was given to Slurm
  bool isWorkedOnHere = false;  ///< over ssh, by a process of this machine
  QString stage;                ///< of ranks
  double share = 0;             ///< of all
  double secondsLeft = -1;      ///< negative: not known
  double trialsPerSecond = 0;
  std::vector<JobPart> parts;

  int count(const QString& state) const;
  /// It is a blind trial: what is counted are cases, not trials.
  bool areCases() const { return what == QStringLiteral("gap prove") || stage == QStringLiteral("blind cases"); }
  /// Something of it is queued or running.
  bool isGoing() const;
  /// Elements that `btr array resume` would work on: failed, stopped or not begun.
  int resumable() const { return count("failed") + count("stopped") + count("not begun"); }
};

/// Of `btr --json array status`, "uchilsim-array-status-1". Throws InputError where it is something else.
JobStatus arrayStatus(const QByteArray& json);
/// Of the file that `--places` keeps, "uchilsim-places-1". Likewise; `file` is named.
JobStatus placesStatus(const QByteArray& json, const QString& file);

}  // namespace btr::ui
