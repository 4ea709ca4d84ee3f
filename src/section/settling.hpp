#pragma once
/// Whether a motion settles on a cycle. Returns of its state to a section say where to look; Newton's method on the map
/// of n returns and the rate at which the motion approaches decide.
///
/// The section of a driven motion is phase 0. A free one has the section of its flights (section/flight_section.hpp),
/// chosen at the start and again after the transient; "periods" are then its returns. A free motion that has no more
/// events has `ended`: section/rest.hpp says where.
///
/// Both `classify` and the search for orbits ask this class, so that what one names the other finds.
/// docs/explanation/classify.md, section 1, says how it decides.
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "section/return_map.hpp"

namespace slapstick::section {

/// Events within one period, of all contacts; engagements of compliant stops are impacts
/// (section/stop_choice.hpp).
struct PeriodEvents {
  int impacts = 0, sticks = 0, chatters = 0;
  friend bool operator==(const PeriodEvents&, const PeriodEvents&) = default;
};

/// Runs to an instant and counts.
PeriodEvents run_counting(Motion& motion, Instant end, Stop stop);

/// Has a harmonic force an amplitude? Otherwise motions are free, and a clock, if there is one, is a unit of time only.
[[nodiscard]] bool driven(const Model& model);
[[nodiscard]] inline bool driven(const System& system) { return driven(system.model()); }

struct SettlingOptions {
  int most_periods = 20'000;   ///< how long returns are looked for
  int most_n = 64;             ///< longest cycle sought, periods
  double tolerance = 1e-10;    ///< return distance, relative to the size of the motion
  double newton_start = 1e-3;  ///< return distance below which a cycle is looked for nearby
  bool by_clock = false;       ///< the section is phase 0 also of a free motion: it is to be driven at other parameters
  Stop stop = nullptr;
  std::optional<std::chrono::steady_clock::time_point> until = {};  ///< ends the search, as `stop` does
  std::function<void(long periods)> progress = {};
};

/// A cycle of the return map that the motion is drawn to, or that it is on where the cycle is one of a family.
struct Cycle {
  Eigen::VectorXd x;                              ///< contact state on the section, representative of its class
  int n = 0;                                      ///< returns
  double duration = 0.0;                          ///< in periods of the clock
  std::vector<std::complex<double>> multipliers;  ///< largest modulus first
  Eigen::VectorXd advance;                        ///< along each translation, per cycle
  double return_distance = 0.0;                   ///< of x from its image, relative to the motion's size
  double approach = 0.0;                          ///< how far the motion itself still was from the cycle
  int family = 0;                                 ///< dimensions of the continuum of cycles that it is a member of
  bool neutral = false;                           ///< the motion is on it, but is not drawn to it
};

class Settling {
 public:
  Settling(const System& system, const State& state, const SettlingOptions& options);

  /// Leaves out so many periods.
  void discard(long periods);
  /// Looks for a return in a further round of periods, each four times as long as the one before; the last ends at
  /// most_periods.
  std::optional<Cycle> next_round();
  [[nodiscard]] bool exhausted() const { return ended_ || done_ >= options_.most_periods; }
  /// A free motion: no more events.
  [[nodiscard]] bool ended() const { return ended_; }
  /// .. or it has events for ever, but shrinks to a state of rest on the border of two modes, as a mass that touches a
  /// compliant stop at rest: the contact state there.
  [[nodiscard]] const std::optional<Eigen::VectorXd>& shrinks_to() const { return shrinks_to_; }
  [[nodiscard]] double distance_from(const Eigen::VectorXd& x) const { return distance(back(0), x, scale_); }
  [[nodiscard]] bool cancelled() const;
  [[nodiscard]] bool out_of_time() const;

  [[nodiscard]] long periods() const { return periods_; }
  [[nodiscard]] State state() const { return motion_.state(); }
  [[nodiscard]] const Motion& motion() const { return motion_; }
  [[nodiscard]] const ReturnMap& map() const { return *map_; }
  [[nodiscard]] const flow::Translations& translations() const { return map_->translations(); }
  /// A state moved back along the translations to where the start was.
  [[nodiscard]] State at_home(const State& state) const { return translations().moved(state, home_); }
  /// By coordinate; zero if it cannot be told from none.
  [[nodiscard]] std::vector<double> drift(const Eigen::VectorXd& advance) const;
  /// True if the last round was still closing in on a cycle: the nearest of its returns kept shrinking. An invariant
  /// curve, too, returns close to its start, but no closer as time goes on.
  [[nodiscard]] bool still_approaching() const { return approaching_; }

 private:
  [[nodiscard]] const Eigen::VectorXd& back(long n) const {
    return states_[states_.size() - 1 - static_cast<std::size_t>(n)];
  }
  [[nodiscard]] double returned(long n, long cycles_ago = 0) const {
    return distance(back(cycles_ago * n), back((cycles_ago + 1) * n), scale_);
  }
  [[nodiscard]] double widest_return(int n) const;
  std::optional<PeriodEvents> run_period();
  void choose_section();
  std::optional<Cycle> run(int periods);
  [[nodiscard]] bool is_a_point(const Cycle& cycle) const;
  struct Look {
    std::optional<Cycle> cycle;
    int refused_return = 0;  ///< after so many periods the motion returned, but is drawn to no cycle; 0: none
  };
  /// Returns within the tolerance, and, as a start for Newton's method, wider ones.
  [[nodiscard]] Look look_for_return(bool newton_turn, bool return_turn) const;
  void note_approach(int k, int periods);
  [[nodiscard]] bool note_period();
  void lose_section();
  void note_size(const Eigen::VectorXd& x);
  void look_between();
  void report() const {
    if (options_.progress) options_.progress(periods());
  }
  [[nodiscard]] bool same_events(long n) const;
  [[nodiscard]] Eigen::VectorXd mean(int n, long count) const;
  [[nodiscard]] std::optional<Cycle> confirm(int n) const;
  [[nodiscard]] FixedPoint once_round(FixedPoint found, int& n) const;
  [[nodiscard]] std::optional<Cycle> drawn_to(int n, const Eigen::VectorXd& start) const;
  [[nodiscard]] std::optional<Cycle> member(int n) const;
  [[nodiscard]] std::optional<Cycle> look_around() const;

  const System& system_;
  SettlingOptions options_;
  std::unique_ptr<const ReturnMap> map_;
  Motion motion_;
  Eigen::VectorXd home_;   ///< the start along each translation
  Eigen::VectorXd scale_;  ///< size of the motion: positions share one number, velocities another
  std::vector<Eigen::VectorXd> states_;
  std::vector<PeriodEvents> events_;
  std::vector<double> earlier_;  ///< widest_return of every n, half a round ago
  double omega_;      ///< of a period: what makes a velocity of a displacement
  long periods_ = 0;  ///< that have passed
  int round_, done_ = 0;
  bool free_;
  std::optional<Eigen::VectorXd> shrinks_to_;
  bool approaching_ = false, ended_ = false;
};

}  // namespace slapstick::section
