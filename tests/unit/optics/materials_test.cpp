#include "lychnite/optics/materials.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

TEST(Materials, AreThePublishedTables) {
  struct Row {
    const char* name;
    Rgb sigma_sp, sigma_a;
    double eta;
  };
  // docs/physics.md, "Materials".
  const Row rows[]{{"apple", {2.29, 2.39, 1.97}, {0.0030, 0.0034, 0.046}, 1.3},
                   {"chicken1", {0.15, 0.21, 0.38}, {0.015, 0.077, 0.19}, 1.3},
                   {"chicken2", {0.19, 0.25, 0.32}, {0.018, 0.088, 0.20}, 1.3},
                   {"cream", {7.38, 5.47, 3.15}, {0.0002, 0.0028, 0.0163}, 1.3},
                   {"fig6", {1.63, 2.41, 3.44}, {0.0125, 0.0206, 0.0487}, 1.3},
                   {"ketchup", {0.18, 0.07, 0.03}, {0.061, 0.97, 1.45}, 1.3},
                   {"marble", {2.19, 2.62, 3.00}, {0.0021, 0.0041, 0.0071}, 1.5},
                   {"potato", {0.68, 0.70, 0.55}, {0.0024, 0.0090, 0.12}, 1.3},
                   {"skimmilk", {0.70, 1.22, 1.90}, {0.0014, 0.0025, 0.0142}, 1.3},
                   {"skin1", {0.74, 0.88, 1.01}, {0.032, 0.17, 0.48}, 1.3},
                   {"skin2", {1.09, 1.59, 1.79}, {0.013, 0.070, 0.145}, 1.3},
                   {"spectralon", {11.6, 20.4, 14.9}, {0, 0, 0}, 1.3},
                   {"wholemilk", {2.55, 3.21, 3.77}, {0.0011, 0.0024, 0.014}, 1.3}};
  ASSERT_EQ(materialLibrary().size(), std::size(rows));
  for (const Row& row : rows) {
    const NamedCoefficients& found = findMaterial(row.name, "");
    EXPECT_EQ(found.coefficients.sigma_sp(), row.sigma_sp) << row.name;
    EXPECT_EQ(found.coefficients.sigma_a, row.sigma_a) << row.name;
    EXPECT_EQ(found.coefficients.eta, row.eta) << row.name;
    EXPECT_EQ(found.source, std::string(row.name) == "fig6" ? "YaoWang2009" : "Jensen2001") << row.name;
    EXPECT_NO_THROW(validate(found.coefficients, row.name));
  }
}

TEST(Materials, AreSortedByName) {
  EXPECT_TRUE(std::is_sorted(materialLibrary().begin(), materialLibrary().end(),
                             [](const auto& a, const auto& b) { return a.name < b.name; }));
}

TEST(Materials, UnknownNamesGetASuggestion) {
  try {
    findMaterial("marbel", "--material");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), Error::Kind::kUsage);
    EXPECT_STREQ(error.what(), "--material: there is no material 'marbel'; did you mean 'marble'?");
  }
  EXPECT_THROW(findMaterial("", "--material"), Error);
}

}  // namespace
}  // namespace lychnite
