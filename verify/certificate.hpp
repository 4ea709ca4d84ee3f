#pragma once
/// A certificate (docs/certificate.md) as it is read, segment by segment. Only the text is judged here: words, numbers,
/// indices, order of records.
#include <istream>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace verify {

/// The file is not a complete certificate; the message begins with the line.
struct Unreadable : std::runtime_error {
  Unreadable(long line, const std::string& why) : std::runtime_error("line " + std::to_string(line) + ": " + why) {}
};

using Entries = std::vector<std::pair<int, double>>;  ///< (index, value), ascending

struct Stop {
  int own;
  double sign, restitution;
  std::string name;
};

struct Guard {
  std::string kind;
  Entries row;
};

struct Mode {
  long line;
  std::vector<Entries> rows;
  std::vector<Guard> guards;
};

struct Head {
  std::string model;
  int m = 0, d = 0;
  double period = 0.0;
  std::vector<Stop> stops;
  std::vector<std::vector<double>> inertia;
};

struct Step {
  long line;
  double s, h, h1, M, d;
};

/// `prove` with its steps, or `rest`.
struct Claim {
  long line;
  int guard;
  bool rest;
  int order = 0;
  double limit = 0.0;
  std::vector<Step> steps = {};
};

enum class EndKind { cut, zero, touch, chatter };

struct End {
  long line = 0;
  EndKind kind = EndKind::cut;
  int index = -1;     ///< guard, or stop of a chatter
  double size = 0.0;  ///< DELTA, NOISE or ERROR
};

/// How the limit of a chatter is proved: modes, a bound of the time, of the accelerations towards the stop on the way
/// away from it and back.
struct Tail {
  long line = 0;  ///< 0: there is none
  long rise = 0, back = 0, hold = 0;
  double duration = 0.0, rise_least = 0.0, rise_most = 0.0, fall_least = 0.0, fall_most = 0.0;
};

struct Blow {
  long line;
  bool rest;
  std::vector<int> stops;
};

struct Event {
  long line;
  std::string kind, contact;
  double w;
};

struct Segment {
  long line = 0, number = 0, mode = 0, period = 0;
  double fraction = 0.0, duration = 0.0;
  std::vector<double> state;
  std::vector<Claim> claims;
  Tail tail;
  End end;
  std::vector<Blow> blows;
  std::vector<Event> events;
};

class Reader {
 public:
  /// Reads the head. @throws Unreadable
  explicit Reader(std::istream& in);
  [[nodiscard]] const Head& head() const { return head_; }
  [[nodiscard]] const std::map<long, Mode>& modes() const { return modes_; }
  /// The next segment with all that happens at its end; false at `done`. @throws Unreadable
  bool next(Segment& segment);

 private:
  void advance();  ///< to the next line
  [[noreturn]] void fail(const std::string& why) const { throw Unreadable(line_, why); }
  [[nodiscard]] bool at(const char* word) const { return !words_.empty() && words_[0] == word; }
  void expect(const char* word);
  std::string word();
  std::string rest_of_line();
  double real();
  long count(long least, long most);
  Entries entries();
  void finish_line();

  void read_head();
  void read_inertia();
  void read_mode();
  void read_claims(Segment& segment);
  void read_tail(Segment& segment);
  void read_end(Segment& segment);

  std::istream& in_;
  Head head_;
  std::map<long, Mode> modes_;
  std::vector<std::string> words_;
  std::size_t next_word_ = 0;
  long line_ = 0, segments_ = 0;
};

}  // namespace verify
