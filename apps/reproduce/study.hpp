#pragma once
/// What all parts of the study share: the model, the sizes of its grids, the folder, the pictures to be drawn.
#include <filesystem>
#include <functional>

#include "figure/figure.hpp"
#include "reproduce/course.hpp"
#include "reproduce/reproduce.hpp"
#include "slapstick/attractor/classify.hpp"
#include "slapstick/io/model_file.hpp"

namespace slapstick::paper {

/// How fine everything is.
struct Sizes {
  int fig2_values, fig2_impacts;
  int fig6_values, fig6_impacts, fig6_transient;
  int fig7_impacts;
  int fig8_values, fig8_impacts;
  double survey_step;  ///< of omega, where attractors are classified over [0.56, 10]
  double locked_step;  ///< the same beyond the Neimark-Sacker bifurcations
};

inline constexpr Sizes full_sizes{2426, 200, 601, 200, 2000, 20000, 945, 100, 0.01, 0.0005};
inline constexpr Sizes quick_sizes{195, 60, 81, 60, 500, 4000, 95, 40, 0.1, 0.002};

/// The friction values of Fig. 8; the paper does not print its own.
inline constexpr double friction_values[] = {0.0, 0.05, 0.1, 0.15, 0.2, 0.3};

/// An attractor at one frequency. After a NumericalError: undecided.
struct Found {
  double omega = 0.0;
  Classification what;
};

/// A picture that waits to be drawn.
struct Picture {
  std::string stem;  ///< "fig2"
  figure::Figure figure;
};

class Study {
 public:
  Study(const Options& options, Course& course);

  [[nodiscard]] const ModelDefinition& definition() const { return definition_; }
  [[nodiscard]] const Options& options() const { return options_; }
  [[nodiscard]] const Sizes& sizes() const { return sizes_; }
  [[nodiscard]] Course& course() const { return course_; }

  /// The model's start: rest, x1 = -0.5.
  [[nodiscard]] State rest() const { return definition_.start(); }
  /// Compiled with these parameters and this frequency.
  [[nodiscard]] System system(Overrides with, double omega) const;
  /// The attractor that a start at phase 0 leads to.
  [[nodiscard]] Found find(const Overrides& with, double omega, State start, const ClassifyOptions& how = {}) const;

  /// Runs body(i) for all i in parallel, with progress of the current part. @throws Interrupted
  void each(int count, const std::function<void(int)>& body) const;

  /// A file of the folder, noted as written.
  std::filesystem::path file(const std::string& name);
  /// Keeps a picture until `draw`, at the end of its part.
  void add(Picture picture) { pictures_.push_back(std::move(picture)); }
  /// Draws the pictures that wait, several at once, also when the run is cancelled: their data are there. @throws
  /// StorageError
  void draw();
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  const Options& options_;
  Course& course_;
  Sizes sizes_;
  ModelDefinition definition_ = load_model("vibro-impact");
  std::vector<Picture> pictures_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace slapstick::paper
