#pragma once
/// A certificate (docs/reference/certificate.md) as it is read: the model, then segment by segment. Only the text is
/// judged here: words, numbers, indices, order of records.
#include <istream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace verify {

/// The file is not a complete certificate; the message begins with the line.
struct Unreadable : std::runtime_error {
  Unreadable(long line, const std::string& why) : std::runtime_error("line " + std::to_string(line) + ": " + why) {}
};

inline constexpr int ground = -1;

/// A pair of coordinates; either may be the ground. Its displacement is x_a - x_b.
struct Pair {
  int a = 0, b = ground;
};

struct Element {
  Pair pair;
  double coefficient;  ///< stiffness of a spring, coefficient of a damper
};

/// amplitude sin(harmonic omega t + phase), or amplitude sin(frequency t + phase) where the frequency is not 0.
struct Force {
  int coordinate, harmonic;
  double amplitude, phase, frequency = 0.0;
};

struct Corner {
  double at, force;  ///< of restitution over speed: the speed and the restitution there
};

struct Stop {
  Pair pair;
  double clearance, restitution;  ///< the restitution below the first corner
  std::vector<Corner> corners;
  std::string name;
};

/// constant + sum (stiffness x_i + damping v_i) + the force of a compliant stop.
struct Normal {
  struct Term {
    int coordinate;
    double stiffness, damping;
  };
  double constant;
  int compliant;  ///< or -1
  std::vector<Term> terms;
};

struct Friction {
  Pair pair;
  double belt_speed, static_limit, kinetic;  ///< with a normal force: coefficients
  std::string name;
  std::optional<Normal> normal = {};
};

struct Compliant {
  Pair pair;
  double clearance, stiffness, damping;
  enum class Law { pushes, pulls, bounded };
  Law law;
  std::string name;
  /// Lets go where its force would pull.
  [[nodiscard]] bool lets_go() const { return law != Law::pulls && damping > 0.0; }
};

struct Polyline {
  Pair pair;
  enum class Over { displacement, velocity, zones };
  Over over;
  double slope_below, slope_above;
  std::vector<Corner> corners;
  std::string name;
};

/// A contact coordinate: p = x_a - x_b - shift, u = v_a - v_b - drift.
struct Number {
  Pair pair;
  double shift, drift;
};

using Table = std::vector<std::vector<double>>;

struct Model {
  std::string name;
  int n = 0;
  double omega = 0.0;
  bool in_sequence = false;  ///< Newton's law at one stop after the other, instead of Moreau's at all at once
  std::vector<double> masses;
  Table mass, damping, stiffness;  ///< added to what the parts give; empty for zero
  std::vector<Element> springs, dampers;
  std::vector<Force> forces;
  std::vector<Stop> stops;
  std::vector<Friction> frictions;
  std::vector<Compliant> compliant;
  std::vector<Polyline> polylines;
  std::vector<Number> numbers;

  [[nodiscard]] int d() const { return static_cast<int>(numbers.size()); }
  [[nodiscard]] bool forced() const;
};

struct Clock {
  long period = 0;
  double fraction = 0.0;
};

/// The state of every contact, in the order stops, friction contacts, compliant stops, polylines.
struct ContactStates {
  std::vector<bool> closed;
  static constexpr int unloaded = 2;
  std::vector<int> slip;  ///< -1, 0 (stick), 1, or unloaded
  [[nodiscard]] bool slips(std::size_t friction) const { return slip[friction] == 1 || slip[friction] == -1; }
  enum class Spring { off, on, detached, bounded };
  std::vector<Spring> compliant;
  std::vector<int> pieces;
  auto operator<=>(const ContactStates&) const = default;
};

enum class EndKind { cut, event, chatter };

/// Stops that get an impulse together.
struct Blow {
  enum class Kind { impact, pile_up, chatter };
  long line = 0;
  Kind kind = Kind::impact;
  std::vector<int> stops;
};

struct Impact {
  long line;
  int stop;
  double w;
};

struct Segment {
  long line = 0, number = 0;
  Clock start;
  double duration = 0.0;
  ContactStates states;
  std::vector<double> p, u;
  EndKind end = EndKind::cut;
  long end_line = 0;
  std::vector<int> chatter;  ///< the stops
  std::vector<Blow> blows;
  std::vector<Impact> impacts;
};

/// The end of the run.
struct Done {
  long line = 0;
  Clock at;
  std::vector<double> p, u;
};

struct Start {
  long line = 0;
  Clock at;
  std::vector<double> q, v;
};

class Reader {
 public:
  /// Reads the model and the start. @throws Unreadable
  explicit Reader(std::istream& in);
  [[nodiscard]] const Model& model() const { return model_; }
  [[nodiscard]] const Start& start() const { return start_; }
  [[nodiscard]] const Done& done() const { return done_; }
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
  double real_from(double least);
  long count(long least, long greatest);
  std::vector<double> reals(int n);
  Pair pair();
  Clock clock();
  void finish_line();

  void read_head();
  void read_masses();
  void read_table(const char* word, Table& table);
  void read_elements(const char* word, std::vector<Element>& elements);
  void read_forces();
  void read_stops();
  void read_frictions();
  void read_compliant();
  void read_normals();
  std::vector<Corner> corners(long least);
  void read_polylines();
  void read_numbers();
  void read_start();
  ContactStates contact_states();
  void read_end(Segment& segment);
  [[nodiscard]] std::vector<int> stops_in_order();
  void read_what_happens(Segment& segment);
  void read_done();

  std::istream& in_;
  Model model_;
  Start start_;
  Done done_;
  std::vector<std::string> words_;
  std::size_t next_word_ = 0;
  long line_ = 0, segments_ = 0;
};

}  // namespace verify
