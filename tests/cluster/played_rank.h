#pragma once
#include <deque>
#include <string>
#include <utility>

#include "core/cluster/rank_link.h"

namespace btr::test {

/// Another rank as its messages make it.
class PlayedRank : public RankLink {
 public:
  explicit PlayedRank(std::deque<Parts> says) : says_(std::move(says)) {}
  int rank() const override { return 0; }
  int size() const override { return 2; }
  void send(int, std::string) override {}
  bool receive(int& from, std::string& bytes) override {
    if (says_.empty()) return false;
    from = 1;
    bytes = pack(says_.front());
    says_.pop_front();
    return true;
  }
  void finish() override {}

 private:
  std::deque<Parts> says_;
};

}  // namespace btr::test
