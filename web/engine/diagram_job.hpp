#pragma once
/// A bifurcation diagram, value by value along one chain: what `slapstick diagram --start carry` computes in one
/// direction, with the same bits (sweep/diagram_point.hpp).
///
/// Rows: index of the value, the value, the quantity that is shown, one row a point.
/// Events: index of the value, the state that the value's recording starts from, at phase 0: where a click leads.
#include "choice.hpp"
#include "job.hpp"
#include "sweep/diagram_point.hpp"

namespace slapstick::web {

struct DiagramWish {
  std::string parameter;
  double from = 0.0, to = 1.0;
  int count = 2, transient = 100, points = 60;
  bool down = false;
  std::string shown = "w";     ///< w, flight, sliding or phase of impacts, or the name of a quantity
  std::string at = "impacts";  ///< impacts, periods, or an event as "stick:belt": when the quantity is read
};

class DiagramJob : public Job {
 public:
  DiagramJob(const Choice& choice, const DiagramWish& wish);
  [[nodiscard]] const std::string& note() const { return note_; }  ///< the first value that failed, and why

 protected:
  bool work(const Deadline& deadline) override;

 private:
  void run_value(int index);
  void add(int index, const sweep::DiagramPoint& point);

  DiagramWish wish_;
  sweep::DiagramProblem problem_;
  sweep::Carried carried_;
  int next_ = 0;
  std::string note_;
};

}  // namespace slapstick::web
