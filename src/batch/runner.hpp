#pragma once
/// Trajectories in the lanes of one thread: fills lanes from a queue, hands back what they record, asks an engine
/// what a lane cannot decide.
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "batch/block.hpp"
#include "batch/program.hpp"
#include "batch/recorder.hpp"

namespace slapstick::batch {

/// A run at one of its stroboscopic points, in contact coordinates (mode/frame.hpp): n numbers each.
struct PassedPoint {
  const Model& model;
  const mode::Frame& frame;
  const double *p, *u;
  long impacts = 0;  ///< since the point before
};

/// What the lanes are to run.
struct Queue {
  std::function<std::optional<std::size_t>()> next;  ///< the index of the next run
  std::function<Model(std::size_t)> model_at;
  std::function<State(std::size_t, const Model&)> start_at;  ///< given the model of the index
  std::function<void(std::size_t, BatchRun&&)> take;         ///< called once for each index, in no order
  BatchPlan plan;
  enum class Wanted {
    all,
    those_of_lanes
  } wanted = Wanted::all;  ///< whether runs that no lane can carry are left
                           ///< out, undone
  bool one_model = false;  ///< `model_at` gives one model for all: it is asked once for the Runner
  const std::atomic<bool>* cancel = nullptr;
  /// If set, it is given every point of a run in place of BatchRun::points, while the lanes wait; true ends the run.
  std::function<bool(std::size_t, const PassedPoint&)> watch = {};
};

/// Work of a thread's lanes.
struct Work {
  long steps = 0, lane_steps = 0, halved = 0;
};

/// A run whose model lanes can run shares the lanes with others of the same shape; one of another shape waits until
/// the lanes are empty.
class Runner {
 public:
  Runner(Queue queue, const Kernel& kernel);
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;
  ~Runner();

  /// Runs the queue until it is empty or the batch is cancelled.
  void run();
  [[nodiscard]] Work work() const { return {block_->steps, block_->lane_steps, block_->halved}; }

 private:
  struct Machine;
  struct Entry;
  struct Rows;

  [[nodiscard]] std::shared_ptr<const Machine> machine_of(std::size_t index);
  [[nodiscard]] std::unique_ptr<Entry> next_entry();
  [[nodiscard]] bool finds_place(const Entry& entry);
  void make_room(const Entry& entry);
  void start(int l);
  void serve(int l);
  void look(int l);
  [[nodiscard]] const double* words_of(const Entry& entry, int mode);
  [[nodiscard]] bool make_mode(int l, int mode);
  void ask_engine(int l, bool to_the_end);
  void put_engine(int l);
  void to_lane(int l);
  void set_cut(int l);
  void finish(int l);
  [[nodiscard]] Instant now(int l) const;
  [[nodiscard]] double growth_at_cut(int l) const;
  [[nodiscard]] bool begin_tangent(int l);

  Queue queue_;
  const Kernel& kernel_;
  std::unique_ptr<Block> block_;
  std::unique_ptr<Entry> entry_[most_lanes], waiting_;
  std::optional<Shape> shape_;
  std::unique_ptr<Rows> active_, all_;
  std::vector<std::uint8_t> ready_;
  std::vector<double> words_;                      ///< of one mode, before they are spread
  std::shared_ptr<const Machine> machine_;         ///< of `one_model`
  std::vector<std::vector<double>> words_of_one_;  ///< .. its words, by mode; empty: not made yet
};

}  // namespace slapstick::batch
