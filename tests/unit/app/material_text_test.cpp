#include "lychnite/app/material_text.h"

#include <gtest/gtest.h>

#include "lychnite/base/error.h"
#include "lychnite/optics/materials.h"

namespace lychnite {
namespace {

TEST(MaterialText, ComesBackAsItWas) {
  Material material;
  material.name = "skin1";
  material.medium = findMaterial("skin1", "test").coefficients;
  material.roughness = 0.45;
  EXPECT_EQ(materialFromToml(materialToToml(material), "clipboard").medium, material.medium);
  EXPECT_EQ(materialFromToml(materialToToml(material), "clipboard").name, "skin1");
  material.medium.g = 0.3;
  const Material custom = materialFromToml(materialToToml(material), "clipboard");
  EXPECT_EQ(custom.medium, material.medium);
  EXPECT_EQ(custom.roughness, 0.45);
  material.opaque = true;
  material.colour = {0.1, 0.2, 0.3};
  EXPECT_TRUE(materialFromToml(materialToToml(material), "clipboard").opaque);
}

TEST(MaterialText, TakesATableWithoutItsHeading) {
  EXPECT_EQ(materialFromToml("name = \"apple\"", "clipboard").name, "apple");
  EXPECT_EQ(materialFromToml("[material]\nname = \"apple\"", "clipboard").name, "apple");
}

TEST(MaterialText, RefusesOtherText) {
  for (const char* text : {"", "hello", "name = \"gold\"", "sigma_s = [1, 1, 1]\nsigma_a = [-1, 0, 0]"})
    EXPECT_THROW(materialFromToml(text, "clipboard"), Error) << text;
}

TEST(MaterialText, ColourIsWhatTheCoefficientsWereMadeFrom) {
  for (const double g : {-0.4, 0.0, 0.8}) {
    const Rgb colour(0.05, 0.5, 0.93);
    const Rgb back = colourOf(coefficientsFromColour(colour, Rgb(0.3, 1, 4), g, 1.4));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(back[c], colour[c], 1e-6) << g;
  }
  EXPECT_EQ(colourOf({.sigma_s = Rgb(0), .sigma_a = Rgb(1)}), Rgb(0));
  EXPECT_NEAR(colourOf({.sigma_s = Rgb(1), .sigma_a = Rgb(0)}).x, 1, 1e-4);
}

}  // namespace
}  // namespace lychnite
