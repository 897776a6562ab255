#pragma once
#include <memory>
#include <string>

namespace btr {

/// The ways between the ranks of a job, numbered from 0. A message arrives whole, and two between the same ranks in
/// their order. Belongs to one thread.
class RankLink {
 public:
  virtual ~RankLink() = default;
  virtual int rank() const = 0;
  virtual int size() const = 0;
  /// Returns at once; the message leaves while send() and receive() are called.
  virtual void send(int to, std::string bytes) = 0;
  /// A message that has arrived; false if there is none.
  virtual bool receive(int& from, std::string& bytes) = 0;
  /// Waits until everything has left and every rank has come here. Nothing may be sent after it.
  virtual void finish() = 0;
};

/// How a process was started: as one of several ranks, or alone.
struct Launch {
  int rank = 0, size = 1;
  std::string by;  ///< "mpirun" or "srun", "" alone
};
/// From the environment that mpirun and srun give to their processes; nothing is loaded for it. With UCHILSIM_ALONE=1
/// every process is alone, whoever started it.
Launch launchOfThisProcess();

/// The link that MPI makes, from the module libbtr_mpi.so beside the library of this program. Throws InputError if the
/// program was built without MPI, or if MPI sees fewer ranks than were started.
std::unique_ptr<RankLink> openMpi(const Launch& launch);

}  // namespace btr
