#include "lychnite/image/montage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lychnite/base/error.h"

namespace lychnite {
namespace {

Image flat(int width, int height, const glm::vec3& colour) {
  Image image(width, height);
  for (size_t i = 0; i < image.pixelCount(); ++i) image.setRgb(i, colour);
  return image;
}

glm::vec3 at(const Image& image, int x, int y) {
  return image.rgb(size_t(y) * size_t(image.width()) + size_t(x));
}

struct Box {
  int left, top, right, bottom;
};

/// Where a picture is lighter than the strip.
Box lightBox(const Image& image, float level) {
  Box box{image.width(), image.height(), -1, -1};
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      if (at(image, x, y).g > level)
        box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x), std::max(box.bottom, y)};
  return box;
}

TEST(Text, AnHIsAsHighAsItsCapitalsAndStandsOnTheBaseline) {
  Image page = flat(60, 60, {0, 0, 0});
  drawText(page, "H", 10, 40, 40, {1, 1, 1});
  const Box box = lightBox(page, 0.5f);
  // DejaVu Sans: capitals are 1493 of 2048 units high; H stands from 201 to 1339 of an advance of 1540.
  EXPECT_EQ(box.bottom, 39);
  EXPECT_NEAR(box.bottom + 1 - box.top, 40 * 1493. / 2048, 1);
  EXPECT_NEAR(box.left, 10 + 40 * 201. / 2048, 1);
  EXPECT_NEAR(box.right + 1, 10 + 40 * 1339. / 2048, 1);
  EXPECT_NEAR(textWidth("H", 40), 40 * 1540. / 2048, 1e-4);
}

TEST(Text, WidthScalesAndAdds) {
  EXPECT_NEAR(textWidth("marble, 5 mm", 40), 2 * textWidth("marble, 5 mm", 20), 1e-4);
  EXPECT_NEAR(textWidth("HHH", 20), 3 * textWidth("H", 20), 1e-4);
  EXPECT_EQ(textWidth("", 20), 0);
  EXPECT_LT(textWidth("AV", 20), textWidth("A", 20) + textWidth("V", 20)) << "kerned";
}

TEST(Text, ReadsUtf8AndSurvivesWhatIsNot) {
  EXPECT_NEAR(textWidth("\xc3\xa9", 20), textWidth("e", 20), 1e-4);
  EXPECT_NE(textWidth("\xc2\xb5", 20), textWidth("\xc3\xa9", 20));
  const double replacement = textWidth("\xef\xbf\xbd", 20);
  for (const char* bad : {"\xff", "\x80", "\xc3", "\xe2\x82"})
    EXPECT_NEAR(textWidth(bad, 20), replacement, 1e-4);
}

TEST(Text, IsCutOffAtTheEdges) {
  Image page = flat(8, 8, {0, 0, 0});
  drawText(page, "MMMM", -20, 20, 60, {1, 1, 1});
  drawText(page, "M", 1000, -1000, 60, {1, 1, 1});
  EXPECT_EQ(page.pixelCount(), 64u);
}

TEST(Montage, PutsPicturesSideBySideAlignedAtTheTop) {
  const Image red = flat(300, 200, {1, 0, 0}), green = flat(200, 100, {0, 0.25f, 0});
  const Panel panels[] = {{&red, "red"}, {&green, "green"}};
  const Image result = montage(panels, {});
  EXPECT_EQ(result.width(), 16 + 300 + 16 + 200 + 16);
  EXPECT_EQ(result.height(), 16 + 200 + 40);
  const glm::vec3 strip = at(result, 0, 0);
  EXPECT_EQ(at(result, 15, 16), strip);
  EXPECT_EQ(at(result, 16, 15), strip);
  EXPECT_EQ(at(result, 16, 16), glm::vec3(1, 0, 0));
  EXPECT_EQ(at(result, 315, 215), glm::vec3(1, 0, 0));
  EXPECT_EQ(at(result, 316, 215), strip);
  EXPECT_NEAR(at(result, 332, 16).g, 0.25f, 1e-6);
  EXPECT_EQ(at(result, 332, 116), strip);
}

TEST(Montage, LabelsAreCentredBelow) {
  const Image black = flat(300, 100, {0, 0, 0});
  const Panel panels[] = {{&black, "HHHH"}};
  const Image result = montage(panels, {});
  const Box box = lightBox(result, 0.3f);
  EXPECT_GT(box.top, 116);
  EXPECT_LT(box.bottom, result.height() - 4);
  EXPECT_NEAR(0.5 * (box.left + box.right + 1), 16 + 150, 1.5);
}

TEST(Montage, WrapsAndMakesRoomForLongLabels) {
  const Image small = flat(10, 10, {1, 1, 1});
  const std::string label = "a label much wider than its picture";
  const Panel panels[] = {{&small, label}, {&small, ""}, {&small, ""}};
  const Image result = montage(panels, {}, 2);
  EXPECT_EQ(result.width(), 16 + int(std::ceil(textWidth(label, 20))) + 16 + 10 + 16);
  EXPECT_EQ(result.height(), 16 + 10 + 40 + 10 + 16);
}

TEST(Montage, ToneMapsOnce) {
  const Image bright = flat(4, 4, {3, 0.5f, 0.1f});
  const Panel panels[] = {{&bright, ""}};
  const ToneMapping filmic{.curve = ToneMapping::Curve::kFilmic, .exposure = -1};
  const glm::vec3 once = toneMap({3, 0.5f, 0.1f}, filmic),
                  shown = toneMap(at(montage(panels, filmic), 17, 17), {});
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], once[c], 1e-5);
}

TEST(Montage, RefusesNothingAndPicturesWithoutColour) {
  EXPECT_THROW(montage({}, {}), Error);
  Image depth(2, 2);
  depth.addChannel("depth.Z");
  const Panel panels[] = {{&depth, ""}};
  EXPECT_THROW(montage(panels, {}), Error);
}

}  // namespace
}  // namespace lychnite
