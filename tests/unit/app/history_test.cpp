#include "lychnite/app/history.h"

#include <gtest/gtest.h>

#include "lychnite/mesh/builtin.h"
#include "lychnite/scene/scene_file.h"

namespace lychnite {
namespace {

ViewState sphereView() {
  return defaultView(loadObject("sphere"));
}

double sizeOf(const ViewState& state) {
  return state.scene.objects.front().size;
}

TEST(History, GoesBackAndForth) {
  ViewState state = sphereView();
  History history(state);
  EXPECT_FALSE(history.canUndo());
  EXPECT_FALSE(history.canRedo());
  for (const double size : {10.0, 20.0, 40.0}) {
    state.scene.objects.front().size = size;
    history.record(state);
  }
  EXPECT_EQ(sizeOf(history.undo()), 20);
  EXPECT_EQ(sizeOf(history.undo()), 10);
  EXPECT_EQ(sizeOf(history.redo()), 20);
  EXPECT_TRUE(history.canRedo());
}

TEST(History, RecordingDropsWhatWasUndone) {
  ViewState state = sphereView();
  History history(state);
  state.scene.objects.front().size = 10;
  history.record(state);
  history.undo();
  state.toneMapping.exposure = 2;
  history.record(state);
  EXPECT_FALSE(history.canRedo());
  EXPECT_EQ(history.size(), 2u);
}

TEST(History, EqualStatesAreOneStep) {
  const ViewState state = sphereView();
  History history(state);
  history.record(state);
  EXPECT_FALSE(history.canUndo());
}

TEST(History, EveryParameterIsAStep) {
  const ViewState start = sphereView();
  const std::vector<void (*)(ViewState&)> changes{
      [](ViewState& s) { s.scene.objects[0].size *= 2; },
      [](ViewState& s) { s.scene.objects[0].material.medium.sigma_s.y += 1; },
      [](ViewState& s) { s.scene.objects[0].material.roughness = 0.5; },
      [](ViewState& s) { s.scene.objects[0].material.opaque = true; },
      [](ViewState& s) { s.scene.objects[0].mesh = builtinMesh("knot"); },
      [](ViewState& s) { s.scene.lights.pop_back(); },
      [](ViewState& s) { std::get<ParallelLight>(s.scene.lights[0]).azimuth += 1; },
      [](ViewState& s) { std::get<OrbitCamera>(s.scene.camera).factor = 2; },
      [](ViewState& s) { s.scene.background.z += 0.1; },
      [](ViewState& s) { s.scene.ambient.x += 0.1; },
      [](ViewState& s) { s.settings.method = Method::kAdaptive; },
      [](ViewState& s) { s.settings.profile = ProfileKind::kBetterDipole; },
      [](ViewState& s) { s.settings.multipleSamples = 64; },
      [](ViewState& s) { s.settings.singleSamples = 16; },
      [](ViewState& s) { s.settings.mapSize = 256; },
      [](ViewState& s) { s.settings.components.single = false; },
      [](ViewState& s) { s.toneMapping.curve = ToneMapping::Curve::kFilmic; },
      [](ViewState& s) { s.variant.size = 5; },
      [](ViewState& s) { s.variant.material = s.scene.objects[0].material; },
      [](ViewState& s) { s.compare.mode = CompareView::Mode::kWipe; },
      [](ViewState& s) { s.compare.wipe = 0.3; },
      [](ViewState& s) { s.inspect.layer = Inspect::Layer::kDepth; },
      [](ViewState& s) { s.ruler = !s.ruler; }};
  for (size_t i = 0; i < changes.size(); ++i) {
    History history(start);
    ViewState changed = start;
    changes[i](changed);
    history.record(changed);
    EXPECT_TRUE(history.canUndo()) << "change " << i;
  }
}

TEST(History, IsBounded) {
  ViewState state = sphereView();
  History history(state);
  for (size_t i = 0; i < History::kMost + 50; ++i) {
    state.toneMapping.exposure = double(i);
    history.record(state);
  }
  EXPECT_EQ(history.size(), History::kMost);
  EXPECT_EQ(history.undo().toneMapping.exposure, double(History::kMost + 48));
}

TEST(History, ForgetsMeshesThatHoldTooMuch) {
  ViewState state = sphereView();
  History history(state);
  const size_t vertices = (History::kMostMeshBytes / 3) / (2 * sizeof(glm::vec3));
  std::weak_ptr<const Mesh> first;
  for (int i = 0; i < 6; ++i) {
    auto mesh = std::make_shared<Mesh>();
    mesh->positions.resize(vertices);
    mesh->normals.resize(vertices);
    mesh->extent = Extent{};
    if (i == 0) first = mesh;
    state.scene.objects.front().mesh = mesh;
    history.record(state);
  }
  EXPECT_TRUE(first.expired());
  EXPECT_TRUE(history.canUndo());
}

}  // namespace
}  // namespace lychnite
