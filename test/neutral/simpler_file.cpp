/// Files that are simpler by one step, and the smallest for which a triple still differs.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/decimal.hpp"
#include "neutral/triple.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::neutral {
namespace {

double rounded(double x, int digits) {
  std::string text;
  append_digits(text, x, digits);
  return std::strtod(text.c_str(), nullptr);
}

class Simpler {
 public:
  explicit Simpler(const Definition& file) : file_(file) {}

  std::vector<Definition> all() {
    for (int i = coordinates(file_) - 1; i >= 0 && coordinates(file_) > 1; --i) offer(without_coordinate(i));
    for (const PartRule& rule : part_rules())
      if (rule.kind != "coordinate" && rule.kind != "base") without_each(std::string(rule.kind));
    for (const std::string& key : matrix_keys())
      if (file_.matrices.contains(key)) offer_changed([&](Definition& other) { other.matrices.erase(key); });
    plain_parts();
    plain_numbers();
    return std::move(out_);
  }

 private:
  void offer(Definition candidate) {
    try {
      const ModelDefinition definition = read(candidate);
      (void)definition.build(), (void)definition.start();
      out_.push_back(std::move(candidate));
    } catch (const InputError&) {  // as stops without room
    }
  }

  template <class Change>
  void offer_changed(Change change) {
    Definition candidate = file_;
    change(candidate);
    offer(std::move(candidate));
  }

  void without_each(const std::string& kind) {
    for (std::size_t i = 0; i < file_.of(kind).size(); ++i)
      offer_changed([&](Definition& other) {
        auto& all = parts(other, kind);
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(i));
        drop_unused_bases(other);
      });
  }

  /// The last base goes if nothing stands on it: the numbers of the others stay.
  static void drop_unused_bases(Definition& file) {
    auto& bases = parts(file, "base");
    while (!bases.empty()) {
      const int last = base_end(static_cast<int>(bases.size()) - 1);
      bool used = std::ranges::any_of(file.of("coordinate"), [&](const Part& p) { return p.b == last; });
      each_linked(file, [&](const Part& part) { used = used || part.a == last || part.b == last; });
      if (used) return;
      bases.pop_back();
    }
  }

  Definition without_coordinate(int gone) {
    Definition other = file_;
    const auto touches = [&](const Part& part) { return part.a == gone || part.b == gone; };
    const std::string name = file_.of("coordinate")[static_cast<std::size_t>(gone)].name;
    for (const PartRule& rule : part_rules()) {
      if (rule.ends == Ends::none) continue;
      auto& all = parts(other, std::string(rule.kind));
      std::erase_if(all, touches);
      for (Part& part : all) {
        if (part.a > gone) --part.a;
        if (part.b > gone) --part.b;
        std::erase_if(part.load,
                      [&](const auto& term) { return term.first == name || term.first == velocity_name(name); });
      }
    }
    parts(other, "coordinate").erase(parts(other, "coordinate").begin() + gone);
    std::erase_if(other.start,
                  [&](const auto& entry) { return entry.first == name || entry.first == velocity_name(name); });
    other.matrices.clear();
    drop_unused_bases(other);
    return other;
  }

  void plain_parts() {
    for (const auto& [kind, all] : file_.parts)
      for (std::size_t i = 0; i < all.size(); ++i) {
        const auto simplify = [&, kind = kind](auto change) {
          offer_changed([&](Definition& other) { change(parts(other, kind)[i]); });
        };
        if (all[i].flag("two_sided"))
          simplify([](Part& p) { p.flags.erase("two_sided"), p.fields.erase("clearance_lower"); });
        if (all[i].ratio) simplify([](Part& p) { p.ratio.reset(); });
        if (!all[i].load.empty() || !all[i].load_stop.empty())
          simplify([](Part& p) { p.load.clear(), p.load_stop.clear(); });
        if (all[i].points.size() > 2) simplify([](Part& p) { p.points.pop_back(); });
        if (all[i].harmonics.size() > 1) simplify([](Part& p) { p.harmonics.pop_back(); });
      }
    if (file_.impact_law) offer_changed([](Definition& other) { other.impact_law.reset(); });
  }

  /// Expressions become numbers, and numbers rounder.
  void plain_numbers() {
    std::size_t count = 0;
    Definition copy = file_;
    each_number(copy, [&](Scalar&, Dimension) { ++count; });
    for (std::size_t i = 0; i < count; ++i)
      for (const int digits : {-1, 0, 1, 2}) {
        bool changed = false;
        Definition candidate = file_;
        std::size_t k = 0;
        each_number(candidate, [&](Scalar& scalar, Dimension) {
          if (k++ != i) return;
          const double x = value(file_, scalar);
          const double simple = digits < 0 ? 0.0 : digits == 0 ? 1.0 : rounded(x, digits);
          changed = scalar.expression || (simple != x && shortest_decimal(simple).size() < shortest_decimal(x).size());
          scalar = number(simple);
        });
        if (changed) offer(std::move(candidate));
      }
    for (std::size_t i = 0; i < file_.parameters.size(); ++i)
      offer_changed([&](Definition& other) {
        other.parameters.erase(other.parameters.begin() + static_cast<std::ptrdiff_t>(i));
      });
  }

  const Definition& file_;
  std::vector<Definition> out_;
};

/// What differs: what stands before the values, without numbers of rows.
std::string respect(const std::string& why) {
  std::string what = why.substr(0, why.find(':'));
  std::erase_if(what, [](char c) { return c >= '0' && c <= '9'; });
  return what;
}

bool still_differs(const Definition& file, const Edit& edit, Verb verb, std::uint64_t seed, const std::string& why) {
  try {
    campaign::Random random(seed, 0);
    const auto edited = edit.apply(file, random);
    if (!edited || file.parameters.size() < parameters_of(verb)) return false;
    Asked asked(file);
    const Judgement judged = judge(asked, edit, *edited, verb);
    return judged.verdict == Verdict::different && respect(judged.why) == respect(why);
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

std::vector<Definition> simpler(const Definition& file) { return Simpler(file).all(); }

Definition smallest(const Definition& file, const Edit& edit, Verb verb, std::uint64_t seed, const std::string& why,
                    int most_tries) {
  Definition best = file;
  for (bool smaller = true; smaller;) {
    smaller = false;
    for (const Definition& candidate : simpler(best)) {
      if (--most_tries < 0) return best;
      if (!still_differs(candidate, edit, verb, seed, why)) continue;
      best = read_definition(text(candidate), "random.toml");
      smaller = true;
      break;
    }
  }
  return best;
}

}  // namespace slapstick::neutral
