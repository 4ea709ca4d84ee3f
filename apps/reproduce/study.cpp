/// Sets up what all parts of the study share.
#include "reproduce/study.hpp"

#include <mutex>

#include "slapstick/base/error.hpp"
#include "slapstick/sweep/parallel.hpp"
#include "sweep/diagram_point.hpp"

namespace slapstick::paper {

Study::Study(const Options& options, Course& course)
    : options_(options), course_(course), sizes_(options.quick ? quick_sizes : full_sizes) {}

System Study::system(Overrides with, double omega) const {
  with["omega"] = omega;
  return System(definition_.build(with));
}

Found Study::find(const Overrides& with, double omega, State start, const ClassifyOptions& how) const {
  const System system = this->system(with, omega);
  sweep::undo_rounding(system.model(), start);
  try {
    return {omega, classify(system, start, how)};
  } catch (const NumericalError&) {
    Found found{omega, {}};
    found.what.label = name(Attractor::undecided);
    found.what.state = std::move(start);
    return found;
  }
}

void Study::each(int count, const std::function<void(int)>& body) const {
  std::mutex counting;
  int done = 0;
  const auto counted = [&](int i) {
    body(i);
    const std::scoped_lock lock(counting);
    course_.step(++done, count);
  };
  if (!sweep::for_each_index(count, options_.threads, counted, options_.cancel)) throw Interrupted{};
}

std::filesystem::path Study::file(const std::string& name) { return files_.emplace_back(options_.folder / name); }

void Study::draw() {
  std::vector<figure::Files> drawn(pictures_.size());
  const auto draw_one = [&](int i) {
    Picture& picture = pictures_[static_cast<std::size_t>(i)];
    if (options_.quick) picture.figure.png_dpi = 150;
    drawn[static_cast<std::size_t>(i)] = figure::write(picture.figure, options_.folder / picture.stem);
  };
  // Not `each`: the part's progress has come to its end.
  sweep::for_each_index(static_cast<int>(pictures_.size()), options_.threads, draw_one);
  for (const figure::Files& files : drawn) {
    for (const auto& file : {files.script, files.data, files.png, files.pdf})
      if (!file.empty()) files_.push_back(file);
    files_.insert(files_.end(), files.rasters.begin(), files.rasters.end());
  }
  pictures_.clear();
}

}  // namespace slapstick::paper
