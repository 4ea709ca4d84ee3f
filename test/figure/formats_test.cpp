/// Panels that share one axis, and figures as other programs take them.
#include <gtest/gtest.h>

#include <cstdlib>

#include "figure/figure.hpp"
#include "figure/latex.hpp"
#include "workshop.hpp"

namespace slapstick::figure {
namespace {

class FormatsTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!workshop::gnuplot_exists()) GTEST_SKIP() << "gnuplot is not installed";
  }
  workshop::Folder folder;
};

Panel rising(double to) {
  return {.x_label = "t", .y_label = "{/:Italic x}_1", .lines = {{.x = {0, to}, .y = {0, 1}, .label = "50 % & more"}}};
}

std::vector<std::string> lines_with(const std::string& text, const std::string& part) {
  std::vector<std::string> found;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    if (text.substr(begin, end - begin).find(part) != std::string::npos)
      found.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return found;
}

TEST_F(FormatsTest, joined_panels_have_one_range_and_one_row_of_numbers) {
  Figure figure{.panels = {rising(3), rising(5), rising(7)}};
  figure.panels[1].joins_below = true;
  const std::string script = workshop::read(write(figure, folder / "a", {.pdf = false}).script);
  const auto ranges = lines_with(script, "set xrange"), formats = lines_with(script, "set format x");
  ASSERT_EQ(ranges.size(), 3U);
  EXPECT_NE(ranges[0].find("[0:3]"), std::string::npos) << ranges[0];
  EXPECT_NE(ranges[1].find("[0:7]"), std::string::npos) << ranges[1];
  EXPECT_EQ(ranges[1], ranges[2]);
  EXPECT_EQ(formats[1], "  set format x ''");
  EXPECT_NE(formats[0], formats[1]);
  EXPECT_NE(formats[2], formats[1]);
  EXPECT_EQ(lines_with(script, "set label 't'").size(), 2U);
}

TEST(FigureText, is_translated_with_what_means_something_escaped) {
  EXPECT_EQ(translate("{/:Italic \u03c9}", Dialect::latex), "$\\mathit{\\omega }$");
  EXPECT_EQ(translate("x_{1} \u2212 x_2", Dialect::latex), "x$_{\\mathrm{1}}$ $-$ x$_{\\mathrm{2}}$");
  EXPECT_EQ(translate("50 % & a\\_b # $1", Dialect::latex), "50 \\% \\& a\\_b \\# \\$1");
  EXPECT_EQ(translate("50 % & a\\_b # $1", Dialect::matplotlib), "50 % & a_b # \\$1");
  EXPECT_EQ(translate("\u03c9 [mm/s]", Dialect::matplotlib), "\u03c9 [mm/s]");
  EXPECT_EQ(translate("^", Dialect::latex), "\\textasciicircum{}");
  for (const char* broken : {"{", "_", "x_{", "{/:Italic", "\\", "}"}) (void)translate(broken, Dialect::latex);
}

TEST_F(FormatsTest, latex_gets_lines_in_a_pdf_and_text_in_commands) {
  const Files files = write({.panels = {rising(3)}}, folder / "a", {.png = false, .pdf = false, .tex = true});
  const std::string tex = workshop::read(files.tex);
  EXPECT_NE(tex.find("$\\mathit{x}$$_{\\mathrm{1}}$"), std::string::npos) << tex;
  EXPECT_NE(tex.find("50 \\% \\& more"), std::string::npos);
  EXPECT_EQ(workshop::read(files.pdf).substr(0, 4), "%PDF");
  EXPECT_EQ(files.pdf, folder / "a-tex.pdf");  // a.pdf may be a picture of its own
  EXPECT_NE(tex.find("a-tex}"), std::string::npos);
  EXPECT_EQ(tex.find("\u2212"), std::string::npos) << "a sign that LaTeX does not know";
}

TEST_F(FormatsTest, a_script_for_matplotlib_needs_no_gnuplot_and_is_python) {
  Figure figure{.panels = {rising(3), rising(5)}};
  figure.panels[0].marks = {{.x = 1, .x_end = 2}, {.y = 0.5, .label = "it's"}};
  const char* path = std::getenv("PATH");
  const std::string before = path != nullptr ? path : "";
  setenv("PATH", "/nowhere", 1);
  const Files files = write(figure, folder / "a", {.png = false, .pdf = false, .py = true}, "a-py");
  setenv("PATH", before.c_str(), 1);
  EXPECT_TRUE(files.script.empty());
  EXPECT_EQ(files.data, folder / "a-py-plot.csv");
  EXPECT_EQ(std::system(("python3 -B -c \"import ast; ast.parse(open('" + files.py.string() + "').read())\"").c_str()),
            0);
  EXPECT_NE(workshop::read(files.py).find("'a-py-plot.csv'"), std::string::npos);
}

}  // namespace
}  // namespace slapstick::figure
