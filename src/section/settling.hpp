#pragma once
/// Whether a motion of a forced model settles on a cycle. Returns of its stroboscopic state say where to look; Newton's
/// method on the n-period map and the rate at which the motion approaches decide.
///
/// Both `classify` and the search for orbits ask this class, so that what one names the other finds. docs/classify.md,
/// section 1, says how it decides.
#include <chrono>
#include <functional>
#include <optional>
#include <vector>

#include "section/return_map.hpp"

namespace slapstick::section {

/// Events within one forcing period, of all contacts; engagements of compliant stops are impacts
/// (section/stop_choice.hpp).
struct PeriodEvents {
  int impacts = 0, sticks = 0, chatters = 0;
  friend bool operator==(const PeriodEvents&, const PeriodEvents&) = default;
};

/// Runs to the end of the present period and counts.
PeriodEvents run_one_period(Motion& motion, Stop stop);

struct SettlingOptions {
  int most_periods = 20'000;   ///< how long returns are looked for
  int most_n = 64;             ///< longest cycle sought, forcing periods
  double tolerance = 1e-10;    ///< return distance, relative to the size of the motion
  double newton_start = 1e-3;  ///< return distance below which a cycle is looked for nearby
  Stop stop = nullptr;
  std::optional<std::chrono::steady_clock::time_point> until = {};  ///< ends the search, as `stop` does
  std::function<void(long periods)> progress = {};
};

/// A cycle of the stroboscopic map that the motion is drawn to, or that it is on where the cycle is one of a family.
struct Cycle {
  Eigen::VectorXd x;                              ///< contact state at phase 0, representative of its class
  int n = 0;                                      ///< forcing periods
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
  [[nodiscard]] bool exhausted() const { return done_ >= options_.most_periods; }
  [[nodiscard]] bool cancelled() const;
  [[nodiscard]] bool out_of_time() const;

  [[nodiscard]] long periods() const { return static_cast<long>(motion_.time().period); }
  [[nodiscard]] State state() const { return motion_.state(); }
  [[nodiscard]] const flow::Translations& translations() const { return translations_; }
  /// A state moved back along the translations to where the start was.
  [[nodiscard]] State at_home(const State& state) const { return translations_.moved(state, home_); }
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
  PeriodEvents run_period(Motion& motion) const;
  std::optional<Cycle> run(int periods);
  struct Look {
    std::optional<Cycle> cycle;
    int refused_return = 0;  ///< after so many periods the motion returned, but is drawn to no cycle; 0: none
  };
  /// Returns within the tolerance, and, as a start for Newton's method, wider ones.
  [[nodiscard]] Look look_for_return(bool newton_turn, bool return_turn) const;
  void note_approach(int k, int periods);
  void note_period();
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
  flow::Translations translations_;
  Motion motion_;
  Eigen::VectorXd home_;   ///< the start along each translation
  Eigen::VectorXd scale_;  ///< size of the motion: positions share one number, velocities another
  std::vector<Eigen::VectorXd> states_;
  std::vector<PeriodEvents> events_;
  std::vector<double> earlier_;  ///< widest_return of every n, half a round ago
  int round_, done_ = 0;
  bool approaching_ = false;
};

}  // namespace slapstick::section
