/// Fills lanes, serves what a kernel hands back, and asks an engine what lanes cannot decide.
#include "batch/runner.hpp"

#include <algorithm>
#include <cmath>

#include "base/floating_point.hpp"
#include "batch/report.hpp"
#include "batch/shape.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::batch {

/// A model, and what follows from it alone.
struct Runner::Machine {
  explicit Machine(Model of)
      : model(std::move(of)),
        frame(model),
        fits(fits_lanes(model, frame)),
        words(fits ? model_words(model, frame) : ModelWords{}) {}

  Model model;
  mode::Frame frame;
  bool fits;
  ModelWords words;  ///< of one that fits
};

/// A run that has begun.
struct Runner::Entry {
  Entry(std::size_t index_, const BatchPlan& plan, std::shared_ptr<const Machine> machine_)
      : index(index_), machine(std::move(machine_)), recorder(plan, {}) {}

  std::size_t index;
  std::shared_ptr<const Machine> machine;
  Recorder recorder;
  std::vector<double> X;  ///< at the start: p and u
  std::unique_ptr<flow::CompiledSystem> system;
  std::unique_ptr<flow::Engine> engine;
  std::unique_ptr<EngineTangent> tangent;
  bool stands = false;  ///< whether `engine` stands where the lane went on from
};

/// [word][lane], at the alignment of a vector.
struct Runner::Rows {
  explicit Rows(std::size_t count) : rows(count) {}
  struct alignas(64) Row {
    Block::Row numbers;
  };
  std::vector<Row> rows;
  [[nodiscard]] Block::Row* at(std::size_t i) { return &rows[i].numbers; }
};

Runner::Runner(Queue queue, const Kernel& kernel)
    : queue_(std::move(queue)), kernel_(kernel), block_(std::make_unique<Block>()) {
  block_->tangents = queue_.plan.exponent;
}

Runner::~Runner() = default;

void Runner::run() {
  const IeeeArithmetic ieee;
  for (;;) {
    for (int l = 0; l < kernel_.width; ++l) {
      if (entry_[l] != nullptr) continue;
      if (waiting_ == nullptr) waiting_ = next_entry();
      if (waiting_ == nullptr || !finds_place(*waiting_)) break;
      entry_[l] = std::move(waiting_);
      start(l);
    }
    if (block_->occupied == 0) return;
    kernel_.run(*block_);
    if (stopped(queue_.cancel)) return;
    for (unsigned left = block_->cuts | block_->doubtful | block_->wanting | block_->events; left != 0;
         left &= left - 1)
      serve(__builtin_ctz(left));
  }
}

/// @throws InputError for a model without meaning
std::shared_ptr<const Runner::Machine> Runner::machine_of(std::size_t index) {
  if (machine_ != nullptr) return machine_;
  Model model = queue_.model_at(index);
  validate(model);
  auto machine = std::make_shared<const Machine>(std::move(model));
  if (queue_.one_model) machine_ = machine;
  return machine;
}

/// The next run that lanes can carry; those that they cannot, and those that fail at once, are done on the way.
std::unique_ptr<Runner::Entry> Runner::next_entry() {
  while (!stopped(queue_.cancel)) {
    const std::optional<std::size_t> index = queue_.next();
    if (!index) break;
    BatchRun failed;
    try {
      const std::shared_ptr<const Machine> machine = machine_of(*index);
      const Model& model = machine->model;
      const State state = queue_.start_at(*index, model);
      validate(model, state);
      auto entry = std::make_unique<Entry>(*index, queue_.plan, machine);
      Recorder& recorder = entry->recorder;
      if (queue_.watch)
        recorder.watch = [this, &of = *entry](const double* p, const double* u, long impacts) {
          return queue_.watch(of.index, {of.machine->model, of.machine->frame, p, u, impacts});
        };
      if (machine->fits) {
        recorder.run.in_lanes = true;
        entry->X.resize(static_cast<std::size_t>(machine->frame.size()));
        machine->frame.enter(state.data(), entry->X.data());
        return entry;
      }
      if (queue_.wanted == Queue::Wanted::those_of_lanes) {
        queue_.take(*index, {});
        continue;
      }
      const flow::CompiledSystem system(model, {});
      flow::Engine engine(system, state, {}, {});
      std::optional<EngineTangent> tangent;
      if (recorder.wants_exponent()) {
        tangent.emplace(system).begin(engine);
        recorder.begin_growth(tangent->growth());
      }
      follow(engine, recorder, tangent ? &*tangent : nullptr, queue_.cancel, true);
      queue_.take(*index, std::move(recorder.run));
      continue;
    } catch (const NumericalError& error) {
      failed.failure = error.what();
    } catch (const InputError& error) {
      failed.failure = error.what();
    }
    queue_.take(*index, std::move(failed));
  }
  return nullptr;
}

bool Runner::finds_place(const Entry& entry) {
  if (shape_ && same_shape(*shape_, entry.machine->model, entry.machine->frame)) return true;
  if (block_->occupied != 0) return false;
  make_room(entry);
  return true;
}

/// New lanes, for models of another shape.
void Runner::make_room(const Entry& entry) {
  shape_ = shape_of(entry.machine->model, entry.machine->frame);
  const auto size = static_cast<std::size_t>(shape_->layout.size()), modes = static_cast<std::size_t>(shape_->modes);
  active_ = std::make_unique<Rows>(size);
  all_ = std::make_unique<Rows>(size * modes);
  ready_.assign(modes * most_lanes, 0);
  words_.assign(size, 0.0);
  words_of_one_.assign(modes, {});
  block_->active = active_->at(0);
  block_->all = all_->at(0);
  block_->ready = ready_.data();
  block_->layout = shape_->layout;
  block_->harmonic = shape_->harmonic.data();
  block_->cosine_of = shape_->cosine_of.data();
  block_->action = shape_->action.data();
  block_->open = shape_->open.data();
  block_->slots = shape_->slots.data();
  block_->still = shape_->still.data();
  block_->filled = 0;
  std::fill_n(block_->active_mode, most_lanes, shape_->modes);
}

void Runner::start(int l) {
  Entry& entry = *entry_[l];
  const mode::Frame& frame = entry.machine->frame;
  const int n = frame.n;
  double delta[2 * most_coordinates];
  for (int i = 0; i < n; ++i) {
    block_->p[i][l] = entry.X[static_cast<std::size_t>(i)];
    block_->u[i][l] = entry.X[static_cast<std::size_t>(n + i)];
    block_->dp[i][l] = delta[i] = first_delta(i);
    block_->du[i][l] = delta[n + i] = first_delta(n + i);
  }
  entry.recorder.begin_growth(growth_of({delta, 2 * static_cast<std::size_t>(n)}, 0.0));
  const ModelWords& words = entry.machine->words;
  for (int s = 0; s < most_contacts; ++s) {
    block_->restitution[s][l] = words.restitution[s];
    block_->zero_force_rate[s][l] = words.zero_force_rate[s];
    for (int i = 0; i < most_coordinates; ++i) block_->impulse[s][i][l] = words.impulse[s][i];
  }
  for (int m = 0; m < shape_->modes; ++m) ready_[static_cast<std::size_t>(m * most_lanes + l)] = 0;
  block_->seen[l] = block_->fraction[l] = block_->period[l] = block_->tries[l] = block_->impacts[l] =
      block_->speeds[l] = block_->power[l] = 0.0;
  block_->scale[l] = 1.0;
  block_->in_phase = false;
  block_->mode[l] = 0;
  block_->start[l] = start_action(entry.machine->model, frame, *shape_, entry.X.data(), entry.X.data() + n);
  block_->occupied |= 1U << l;
  block_->starting |= 1U << l;
  set_cut(l);
}

void Runner::serve(int l) {
  const unsigned bit = 1U << l;
  if ((block_->cuts & bit) != 0) return look(l);
  if ((block_->doubtful & bit) != 0) return ask_engine(l, false);
  if ((block_->wanting & bit) != 0) {
    if (!make_mode(l, block_->wanted[l])) ask_engine(l, true);
    return;
  }
  double u[most_coordinates];
  for (int i = 0; i < block_->layout.n; ++i) u[i] = block_->u[i][l];
  const Ending ending{block_->event_mode[l], block_->event_slot[l], block_->event_side[l], block_->event_speed[l]};
  Entry& entry = *entry_[l];
  report(*shape_, entry.machine->model, entry.machine->frame, ending, block_->mode[l], now(l), u,
         entry.recorder.run.events);
}

Instant Runner::now(int l) const { return {static_cast<std::int64_t>(block_->period[l]), block_->fraction[l]}; }

/// Where the lane stops next: at what its recorder asks for, and before that for a look at `cancel`. A cut changes
/// nothing. Between two looks a lane works for some milliseconds.
void Runner::set_cut(int l) {
  constexpr double periods_between_looks = 10'000.0;
  const Recorder& recorder = entry_[l]->recorder;
  const Instant at = recorder.next();
  block_->cut_period[l] = std::min(static_cast<double>(at.period), block_->period[l] + periods_between_looks);
  block_->cut_fraction[l] = at.fraction;
  block_->watched = recorder.wants_events() ? block_->watched | 1U << l : block_->watched & ~(1U << l);
}

/// A lane at its cut.
void Runner::look(int l) {
  Recorder& recorder = entry_[l]->recorder;
  if (block_->cut_period[l] < static_cast<double>(recorder.next().period)) return set_cut(l);
  if (!recorder.recording() && block_->tangents && !std::isfinite(growth_at_cut(l)) && begin_tangent(l)) return;
  double p[most_coordinates], u[most_coordinates];
  for (int i = 0; i < block_->layout.n; ++i) {
    p[i] = block_->at_p[i][l];
    u[i] = block_->at_u[i][l];
  }
  recorder.impacts = block_->impacts[l];
  recorder.speeds = block_->speeds[l];
  if (recorder.look(entry_[l]->machine->frame, p, u, block_->tangents ? growth_at_cut(l) : 0.0)) return finish(l);
  block_->impacts[l] = recorder.impacts;
  block_->speeds[l] = recorder.speeds;
  set_cut(l);
}

double Runner::growth_at_cut(int l) const {
  double delta[2 * most_coordinates];
  const int n = block_->layout.n;
  for (int i = 0; i < n; ++i) {
    delta[i] = block_->at_dp[i][l];
    delta[n + i] = block_->at_du[i][l];
  }
  return growth_of({delta, 2 * static_cast<std::size_t>(n)}, block_->power[l]);
}

/// A tangent that is lost starts again at the lane's window, and the lane comes to its cut once more.
/// @returns false if the mode holds all of it still
bool Runner::begin_tangent(int l) {
  const int n = block_->layout.n, still = shape_->still[static_cast<std::size_t>(block_->mode[l])];
  bool moves = false;
  for (int i = 0; i < n; ++i) {
    block_->dp[i][l] = (still >> (most_coordinates + i) & 1) != 0 ? 0.0 : first_delta(i);
    block_->du[i][l] = (still >> i & 1) != 0 ? 0.0 : first_delta(n + i);
    moves = moves || block_->dp[i][l] != 0.0 || block_->du[i][l] != 0.0;
  }
  block_->power[l] = 0.0;
  return moves;
}

void Runner::finish(int l) {
  const std::size_t index = entry_[l]->index;
  BatchRun run = std::move(entry_[l]->recorder.run);
  run.lane_events = static_cast<long>(block_->seen[l]);
  entry_[l].reset();
  const unsigned others = ~(1U << l);
  block_->occupied &= others;
  block_->starting &= others;
  block_->watched &= others;
  queue_.take(index, std::move(run));
}

/// Null: the mode has another structure than the shape.
const double* Runner::words_of(const Entry& entry, int mode) {
  std::vector<double>* const kept = queue_.one_model ? &words_of_one_[static_cast<std::size_t>(mode)] : nullptr;
  if (kept != nullptr && !kept->empty()) return kept->data();
  if (!make_words(entry.machine->model, entry.machine->frame, *shape_, mode, words_.data())) return nullptr;
  if (kept != nullptr) *kept = words_;
  return words_.data();
}

bool Runner::make_mode(int l, int mode) {
  std::uint8_t& ready = ready_[static_cast<std::size_t>(mode * most_lanes + l)];
  if (ready != 0) return true;
  const double* const words = words_of(*entry_[l], mode);
  if (words == nullptr) return false;
  Block::Row* const rows = all_->at(static_cast<std::size_t>(mode) * words_.size());
  for (std::size_t w = 0; w < words_.size(); ++w) rows[w][l] = words[w];
  ready = 1;
  return true;
}

/// One event, or all up to the end, by an engine from the lane's state.
void Runner::ask_engine(int l, bool to_the_end) {
  Recorder& recorder = entry_[l]->recorder;
  recorder.impacts = block_->impacts[l];
  recorder.speeds = block_->speeds[l];
  block_->starting &= ~(1U << l);
  try {
    put_engine(l);
    if (follow(*entry_[l]->engine, recorder, entry_[l]->tangent.get(), queue_.cancel, to_the_end)) return finish(l);
    return to_lane(l);
  } catch (const NumericalError& error) {
    recorder.run.failure = error.what();
  } catch (const InputError& error) {
    recorder.run.failure = error.what();
  }
  recorder.run.done = false;
  finish(l);
}

/// Puts the engine where the lane is. A lane that is in doubt at once after an engine's event goes on with the same
/// engine: that knows more of what has happened than the state says.
void Runner::put_engine(int l) {
  Entry& entry = *entry_[l];
  const int n = entry.machine->frame.n;
  double X[2 * most_coordinates];
  for (int i = 0; i < n; ++i) {
    X[i] = block_->p[i][l];
    X[n + i] = block_->u[i][l];
  }
  const std::span<const double> coordinates(X, 2 * static_cast<std::size_t>(n));
  if (entry.engine == nullptr) {
    entry.system = std::make_unique<flow::CompiledSystem>(entry.machine->model, SystemOptions{});
    entry.engine = std::make_unique<flow::Engine>(*entry.system, coordinates, now(l), MotionOptions{});
  } else if (!entry.stands || entry.engine->time() != now(l)) {
    entry.engine->restart(coordinates, now(l));
  }
  if (!block_->tangents) return;
  if (entry.tangent == nullptr) entry.tangent = std::make_unique<EngineTangent>(*entry.system);
  for (int i = 0; i < n; ++i) {
    X[i] = block_->dp[i][l];
    X[n + i] = block_->du[i][l];
  }
  entry.tangent->take(coordinates, block_->power[l], *entry.engine);
}

/// The lane goes on from where its engine stands; in a mode of another structure the engine goes on to the end.
void Runner::to_lane(int l) {
  Entry& entry = *entry_[l];
  const int n = entry.machine->frame.n;
  const std::span<const double> X = entry.engine->extended();
  for (int i = 0; i < n; ++i) {
    block_->p[i][l] = X[static_cast<std::size_t>(i)];
    block_->u[i][l] = X[static_cast<std::size_t>(n + i)];
  }
  for (int i = 0; i < n && block_->tangents; ++i) {
    block_->dp[i][l] = entry.tangent->delta()[static_cast<std::size_t>(i)];
    block_->du[i][l] = entry.tangent->delta()[static_cast<std::size_t>(n + i)];
    block_->power[l] = entry.tangent->power();
  }
  const Instant time = entry.engine->time();
  block_->period[l] = static_cast<double>(time.period);
  block_->fraction[l] = time.fraction;
  block_->in_phase = false;
  block_->scale[l] = 1.0;
  block_->tries[l] = 0.0;
  block_->impacts[l] = entry.recorder.impacts;
  block_->speeds[l] = entry.recorder.speeds;
  entry.stands = true;
  const int mode = static_cast<int>(entry.engine->mode_id());
  if (!make_mode(l, mode)) {
    (void)follow(*entry.engine, entry.recorder, entry.tangent.get(), queue_.cancel, true);
    return finish(l);
  }
  block_->mode[l] = block_->active_mode[l] = mode;
  block_->filled = std::max(block_->filled, static_cast<int>(shape_->slots[static_cast<std::size_t>(mode)]));
  const Block::Row* const rows = all_->at(static_cast<std::size_t>(mode) * words_.size());
  for (std::size_t w = 0; w < words_.size(); ++w) block_->active[w][l] = rows[w][l];
  set_cut(l);
}

}  // namespace slapstick::batch
