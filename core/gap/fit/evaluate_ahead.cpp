#include "core/gap/fit/evaluate_ahead.h"

#include <algorithm>

#include "core/gap/fit/parallel.h"
#include "core/sim/worker_pool.h"

namespace btr {

void EvaluateAhead::PrepareForEvaluation(bool jacobians, bool /*newPoint*/) {
  constexpr std::size_t piecesPerWorker = 4;
  std::vector<const Asked*> open;
  for (const Asked& asked : costs_)
    if (asked.cost->simulatesAt(asked.blocks.data(), jacobians)) open.push_back(&asked);
  if (open.empty()) return;

  // Few long segments keep no two workers busy: their columns are divided.
  struct Piece {
    const Asked* of;
    Eigen::Index from, to;
  };
  std::vector<Piece> pieces;
  const bool divides = jacobians && !WorkerPool::inWorker();
  const std::size_t wanted =
      divides ? (piecesPerWorker * static_cast<std::size_t>(problem_.jobs) + open.size() - 1) / open.size() : 1;
  int replays = 1;
  for (const Asked* asked : open) {
    const Eigen::Index columns = jacobians && asked->cost->differencesNext() ? asked->cost->columns() : 0;
    const auto count =
        std::clamp<Eigen::Index>(static_cast<Eigen::Index>(wanted), 1, std::max<Eigen::Index>(1, columns));
    for (Eigen::Index k = 0; k < count; ++k) pieces.push_back({asked, k * columns / count, (k + 1) * columns / count});
    replays = std::max(replays, 1 + static_cast<int>(columns));
  }
  const auto numbers = inWorkers(problem_, pieces.size(), replays, [&](std::size_t k) {
    const Piece& piece = pieces[k];
    return piece.of->cost->simulated(piece.of->blocks.data(), piece.from, piece.to);
  });
  for (std::size_t k = 0; k < pieces.size();) {
    const Asked& of = *pieces[k].of;
    std::vector<double> all;
    bool refused = false;  // then Evaluate simulates it, and throws
    for (; k < pieces.size() && pieces[k].of == &of; ++k) {
      refused = refused || !numbers[k].ok();
      all.insert(all.end(), numbers[k].numbers.begin(), numbers[k].numbers.end());
    }
    if (!refused) of.cost->take(of.blocks.data(), all);
  }
}

}  // namespace btr
