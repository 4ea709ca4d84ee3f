/// Campaign `peers`: identical contact queries through slapstick, CVODE and odeint, by distance from graze.
#include <ctime>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "batches.hpp"
#include "contact_query.hpp"
#include "first_zero.hpp"
#include "flow/compiled_system.hpp"
#include "mode/frame.hpp"
#include "mode/mode.hpp"
#include "near_graze.hpp"
#include "slapstick/flow/motion.hpp"

namespace campaign {
namespace {

using slapstick::Json;

/// A query with its truth.
struct Question {
  Start start;
  ContactQuery query;
  Truth truth;
  int bin;
};

/// By least value / scale: none known, 2^-8 .. 2^-16, .., 2^-40 and below.
constexpr int bins = 6;
constexpr const char* bin_names[bins] = {"random",       "2^-8..2^-16",  "2^-16..2^-24",
                                         "2^-24..2^-32", "2^-32..2^-40", "2^-40..2^-53"};

/// What one tool said of the queries of one bin.
struct Score {
  long hits = 0, misses = 0;  ///< by the truth
  long false_negatives = 0, false_positives = 0, grazes = 0, failures = 0;
  double seconds = 0.0;
  std::vector<float> errors;  ///< of the times of hits that were found

  void add(const Score& o) {
    hits += o.hits, misses += o.misses, false_negatives += o.false_negatives, false_positives += o.false_positives;
    grazes += o.grazes, failures += o.failures, seconds += o.seconds;
    errors.insert(errors.end(), o.errors.begin(), o.errors.end());
  }
};

constexpr double graze_answer = -3.0;  ///< slapstick's third answer

struct Tool {
  const char* name;
  std::function<std::vector<double>(const Scene&, const ContactProblem&, const std::vector<Question>&)> ask;
};

std::vector<ContactQuery> queries_of(const std::vector<Question>& questions) {
  std::vector<ContactQuery> queries;
  for (const Question& question : questions) queries.push_back(question.query);
  return queries;
}

/// Everything that a query costs: a Motion is made, and flown to its first event.
std::vector<double> slapstick_contacts(const Scene& scene, const ContactProblem& problem,
                                       const std::vector<Question>& questions) {
  std::vector<double> times;
  for (const Question& question : questions) {
    const slapstick::Instant start{0, question.start.phase};
    slapstick::Motion motion(scene.system(), question.start.state, start);
    const auto outcome = motion.advance(start.plus(problem.duration / scene.system().period()));
    if (outcome == slapstick::Outcome::reached_end)
      times.push_back(no_contact);
    else
      times.push_back(motion.event().kind == slapstick::EventKind::graze ? graze_answer : motion.segment().duration);
  }
  return times;
}

const std::vector<Tool>& tools() {
  const auto cvode = [](double tolerance, double steps) {
    return [=](const Scene&, const ContactProblem& problem, const std::vector<Question>& questions) {
      return cvode_contacts(problem, queries_of(questions), tolerance,
                            steps > 0.0 ? problem.shortest_period / steps : 0.0);
    };
  };
  const auto odeint = [](int samples) {
    return [=](const Scene&, const ContactProblem& problem, const std::vector<Question>& questions) {
      return odeint_contacts(problem, queries_of(questions), 1e-12, samples);
    };
  };
  static const std::vector<Tool> all = {
      {"slapstick", slapstick_contacts},          {"CVODE 1e-9", cvode(1e-9, 0)},
      {"CVODE 1e-12", cvode(1e-12, 0)},           {"CVODE 1e-12, 100 steps per period", cvode(1e-12, 100)},
      {"odeint 1e-12, ends of steps", odeint(1)}, {"odeint 1e-12, 10 places per step", odeint(10)}};
  return all;
}

struct Tally {
  std::vector<std::array<Score, bins>> scores{tools().size()};
  void add(const Tally& o) {
    for (std::size_t t = 0; t < scores.size(); ++t)
      for (int b = 0; b < bins; ++b) scores[t][b].add(o.scores[t][b]);
  }
};

void judge(const Question& question, double answer, double duration, Score& score) {
  const Truth& truth = question.truth;
  const bool hit = truth.kind == Kind::crossing;
  ++(hit ? score.hits : score.misses);
  if (answer == graze_answer) return void(++score.grazes);
  if (answer == solver_failed) return void(++score.failures);
  if (!hit) return void(score.false_positives += answer >= 0.0 ? 1 : 0);
  // A contact that is reported behind the bottom of the first one's dip is another: the first was missed.
  const double bottom = truth.time + std::min(truth.slope / std::max(truth.bend, 1e-300), duration);
  if (answer < 0.0 || answer > bottom + 1e-4) return void(++score.false_negatives);
  score.errors.push_back(static_cast<float>(std::abs(answer - truth.time)));
}

/// A frictionless oscillator of one or two masses with one stop. Of free bodies the error estimate of
/// runge_kutta_fehlberg78 sees nothing (it is zero for x'' = f(t)): they are left out.
bool suits(const Scene& scene) {
  const slapstick::Model& model = scene.system().model();
  const bool single = std::ranges::all_of(model.forces, [](const slapstick::Force& f) { return f.harmonic <= 1; });
  const bool held = !model.springs.empty() &&
                    std::ranges::all_of(model.springs, [](const slapstick::Spring& k) { return k.stiffness != 0.0; });
  return held && model.frictions.empty() && model.stops.size() == 1 &&
         scene.system().compiled().frame().d <= ContactProblem::most && single;
}

ContactProblem problem_of(const Scene& scene, const slapstick::mode::Mode& mode) {
  const slapstick::mode::Frame& frame = scene.system().compiled().frame();
  ContactProblem problem;
  problem.d = frame.d;
  problem.own = mode.guards()[0].single;
  problem.sign = mode.guards()[0].factor;
  problem.omega = scene.system().model().omega;
  problem.duration = scene.duration();
  problem.shortest_period = std::numbers::pi * mode.window();  // a window is about two radians long
  for (int i = 0; i < frame.d; ++i)
    for (int k = 0; k < frame.size(); ++k) problem.acceleration[i][k] = mode.system()(frame.d + i, k);
  return problem;
}

/// Every other question a near-graze.
std::vector<Question> questions_of(Scene& scene, Random& random, const ExactFlow& flow, long count) {
  NearGrazes near_grazes(scene, random);
  std::vector<Question> questions;
  const int d = scene.system().compiled().frame().d;
  for (long attempt = 0; std::ssize(questions) < count && attempt < 100 * count; ++attempt) {
    Question question{random_start(scene, random), {}, {}, 0};
    const bool near = questions.size() % 2 == 1;
    if (near && !near_grazes.next(question.start)) continue;
    std::array<double, 32> X{};
    scene.enter(question.start.state, question.start.phase, X.data());
    if (X[0] == 0.0) continue;  // in contact
    std::copy_n(X.begin(), 2 * d, question.query.start.begin());
    question.query.theta0 = 2.0 * std::numbers::pi * question.start.phase;
    question.truth = first_zero(flow, 0, X.data(), 0, scene.intervals(), Method::quick);
    const double depth = std::abs(question.truth.least) / question.truth.scale;
    if (question.truth.kind == Kind::touch || (near && (!question.truth.low || depth > 0x1p-7))) continue;
    if (near && question.truth.kind == Kind::crossing && question.truth.least > 0.0) continue;  // a hit later on
    if (near) question.bin = std::clamp(static_cast<int>(-std::log2(depth)) / 8, 1, bins - 1);
    questions.push_back(question);
  }
  return questions;
}

double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Tally examine(Random random, long count) {
  Tally tally;
  std::vector<Question> questions;
  while (questions.empty()) {
    Scene scene(random);
    if (!suits(scene)) continue;
    const slapstick::mode::Mode& mode = scene.system().compiled().mode(0);
    const ExactFlow& flow = scene.flow(0);
    questions = questions_of(scene, random, flow, count);
    std::ranges::sort(questions, {}, &Question::bin);
    const ContactProblem problem = problem_of(scene, mode);
    for (std::size_t t = 0; t < tools().size(); ++t) {
      for (auto first = questions.begin(); first != questions.end();) {
        const int bin = first->bin;
        const auto last = std::find_if(first, questions.end(), [&](const Question& q) { return q.bin != bin; });
        const std::vector<Question> some(first, last);
        const double begin = cpu_seconds();
        const std::vector<double> answers = tools()[t].ask(scene, problem, some);
        tally.scores[t][bin].seconds += cpu_seconds() - begin;
        for (std::size_t i = 0; i < some.size(); ++i)
          judge(some[i], answers[i], problem.duration, tally.scores[t][bin]);
        first = last;
      }
    }
  }
  return tally;
}

Json json(Score score) {
  Json json = Json::object();
  const long queries = score.hits + score.misses;
  json.set("hits", score.hits).set("misses", score.misses).set("false_negatives", score.false_negatives);
  json.set("false_positives", score.false_positives).set("grazes", score.grazes).set("failures", score.failures);
  json.set("microseconds_per_query", queries > 0 ? 1e6 * score.seconds / static_cast<double>(queries) : 0.0);
  std::ranges::sort(score.errors);
  const std::size_t n = score.errors.size();
  json.set("median_time_error", n > 0 ? static_cast<double>(score.errors[n / 2]) : 0.0);
  json.set("largest_time_error", n > 0 ? static_cast<double>(score.errors.back()) : 0.0);
  return json;
}

}  // namespace

Report run_peers(const Options& options) {
  Batches<Tally> batches(options, 500, "queries");
  const Tally all = batches.run([&](long k, long n) { return examine(Random(options.seed, k), n); });
  Report report;
  report.done = batches.done();
  report.passed = true;
  for (std::size_t t = 0; t < tools().size(); ++t) {
    Json rows = Json::object();
    for (int b = 0; b < bins; ++b) rows.set(bin_names[b], json(all.scores[t][b]));
    report.figures.set(tools()[t].name, rows);
    for (const Score& score : all.scores[0])
      report.passed = report.passed && score.false_negatives + score.false_positives == 0;
  }
  return report;
}

const std::vector<Campaign>& campaigns() {
  static const std::vector<Campaign> all = {
      {"peers", "identical contact queries through slapstick, CVODE and odeint", "queries", 100'000, run_peers}};
  return all;
}

}  // namespace campaign

int main(int count, char** arguments) { return campaign::campaign_main(count, arguments); }
