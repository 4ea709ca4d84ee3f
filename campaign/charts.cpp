/// Campaign `charts`: pixels of the gallery's charts, beside boundaries of classes and anywhere, against `classify` of
/// one motion alone, by the same criterion and by its whole search: where both decide, they name the same class.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/text.hpp"
#include "batches.hpp"
#include "random.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/base/error.hpp"
#include "slapstick/chart/chart.hpp"
#include "slapstick/io/model_file.hpp"

namespace campaign {
namespace {

using namespace slapstick;

constexpr double may_differ = 1e-3;  ///< of all pixels: decided by both routes, with different classes

/// Two parameters of a built-in model, as docs/howto/gallery.md has them.
struct Wanted {
  const char *model, *x;
  double x_from, x_to;
  const char* y;
  double y_from, y_to;
};

constexpr std::array<Wanted, 7> gallery{{{"vibro-impact", "omega", 1.0, 6.0, "friction", 0.05, 0.3},
                                         {"vibro-impact", "omega", 1.0, 6.0, "restitution", 0.5, 0.95},
                                         {"vibro-impact", "omega", 1.0, 6.0, "clearance", 0.0, 0.6},
                                         {"vibro-impact", "omega", 1.0, 6.0, "force_share_2", 0.0, 1.0},
                                         {"gear-pair", "omega", 0.3, 1.2, "load", 0.02, 0.2},
                                         {"shaken-table", "acceleration", 1.0, 4.0, "restitution", 0.1, 0.9},
                                         {"two-sided-rattle", "omega", 0.6, 3.0, "clearance", 0.1, 1.0}}};

struct ChartTally {
  long boundary = 0, anywhere = 0, agree = 0, one_undecided = 0, differ = 0, decided_by_both = 0, contradictions = 0,
       failed = 0;
  std::vector<std::string> notes;
  void add(const ChartTally& o) {
    boundary += o.boundary, anywhere += o.anywhere, agree += o.agree, one_undecided += o.one_undecided,
        differ += o.differ;
    decided_by_both += o.decided_by_both, contradictions += o.contradictions, failed += o.failed;
    notes.insert(notes.end(), o.notes.begin(), o.notes.end());
  }
};

/// One chart and what is asked about its pixels.
class Questions {
 public:
  Questions(const Wanted& wanted, int columns, const Options& options, ChartTally& tally)
      : wanted_(wanted),
        options_(options),
        tally_(tally),
        chart_(chart::over(load_model(wanted.model), {}, wanted.x, {wanted.x_from, wanted.x_to, columns}, wanted.y,
                           {wanted.y_from, wanted.y_to, columns * 11 / 16})) {
    chart_.problem.threads = 1;
    chart_.problem.cancel = options.stop;
    map_ = sweep::run_map(chart_.problem);
  }

  /// Places among the findings whose right or upper neighbour is of another class.
  [[nodiscard]] std::vector<std::size_t> boundary() const {
    const auto columns = static_cast<std::size_t>(map_.x.count);
    const auto label = [&](std::size_t i) { return map_.findings[i].label(map_.driven); };
    std::vector<std::size_t> found;
    for (std::size_t i = 0; map_.complete && i < map_.findings.size(); ++i)
      if (((i + 1) % columns != 0 && label(i) != label(i + 1)) ||
          (i + columns < map_.findings.size() && label(i) != label(i + columns)))
        found.push_back(i);
    return found;
  }
  [[nodiscard]] std::size_t size() const { return map_.complete ? map_.findings.size() : 0; }

  /// The same criterion on a Motion of its own. @returns whether the answer is the same;
  /// nothing if the pixel or the search has failed
  std::optional<bool> ask(std::size_t place) {
    const sweep::Finding& found = map_.findings[place];
    if (found.failed) return ++tally_.failed, std::nullopt;
    const System system = system_at(found);
    const Classification alone =
        classify_quickly(system, start_at(found), chart_.problem.periods, {.cancel = options_.stop});
    if (options_.stopped()) return std::nullopt;
    const bool same = alone.label == found.label(map_.driven);
    const bool both = alone.attractor != Attractor::undecided && found.attractor != Attractor::undecided;
    ++(same ? tally_.agree : both ? tally_.differ : tally_.one_undecided);
    if (!same && both) note(found, "alone it is " + alone.label);
    return same;
  }

  /// The whole search of a motion that is what the chart has by the criterion of the chart.
  void ask_in_full(std::size_t place) {
    const sweep::Finding& found = map_.findings[place];
    const Classification full = classify(system_at(found), start_at(found), {.cancel = options_.stop});
    if (options_.stopped() || full.attractor == Attractor::undecided || found.attractor == Attractor::undecided) return;
    ++tally_.decided_by_both;
    if (full.label == found.label(map_.driven)) return;
    ++tally_.contradictions;
    note(found, "the whole search says " + full.label);
  }

 private:
  [[nodiscard]] System system_at(const sweep::Finding& found) const {
    return System(chart_.problem.model_at(map_.x_of(found), map_.y_of(found)));
  }
  [[nodiscard]] State start_at(const sweep::Finding& found) const {
    return chart_.problem.start_at(map_.x_of(found), map_.y_of(found));
  }

  void note(const sweep::Finding& found, const std::string& what) {
    tally_.notes.push_back(std::string(wanted_.model) + ", " + wanted_.x + " = " + shown(map_.x_of(found)) + ", " +
                           wanted_.y + " = " + shown(map_.y_of(found)) + ": the chart has " + found.label(map_.driven) +
                           ", " + what);
  }

  const Wanted& wanted_;
  const Options& options_;
  ChartTally& tally_;
  chart::Chart chart_;
  sweep::Map map_;
};

/// @param count  boundary pixels that are asked about, and 7.2 times that number of all pixels: 200 of each chart make
/// 1e4
ChartTally examine_chart(const Options& options, long chart, long count) {
  constexpr int most_columns = 160, per_root = 12;
  constexpr double anywhere_for_each = 7.2;
  ChartTally tally;
  Random random(options.seed, static_cast<std::uint64_t>(chart));
  const int columns = std::clamp(static_cast<int>(per_root * std::sqrt(static_cast<double>(count))), 12, most_columns);
  Questions questions(gallery[static_cast<std::size_t>(chart)], columns, options, tally);
  std::vector<std::size_t> boundary = questions.boundary();
  for (long i = 0; i < count && !boundary.empty() && !options.stopped(); ++i) {
    const auto drawn = boundary.begin() + static_cast<std::ptrdiff_t>(random.below(static_cast<int>(boundary.size())));
    const std::optional<bool> same = questions.ask(*drawn);
    if (same == true) questions.ask_in_full(*drawn);
    tally.boundary += same ? 1 : 0;
    boundary.erase(drawn);
  }
  for (long i = 0;
       i < std::lround(anywhere_for_each * static_cast<double>(count)) && questions.size() > 0 && !options.stopped();
       ++i)
    tally.anywhere +=
        questions.ask(static_cast<std::size_t>(random.below(static_cast<int>(questions.size())))).has_value() ? 1 : 0;
  return tally;
}

}  // namespace

Report run_charts(const Options& options) {
  Options batches = options;
  batches.count = options.count * static_cast<long>(gallery.size());
  Batches<ChartTally> work(batches, options.count, "boundary pixels");
  const ChartTally all = work.run([&](long chart, long count) { return examine_chart(options, chart, count); });
  Report report;
  report.done = work.done() / static_cast<long>(gallery.size());
  // A chaotic transient ends on one of several attractors by the rounding of its kernel: few pixels may differ.
  const long asked = all.agree + all.one_undecided + all.differ;
  report.passed = all.boundary > 0 && static_cast<double>(all.differ) <= may_differ * static_cast<double>(asked) &&
                  all.contradictions == 0 && all.failed == 0;
  report.figures.set("charts", static_cast<long>(gallery.size()))
      .set("boundary_pixels", all.boundary)
      .set("pixels_anywhere", all.anywhere);
  report.figures.set("agree", all.agree)
      .set("one_undecided", all.one_undecided)
      .set("differ", all.differ)
      .set("failed", all.failed);
  report.figures.set("decided_by_the_whole_search_too", all.decided_by_both).set("contradictions", all.contradictions);
  Json notes = Json::list();
  for (const std::string& note : all.notes) notes.push(note);
  report.figures.set("notes", std::move(notes));
  return report;
}

}  // namespace campaign
