/// Lists the campaigns and runs the one that is asked for.
#include "campaign.hpp"

namespace campaign {

const std::vector<Campaign>& campaigns() {
  static const std::vector<Campaign> all = {
      {"segments", "random segments, half of them near-grazes, against a certain search", "segments", 1'000'000'000,
       run_segments},
      {"wide", "the same against a search with 113 bits throughout", "segments", 10'000'000, run_wide},
      {"balls", "random motions proved by certificates in ball arithmetic", "segments", 100'000, run_balls},
      {"forgeries", "forged certificates, none of which may be accepted unless it is true", "forgeries", 100'000,
       run_forgeries},
      {"noise", "the rounding bound of guards against exact values", "evaluations", 1'000'000'000, run_noise},
      {"orbit", "drift of stable orbits", "periods", 10'000'000, run_orbit},
      {"branches", "branches followed from three starts each have the same special points", "cases", 300, run_branches},
      {"classes", "what classify says, also right beside special points, against orbits and 50 digits", "cases", 10'000,
       run_classes},
      {"charts", "pixels of the gallery's charts, at boundaries and anywhere, against classify alone",
       "boundary pixels of each chart", 200, run_charts},
      {"lanes", "runs of a batch have the events of a motion", "runs", 100'000, run_lanes},
      {"lane-grazes", "near-grazes in the lanes of a batch, against a motion and a certain search", "starts", 1'000'000,
       run_lane_grazes},
      {"neutral", "edits of a model file that change nothing change no verb's answer", "triples", 100'000, run_neutral},
      {"families", "error near resonance and near defective matrices", "starts", 1'000, run_families},
  };
  return all;
}

}  // namespace campaign

int main(int count, char** arguments) { return campaign::campaign_main(count, arguments); }
