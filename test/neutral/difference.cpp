#include "neutral/difference.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <tuple>

#include "base/text.hpp"
#include "neutral/spectrum.hpp"

namespace slapstick::neutral {
namespace {

using Key = std::tuple<std::string, std::string, int>;  // what, of, sample

/// What the builder puts behind a part's name stays behind: "wall_twin_upper", "pad_twin_speed".
std::string behind(std::string name, const std::string& suffix) {
  std::string own;
  for (const std::string ending : {"_hysteresis", "_speed", "_upper", "_lower"})
    if (name.ends_with(ending)) own = ending + own, name.resize(name.size() - ending.size());
  return name + suffix + own;
}

std::string swapped_extreme(const std::string& what) {
  for (const auto& [from, to] : {std::pair(" min", " max"), std::pair(" max", " min")})
    if (what.ends_with(from)) return what.substr(0, what.size() - 4) + to;
  return what;
}

/// The generator's machines have masses, stiffnesses and frequencies of order one: what stays below this rests.
constexpr double at_rest = 1e-2;
/// Impacts slower than this part of the fastest belong to a chatter near its limit. Less would count impacts that the
/// proof of the limit leaves out, and rounding decides when that proof comes.
constexpr double slow = 1e-6;
/// So long before its limit a chatter is at such impacts: a gap that is passed at speed 1e-6 by a force of order one.
constexpr double tail = 1e-5;
/// Rounding may exchange two events that are so near. More would let two events be one.
constexpr double one_instant = 1e-9;

class Comparison {
 public:
  Comparison(const Answer& first, const Answer& second, const Rule& rule, double grid, double tolerance)
      : first_(first), second_(second), rule_(rule), tolerance_(tolerance), later_(rule.steps * grid) {}

  std::optional<Difference> run() {
    if (first_.failure != second_.failure) {
      note("one is answered, the other not: '" + first_.message + "', '" + second_.message + "'", 0.0);
      return found_;
    }
    words();
    numbers();
    for (const std::string& twin : twins()) rows(twin);
    spectrum("multipliers", first_.multipliers, second_.multipliers, 1.0);
    spectrum("eigenvalues", first_.eigenvalues, second_.eigenvalues, 1.0 / rule_.time);
    return found_;
  }

 private:
  void note(const std::string& what, double time) {
    if (!found_ || time < found_->time) found_ = {what, time};
  }

  [[nodiscard]] std::vector<std::string> twins() const {
    return rule_.twin.empty() ? std::vector<std::string>{""} : std::vector<std::string>{"", rule_.twin};
  }

  [[nodiscard]] std::string renamed(const std::string& name, const std::string& twin) const {
    return name.empty() ? name : rule_.prefix + behind(name, twin);
  }

  [[nodiscard]] double factor(Dimension d) const {
    return std::pow(rule_.length, d.length) * std::pow(rule_.time, d.time) * std::pow(rule_.mass, d.mass);
  }

  [[nodiscard]] bool same(double expected, double found, double size) const {
    if (std::isnan(expected) || std::isnan(found)) return std::isnan(expected) == std::isnan(found);
    if (expected == found) return true;
    if (std::isinf(expected) || std::isinf(found)) return false;
    return std::abs(expected - found) <= tolerance_ * size;
  }

  void words() {
    for (const auto& [key, word] : first_.words) {
      if (key == "class" && !rule_.twin.empty()) continue;  // has twice the impacts
      const auto other = second_.words.find(key);
      if (other == second_.words.end() || other->second != word)
        note(key + ": " + word + ", " + (other == second_.words.end() ? "none" : other->second), 0.0);
    }
  }

  /// Energies, powers, impacts and dimensions of a whole model, of which there are two.
  [[nodiscard]] double copies(const Number& number) const {
    if (rule_.twin.empty() || !number.of.empty()) return 1.0;
    if (number.what == "p" || number.what == "family") return 2.0;
    if (number.what.find("at impacts") != std::string::npos) return number.what.ends_with("impulse") ? 2.0 : 1.0;
    return number.dimension.mass == 1 ? 2.0 : 1.0;
  }

  /// Of a displacement, velocity or acceleration of the coordinate that is scaled, or of a statistic of one.
  [[nodiscard]] double scale(const Number& number) const {
    if (rule_.scaled.empty() || number.of != rule_.scaled || number.dimension.length != 1 || number.dimension.mass != 0)
      return 1.0;
    return number.odd ? rule_.by : std::abs(rule_.by);
  }

  void numbers() {
    std::map<Key, double> others;
    std::set<Key> undetermined;
    std::map<Dimension, double> sizes;
    const bool same_parts = rule_.bits || rule_.mirrored || rule_.length != 1.0;
    if (same_parts && first_.numbers.size() != second_.numbers.size())
      note(std::to_string(first_.numbers.size()) + " numbers, " + std::to_string(second_.numbers.size()), 0.0);
    for (const Number& n : second_.numbers) {
      others[{n.what, n.of, n.sample}] = n.value;
      if (n.undetermined) undetermined.insert({n.what, n.of, n.sample});
      if (double& size = sizes[n.dimension]; std::isfinite(n.value)) size = std::max(size, std::abs(n.value));
    }
    for (const Number& n : first_.numbers)
      for (const std::string& twin : twins()) {
        const bool turned = n.odd && (rule_.mirrored || scale(n) < 0.0);
        const double sign = rule_.mirrored && n.odd ? -1.0 : 1.0;
        const double expected = n.value * factor(n.dimension) * copies(n) * scale(n) * sign;
        if (n.sample >= 0 && n.until > 0.0 && n.sample <= rule_.steps) continue;
        const int sample = n.until > 0.0 && n.sample >= 0 ? n.sample - rule_.steps : n.sample;
        const Key key{turned ? swapped_extreme(n.what) : n.what, renamed(n.of, twin), sample};
        if (n.undetermined || undetermined.contains(key)) continue;
        if (n.what == "family" && rule_.joined) continue;  // of motions apart there are fewer
        const auto other = others.find(key);
        const std::string what =
            n.what + (n.of.empty() ? "" : " of " + n.of) + (n.sample < 0 ? "" : " at " + std::to_string(n.sample));
        if (other == others.end()) {
          if (rule_.steps == 0) note(what + " is not in the second", n.until);
          continue;
        }
        const double least = (rule_.farthest > 1.0 ? 1.0 : at_rest) * factor(n.dimension);
        const double size = std::max({sizes[n.dimension], std::abs(expected), least});
        if (!same(expected, other->second, size))
          note(what + ": " + shown(expected) + ", " + shown(other->second) + ", of " + shown(size), n.until);
      }
  }

  /// Those of one machine, in its own names, at the second one's clock and in its units.
  /// Of one contact at one instant the last row counts: a stick, or a release, of no length is rounding.
  /// At one instant contacts are in the order of names.
  [[nodiscard]] std::vector<Row> compared(std::vector<Row> rows) const {
    std::erase_if(rows, [&](const Row& row) { return rule_.rows_apart.contains(row.contact); });
    close_chatters(rows);
    std::vector<Row> out;
    for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
      while (end < rows.size() && rows[end].time - rows[begin].time <= one_instant * rule_.time) ++end;
      std::map<std::string, Row> first, last;
      const auto impacts = static_cast<std::ptrdiff_t>(out.size());
      for (std::size_t i = begin; i < end; ++i)
        if (rows[i].kind == EventKind::impact)
          out.push_back(rows[i]);
        else
          first.try_emplace(rows[i].contact, rows[i]), last[rows[i].contact] = rows[i];
      std::stable_sort(out.begin() + impacts, out.end(),
                       [](const Row& a, const Row& b) { return a.contact < b.contact; });
      // That an impact frees a contact is told where another impact of the instant comes between.
      const bool struck = std::ranges::any_of(std::span(rows).subspan(begin, end - begin),
                                              [](const Row& row) { return row.kind == EventKind::impact; });
      for (const auto& [contact, row] : last)
        if (!row.held && (row.kind == EventKind::release
                              ? !struck
                              : row.kind != EventKind::stick || first[contact].kind != EventKind::release))
          out.push_back(row);
    }
    return out;
  }

  /// How many impacts a chatter has before its limit is a matter of rounding, and what else happens in so short a time.
  void close_chatters(std::vector<Row>& rows) const {
    double fastest = 0.0;
    for (const Row& row : rows) fastest = std::max(fastest, std::abs(row.w));
    std::vector<double> limits;
    double last = -INFINITY;
    for (Row& row : rows) {
      if (row.kind == EventKind::impact && row.w < slow * fastest) last = row.time;
      if (row.kind == EventKind::stick && row.time - last <= tail * rule_.time)
        row.kind = EventKind::chatter;  // of friction on the pair
      if (row.kind != EventKind::chatter) continue;
      row.contact.clear();  // of several that close the pair
      limits.push_back(row.time);
    }
    std::erase_if(rows, [&](const Row& row) { return row.kind == EventKind::impact && row.w < slow * fastest; });
    std::erase_if(rows, [&](const Row& row) {
      return row.kind != EventKind::chatter && row.kind != EventKind::impact &&
             std::ranges::any_of(limits, [&](double limit) { return std::abs(row.time - limit) <= tail * rule_.time; });
    });
  }

  /// How often a name has the twin's suffix decides whose row it is.
  [[nodiscard]] std::vector<Row> rows_of_second(const std::string& twin) const {
    std::vector<Row> rows = second_.rows;
    if (!rule_.twin.empty())
      std::erase_if(
          rows, [&](const Row& row) { return (row.contact.find(rule_.twin) != std::string::npos) == twin.empty(); });
    return compared(std::move(rows));
  }

  void rows(const std::string& twin) {
    std::vector<Row> expected = first_.rows;
    if (rule_.steps > 0) std::erase_if(expected, [&](const Row& row) { return row.time <= later_; });
    for (Row& row : expected)
      row = {row.kind, renamed(row.contact, twin), (row.time - later_) * rule_.time, row.w * rule_.length / rule_.time,
             row.held};
    expected = compared(std::move(expected));
    const std::vector<Row> found = rows_of_second(twin);
    double fastest = 0.0, latest = 0.0;
    for (const Row& row : expected) fastest = std::max(fastest, std::abs(row.w)), latest = std::max(latest, row.time);
    for (std::size_t i = 0; i < std::max(expected.size(), found.size()); ++i) {
      const bool both = i < expected.size() && i < found.size();
      const Row& told = i < expected.size() ? expected[i] : found[i];
      const double when = told.time / rule_.time + later_;
      if (both && expected[i].kind == found[i].kind && expected[i].contact == found[i].contact &&
          same(expected[i].time, found[i].time, latest) && same(expected[i].w, found[i].w, fastest))
        continue;
      if (!both && rule_.steps > 0) return;  // behind the end of one of the two
      note("event " + std::to_string(i + 1) + ": " + (i < expected.size() ? words_of(expected[i]) : "none") + "; " +
               (i < found.size() ? words_of(found[i]) : "none"),
           std::min(when, both ? found[i].time / rule_.time + later_ : when));
      return;
    }
  }

  static std::string words_of(const Row& row) {
    return std::string(name(row.kind)) + " of " + row.contact + " at " + shown(row.time) + " with " + shown(row.w);
  }

  /// As sets: each of the first has its own among the second, twice where there are twins that are not joined.
  void spectrum(const std::string& what, const Spectrum& first, Spectrum second, double unit) {
    const std::size_t each = rule_.joined ? 1 : twins().size(), expected = first.size() * each,
                      most = first.size() * twins().size() + static_cast<std::size_t>(rule_.more_directions);
    if (second.size() < expected || second.size() > most)
      return note("number of " + what + ": " + std::to_string(expected) + ", " + std::to_string(second.size()), 0.0);
    for (const auto& one : first)
      for (std::size_t k = 0; k < each; ++k) {
        const std::complex<double> wanted = one * unit;
        const std::complex<double> there = take_nearest(second, wanted).value_or(std::complex<double>(NAN, NAN));
        const double size = std::max(unit, std::abs(wanted));
        if (!(std::abs(there - wanted) <= tolerance_ * size))
          return note(what + ": " + shown(wanted.real()) + (wanted.imag() < 0 ? " - " : " + ") +
                          shown(std::abs(wanted.imag())) + " i, nearest " + shown(there.real()) +
                          (there.imag() < 0 ? " - " : " + ") + shown(std::abs(there.imag())) + " i",
                      0.0);
      }
  }

  const Answer &first_, &second_;
  const Rule& rule_;
  double tolerance_, later_;
  std::optional<Difference> found_;
};

}  // namespace

std::optional<Difference> difference(const Answer& first, const Answer& second, const Rule& rule, double grid,
                                     double tolerance) {
  return Comparison(first, second, rule, grid, tolerance).run();
}

}  // namespace slapstick::neutral
