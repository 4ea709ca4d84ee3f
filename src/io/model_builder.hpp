#pragma once
/// From a Definition and the values of its parameters to a validated Model.
///
/// Two things of a file are not in a Model but stand for others: a two-sided stop is two Stops, and a [[base]] is the
/// forces that its springs and dampers pass on. So each part of the Model remembers the part of the file that it came
/// from, for messages.
///
/// The derivative of a Model goes the same way: every number is calculated as a Dual, of which its value or its rate is
/// written down.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/definition.hpp"
#include "io/dual.hpp"
#include "slapstick/base/error.hpp"

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
  [[nodiscard]] Model rate() { return assembled(); }
  /// @throws InputError with the file's line
  [[nodiscard]] State start(const Model& model) const;

  /// The displacement of the k-th [[base]] at a time (after `model`).
  [[nodiscard]] double base(std::size_t k, double omega, double time) const;

  /// The value of a number or expression; `where` is for the message. @throws InputError
  [[nodiscard]] double number(const Scalar& scalar, const std::string& where) const;

 private:
  struct Origin {
    std::string_view kind;
    std::size_t index;
    bool lower = false;  ///< the lower side of a two-sided stop
  };
  /// One term of a prescribed motion: amplitude sin(harmonic omega t + phase).
  struct Term {
    Dual amplitude;
    int harmonic = 1;
    Dual phase;
  };

  template <class Add>
  void each(const char* kind, Add add);
  [[nodiscard]] std::string where(std::string_view key) const;
  [[nodiscard]] Dual dual(const Scalar& scalar, const std::string& where) const;
  [[nodiscard]] Dual field(const Part& part, std::string_view key, const Dual& fallback = {}) const;
  [[nodiscard]] Dual at(const Part& part, std::string_view key, const Dual& fallback, const std::string& place) const;
  /// What the model that is being made has in the place of a number.
  [[nodiscard]] double written(const Dual& number) const { return rates_ == nullptr ? number.value : number.rate; }
  [[nodiscard]] double written(const Part& part, std::string_view key) const { return written(field(part, key)); }
  [[nodiscard]] Model assembled();
  [[nodiscard]] int harmonic(const Part& part, const std::string& place) const;
  void add_links(Model& model);
  void add_motion(Model& model, const Part& part, const Dual& strength, bool velocity);
  void add_contacts(Model& model);
  void add_matrices(Model& model) const;
  void demand_no_forcing(const Model& model) const;
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
  std::map<std::string, std::vector<Origin>, std::less<>> origins_;  // by Fault::part
};

}  // namespace slapstick
