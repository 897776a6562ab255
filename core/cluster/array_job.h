#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/cluster/parts.h"

namespace btr {

/// One part of an array job, which a machine works on for itself.
struct ArrayElement {
  std::string name;  ///< "worn knee, seed 3"
  /// Of btr; "{db}" is its database, "{out}" its folder, "{places}" a file in which btr keeps how fast it is.
  std::vector<std::string> arguments;
  std::vector<std::size_t> cases = {};  ///< of a blind trial: those that it proves
};

/// Runs of a comparison, grids or blind cases for a batch queue or for other machines over ssh, in a folder: job.json
/// ("format": "uchilsim-array-1"), for element N = 1, 2, … what it begins with and comes to (N.db or N.tar), how it is
/// (N.json) and what it said (N.log). A database holds all that a run needs (experiment, scene, robots), so that an
/// element needs no other file.
struct ArrayJob {
  std::string what;     ///< "compare", "grid" or "gap prove"
  std::string into;     ///< the database or folder that collects the results; absolute
  std::string program;  ///< btr, absolute
  int workers = 1;      ///< worker processes of each element
  std::vector<ArrayElement> elements;
  Parts build;                        ///< buildIdentity() of who wrote it
  std::vector<std::string> queueIds;  ///< of the queue's jobs that work on it, in their order
};

/// Throws InputError: the folder must not be there, or be empty.
void claimArrayFolder(const std::string& folder);
void saveArrayJob(const std::string& folder, const ArrayJob& job);
/// Throws InputError for a folder that holds none.
ArrayJob loadArrayJob(const std::string& folder);

/// How an element is, as it says itself.
struct ElementState {
  std::string state;  ///< "" (not begun), "running", "done", "waiting" (for a person), "stopped", "failed"
  std::string host;
  std::string note;                 ///< why it failed or what it waits for
  double share = 0;                 ///< of what is to be done, as far as it is known
  double gained = 0, worked_s = 0;  ///< the part of it that was done since it last began, and how long that took
  double trialsPerSecond = 0;       ///< of a blind trial cases, 0: not known
  std::string login = {};           ///< by which ssh reached its machine
  long process = 0;                 ///< there
};
std::string toJsonText(const ElementState& state);
ElementState elementStateFromJson(const std::string& text);  ///< throws nlohmann::json::exception
void saveElementState(const std::string& folder, std::size_t number, const ElementState& state);
ElementState loadElementState(const std::string& folder, std::size_t number);

/// How far a job is as a whole.
struct ArrayProgress {
  double share = 0;            ///< of all elements
  double secondsLeft = -1;     ///< at the pace so far, on as many machines as now; negative: not known
  double trialsPerSecond = 0;  ///< of all that are running
};
ArrayProgress progressOf(const std::vector<ElementState>& states);

/// A file of the folder: "FOLDER/7.db".
std::string elementFile(const std::string& folder, std::size_t number, const std::string& ending);

/// The element's database in the job's folder, for startRun() and others to begin.
std::string elementDatabase(const std::string& folder, std::size_t number);

/// The cases of an element in the job's folder, "FOLDER/7.tar".
std::string elementCases(const std::string& folder, std::size_t number);
/// Packs the finished cases of a blind trial's folder, whole or not at all; none where there is no such folder. Throws
/// InputError.
void packCases(const std::string& trial, const std::string& tar);
/// Unpacks them into a folder, which is made. Throws InputError.
void unpackCases(const std::string& tar, const std::string& trial);
/// Of these cases, how many are finished there.
std::size_t finishedCases(const std::string& trial, const std::vector<std::size_t>& cases);

/// What came of collecting.
struct Collected {
  std::size_t fresh = 0, before = 0;  ///< elements taken now; those that had been taken
  std::vector<std::size_t> missing;   ///< elements that are not done
};
/// Takes the results of all elements that are done, once each: runs and grids into the database. Of a blind trial all
/// finished cases, into the folder, of elements that are not done, too; then it counts what the folder holds as
/// runProof() does.
Collected collectArray(const std::string& folder);

}  // namespace btr
