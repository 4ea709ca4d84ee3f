/// Bytes as the value of --state, and in the lines after it values of --set: the start that the program makes of them
/// on a small model.
#include <cmath>

#include "lines.hpp"
#include "model_options.hpp"
#include "small_model.hpp"
#include "target.hpp"

namespace slapstick::fuzz {
namespace {

void check_start(const app::ModelOptions& options, const app::ChosenModel& chosen) {
  const State start = options.start(chosen);
  demand(start.size() == 2 * static_cast<std::size_t>(chosen.model.size()), "a start has all numbers");
  for (const double number : start) demand(std::isfinite(number), "a start is finite");
  validate(chosen.model, start);
}

void check(const std::vector<std::string>& lines) {
  static const app::ChosenModel as_it_is = app::ModelOptions{}.with_sets(small_model());
  app::ModelOptions options;
  options.state = lines.front();
  options.sets.assign(lines.begin() + 1, lines.end());
  if (options.sets.empty())
    check_start(options, as_it_is);
  else
    check_start(options, options.with_sets(small_model()));
}

}  // namespace
}  // namespace slapstick::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace slapstick::fuzz;
  (void)succeeds([&] { check(lines_of(text_of(data, size))); });
  return 0;
}
