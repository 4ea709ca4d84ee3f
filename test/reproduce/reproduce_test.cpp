/// The study of the paper on its quick grids: the claims come out, the files are there, and nothing half-written is left.
#include "reproduce/reproduce.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "figure/workshop.hpp"
#include "slapstick/base/error.hpp"

namespace slapstick::paper {
namespace {

namespace fs = std::filesystem;

/// One quick run for all tests of this program.
struct Run {
  workshop::Folder folder;
  Reproduction result;
  std::vector<std::string> finished;
  int reports = 0;
  bool backwards = false;

  Run() {
    Options options;
    options.folder = folder / "out";
    options.quick = true;
    options.command = "a test";
    double last = 0.0;
    options.progress = [&](const Progress& now) {
      ++reports;
      backwards = backwards || now.fraction < last - 1e-9;
      last = now.fraction;
    };
    options.part_finished = [&](const Part& part) { finished.push_back(part.name); };
    result = reproduce(options);
  }
};

const Run& run() {
  static const Run once;
  return once;
}

const Claim& claim(const std::string& id) {
  for (const Claim& one : run().result.claims)
    if (one.id == id) return one;
  throw std::logic_error("no claim " + id);
}

double number(const std::string& id, const std::string& quantity) {
  const Quantity* found = claim(id).find(quantity);
  return found != nullptr && found->value ? *found->value : std::nan("");
}

std::string word(const std::string& id, const std::string& quantity) {
  const Quantity* found = claim(id).find(quantity);
  return found != nullptr ? found->computed : "missing";
}

TEST(Reproduce, AllClaimsAreAnswered) {
  std::string ids;
  for (const Claim& one : run().result.claims) {
    ids += one.id + " ";
    EXPECT_FALSE(one.printed.empty() || one.computed.empty() || one.explanation.empty()) << one.id;
    EXPECT_TRUE(one.quantities.size() > 0 || one.id == "coexisting") << one.id;
  }
  EXPECT_EQ(ids, "C1 C2 C3 C4 C5 C6 C7 C8 C9 print coexisting branches bounds ");
}

// Enclosures from the stroboscopic return of the engine's events in steps of 0.001, found by hand before this study was written.
TEST(Reproduce, WindowOfOneImpactPerCycle) {
  EXPECT_NEAR(number("C1", "lower edge of the 1-1 window"), 1.1145, 1e-3);
  EXPECT_NEAR(number("C1", "upper edge of the 1-1 window"), 2.8460, 2e-4);
  EXPECT_EQ(claim("C1").agreement, Agreement::yes);
}

TEST(Reproduce, SlipStickAt15AndOnlySlipAt22) {
  EXPECT_EQ(word("C2", "class at 1.5"), "1-1-II");
  EXPECT_EQ(word("C3", "class at 2.2"), "1-1-I");
  EXPECT_EQ(word("C3", "class at 2"), "1-1-I");
  EXPECT_EQ(claim("C2").agreement, Agreement::yes);
  EXPECT_EQ(claim("C3").agreement, Agreement::yes);
}

TEST(Reproduce, ChatterAt0552IsCompleteOncePerPeriod) {
  EXPECT_EQ(word("C4", "class at 0.552"), "1-inf-II");
  EXPECT_NEAR(number("C4", "upper edge of complete chatter"), 0.5524, 3e-4);
  EXPECT_NE(claim("C4").computed.find("10 limits in 10 periods"), std::string::npos);
}

TEST(Reproduce, FixedPointsAt4801AndInvariantCirclesAt4805) {
  EXPECT_EQ(word("C7", "class at 4.801"), "4-2-I");
  EXPECT_EQ(word("C7", "class at 4.805"), "quasi-periodic");
  const double circle = number("C7", "4-2-I loses stability");
  EXPECT_GT(circle, 4.801);
  EXPECT_LT(circle, 4.805);
}

TEST(Reproduce, ThreeOneDoublesBelow67) {
  EXPECT_NEAR(number("C8", "3-1-I doubles to 6-2-I"), 6.63, 2e-3);
  EXPECT_NEAR(number("C8", "6-2-I loses stability"), 6.672, 2e-3);
}

TEST(Reproduce, ThePrintedRestitutionGivesAnotherDiagram) {
  EXPECT_EQ(claim("print").agreement, Agreement::no);
  EXPECT_EQ(word("print", "class at 4.801, r = 0.8, f_k = f_s"), "4-2-I");
  EXPECT_NE(word("print", "class at 4.801, r = 0.08"), "4-2-I");
  EXPECT_GT(std::abs(number("print", "lower edge of the 1-1 window, r = 0.08") - 1.12), 0.1);
}

TEST(Reproduce, ImpactsAreSlowerWithMoreFriction) {
  double last = INFINITY;
  for (const char* friction : {"0", "0.05", "0.1", "0.15", "0.2", "0.3"}) {
    const double speed = number("C9", std::string("mean impact speed below 1.12 at f_s = ") + friction);
    EXPECT_LT(speed, last) << friction;
    last = speed;
  }
}

TEST(Reproduce, EveryPromisedFileIsThere) {
  const fs::path out = run().folder / "out";
  std::vector<std::string> names = {"index.html", "claims.json", "fig2-impacts.csv", "fig7-4.805.csv",
                                    "fig5-trajectory.csv"};
  for (const char* stem : {"fig2", "fig2-sliding", "fig3", "fig4", "fig5", "fig6", "fig7", "fig8", "print"})
    for (const char* extension : {".png", ".pdf", ".gp"}) names.push_back(std::string(stem) + extension);
  for (const std::string& name : names) {
    ASSERT_TRUE(fs::exists(out / name)) << name;
    EXPECT_GT(fs::file_size(out / name), 100U) << name;
  }
  for (const auto& file : run().result.files) EXPECT_TRUE(fs::exists(file)) << file;
  const std::string page = workshop::read(out / "index.html");
  EXPECT_NE(page.find("data:image/png;base64,"), std::string::npos);
  for (const Claim& one : run().result.claims) EXPECT_NE(page.find("id=\"claim-" + one.id + "\""), std::string::npos);
}

TEST(Reproduce, ProgressGoesForwardAndEveryPartIsTimed) {
  EXPECT_GT(run().reports, 50);
  EXPECT_FALSE(run().backwards);
  EXPECT_EQ(run().finished.size(), run().result.parts.size());
  EXPECT_EQ(run().finished.size(), 13U);
}

TEST(Reproduce, AFolderThatCannotBeMadeIsRefusedAtOnce) {
  workshop::Folder folder;
  workshop::save(folder / "file", "in the way");
  Options options;
  options.quick = true;
  int parts = 0;
  options.part_finished = [&](const Part&) { ++parts; };
  for (const fs::path& bad : {folder / "file", folder / "file" / "below", fs::path("/proc/out")}) {
    options.folder = bad;
    EXPECT_THROW((void)reproduce(options), StorageError) << bad;
  }
  EXPECT_EQ(parts, 0);
  EXPECT_EQ(folder.entries(), 1U);
  EXPECT_EQ(workshop::read(folder / "file"), "in the way");
}

TEST(Reproduce, CancelledItLeavesWholeFilesAndNoPage) {
  workshop::Folder folder;
  std::atomic<bool> stop = false;
  Options options;
  options.folder = folder.path();
  options.quick = true;
  options.cancel = &stop;
  options.part_finished = [&](const Part& part) { stop = stop || part.name == "Figs. 3-5"; };
  const Reproduction result = reproduce(options);
  EXPECT_FALSE(result.complete);
  EXPECT_FALSE(fs::exists(folder / "index.html"));
  EXPECT_FALSE(fs::exists(folder / "claims.json"));
  EXPECT_EQ(result.files.size(), folder.entries());
}

}  // namespace
}  // namespace slapstick::paper
