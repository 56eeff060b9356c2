// The README's ten lines.
#include "lychnite/app/image_maker.h"
#include "lychnite/image/io.h"
#include "lychnite/optics/materials.h"
#include "lychnite/scene/scene_file.h"

int main() {
  using namespace lychnite;
  Scene scene;
  scene.objects.push_back(loadObject("figurine"));  // or a mesh file
  scene.objects[0].size = 20;                       // mm, the longest side
  scene.objects[0].material.medium = findMaterial("marble", "material").coefficients;
  scene.lights.push_back(ParallelLight{.azimuth = 150, .elevation = 30});  // from behind
  ImageMaker maker({});
  writePng(maker.render(scene, RenderSettings{}), "marble.png");
}
