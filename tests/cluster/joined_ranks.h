#pragma once
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/cluster/ranks.h"

namespace btr::test {

/// Several ranks in this process: every other than the first is served by a thread, which ends when rank 0 lets it.
class JoinedRanks {
 public:
  /// `options`: of the others.
  JoinedRanks(int size, const CoordinatorOptions& options) : boxes_(std::make_shared<Boxes>()) {
    boxes_->byRank.resize(static_cast<std::size_t>(size));
    for (int rank = 1; rank < size; ++rank)
      others_.emplace_back([rank, size, options, boxes = boxes_] {
        Link link(rank, size, boxes);
        serveRank(link, options);
      });
  }
  ~JoinedRanks() {
    for (std::thread& other : others_) other.join();
  }
  JoinedRanks(const JoinedRanks&) = delete;
  JoinedRanks& operator=(const JoinedRanks&) = delete;

  /// Of rank 0, which must have let the others end before this object goes.
  std::unique_ptr<RankLink> first() {
    return std::make_unique<Link>(0, static_cast<int>(boxes_->byRank.size()), boxes_);
  }

 private:
  struct Boxes {
    std::mutex mutex;
    std::vector<std::deque<std::pair<int, std::string>>> byRank;  ///< from whom, what
  };

  class Link : public RankLink {
   public:
    Link(int rank, int size, std::shared_ptr<Boxes> boxes) : rank_(rank), size_(size), boxes_(std::move(boxes)) {}
    int rank() const override { return rank_; }
    int size() const override { return size_; }
    void send(int to, std::string bytes) override {
      const std::lock_guard lock(boxes_->mutex);
      boxes_->byRank[static_cast<std::size_t>(to)].emplace_back(rank_, std::move(bytes));
    }
    bool receive(int& from, std::string& bytes) override {
      const std::lock_guard lock(boxes_->mutex);
      auto& mine = boxes_->byRank[static_cast<std::size_t>(rank_)];
      if (mine.empty()) return false;
      from = mine.front().first;
      bytes = std::move(mine.front().second);
      mine.pop_front();
      return true;
    }
    void finish() override {}

   private:
    const int rank_, size_;
    std::shared_ptr<Boxes> boxes_;
  };

  std::shared_ptr<Boxes> boxes_;
  std::vector<std::thread> others_;
};

}  // namespace btr::test
