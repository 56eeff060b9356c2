#include "accuracy/cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "accuracy/models.h"
#include "accuracy/plate.h"
#include "lychnite/base/error.h"
#include "lychnite/mesh/load.h"

namespace lychnite::accuracy {
namespace {

TEST(AccuracyCells, AreTheWholeStudyOnceEach) {
  const std::vector<Cell> cells = cellsOf(everything());
  EXPECT_EQ(cells.size(), 7u * 6 * 6 * 3 + 3 * 2 * 6 * 3);
  std::set<std::string> names;
  for (const Cell& cell : cells) names.insert(cell.name());
  EXPECT_EQ(names.size(), cells.size());
  EXPECT_TRUE(names.contains("bunny_filled-skin1-100mm-behind-g0.8"));
  EXPECT_FALSE(names.contains("knot-skin1-100mm-behind-g0.8"));
}

TEST(AccuracyCells, AnyFirstPartIsACrossSection) {
  const std::vector<Cell> cells = cellsOf(everything());
  for (const std::string& shape : everything().shapes)
    EXPECT_GT(std::count_if(cells.begin(), cells.begin() + 100,
                            [&](const Cell& cell) { return cell.shape == shape; }),
              4)
        << shape;
  // A part of the study has them in the same order.
  Choice part = everything();
  part.shapes = {"knot", "sphere"};
  std::vector<Cell> expected;
  for (const Cell& cell : cells)
    if (cell.shape == "knot" || cell.shape == "sphere") expected.push_back(cell);
  EXPECT_EQ(cellsOf(part), expected);
}

TEST(AccuracyCells, KeepTheReducedScatteringAtAnyG) {
  Shapes shapes("");
  const Coefficients even = shapes.sceneOf({"sphere", "skin1", 10, "side", 0}).objects[0].material.medium;
  const Coefficients ahead = shapes.sceneOf({"sphere", "skin1", 10, "side", 0.8}).objects[0].material.medium;
  EXPECT_EQ(ahead.g, 0.8);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(ahead.sigma_sp()[c], even.sigma_sp()[c], 1e-12);
}

TEST(AccuracyCells, RefuseWhatThereIsNot) {
  Choice choice = everything();
  choice.lights = {"above"};
  EXPECT_THROW(cellsOf(choice), Error);
  choice = everything();
  choice.materials = {"skin"};
  EXPECT_THROW(cellsOf(choice), Error);
  EXPECT_THROW(Shapes("").at("teapot"), Error);
}

TEST(AccuracyCells, PlateIsClosedAndOfItsSize) {
  const auto plate = roundedPlate();
  const MeshInfo info = inspect(*plate);
  EXPECT_TRUE(info.closed);
  const glm::dvec3 extent = boundsOf(*plate).extent();
  EXPECT_NEAR(extent.x, 0.12, 1e-6);
  EXPECT_NEAR(extent.y, 1, 1e-6);
  EXPECT_NEAR(extent.z, 0.7, 1e-6);
}

TEST(AccuracyColumns, ReadTheirTexts) {
  EXPECT_EQ(columnOf("volume").passes, RenderSettings{}.passes);
  EXPECT_EQ(columnOf("volume:32:9").cells, 32);
  EXPECT_EQ(columnOf("volume:32:9").passes, 9);
  EXPECT_EQ(columnOf("volume:0:9").cells, 0);
  EXPECT_EQ(columnOf("first").passes, 0);
  EXPECT_EQ(columnOf("first:64").cells, 64);
  EXPECT_EQ(columnOf("tabulated").profile, ProfileKind::kTabulated);
  EXPECT_EQ(columnOf("matched").method, Method::kMatched);
  for (const char* bad : {"volume:7", "volume:32:0", "volume:1.5", "first:64:2", "walk", "volumes", ""})
    EXPECT_THROW(columnOf(bad), Error) << bad;
  EXPECT_THROW(requireOnSurface(columnOf("better-dipole")), Error);
}

}  // namespace
}  // namespace lychnite::accuracy
