#include "lychnite/app/view_state.h"

#include <gtest/gtest.h>

#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"

namespace lychnite {
namespace {

ViewState sphereView() {
  return defaultView(loadObject("sphere"));
}

TEST(ViewState, AVariantChangesWhatItSaysAndNothingElse) {
  ViewState state = sphereView();
  state.scene.lights.push_back(PointLight{.position = {100, 0, 0}, .intensity = Rgb(10000)});
  EXPECT_EQ(fingerprint(applied({}, state)), fingerprint(state));
  Material wax = state.scene.objects[0].material;
  wax.roughness = 0.9;
  const Variant variant{.method = Method::kAdaptive, .samples = 64, .material = wax, .size = 60};
  const ViewState other = applied(variant, state);
  EXPECT_EQ(other.settings.method, Method::kAdaptive);
  EXPECT_EQ(other.settings.multipleSamples, 64);
  EXPECT_EQ(other.settings.profile, state.settings.profile);
  EXPECT_EQ(other.scene.objects[0].size, 60);
  EXPECT_EQ(other.scene.objects[0].material.roughness, 0.9);
  EXPECT_EQ(std::get<PointLight>(other.scene.lights[2]).position.x, 200);  // the light keeps its look
}

TEST(ViewState, TheFingerprintTellsWhatIsShownApart) {
  const ViewState state = sphereView();
  const auto changed = [&](const auto& change) {
    ViewState other = state;
    change(other);
    return fingerprint(other) != fingerprint(state);
  };
  EXPECT_FALSE(changed([](ViewState&) {}));
  EXPECT_TRUE(changed([](ViewState& s) { s.resolution = 0.5; }));
  EXPECT_TRUE(changed([](ViewState& s) { s.ruler = false; }));
  EXPECT_TRUE(changed([](ViewState& s) { s.compare.full = 0.1; }));
  EXPECT_TRUE(changed([](ViewState& s) { s.settings.mapSize = 256; }));
  EXPECT_TRUE(changed([](ViewState& s) { s.scene.objects[0].material.roughness = 0.9; }));
}

TEST(ViewState, TheSubjectIsTheFirstTranslucentObject) {
  Scene scene = sphereView().scene;
  scene.objects.push_back(scene.objects[0]);
  EXPECT_EQ(subjectIndex(scene), 0u);
  scene.objects[0].material.opaque = true;
  EXPECT_EQ(subjectIndex(scene), 1u);
  scene.objects[1].material.opaque = true;
  EXPECT_EQ(subjectIndex(scene), 0u);
}

TEST(ViewState, TheCommandSaysWhatDiffersFromTheDefaults) {
  ViewState state = sphereView();
  EXPECT_EQ(renderCommand(state, "a.toml", "a.png", 64, 48),
            "lychnite render a.toml --resolution 64x48 --method volume --cells 64 -o a.png");
  state.settings.method = Method::kFixed;
  state.settings.profile = ProfileKind::kBetterDipole;
  state.settings.components.surface = false;
  state.settings.mapSize = state.settings.mostMapSize = 256;
  state.settings.singleSamples = 4;
  state.toneMapping = {.curve = ToneMapping::Curve::kFilmic, .exposure = -1.5};
  EXPECT_EQ(renderCommand(state, "it's.toml", "a b.png", 64, 48),
            "lychnite render 'it'\\''s.toml' --resolution 64x48 --method fixed --profile better-dipole "
            "--components multiple,single --single-samples 4 --map 256 --exposure -1.5 --tone-map filmic -o "
            "'a b.png'");
  state.settings.method = Method::kMatched;
  state.settings.multipleSamples = 64;
  EXPECT_NE(renderCommand(state, "a.toml", "a.png", 64, 48).find("--samples 64"), std::string::npos);
}

}  // namespace
}  // namespace lychnite
