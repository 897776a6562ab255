#include "core/remote/gate.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sstream>

#include "core/remote/refusal.h"
#include "core/spec/error.h"
#include "core/spec/json_reader.h"
#include "core/spec/sha256.h"

namespace btr::remote {
namespace {

/// Looks at every character, whatever it finds. Both have the same length.
bool isSame(const std::string& a, const std::string& b) {
  volatile unsigned char different = 0;
  for (std::size_t i = 0; i < a.size() && i < b.size(); ++i)
    different = static_cast<unsigned char>(different | (a[i] ^ b[i]));
  return different == 0 && a.size() == b.size();
}

/// "ipv4:127.0.0.1:5000" without its port: a client that connects again is the same one.
std::string addressOf(const std::string& peer) {
  const std::size_t colon = peer.rfind(':');
  return peer.starts_with("ip") && colon != std::string::npos ? peer.substr(0, colon) : peer;
}

/// Only its owner may read and write it; asked of the opened file, so that it is the one that is read.
void requirePrivate(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0)
    throw InputError("--token-file", path, std::string("a file that can be read (") + std::strerror(errno) + ")");
  struct stat status {};
  const bool known = fstat(file, &status) == 0;
  close(file);
  if (!known || !S_ISREG(status.st_mode)) throw InputError("--token-file", path, "a regular file");
  if ((status.st_mode & 077) != 0)
    throw InputError("--token-file", path + " that others may read", "a file of mode 0600: chmod 600 " + path);
}

}  // namespace

const char* wordOf(Role role) { return role == Role::watch ? "watch" : role == Role::drive ? "drive" : "administrate"; }

bool isLoopback(const std::string& address) {
  if (address == "localhost" || address == "::1") return true;
  if (!address.starts_with("127.")) return false;
  return std::ranges::count(address, '.') == 3 &&
         std::ranges::all_of(address, [](char c) { return c == '.' || (c >= '0' && c <= '9'); });
}

bool isOfThisMachine(const std::string& peer) {
  const std::string address = addressOf(peer);
  if (address.starts_with("ipv4:")) return isLoopback(address.substr(5));
  return address.starts_with("unix:") || address == "ipv6:[::1]" || address == "ipv6:%5B::1%5D";
}

TokenBook::TokenBook(const std::string& path) {
  constexpr std::size_t shortest = 20, largestFile = 1u << 20;
  requirePrivate(path);
  std::istringstream lines(readFile(path, largestFile));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string role, token, name, more;
    if (!(words >> role) || role.starts_with('#')) continue;
    words >> token >> name >> more;
    // The token itself is never shown.
    Entry entry{Role::watch, name.empty() ? "line " + std::to_string(number) : name};
    if (role == "drive")
      entry.role = Role::drive;
    else if (role == "administrate")
      entry.role = Role::administrate;
    else if (role != "watch")
      throw InputError(path, number, "a line that does not begin with watch, drive or administrate");
    if (token.size() < shortest)
      throw InputError(path, number, "a token of less than " + std::to_string(shortest) + " characters");
    if (!more.empty()) throw InputError(path, number, "more than ROLE TOKEN NAME");
    kept_.push_back({sha256(token), entry});
  }
  if (kept_.empty()) throw InputError("--token-file", path + " without a token", "lines ROLE TOKEN [NAME]");
}

std::optional<TokenBook::Entry> TokenBook::find(const std::string& token) const {
  const std::string sha = sha256(token);
  const Kept* found = nullptr;
  for (const Kept& kept : kept_)
    if (isSame(kept.sha256, sha)) found = &kept;
  return found ? std::optional(found->entry) : std::nullopt;
}

bool Bucket::take(double now_s) {
  left_ = std::min(perSecond_, left_ + (now_s - since_s_) * perSecond_);
  since_s_ = now_s;
  if (left_ < 1) return false;
  left_ -= 1;
  return true;
}

Gate::Gate(const Options& options) : options_(options) {
  if (!options.tokenFile.empty()) tokens_.emplace(options.tokenFile);
}

bool Gate::take(std::map<std::string, Bucket>& buckets, const std::string& name, double perSecond) {
  constexpr std::size_t mostNames = 10000;
  const std::lock_guard lock(mutex_);
  const double now = options_.clock_s();
  // Who has not called for a second is forgotten, and nobody new comes in while there are too many others.
  if (buckets.size() >= mostNames && !buckets.contains(name)) {
    std::erase_if(buckets, [&](const auto& each) { return each.second.isFull(now); });
    if (buckets.size() >= mostNames) return false;
  }
  return buckets.try_emplace(name, std::max(1.0, perSecond)).first->second.take(now);
}

Gate::Caller Gate::admit(const std::string& peer, const std::string& authorization, Role needed) {
  Caller caller{Role::drive, addressOf(peer)};
  if (tokens_) {
    const std::string bearer = "Bearer ";
    const bool said = authorization.starts_with(bearer);
    const auto entry = tokens_->find(said ? authorization.substr(bearer.size()) : "");
    if (!entry) {
      if (!take(failures_, addressOf(peer), options_.failuresPerSecond))
        throw Refusal(Code::tooMuch, "too many calls without a token that is known; wait a second");
      throw Refusal(Code::nobody, said ? "this token is not known" : "this server wants a token");
    }
    caller = {entry->role, "token " + entry->name, entry->name};
  }
  count(caller);
  if (caller.role < needed)
    throw Refusal(Code::notAllowed, std::string("this call needs the role ") + wordOf(needed) + "; " +
                                        (tokens_ ? "the token's" : "without a token the role") + " is " +
                                        wordOf(caller.role));
  return caller;
}

void Gate::count(const Caller& caller) {
  if (!take(calls_, caller.name, options_.callsPerSecond))
    throw Refusal(Code::tooMuch, "more than " + toText(options_.callsPerSecond) + " calls a second");
}

}  // namespace btr::remote
