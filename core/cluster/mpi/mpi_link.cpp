// The ranks of an MPI job, a module that is loaded only where a launcher started several of them.
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <climits>
#include <list>

#include "core/cluster/rank_link.h"
#include "core/spec/error.h"

namespace btr {
namespace {

constexpr int tag = 1;

class MpiLink : public RankLink {
 public:
  MpiLink() {
    if (MPI_Init(nullptr, nullptr) != MPI_SUCCESS) throw InputError("MPI cannot be started");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~MpiLink() override { finish(); }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void send(int to, std::string bytes) override {
    if (bytes.size() > INT_MAX) throw InputError("a message between ranks of more than 2 GB cannot be sent");
    Leaving& message = leaving_.emplace_back();
    message.bytes = std::move(bytes);
    MPI_Isend(message.bytes.data(), static_cast<int>(message.bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD,
              &message.request);
    forgetWhatLeft();
  }

  bool receive(int& from, std::string& bytes) override {
    forgetWhatLeft();
    int there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &there, &status);
    if (!there) return false;
    int count = 0;
    MPI_Get_count(&status, MPI_BYTE, &count);
    bytes.resize(static_cast<std::size_t>(count));
    from = status.MPI_SOURCE;
    MPI_Recv(bytes.data(), count, MPI_BYTE, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return true;
  }

  void finish() override {
    if (finished_) return;
    finished_ = true;
    // What still arrives must be taken, or those who send it would wait for ever; and who has come to the barrier may
    // have nothing on its way any more, as nobody takes it behind it.
    int from = 0, done = 0;
    std::string ignored;
    while (!leaving_.empty()) receive(from, ignored);
    MPI_Request all;
    MPI_Ibarrier(MPI_COMM_WORLD, &all);
    while (!done)
      if (!receive(from, ignored)) MPI_Test(&all, &done, MPI_STATUS_IGNORE);
    MPI_Finalize();
  }

 private:
  struct Leaving {
    std::string bytes;
    MPI_Request request = MPI_REQUEST_NULL;
  };

  void forgetWhatLeft() {
    for (auto message = leaving_.begin(); message != leaving_.end();) {
      int done = 0;
      MPI_Test(&message->request, &done, MPI_STATUS_IGNORE);
      message = done ? leaving_.erase(message) : std::next(message);
    }
  }

  int rank_ = 0, size_ = 1;
  bool finished_ = false;
  std::list<Leaving> leaving_;
};

}  // namespace
}  // namespace btr

extern "C" __attribute__((visibility("default"))) btr::RankLink* btrOpenMpi() { return new btr::MpiLink; }
