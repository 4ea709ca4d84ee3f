/// Colours the points of a picture by the stop that they belong to.
#include "contact_clouds.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "axis_text.hpp"
#include "base/ranges.hpp"
#include "stop_options.hpp"

namespace slapstick::app {
namespace {

namespace colours = figure::colours;
constexpr std::array palette{colours::dark_blue, colours::vermillion, colours::green,
                             colours::orange,    colours::purple,     colours::sky_blue};

}  // namespace

ContactClouds::ContactClouds(const Model& model, const StopChoice& choice, Overlap overlap)
    : stops_(chosen_stops(model, choice)) {
  for (const int contact : stops_) {
    figure::Points cloud{.colour = palette[clouds_.size() % palette.size()]};
    const auto above = std::min<std::size_t>(stops_.size() - 1 - clouds_.size(), 3);
    if (overlap == Overlap::rims && stops_.size() > 1) cloud.diameter_mm = 0.25 + 0.15 * static_cast<double>(above);
    if (stops_.size() > 1) cloud.label = axis_text(stop_name(model, contact));
    clouds_.push_back(std::move(cloud));
  }
}

void ContactClouds::add(int contact, double x, double y) {
  const auto index = ranges::find(stops_, contact) - stops_.begin();
  clouds_[static_cast<std::size_t>(index)].x.push_back(x);
  clouds_[static_cast<std::size_t>(index)].y.push_back(y);
}

std::vector<figure::Points> ContactClouds::points() const {
  std::vector<figure::Points> filled;
  ranges::copy_if(clouds_, std::back_inserter(filled), [](const auto& cloud) { return !cloud.x.empty(); });
  return filled;
}

void ContactClouds::direct(bool up) {
  constexpr double thick_mm = 0.5, thin_mm = 0.25;
  constexpr std::array up_palette{colours::dark_blue, colours::green, colours::orange, colours::black};
  constexpr std::array down_palette{colours::vermillion, colours::purple, colours::sky_blue, colours::grey};
  for (std::size_t i = 0; i < clouds_.size(); ++i) {
    figure::Points& cloud = clouds_[i];
    cloud.colour = (up ? up_palette : down_palette)[i % up_palette.size()];
    cloud.diameter_mm = up ? thick_mm : thin_mm;
    cloud.label += (cloud.label.empty() ? "" : " ") + std::string(up ? "up" : "down");
  }
}

DirectedClouds::DirectedClouds(const Model& model, const StopChoice& choice, bool both)
    : up_(model, choice, ContactClouds::Overlap::rims), down_(up_), both_(both) {
  if (!both) return;
  up_.direct(true);
  down_.direct(false);
}

std::vector<figure::Points> DirectedClouds::points() const {
  std::vector<figure::Points> all = up_.points();
  if (both_)
    for (const figure::Points& cloud : down_.points()) all.push_back(cloud);
  return all;
}

}  // namespace slapstick::app
