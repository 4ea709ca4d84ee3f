#pragma once
/// Whether a motion settles on a cycle. Returns of its state to a section say where to look; Newton's method on the map
/// of n returns and the rate at which the motion approaches decide.
///
/// The section of a driven motion is phase 0. A free one has the section of its flights (section/flight_section.hpp),
/// chosen at the start and again after the transient; "periods" are then its returns. A free motion that has no more
/// events has `ended`: section/outlook.hpp says where. One that `grows` beyond all bounds is followed no further.
///
/// Both `classify` and the search for orbits ask this class, so that what one names the other finds.
/// docs/explanation/classify.md, section 1, says how it decides.
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "section/confirmation.hpp"

namespace slapstick::section {

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

class Settling {
 public:
  Settling(const System& system, const State& state, const SettlingOptions& options);

  /// Leaves out this many periods.
  void discard(long periods);
  /// Looks for a return in a further round of periods, each four times as long as the one before; the last ends at
  /// most_periods.
  std::optional<Cycle> next_round();
  [[nodiscard]] bool exhausted() const { return ended_ || grows_ || done_ >= options_.most_periods; }
  /// The motion is beyond bounds (section/flights.hpp).
  [[nodiscard]] bool grows() const { return grows_; }
  /// A free motion: no more events.
  [[nodiscard]] bool ended() const { return ended_; }
  /// .. or it has events for ever, but shrinks to a state of rest on the border of two modes, as a mass that touches a
  /// compliant stop at rest: the contact state there.
  [[nodiscard]] const std::optional<Eigen::VectorXd>& shrinks_to() const { return shrinks_to_; }
  [[nodiscard]] double distance_from(const Eigen::VectorXd& x) const {
    return distance(translations(), record_.back(0), x, record_.scale());
  }
  /// The size of the motion so far, as of section::distance, if it is to reach numbers of these sizes too.
  [[nodiscard]] Eigen::VectorXd scale_with(const Eigen::VectorXd& sizes) const;
  [[nodiscard]] bool cancelled() const;
  [[nodiscard]] bool out_of_time() const;

  [[nodiscard]] long periods() const { return periods_; }
  [[nodiscard]] State state() const { return motion_.state(); }
  [[nodiscard]] const Motion& motion() const { return motion_; }
  [[nodiscard]] const ReturnMap& map() const { return *map_; }
  [[nodiscard]] const flow::Translations& translations() const { return map_->translations(); }
  /// A state moved back along the translations to where the start was.
  [[nodiscard]] State moved_to_start_cell(const State& state) const { return translations().moved(state, start_cell_); }
  /// By coordinate; zero if it cannot be told from none.
  [[nodiscard]] std::vector<double> drift(const Eigen::VectorXd& advance) const;
  /// True if the last round was still closing in on a cycle: the nearest of its returns kept shrinking. An invariant
  /// curve, too, returns close to its start, but no closer as time goes on.
  [[nodiscard]] bool still_approaching() const { return approaching_; }

 private:
  std::optional<PeriodEvents> run_period();
  void choose_section();
  std::optional<Cycle> run(int periods);
  [[nodiscard]] bool is_a_point(const Cycle& cycle) const;
  void note_approach(int k, int periods);
  [[nodiscard]] bool note_period();
  void lose_section();
  [[nodiscard]] Eigen::VectorXd sizes_between() const;
  void look_between(bool by_chance);
  void report() const {
    if (options_.progress) options_.progress(periods());
  }
  [[nodiscard]] Confirmation confirmation() const;

  const System& system_;
  SettlingOptions options_;
  std::unique_ptr<const ReturnMap> map_;
  Motion motion_;
  Eigen::VectorXd start_cell_;  ///< the start along each translation
  PointRecord record_;
  std::vector<double> earlier_;  ///< widest_return of every n, half a round ago
  double omega_;                 ///< of a period: what makes a velocity of a displacement
  long periods_ = 0;             ///< passed so far
  int round_, done_ = 0;
  bool free_;
  std::optional<Eigen::VectorXd> shrinks_to_;
  bool approaching_ = false, ended_ = false, grows_ = false;
};

}  // namespace slapstick::section
