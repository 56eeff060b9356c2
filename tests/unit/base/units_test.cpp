#include "lychnite/base/units.h"

#include <gtest/gtest.h>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

TEST(ParseLength, KnowsEveryUnit) {
  EXPECT_DOUBLE_EQ(parseLength("20mm", ""), 20);
  EXPECT_DOUBLE_EQ(parseLength("3 cm", ""), 30);
  EXPECT_DOUBLE_EQ(parseLength("0.5m", ""), 500);
  EXPECT_DOUBLE_EQ(parseLength("200um", ""), 0.2);
  EXPECT_DOUBLE_EQ(parseLength("200µm", ""), 0.2);
  EXPECT_DOUBLE_EQ(parseLength("1in", ""), 25.4);
  EXPECT_DOUBLE_EQ(parseLength("2\"", ""), 50.8);
  EXPECT_DOUBLE_EQ(parseLength("2ft", ""), 609.6);
  EXPECT_DOUBLE_EQ(parseLength("1.5dm", ""), 150);
  EXPECT_DOUBLE_EQ(parseLength("1km", ""), 1e6);
}

TEST(ParseLength, TakesSignsBlanksAndExponents) {
  EXPECT_DOUBLE_EQ(parseLength("  +2.5 mm\t", ""), 2.5);
  EXPECT_DOUBLE_EQ(parseLength("-4mm", ""), -4);
  EXPECT_DOUBLE_EQ(parseLength("0mm", ""), 0);
  EXPECT_DOUBLE_EQ(parseLength("1e2mm", ""), 100);
}

TEST(ParseLength, RefusesTheRestAndNamesThePlace) {
  for (const char* text : {"", "20", "mm", "20 furlongs", "20mm x", "nan mm", "inf mm", "1e400mm", "1e308km",
                           "--2mm", "+-2mm", "0x10mm", "20,5mm"}) {
    try {
      parseLength(text, "--size");
      ADD_FAILURE() << "'" << text << "' was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.parts().where, "--size");
      EXPECT_EQ(error.kind(), Error::Kind::kUsage);
      EXPECT_NE(error.parts().found.find(text), std::string::npos) << error.what();
    }
  }
}

TEST(ParseLength, SuggestsMillimetresForABareNumber) {
  try {
    parseLength("20", "--size");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(error.parts().todo.find("20mm"), std::string::npos) << error.what();
  }
}

TEST(FormatLength, PicksAPleasantUnit) {
  EXPECT_EQ(formatLength(0), "0 mm");
  EXPECT_EQ(formatLength(0.05), "50 um");
  EXPECT_EQ(formatLength(0.25), "0.25 mm");
  EXPECT_EQ(formatLength(30), "30 mm");
  EXPECT_EQ(formatLength(500), "50 cm");
  EXPECT_EQ(formatLength(2000), "2 m");
  EXPECT_EQ(formatLength(-30), "-30 mm");
}

TEST(FormatLength, CanBeReadAgain) {
  for (double mm : {1e-4, 0.3, 12.34, 99.9, 100.0, 999.0, 1234.0, 5e6})
    EXPECT_NEAR(parseLength(formatLength(mm), ""), mm, 1e-3 * mm) << formatLength(mm);
}

TEST(ParseNumber, TakesAFiniteNumberAndNothingElse) {
  EXPECT_DOUBLE_EQ(parseNumber("2.5", ""), 2.5);
  EXPECT_DOUBLE_EQ(parseNumber(" +1e-3 ", ""), 1e-3);
  for (const char* text : {"", " ", "x", "1 2", "1mm", "nan", "inf", "-inf", "1e999"})
    EXPECT_THROW(parseNumber(text, "--factor"), Error) << text;
}

}  // namespace
}  // namespace lychnite
