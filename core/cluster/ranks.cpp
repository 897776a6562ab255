#include "core/cluster/ranks.h"

#include <algorithm>
#include <thread>

#include "core/cluster/build_identity.h"
#include "core/spec/error.h"

namespace btr {
namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

Ranks::Ranks(std::unique_ptr<RankLink> link, const PluginHost& host, CoordinatorOptions options)
    : link_(std::move(link)), options_(std::move(options)), identity_(buildIdentity(host)), last_(Clock::now()) {
  arrived_.assign(link_ ? static_cast<std::size_t>(link_->size()) : 1, false);
  arrived_[0] = true;
  for (int k = 0; k < options_.foremen; ++k) addMember(0, k, hostName());
}

Ranks::~Ranks() {
  crew_.reset();
  if (!link_) return;
  for (int rank = 1; rank < link_->size(); ++rank) link_->send(rank, pack({"quit"}));
  link_->finish();
}

void Ranks::addMember(int rank, int foreman, const std::string& host) {
  Member member;
  member.rank = rank;
  member.foreman = foreman;
  member.host = host;
  members_.push_back(std::move(member));
}

bool Ranks::areAllGone() const { return std::ranges::all_of(members_, &Member::gone); }

void Ranks::send(std::size_t number, const Parts& parts) {
  const Member& member = members_[number];
  if (member.rank == 0) return crew_->send(member.foreman, parts);
  Parts whole{"to", std::to_string(member.foreman)};
  whole.insert(whole.end(), parts.begin(), parts.end());
  link_->send(member.rank, pack(whole));
}

void Ranks::restart(std::size_t number) {
  const Member& member = members_[number];
  if (member.rank == 0) return crew_->restart(member.foreman);
  link_->send(member.rank, pack({"restart", std::to_string(member.foreman)}));
}

void Ranks::listen(const Hear& hear) {
  bool any = false;
  if (crew_) {
    const bool isIdle = std::ranges::all_of(members_, [](const Member& m) { return m.rank != 0 || m.isIdle; });
    constexpr std::chrono::milliseconds alone(100);
    for (const Crew::Event& event : crew_->wait(link_ ? momentToWait(Clock::now() - last_, isIdle) : alone)) {
      heard(static_cast<std::size_t>(event.foreman), event.parts, hear);
      any = true;
    }
  }
  if (link_) takeFromOthers(hear, any);
  if (any) last_ = Clock::now();
  if (!crew_ && !any) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

void Ranks::takeFromOthers(const Hear& hear, bool& any) {
  int from = 0;
  std::string bytes;
  while (link_->receive(from, bytes)) {
    any = true;
    Parts parts = unpack(bytes);
    if (parts.size() == 4 && parts[0] == "crew") {
      if (parts[3] != options_.words)
        throw InputError("rank " + std::to_string(from) + " (host " + parts[1] +
                         "): it was started with other words than rank 0; for a run of its own on each rank set "
                         "UCHILSIM_ALONE=1");
      const int foremen = std::stoi(parts[2]);
      for (int k = 0; k < foremen; ++k) addMember(from, k, parts[1]);
      arrived_[static_cast<std::size_t>(from)] = true;
      continue;
    }
    const int foreman = std::stoi(parts.front());
    const auto member =
        std::ranges::find_if(members_, [&](const Member& m) { return m.rank == from && m.foreman == foreman; });
    parts.erase(parts.begin());
    if (member != members_.end()) heard(static_cast<std::size_t>(member - members_.begin()), parts, hear);
  }
}

void Ranks::requireSame(std::size_t member, const Parts& ours, Parts::const_iterator from,
                        Parts::const_iterator to) const {
  if (const auto what = difference(ours, Parts(from, to)))
    throw InputError(members_[member].name() + ": " + *what + "; install the same build on every machine");
}

void Ranks::heard(std::size_t number, const Parts& parts, const Hear& hear) {
  Member& member = members_[number];
  const std::string& kind = parts.front();
  if (kind == "hello") {
    // Of a foreman that was started anew, the plugins of the task are checked once it is ready.
    if (!allBegun_) requireSame(number, parts.begin() + 1, parts.end());
    member.begun = true;
  } else if (kind == "lost" || kind == "gone") {
    member.gone = kind == "gone";
    member.begun = false;
  }
  hear(number, parts);
}

bool Ranks::haveAllBegun() const {
  return std::ranges::all_of(arrived_, [](bool a) { return a; }) &&
         std::ranges::all_of(members_, [](const Member& m) { return m.begun || m.gone; });
}

bool Ranks::begin(const std::function<bool()>& goesOn, const Hear& hear) {
  if (allBegun_) return true;
  if (!crew_ && options_.foremen > 0) crew_ = std::make_unique<Crew>(options_.foremen, options_.command);
  const auto begun = Clock::now();
  while (!haveAllBegun()) {
    if (!goesOn()) return false;
    listen(hear);
    if (std::chrono::duration<double>(Clock::now() - begun).count() < options_.patience_s) continue;
    for (std::size_t rank = 0; rank < arrived_.size(); ++rank)
      if (!arrived_[rank]) throw InputError("rank " + std::to_string(rank) + " did not begin in time");
    for (const Member& member : members_)
      if (!member.begun && !member.gone) throw InputError(member.name() + ": its workers did not begin in time");
  }
  if (areAllGone()) throw InputError("no rank has a worker");
  allBegun_ = true;
  return true;
}

std::chrono::microseconds momentToWait(Clock::duration sinceLast, bool isIdle) {
  using namespace std::chrono_literals;
  if (isIdle && sinceLast < 50ms) return 100us;
  return sinceLast < 1s ? 2ms : 5ms;
}

}  // namespace btr
