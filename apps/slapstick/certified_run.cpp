/// Runs a motion again and writes its certificate.
#include "certified_run.hpp"

#include "progress.hpp"
#include "slapstick/flow/stage.hpp"

namespace slapstick::app {

bool CertifiedRun::operator()(const System& system, const State& start, Instant end, bool progress,
                              const Context& context) {
  certify::Certificate certificate(system, start, [this](const std::string& text) { output_.write(text); });
  Progress shown("periods certified", end.since({}), progress);
  certificate.run(end, [&](Instant now) {
    shown.update(now.since({}));
    return !stopped(&context.stop);
  });
  certificate.finish();
  tally_ = certificate.tally();
  return certificate.time() == end;
}

Json CertifiedRun::summary() const {
  Json json = Json::object();
  json.set("segments", tally_.segments).set("impacts", tally_.impacts);
  json.set("chatters", tally_.chatters).set("unproved", tally_.unproved);
  return json;
}

}  // namespace slapstick::app
