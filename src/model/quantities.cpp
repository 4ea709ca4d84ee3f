/// Names the quantities of a model by the rules of quantity_rules.cpp, and finds one by its name.
#include <algorithm>

#include "base/nearest.hpp"
#include "base/text.hpp"
#include "model/free_name.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/model/quantity.hpp"

namespace slapstick {
namespace {

using Kind = Quantity::Kind;

/// Gathers quantities by the rules.
class List {
 public:
  explicit List(const Model& model) : model_(model) {}

  void coordinates();
  void contacts();
  void whole();
  void impacts();
  [[nodiscard]] std::vector<Quantity> take() { return std::move(all_); }

 private:
  using Of = QuantityRule::Of;
  void add(const QuantityRule& rule, int index, const std::string& name);
  template <class Wanted>
  void each(Of of, int index, const std::string& name, const Wanted& wanted) {
    for (const QuantityRule& rule : quantity_rules())
      if (rule.of == of && wanted(rule.kind)) add(rule, index, name);
  }
  void each(Of of, int index, const std::string& name) {
    each(of, index, name, [](Kind) { return true; });
  }
  template <class Part>
  void named(Of of, const std::vector<Part>& parts) {
    for (const Part& part : parts) each(of, number_++, part.name);
  }
  void links();

  const Model& model_;
  int number_ = 0;  ///< of the next contact
  std::vector<Quantity> all_;
};

/// The pattern with the name in place of NAME.
std::string filled(std::string_view pattern, const std::string& name) {
  std::string text(pattern);
  if (const std::size_t at = text.find("NAME"); at != std::string::npos) text.replace(at, 4, name);
  return text;
}

void List::add(const QuantityRule& rule, int index, const std::string& name) {
  all_.push_back({rule.kind, index, -1, 0.0, free_name(all_, filled(rule.name, name)), "", filled(rule.meaning, name)});
}

/// x1, v1, a1; of a coordinate `l` l, v_l, a_l.
void List::coordinates() {
  const std::vector<std::string> names = state_names(model_);
  for (int i = 0; i < model_.size(); ++i) {
    const std::string &x = names[2 * static_cast<std::size_t>(i)], &v = names[2 * static_cast<std::size_t>(i) + 1];
    for (const QuantityRule& rule : quantity_rules()) {
      if (rule.of != Of::coordinate || (rule.kind == Kind::acceleration && model_.is_inner(i))) continue;
      const std::string name = rule.kind == Kind::displacement ? x
                               : rule.kind == Kind::velocity   ? v
                                                               : "a" + v.substr(1);
      all_.push_back({rule.kind, i, -1, 0.0, free_name(all_, name), "", filled(rule.meaning, x)});
    }
  }
}

void List::contacts() {
  named(Of::stop, model_.stops);
  for (const FrictionContact& contact : model_.frictions)
    each(Of::friction, number_++, contact.name,
         [&](Kind kind) { return contact.normal.has_value() || kind != Kind::normal; });
  named(Of::compliant_stop, model_.compliant_stops);
  for (const Characteristic& one_of : model_.characteristics) {
    const bool lossy = one_of.over != Characteristic::Over::displacement || one_of.inner >= 0;
    each(Of::characteristic, number_++, one_of.name, [&](Kind kind) { return lossy || kind != Kind::power; });
  }
  links();
}

/// Springs and dampers that have a name. Of a spring on a base that moves, or in series with a damper, there is no
/// relative velocity; of the latter there is the power that the damper takes.
void List::links() {
  for (const Spring& spring : model_.springs) {
    const int number = number_++;
    if (spring.name.empty()) continue;
    const bool series = spring.inner >= 0;
    each(Of::spring, number, spring.name, [&](Kind kind) {
      return kind == Kind::power ? series : kind != Kind::relative || (spring.motion.none() && !series);
    });
  }
  for (const Damper& damper : model_.dampers) {
    const int number = number_++;
    if (!damper.name.empty()) each(Of::damper, number, damper.name);
  }
}

void List::whole() {
  const bool damped = !model_.dampers.empty() || !model_.damping.empty();
  each(Of::model, -1, {}, [&](Kind kind) { return damped || kind != Kind::damping; });
}

/// `w_NAME` is the relative velocity at any time, so the speed of a stop's impacts is `speed_NAME`.
void List::impacts() {
  const bool rigid = !model_.stops.empty();
  if (!rigid && model_.compliant_stops.empty()) return;
  const auto takes_time = [](Kind kind) { return kind == Kind::impulse || kind == Kind::loss; };
  each(Of::impacts, -1, {}, [&](Kind kind) { return rigid || !takes_time(kind); });
  for (std::size_t i = 0; i < model_.stops.size(); ++i)
    each(Of::impacts_of_one, static_cast<int>(i), model_.stops[i].name);
  const auto first = model_.stops.size() + model_.frictions.size();
  for (std::size_t i = 0; i < model_.compliant_stops.size(); ++i)
    each(Of::impacts_of_one, static_cast<int>(first + i), model_.compliant_stops[i].name,
         [&](Kind kind) { return !takes_time(kind); });
}

const Quantity* known(const std::vector<Quantity>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Quantity& one) { return one.name == name; });
  return found == all.end() ? nullptr : &*found;
}

bool has_difference(Kind kind) { return kind <= Kind::normal; }

}  // namespace

std::string_view name(Quantity::Kind kind) {
  switch (kind) {
    case Kind::displacement:
      return "displacement";
    case Kind::velocity:
    case Kind::relative:
      return "velocity";
    case Kind::acceleration:
      return "acceleration";
    case Kind::gap:
      return "gap";
    case Kind::force:
      return "force";
    case Kind::normal:
      return "normal force";
    case Kind::power:
    case Kind::damping:
    case Kind::input:
      return "power";
    case Kind::kinetic:
    case Kind::potential:
      return "energy";
    case Kind::speed:
    case Kind::impulse:
    case Kind::loss:
    case Kind::flight:
    case Kind::sliding:
      return "impact";
    case Kind::parameter:
      break;
  }
  return "parameter";
}

std::vector<Quantity> quantities(const Model& model) {
  List list(model);
  list.coordinates();
  list.contacts();
  list.whole();
  list.impacts();
  return list.take();
}

Quantity find_quantity(const std::vector<Quantity>& all, const std::string& name) {
  if (const Quantity* const one = known(all, name)) return *one;
  for (std::size_t dash = name.find('-'); dash != std::string::npos; dash = name.find('-', dash + 1)) {
    const Quantity *const a = known(all, name.substr(0, dash)), *const b = known(all, name.substr(dash + 1));
    if (a == nullptr || b == nullptr) continue;
    if (a->kind != b->kind || !has_difference(a->kind))
      throw InputError(in_quotes(name) +
                       ": a difference is of two displacements, velocities, accelerations, gaps or forces");
    return {a->kind,
            a->index,
            b->index,
            0.0,
            name,
            a->unit == b->unit ? a->unit : "",
            a->meaning + ", minus " + b->meaning};
  }
  std::vector<std::string> names;
  for (const Quantity& one : all) names.push_back(one.name);
  throw InputError("no quantity " + in_quotes(name) + suggestion(name, names) + " ('slapstick quantities' lists them)");
}

}  // namespace slapstick
