#include "lychnite/scene/settings.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(Settings, MethodNamesRoundTrip) {
  for (const char* name : {"adaptive", "fixed", "dipole", "hierarchical", "walk"})
    EXPECT_EQ(methodName(parseMethod(name, "")), name);
  EXPECT_FALSE(isReference(Method::kAdaptive));
  EXPECT_FALSE(isReference(Method::kFixed));
  for (Method method : {Method::kDipole, Method::kHierarchical, Method::kWalk})
    EXPECT_TRUE(isReference(method));
  try {
    parseMethod("adaptiv", "--method");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.parts().where, "--method");
    EXPECT_NE(error.parts().todo.find("'adaptive'"), std::string::npos);
    EXPECT_EQ(error.kind(), Error::Kind::kUsage);
  }
  EXPECT_THROW(parseMethod("", "--method"), Error);
  EXPECT_EQ(methodName(Method::kAuto), "auto");
  EXPECT_THROW(parseMethod("auto", "--method"), Error) << "it is asked for by no --method";
}

TEST(Settings, ComponentListsRoundTrip) {
  for (const char* list : {"multiple", "single", "surface", "multiple,single", "multiple,single,surface"})
    EXPECT_EQ(componentsName(parseComponents(list, "")), list);
  EXPECT_EQ(componentsName(parseComponents("surface,multiple", "")), "multiple,surface");
  EXPECT_EQ(componentsName(Components{}), "multiple,single,surface");
  for (const char* list : {"", "multiple,", "multi", "multiple;single", "multiple, single"})
    EXPECT_THROW(parseComponents(list, "--components"), Error) << "'" << list << "'";
}

TEST(Settings, WantsWhatIsListed) {
  RenderSettings settings;
  settings.aovs = {"depth", "single"};
  EXPECT_TRUE(settings.wants("depth"));
  EXPECT_FALSE(settings.wants("normal"));
}

TEST(Settings, DefaultsAreValid) {
  RenderSettings settings;
  EXPECT_NO_THROW(validate(settings));
  EXPECT_EQ(resolved(settings), Method::kVolume);
  settings.aovs = {"multiple", "single", "surface", "depth", "normal", "lights", "radiosity"};
  EXPECT_NO_THROW(validate(settings));
  EXPECT_EQ(resolved(settings), Method::kMatched) << "volume does not keep lights apart";
  settings.aovs = {"stderr"};
  EXPECT_NO_THROW(validate(settings));
  settings = {.method = Method::kWalk};
  settings.aovs = {"stderr", "radiosity"};
  EXPECT_NO_THROW(validate(settings));
}

TEST(Settings, OutOfRangeIsNamed) {
  struct Case {
    const char* where;
    std::function<void(RenderSettings&)> spoil;
  };
  const Case cases[]{
      {"resolution", [](RenderSettings& s) { s.width = 0; }},
      {"resolution", [](RenderSettings& s) { s.height = -5; }},
      {"resolution", [](RenderSettings& s) { s.width = 16385; }},
      {"map", [](RenderSettings& s) { s.mapSize = 127; }},
      {"map", [](RenderSettings& s) { s.mapSize = 4097; }},
      {"map", [](RenderSettings& s) { s.mostMapSize = 4097; }},
      {"single samples", [](RenderSettings& s) { s.singleSamples = 0; }},
      {"single samples", [](RenderSettings& s) { s.singleSamples = 257; }},
      {"samples", [](RenderSettings& s) { s.samples = 0; }},
      {"samples", [](RenderSettings& s) { s.samples = kNan; }},
      {"tolerance", [](RenderSettings& s) { s.tolerance = 0; }},
      {"time", [](RenderSettings& s) { s.timeLimit = -1; }},
      {"noise", [](RenderSettings& s) { s.noise = kNan; }},
      {"threads", [](RenderSettings& s) { s.threads = -1; }},
      {"aov", [](RenderSettings& s) { s.aovs = {"dept"}; }},
      {"aov",
       [](RenderSettings& s) {
         s.aovs = {"stderr", "lights"};
       }},
      {"aov", [](RenderSettings& s) { s.method = Method::kWalk, s.aovs = {"lights"}; }},
  };
  for (size_t i = 0; i < std::size(cases); ++i) {
    RenderSettings settings;
    cases[i].spoil(settings);
    try {
      validate(settings);
      ADD_FAILURE() << "case " << i << " (" << cases[i].where << ") was accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.parts().where, cases[i].where) << error.what();
      EXPECT_EQ(error.kind(), Error::Kind::kUsage);
    }
  }
}

}  // namespace
}  // namespace lychnite
