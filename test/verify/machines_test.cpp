/// Certificates of random machines are proved: several stops, friction contacts, belts and loops, with their ties and limits of chatter.
#include <gtest/gtest.h>

#include <sstream>

#include "check.hpp"
#include "property/machine.hpp"
#include "slapstick/certify/certificate.hpp"

namespace slapstick {
namespace {

struct Verdict {
  long refusals = 0;
  std::string first;
  verify::Tally tally;
};

Verdict verdict_on(const test::Machine& machine) {
  const System system(machine.model);
  std::stringstream text;
  certify::Certificate certificate(system, machine.start, [&](const std::string& lines) { text << lines; });
  certificate.run(Instant{}.plus(6.0), [](Instant) { return true; });
  certificate.finish();
  Verdict verdict;
  const verify::Refuse refuse = [&](long, const std::string& what) {
    if (verdict.refusals++ == 0) verdict.first = what;
  };
  verify::Reader reader(text);
  verify::Checker checker(reader.head(), reader.modes(), refuse);
  for (verify::Segment segment; reader.next(segment);) checker.segment(segment);
  verdict.tally = checker.tally();
  return verdict;
}

TEST(CertificateOfManyContacts, IsProvedWithItsChatterLimitsWhateverTheMachine) {
  test::Shape shape;
  shape.most_stops = 3;
  shape.most_frictions = 3;
  long chatters = 0, impacts = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const test::Machine machine = test::random_machine(seed, shape);
    const Verdict verdict = verdict_on(machine);
    EXPECT_EQ(verdict.refusals, 0) << verdict.first << "\n" << machine;
    chatters += verdict.tally.chatters;
    impacts += verdict.tally.impacts;
  }
  EXPECT_GT(chatters, 20);
  EXPECT_GT(impacts, 1000);
}

}  // namespace
}  // namespace slapstick
