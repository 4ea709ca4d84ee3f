#pragma once
/// The rules of docs/certificate.md that lead from segment to segment: clock, phases, continuity, impulses, stops that
/// are not watched.
#include <map>
#include <memory>

#include "flight.hpp"

namespace verify {

class Checker {
 public:
  /// @param head, modes  as the reader fills them; they must outlive the object
  Checker(const Head& head, const std::map<long, Mode>& modes, const Refuse& refuse);
  Checker(const Checker&) = delete;
  Checker& operator=(const Checker&) = delete;
  void segment(const Segment& segment);
  [[nodiscard]] const Tally& tally() const { return tally_; }

 private:
  /// X- of a segment's end, and what the blows make of it.
  struct Departure {
    Segment segment;
    Balls X;
    std::vector<double> size;
    Ball rests_from = {};  ///< velocity towards the stop that the last blow has brought to rest
  };

  const Flow& flow(long mode);
  void mode_is_mechanical(const Mode& mode);
  [[nodiscard]] Ball harmonic(const Mode& mode, std::size_t i) const;
  void start(const Segment& segment);
  void phases(const Segment& segment, const Mode& mode);
  void clock(const Segment& segment);
  void blur(Departure& end, const Flow& flow) const;
  void continuity(const Segment& segment);
  [[nodiscard]] double size_of_others(std::size_t i) const;
  [[nodiscard]] double fastest_approach(const Stop& stop, const Segment& segment, const Mode& mode) const;
  void stops(const Segment& segment, const Mode& mode);
  void chatter(const Segment& segment, const std::vector<double>& sizes);
  void blows(Departure& departure);
  void blow(Departure& departure, const Blow& blow);
  void report_of(const Departure& departure, const Blow& blow, std::vector<bool>& found);

  [[nodiscard]] std::size_t u(const Stop& stop) const { return static_cast<std::size_t>(head_.d + stop.own); }
  [[nodiscard]] std::size_t p(const Stop& stop) const { return static_cast<std::size_t>(stop.own); }

  const Head& head_;
  const std::map<long, Mode>& modes_;
  Refuse refuse_;              ///< names the segment
  std::vector<bool> follows_;  ///< by displacement: it is a combination of others
  std::map<long, std::unique_ptr<Flow>> flows_;
  std::unique_ptr<Departure> last_;
  Tally tally_;
};

}  // namespace verify
