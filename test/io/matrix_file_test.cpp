/// Matrices from Matrix Market and CSV files: what the file says is what the Model has.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "io/matrix_file.hpp"
#include "io/refusal.hpp"
#include "io/same_model.hpp"

namespace slapstick {
namespace {

using std::numbers::pi;
const std::string banner = "%%MatrixMarket matrix ";

template <class Read>
std::string message(Read read) {
  try {
    (void)read();
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}
std::string market(const std::string& text) {
  return message([&] { return read_matrix_market(text, "K.mtx"); });
}
std::string csv(const std::string& text) {
  return message([&] { return read_matrix_csv(text, "K.csv"); });
}

TEST(MatrixFile, one_matrix_in_six_notations) {
  const std::vector<double> expected = {2, -1, 0, -1, 2, -0.5, 0, -0.5, 0};
  const std::string rows = "2 -1 0\n-1 2 -5D-1\n0 -0.5 +0\n";
  for (const auto& text :
       {banner + "coordinate real symmetric\n% lower half\n\n3 3 4\n1 1 2\n2 1 -1\n2 2 2e0\n3 2 -0.5\n",
        banner + "coordinate real symmetric\r\n3 3 4\r\n1 1 2\r\n1 2 -1\r\n2 2 2\r\n2 3 -.5\r\n",  // the upper half
        banner + "coordinate real general\n3 3 6\n1 1 2\n2 1 -1\n1 2 -1\n2 2 2\n3 2 -0.5\n2 3 -0.5\n",
        banner + "array real symmetric\n3 3\n2\n-1\n0\n2\n-0.5\n0\n",
        banner + "array real general\n3 3\n2\n-1\n0\n-1\n2\n-0.5\n0\n-0.5\n0"})
    EXPECT_EQ(read_matrix_market(text, "K.mtx").entries, expected) << text;
  EXPECT_EQ(read_matrix_csv("# comment\n" + rows, "K.csv").entries, expected);
  const FileMatrix named = read_matrix_csv("tip,\"mid\",root\n2,-1,0\n-1,2,-0.5\n0,-0.5,0\n", "K.csv");
  EXPECT_EQ(named.entries, expected);
  EXPECT_EQ(named.names, (std::vector<std::string>{"tip", "mid", "root"}));
}

TEST(MatrixFile, the_symmetric_part_of_rounding_and_nothing_else) {
  const auto text = [](const std::string& above) { return "1e6 " + above + "\n1 1e6\n"; };
  const auto matrix = read_matrix_csv(text("1.0004"), "K.csv");
  EXPECT_EQ(matrix.entries[1], matrix.entries[2]);
  EXPECT_NEAR(matrix.entries[1], 1.0002, 1e-15);
  EXPECT_EQ(csv(text("1.002")), "K.csv:2: the matrix is not symmetric: (2, 1) = 1 differs from (1, 2) = 1.002");
}

TEST(MatrixFile, every_fault_has_its_line) {
  EXPECT_EQ(market("1 2\n"), "K.mtx:1: expected '%%MatrixMarket matrix coordinate real symmetric' or the like");
  EXPECT_EQ(market(""), "K.mtx:1: expected '%%MatrixMarket matrix coordinate real symmetric' or the like");
  EXPECT_EQ(market(banner + "coordinate complex general\n"),
            "K.mtx:1: 'complex' is not available: the matrix must be real or integer");
  EXPECT_EQ(market(banner + "array real skew-symmetric\n"),
            "K.mtx:1: 'skew-symmetric' is not available: the matrix must be general or symmetric");
  const std::string symmetric = banner + "coordinate real symmetric\n";
  EXPECT_EQ(market(symmetric + "2 3 1\n"), "K.mtx:2: the matrix is not square: 2 x 3");
  EXPECT_EQ(market(symmetric + "1e9 1e9 1\n"),
            "K.mtx:2: the number of rows = 1000000000 is not a whole number in [1, 1000]");
  EXPECT_EQ(market(symmetric + "2 2 1\n% here\n3 1 1\n"), "K.mtx:4: the row = 3 is not a whole number in [1, 2]");
  EXPECT_EQ(market(symmetric + "2 2 2\n2 1 1\n1 2 1\n"), "K.mtx:4: entry (1, 2) was given before, in line 3");
  EXPECT_EQ(market(symmetric + "2 2 2\n2 1 1\n"), "K.mtx:4: the file ends, and row, column, value are expected");
  EXPECT_EQ(market(symmetric + "2 2 1\n2 1 nan\n"), "K.mtx:3: 'nan' is not a finite number");
  EXPECT_EQ(market(symmetric + "2 2 1\n2 1\n"), "K.mtx:3: expected 3 fields (row, column, value), found 2");
  EXPECT_EQ(market(symmetric + "1 1 1\n1 1 1\n1 1 1\n"), "K.mtx:4: expected the file's end, found '1 1 1'");
  EXPECT_EQ(csv("1,2\n2\n"), "K.csv:2: the row has 1 fields, and the first one has 2");
  EXPECT_EQ(csv("1,\n0,2\n"), "K.csv:1: a number is missing");
  EXPECT_EQ(csv("1,2\n"), "K.csv:1: the matrix has 1 rows and 2 columns; a matrix is square, with at most 1000 rows");
  EXPECT_EQ(csv("\n"), "K.csv: the file has no row of numbers");
}

/// A folder of its own with a model file and its matrices.
class Folder : public ::testing::Test {
 protected:
  void SetUp() override {
    path_ =
        std::filesystem::path(::testing::TempDir()) / ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(path_);
  }
  void TearDown() override { std::filesystem::remove_all(path_); }
  void put(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }
  [[nodiscard]] ModelDefinition model(const std::string& text) const {
    put("m.toml", text);
    return load_model((path_ / "m.toml").string());
  }
  std::filesystem::path path_;
};

TEST_F(Folder, files_are_beside_the_model_and_a_factor_follows_parameters) {
  put("K.mtx", banner + "array real symmetric\n2 2\n3\n-1\n2\n");
  put("names.txt", "# nodes\na\nb\n");
  const auto definition = model(
      "name = 'm'\n[parameters]\nbeta = 0.5\n[matrix]\ncoordinates = 'names.txt'\nmass = [[1, 0], [0, 'beta']]\n"
      "stiffness = 'K.mtx'\ndamping = { file = 'K.mtx', factor = 'beta^2' }\n");
  const Model built = definition.build();
  EXPECT_EQ(state_names(built), (std::vector<std::string>{"a", "v_a", "b", "v_b"}));
  EXPECT_EQ(built.stiffness, (SymmetricMatrix{3, -1, -1, 2}));
  EXPECT_EQ(built.damping, (SymmetricMatrix{0.75, -0.25, -0.25, 0.5}));
  EXPECT_EQ(definition.rate("beta").damping, built.stiffness);  // 2 beta K
  const auto printed = ModelDefinition::parse(definition.to_toml(), "elsewhere/g.toml");
  EXPECT_EQ(printed.to_toml(), definition.to_toml());
  expect_same(printed.build({{"beta", 0.3}}), definition.build({{"beta", 0.3}}));
}

TEST_F(Folder, rows_may_be_some_of_the_coordinates) {
  put("K.csv", "b,c\n3,-1\n-1,2\n");
  const auto built = model(
                         "name = 'm'\n[[coordinate]]\nname = 'c'\nmass = 1\n[[coordinate]]\nname = 'a'\nmass = 1\n"
                         "[matrix]\ncoordinates = 'K.csv'\nstiffness = 'K.csv'\nmass = [[1, 0], [0, 0]]\n")
                         .build();
  EXPECT_EQ(state_names(built), (std::vector<std::string>{"c", "v_c", "a", "v_a", "b", "v_b"}));
  EXPECT_EQ(built.stiffness, (SymmetricMatrix{2, 0, -1, 0, 0, 0, -1, 0, 3}));
}

TEST_F(Folder, a_fault_of_a_file_names_both_places) {
  const auto fault = [&](const std::string& text) {
    try {
      (void)model("name = 'm'\n" + text);
    } catch (const std::exception& error) {
      const std::string what = error.what(), folder = path_.string() + "/";
      std::string shortened = what;
      for (auto at = shortened.find(folder); at != std::string::npos; at = shortened.find(folder))
        shortened.erase(at, folder.size());
      return shortened;
    }
    return std::string("accepted");
  };
  const std::string x = "[[coordinate]]\nname = 'x'\nmass = 1\n[matrix]\n";
  put("two.csv", "y,z\n1,0\n0,1\n");
  put("one.csv", "y\n1\n");
  EXPECT_EQ(fault(x + "stiffness = 'K.mtx'\n"), "m.toml:6: matrix: stiffness: matrix file 'K.mtx': no such file");
  EXPECT_EQ(fault(x + "stiffness = 'K.txt'\n"),
            "m.toml:6: matrix: stiffness: expected rows of numbers, or a file whose name ends in .mtx or .csv, found "
            "'K.txt'");
  EXPECT_EQ(fault(x + "stiffness = 'two.csv'\n"),
            "m.toml:6: matrix: stiffness: file 'two.csv' has 2 rows, expected 1 (one per coordinate)");
  EXPECT_EQ(fault(x + "stiffness = 'one.csv'\n"),
            "m.toml:6: matrix: stiffness: file 'one.csv': column 1 is 'y', and the coordinate there is 'x'");
  EXPECT_EQ(fault("[matrix]\ncoordinates = ['a', 'a']\n"), "m.toml:3: matrix: coordinates: name 'a' is used twice");
  EXPECT_EQ(fault("[matrix]\ncoordinates = ['a']\nstiffness = [[1]]\n"),
            "m.toml:3: coordinate 'a': mass = 0 is not positive");
}

}  // namespace
}  // namespace slapstick
