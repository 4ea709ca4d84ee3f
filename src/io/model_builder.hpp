#pragma once
/// From a Definition and the values of its parameters to a validated Model.
///
/// Some things of a file are not in a Model but stand for others. A two-sided stop is two Stops. A [[freewheel]] is
/// friction and a constant force. A [[base]] is the forces that its springs and dampers pass on, and the inertia of the
/// coordinates that are measured from it. So each part of the Model remembers the part of the file that it came from,
/// for messages.
///
/// The derivative of a Model goes the same way: every number is calculated as a Dual, of which its value or its rate is
/// written down.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.hpp"
#include "io/definition.hpp"
#include "io/dual.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick {

struct Fault;
class ModelNumbers;

using Values = std::map<std::string, double>;

class ModelBuilder {
 public:
  /// @param numbers  null: the units of parameters are not looked at
  ModelBuilder(const Definition& definition, const Values& values, const ModelNumbers* numbers = nullptr)
      : definition_(definition), values_(values), numbers_(numbers) {}
  /// For `rate` only. @param rates  the parameters' values with their derivatives
  ModelBuilder(const Definition& definition, const Values& values, const Duals& rates)
      : definition_(definition), values_(values), rates_(&rates) {}

  /// @throws InputError with the file's line
  [[nodiscard]] Model model();
  /// The derivative of `model`, a Model of the same shape. @throws InputError with the file's line for a number that
  /// has none
  [[nodiscard]] Model rate();
  /// @throws InputError with the file's line
  [[nodiscard]] State start(const Model& model) const;

  /// @throws InputError with the file's line
  [[nodiscard]] std::vector<LaidLaw> laid_laws();

  /// The displacement of the k-th [[base]] at a time (after `model`).
  [[nodiscard]] double base(std::size_t k, double omega, double time) const;

  /// The value of a number or expression; `where` is for the message. @throws InputError
  [[nodiscard]] double number(const Scalar& scalar, const LazyText& where) const;

 private:
  struct Origin {
    std::string_view kind;
    std::size_t index;
    bool lower = false;  ///< the lower side of a two-sided stop
  };
  /// A characteristic while it is being built: its corners and the slopes beyond them.
  struct Bends {
    std::vector<std::pair<Dual, Dual>> corners;
    Dual below, above;
  };
  /// One term of a prescribed motion: amplitude sin(harmonic omega t + phase), or with a frequency of its own, or a
  /// signal.
  struct Term {
    Dual amplitude;
    int harmonic = 1;
    Dual phase;
    Dual frequency = {};
    int signal = -1;
    bool silent = false;  ///< of a size that the file writes as 0
  };

  /// Calls `add(part)` for every part of a kind; kind_ and index_ say which one it is, for messages.
  template <class Add>
  void each(const char* kind, Add add) {
    kind_ = kind;
    index_ = 0;
    for (const auto& part : definition_.of(kind)) {
      add(part);
      ++index_;
    }
  }
  [[nodiscard]] std::string where(std::string_view key) const;
  [[nodiscard]] Dual dual(const Scalar& scalar, const LazyText& where) const;
  [[nodiscard]] Dual field(const Part& part, std::string_view key, const Dual& fallback = {}) const;
  [[nodiscard]] Dual at(const Part& part, std::string_view key, const Dual& fallback, const LazyText& place) const;
  /// What the model that is being made has in the place of a number.
  [[nodiscard]] double written(const Dual& number) const { return rates_ == nullptr ? number.value : number.rate; }
  [[nodiscard]] std::vector<std::pair<Dual, Dual>> points(const Part& part,
                                                          std::string_view key = "characteristic") const;
  [[nodiscard]] static Ratio ratio_of(const Part& part) { return part.ratio.value_or(Ratio{}); }
  /// A characteristic between the ends of a part, without its polyline.
  [[nodiscard]] static Characteristic bent(const Part& part, const std::string& name, Characteristic::Over over) {
    return {name, part.a, part.b, over, {}, 0.0, 0.0, ratio_of(part)};
  }
  void add_bends(Model& model, const Part& part, Characteristic::Over over);
  void add_zones(Model& model, const Part& part, const Dual& inside);
  void add_friction(Model& model, const Part& part);
  void add_freewheel(Model& model, const Part& part);
  void add_falling_friction(Model& model, const Part& part, const std::vector<std::pair<Dual, Dual>>& law);
  [[nodiscard]] std::vector<std::pair<Dual, Dual>> friction_law(const Part& part) const;
  /// @param error  takes the largest error of the polyline, unless null
  [[nodiscard]] std::vector<std::pair<Dual, Dual>> stribeck(const Part& part, double* error = nullptr) const;
  [[nodiscard]] NormalForce load(const Part& part, const Model& model) const;
  [[nodiscard]] Stop stop(const Part& part) const;
  [[nodiscard]] CompliantStop compliant_stop(const Part& part) const;
  void add_hysteresis(Model& model);
  void add(Model& model, Characteristic head, const Bends& bends);
  [[nodiscard]] double written(const Part& part, std::string_view key) const { return written(field(part, key)); }
  [[nodiscard]] Model assembled();
  [[nodiscard]] int harmonic(const Part& part, const LazyText& place) const;
  using Points = std::vector<std::pair<Dual, Dual>>;
  /// The points of a [[signal]], in the model's unit of time or in forcing periods.
  [[nodiscard]] Points signal_points(const Part& part) const;
  [[nodiscard]] Points shape_points(const Part& part) const;
  /// Does a force or a base follow this signal, and is it not 0 throughout?
  [[nodiscard]] bool drives(const Part& signal) const;
  /// The longest round of the signals, if they are all that moves the model and come back together.
  [[nodiscard]] std::optional<Dual> common_round();
  /// The points of the rounds that make one period.
  [[nodiscard]] Points over_a_period(const Part& part, Points points, const Dual& period) const;
  void add_signals(Model& model);
  [[nodiscard]] Points impulse_points(const Part& part) const;
  [[nodiscard]] Points speed_jumps(int signal) const;
  /// The second derivative of a signal that a base moves by: pulses where its speed jumps. Made once.
  int acceleration_of(Model& model, int signal, std::string_view base);
  void add_impulses(Model& model);
  void add_bases();
  void add_forces(Model& model);
  [[nodiscard]] Term term(const Part& part, const std::string& place) const;
  [[nodiscard]] std::vector<Term> band(const Part& part) const;
  [[nodiscard]] int signal(const Part& part) const;
  void add_links(Model& model);
  int add_inner(Model& model, const Part& part);
  void add_elements(Model& model);
  /// The force that the motion of the surroundings passes on through a spring (`order` 0) or a damper (1).
  BaseMotion add_motion(Model& model, const Part& part, std::string_view strength, int order);
  /// `strength` times the derivative of a base's motion of this order, as forces on a coordinate.
  void push(Model& model, int coordinate, int base, const Dual& strength, int order, bool silent);
  /// @param silent  its size is 0 at all values of the parameters
  void add_force(Model& model, const Force& force, bool silent);
  /// Is it 0 at all values of the parameters?
  [[nodiscard]] static bool always_zero(const Scalar& scalar);
  [[nodiscard]] static bool always_zero(const Part& part, std::string_view key);
  /// Is the signal of this index 0 at all its points?
  [[nodiscard]] bool silent_signal(int index) const;
  /// A drive that does nothing is no drive: it would make a model forced, or without a period. Once all is checked.
  /// @return whether there was one to look for
  bool leave_out_silent(Model& model);
  /// What a coordinate that is measured from a base feels of its motion: -M x_base'', and of the matrices
  /// -C x_base' and -K x_base.
  void add_inertia(Model& model);
  static void stand_still(Model& model);
  /// The base that an end moves with when its own number stands still, or the ground.
  [[nodiscard]] int home(int end) const {
    return end >= 0 ? definition_.of("coordinate")[static_cast<std::size_t>(end)].b : end;
  }
  void add_contacts(Model& model);
  void add_matrices(Model& model) const;
  void demand_no_forcing(const Model& model) const;
  void demand_resolved_records(const Model& model);
  [[nodiscard]] const Origin* origin(const Fault& fault) const;
  [[nodiscard]] InputError refusal(const Fault& fault, const Model& model) const;

  const Definition& definition_;
  const Values& values_;
  const ModelNumbers* numbers_ = nullptr;
  const Duals* rates_ = nullptr;
  Dual omega_;
  std::string_view kind_;
  std::size_t index_ = 0;
  std::vector<std::vector<Term>> bases_;
  std::vector<Signal> signals_;
  std::vector<Points> knots_;         ///< of the file's signals, as the model has them
  std::map<int, int> accelerations_;  ///< signals of pulses, by the signal whose second derivative they are
  std::optional<Dual> round_;         ///< the forcing period of a model that signals alone drive
  std::vector<bool> silent_;          // of each force of the model, before any is left out
  std::map<std::string, std::vector<Origin>, std::less<>> origins_;  // by Fault::part
};

}  // namespace slapstick
