#pragma once
/// The rules of docs/reference/certificate.md that lead from segment to segment: clock, continuity, rest, impulses, the
/// choice of the mode. What happens at the end of a segment is judged with the start of the next one, whose state says
/// which stops touch.
#include <map>
#include <memory>

#include "flight.hpp"
#include "jumps.hpp"
#include "limit.hpp"

namespace verify {

/// What a verdict leaves open.
struct Open {
  long pile_ups = 0;   ///< impacts without end at one instant, ended by assumption
  long undecided = 0;  ///< signs that rounding decides: touches, impacts without speed
  long choices = 0;    ///< starts at which another mode is as lawful
  long still = 0;      ///< coordinates that rounding alone moves: zero up to the rounding of their contact numbers
  [[nodiscard]] bool none() const { return pile_ups + undecided + choices + still == 0; }
};

/// The largest, and all together, in units of what the coordinate is added up from.
struct JumpTally {
  double largest = 0.0, sum = 0.0;
};

struct Tally {
  FlightTally flight;
  Open open;
  long segments = 0, events = 0, impacts = 0, chatters = 0;
  JumpTally displacement, velocity;
  double of_allowed = 0.0;   ///< the greatest jump in units of what it may be
  JumpTally clock;           ///< jumps of the clock, in periods
  double limit_error = 0.0;  ///< of the limits of chatter, in periods
};

class Checker {
 public:
  /// @param model, start  as the reader fills them; they must outlive the object
  Checker(const Model& model, const Start& start, const Refuse& refuse);
  Checker(const Checker&) = delete;
  Checker& operator=(const Checker&) = delete;
  void segment(const Segment& segment);
  void done(const Done& done);
  [[nodiscard]] const Tally& tally() const { return tally_; }

 private:
  /// X- of a segment's end, and what the blows make of it.
  struct Departure {
    Segment segment;
    Balls X;
    std::vector<double> size;
    std::vector<bool> touches = {};  ///< stops whose gap is zero
    std::vector<bool> struck = {};   ///< stops that had an impulse
    Balls rests_from = {};           ///< velocities towards the stops that a chatter has brought to rest
  };
  /// Impacts of one instant.
  struct Instant {
    std::vector<double> fastest;  ///< by stop; 0 for one that was not struck
    long blows = 0;
    std::vector<std::vector<int>> rested = {};  ///< the sets of stops that have come to rest
  };

  const FlownMode& flown(const ContactStates& states);
  void begin(const Segment& segment);
  void arrive(long line, const Clock& at, const std::vector<double>& p, const std::vector<double>& u);
  void clock(long line, const Clock& at);
  void land(const std::vector<double>& next);
  void continuity(long line, const std::vector<double>& p, const std::vector<double>& u);
  void dependence(long line, const Balls& X, const std::vector<double>& size);
  void jump(long line, std::size_t i, const Ball& by, double allowed);
  void rest(const Segment& segment);
  [[nodiscard]] double clock_allowance(const Segment& segment);
  void blur(Departure& end, const Flow& flow);
  [[nodiscard]] double size_of_loop(std::size_t i) const;
  [[nodiscard]] double allowance(std::size_t i) const { return rounding * size_of_loop(i); }
  void coordinates_jump(const std::vector<double>& p, const std::vector<double>& u, const Balls& X);
  void start(const Segment& segment);
  void ends(const Segment& segment, const Flight& flight, const FlownMode& mode);
  void unanswered(const Segment& next);
  void chatter(const Segment& segment, const std::vector<double>& sizes);
  [[nodiscard]] ContactStates with_pair(ContactStates states, int stop, int direction) const;
  [[nodiscard]] Limit::Modes ways(const Segment& segment);
  [[nodiscard]] std::string names(const std::vector<int>& stops) const;

  // blows.cpp
  void blows();
  void blow(const Blow& blow, std::vector<bool>& found);
  void law(const Blow& blow, const Balls& before);
  void in_sequence(const Blow& blow, const Balls& before);
  void impact(const Blow& blow, std::vector<bool>& found);
  void bring_to_rest(const Blow& blow);
  void pile_up(const Blow& blow);
  void report(const Blow& blow, std::vector<bool>& found);
  [[nodiscard]] double fastest_near(const Blow& blow) const;
  [[nodiscard]] bool strike(const Blow& blow, const std::vector<int>& stops);
  [[nodiscard]] Balls impulses(const std::vector<int>& stops, bool to_rest) const;
  void apply(const std::vector<int>& stops, const Balls& impulses);
  [[nodiscard]] Ball approach(int stop) const;
  [[nodiscard]] Ball rebound(int stop, const Ball& v) const;
  [[nodiscard]] double steepness(int stop, double v) const;
  [[nodiscard]] double speed_rounding(int stop) const;

  // choice.cpp
  struct Candidates;
  [[nodiscard]] Candidates those_at_rest(const Segment& segment) const;
  [[nodiscard]] bool led_to(const Segment& segment, std::size_t i) const;
  void choice(const Segment& segment);
  [[nodiscard]] bool near_zero(const Segment& segment, std::size_t i) const;

  [[nodiscard]] std::size_t p(int stop) const { return m_.stop(static_cast<std::size_t>(stop)).own; }
  [[nodiscard]] std::size_t u(int stop) const { return m_.d() + p(stop); }
  [[nodiscard]] const std::string& name(int stop) const {
    return m_.model().stops[static_cast<std::size_t>(stop)].name;
  }

  Mechanics m_;
  Refuse refuse_;  ///< names the segment
  const Start& start_;
  double period_, fastest_ = 0.0;  ///< the greatest norm of a mode that was flown
  std::map<ContactStates, std::unique_ptr<FlownMode>> flown_;
  std::unique_ptr<Departure> last_;
  bool cut_ = false;                 ///< the segment goes on where the one before was cut
  std::vector<std::size_t> fallen_;  ///< conditions that are zero at the end of the last segment, and fall
  bool choice_due_ = false;          ///< no segment that lasts has been flown in the mode since it was chosen
  Jumps jumps_;
  Instant instant_;
  Tally tally_;
};

}  // namespace verify
