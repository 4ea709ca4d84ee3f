#pragma once
/// How stores say what charts and planes of starts are made of: the words of the program's options.
#include <string>
#include <vector>

#include "slapstick/sweep/map.hpp"

namespace slapstick::chart {

/// "omega=1:6:400"
[[nodiscard]] std::string axis_words(const std::string& name, const sweep::GridAxis& axis);
/// "--level", "quick", "--periods", "300", ..: how each pixel is analysed.
void add_analysis_words(const sweep::MapProblem& problem, std::vector<std::string>& words);

}  // namespace slapstick::chart
