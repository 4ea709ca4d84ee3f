/// Searches contacts with Boost.odeint.
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint.hpp>
#include <cmath>

#include "contact_query.hpp"

namespace campaign {
namespace {

namespace odeint = boost::numeric::odeint;
using State = ContactProblem::State;
using Stepper = odeint::runge_kutta_fehlberg78<State>;

struct Equations {
  const ContactProblem* problem;
  double theta0;
  void operator()(const State& y, State& dydt, double t) const {
    const double theta = theta0 + problem->omega * t;
    dydt = {};
    problem->derivative(y, dydt, std::cos(theta), std::sin(theta));
  }
};

/// Static, so zeroed before it is copied: a Stepper's own constructor leaves its work arrays unset.
const Stepper prototype{};

class Search {
 public:
  Search(const ContactProblem& problem, double tolerance, int samples)
      : problem_(problem), samples_(samples), controlled_(odeint::make_controlled(tolerance, tolerance, prototype)) {}

  double contact(const ContactQuery& query) {
    const Equations equations{&problem_, query.theta0};
    State begin = query.start, end{}, slope{};
    double time = 0.0;
    while (time < problem_.duration) {
      equations(begin, slope, time);
      double after = time, next = std::min(next_, problem_.duration - time), length = 0.0;
      odeint::controlled_step_result result = odeint::fail;
      for (int tries = 0; result == odeint::fail; ++tries) {
        if (tries > 100) return solver_failed;
        length = next;
        after = time;
        result = controlled_.try_step(equations, begin, slope, after, end, next);
      }
      if (time + length < problem_.duration) next_ = next;
      const double found = change_of_sign(equations, begin, slope, time, length, end);
      if (found >= 0.0) return time + found;
      time += length;
      begin = end;
    }
    return no_contact;
  }

 private:
  double change_of_sign(const Equations& equations, const State& begin, const State& slope, double time, double length,
                        const State& end) {
    const auto gap_at = [&](double tau) {
      State y{};
      retaken_.do_step(equations, begin, slope, time, y, tau);
      return problem_.gap(y);
    };
    double low = 0.0, g_low = problem_.gap(begin);
    for (int i = 1; i <= samples_; ++i) {
      const double high = length * i / samples_, g_high = i == samples_ ? problem_.gap(end) : gap_at(high);
      if (g_low > 0.0 && g_high <= 0.0) {
        if (g_high == 0.0) return high;
        std::uintmax_t iterations = 100;
        const auto [a, b] = boost::math::tools::toms748_solve(
            gap_at, low, high, g_low, g_high, boost::math::tools::eps_tolerance<double>(46), iterations);
        return 0.5 * (a + b);
      }
      low = high;
      g_low = g_high;
    }
    return -1.0;
  }

  const ContactProblem& problem_;
  int samples_;
  odeint::result_of::make_controlled<Stepper>::type controlled_;
  Stepper retaken_;
  double next_ = 0.1;
};

}  // namespace

std::vector<double> odeint_contacts(const ContactProblem& problem, const std::vector<ContactQuery>& queries,
                                    double tolerance, int samples) {
  Search search(problem, tolerance, samples);
  std::vector<double> times;
  for (const ContactQuery& query : queries) times.push_back(search.contact(query));
  return times;
}

}  // namespace campaign
