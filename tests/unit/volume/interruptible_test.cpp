// A solver that is stopped somewhere goes on as if it had not been.
#include "volume/interruptible.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "lychnite/base/error.h"
#include "lychnite/mesh/builtin.h"
#include "lychnite/optics/materials.h"
#include "lychnite/volume/volume.h"

namespace lychnite {
namespace {

Scene stoneScene() {
  Scene scene;
  scene.objects.push_back({.mesh = builtinMesh("stone"), .size = 20});
  scene.objects[0].material.medium = findMaterial("marble", "").coefficients;
  scene.lights.push_back(ParallelLight{.azimuth = 150, .elevation = 20});
  scene.lights.push_back(ParallelLight{.azimuth = -40, .elevation = 50});
  return scene;
}

/// So that all work asks on this thread, the same number of times each time.
struct OneThread {
  tbb::global_control control{tbb::global_control::max_allowed_parallelism, 1};
};

const VolumeSettings kQuick{.cells = 12, .photons = 1 << 12};

/// Says stop when it is asked for the nth time.
Progress stopAt(int n, int& asked) {
  return Progress([n, &asked](const Progress::Update&) { return ++asked < n; });
}

std::vector<glm::vec3> radiosity(const VolumeSolver& solver) {
  return solver.vertexRadiosity(0, VolumeSolver::Orders::kAll);
}

TEST(Interruptible, AsksOnlyWhileItLives) {
  int asked = 0;
  const Progress progress = stopAt(3, asked);
  {
    const volume::Interruptible inside(progress, {"", 0, ""});
    EXPECT_EQ(asked, 1);
    volume::Interruptible::check();
    EXPECT_THROW(volume::Interruptible::check(), Interrupted);
  }
  volume::Interruptible::check();
  EXPECT_EQ(asked, 3);
}

TEST(Interruptible, AnUpdateThatWasStoppedIsMadeWholeByTheNext) {
  const OneThread one;
  const Scene scene = stoneScene();
  VolumeSolver whole;
  int steps = 0;
  whole.update(scene, kQuick, stopAt(1 << 30, steps));
  whole.refine();
  ASSERT_GT(steps, 30);  // geometry, photons and the solver all ask
  const std::vector<glm::vec3> wanted = radiosity(whole);
  for (int n = 1; n <= steps; n += 1 + steps / 12) {
    VolumeSolver solver;
    int asked = 0;
    EXPECT_THROW(solver.update(scene, kQuick, stopAt(n, asked)), Interrupted) << n;
    solver.update(scene, kQuick);
    solver.refine();
    EXPECT_EQ(radiosity(solver), wanted) << n;
  }
}

TEST(Interruptible, APassThatWasStoppedLeavesAPicture) {
  const OneThread one;
  const Scene scene = stoneScene();
  VolumeSolver whole;
  whole.update(scene, kQuick);
  int steps = 0;
  whole.refine(stopAt(1 << 30, steps));
  for (int n = 1; n <= steps; n += 1 + steps / 6) {
    VolumeSolver solver;
    solver.update(scene, kQuick);
    int asked = 0;
    EXPECT_THROW(solver.refine(stopAt(n, asked)), Interrupted) << n;
    solver.update(scene, kQuick);  // what a viewer does for the next picture
    const std::vector<glm::vec3> found = radiosity(solver), wanted = radiosity(whole);
    double worst = 0, largest = 0;
    for (size_t i = 0; i < found.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        worst = std::max(worst, std::abs(double(found[i][c]) - double(wanted[i][c])));
        largest = std::max(largest, double(wanted[i][c]));
      }
    EXPECT_LT(worst, 0.5 * largest) << n;  // fewer photons, but all of the light
  }
}

}  // namespace
}  // namespace lychnite
