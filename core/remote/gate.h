#pragma once
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/remote/clock.h"

namespace btr::remote {

/// What a client may do; each may what those before may.
enum class Role { watch, drive, administrate };
const char* wordOf(Role role);

/// True for an address that nobody but this machine reaches: 127.0.0.0/8, ::1, localhost.
bool isLoopback(const std::string& address);

/// True for a caller on this machine, `peer` as gRPC names it.
bool isOfThisMachine(const std::string& peer);

/// Who may do what. A line of the file is "ROLE TOKEN [NAME]", of which TOKEN has at least 20 characters; lines that
/// begin with # are remarks.
class TokenBook {
 public:
  struct Entry {
    Role role;
    std::string name;
  };
  /// Throws InputError for a file that is not there, that others may read or write (mode 0600 is wanted), or a line
  /// that is wrong.
  explicit TokenBook(const std::string& path);
  /// Nothing if nobody has this token. Takes as long whatever the token is.
  std::optional<Entry> find(const std::string& token) const;

 private:
  struct Kept {
    std::string sha256;
    Entry entry;
  };
  std::vector<Kept> kept_;
};

/// Lets so many through in a second, and a burst of one second's at once.
class Bucket {
 public:
  explicit Bucket(double perSecond) : perSecond_(perSecond), left_(perSecond) {}
  /// False if there were too many. `now_s` never goes back.
  bool take(double now_s);
  bool isFull(double now_s) const { return left_ + (now_s - since_s_) * perSecond_ >= perSecond_; }

 private:
  double perSecond_, left_, since_s_ = 0;
};

/// Judges each call before anything else is done with it. From any thread.
class Gate {
 public:
  struct Options {
    std::string tokenFile;                    ///< "": who reaches the server may drive
    double callsPerSecond = 10000;            ///< of one client
    double failuresPerSecond = 5;             ///< tries with a wrong token from one address
    std::function<double()> clock_s = now_s;  ///< never goes back
  };
  explicit Gate(const Options& options);

  struct Caller {
    Role role;
    std::string name;            ///< whose calls are counted together: a token's, or an address
    std::string who = "remote";  ///< as it is stored: the token's name, if it has one
  };
  /// `peer` as gRPC names it, `authorization` the metadata of that name. Throws Refusal.
  Caller admit(const std::string& peer, const std::string& authorization, Role needed);
  /// A further message of a stream. Throws Refusal.
  void count(const Caller& caller);

 private:
  bool take(std::map<std::string, Bucket>& buckets, const std::string& name, double perSecond);

  const Options options_;
  std::optional<TokenBook> tokens_;
  std::mutex mutex_;
  std::map<std::string, Bucket> calls_, failures_;
};

}  // namespace btr::remote
