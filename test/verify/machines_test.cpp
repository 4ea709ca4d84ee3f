/// Certificates of random machines are proved: several stops, friction contacts, belts and loops, with their ties and
/// limits of chatter.
#include <gtest/gtest.h>

#include <sstream>

#include "property/machine.hpp"
#include "slapstick/certify/certificate.hpp"
#include "slapstick/flow/motion.hpp"
#include "slapstick/io/model_file.hpp"
#include "verdict.hpp"

namespace slapstick {
namespace {

struct Checked {
  verify::Verdict verdict;
  std::string first, text;
};

Checked verdict_on(const test::Machine& machine) {
  const System system(machine.model);
  std::stringstream text;
  certify::Certificate certificate(system, machine.start, [&](const std::string& lines) { text << lines; });
  certificate.run(Instant{}.plus(6.0), [](Instant) { return true; });
  certificate.finish();
  Checked checked;
  checked.text = text.str();
  checked.verdict = verify::check(text, [&](long line, const std::string& what) {
    if (checked.first.empty()) checked.first = "line " + std::to_string(line) + ": " + what;
  });
  return checked;
}

TEST(CertificateOfManyContacts, IsProvedWithItsChatterLimitsWhateverTheMachine) {
  test::Shape shape;
  shape.most_stops = 3;
  shape.most_frictions = 3;
  long chatters = 0, impacts = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const test::Machine machine = test::random_machine(seed, shape);
    const Checked checked = verdict_on(machine);
    EXPECT_EQ(checked.verdict.refusals, 0) << checked.first << "\n" << machine;
    chatters += checked.verdict.tally.chatters;
    impacts += checked.verdict.tally.impacts;
  }
  EXPECT_GT(chatters, 20);
  EXPECT_GT(impacts, 1000);
}

/// Masses 1 in a row with springs 1, a load on the first and a stop at the last: the stop's conditions start with zeros
/// of order 2 (masses - 1).
TEST(CertificateOfAChain, IsProvedHoweverHighTheOrderOfItsFirstZero) {
  for (const int masses : {2, 5, 6, 9, 12}) {
    for (const double load : {-1.0, 1.0}) {
      test::Machine machine;
      for (int i = 0; i < masses; ++i) machine.model.coordinates.push_back({"x" + std::to_string(i + 1), 1.0});
      for (int i = 0; i < masses; ++i) machine.model.springs.push_back({i, i == 0 ? ground : i - 1, 1.0});
      machine.model.forces = {{0, 0, load, 0.0}};
      machine.model.stops = {{"stop", masses - 1, ground, 0.0, 0.5}};
      machine.start.assign(2 * static_cast<std::size_t>(masses), 0.0);
      const Checked checked = verdict_on(machine);
      EXPECT_EQ(checked.verdict.refusals, 0) << masses << " masses, load " << load << ": " << checked.first;
    }
  }
}

/// What docs/reference/certificate.md says of the size of certificates.
TEST(SizeOfACertificate, PerEventStaysAsItIsTold) {
  for (const auto& [name, told] : {std::pair{"vibro-impact", 179.0}, {"spool", 167.0}}) {
    const ModelDefinition definition = load_model(name);
    test::Machine machine;
    machine.model = definition.build();
    machine.start = definition.start();
    const System system(machine.model);
    long bytes = 0;
    certify::Certificate certificate(system, machine.start,
                                     [&](const std::string& lines) { bytes += static_cast<long>(lines.size()); });
    certificate.run(Instant{}.plus(2000.0), [](Instant) { return true; });
    certificate.finish();
    Motion motion(system, machine.start);
    long events = 0;
    while (motion.advance(Instant{}.plus(2000.0)) == Outcome::event) ++events;
    EXPECT_NEAR(static_cast<double>(bytes) / static_cast<double>(events), told, 4.0) << name;
  }
}

}  // namespace
}  // namespace slapstick
