#include <algorithm>

#include "lychnite/base/error.h"
#include "lychnite/base/text.h"
#include "lychnite/scene/scene.h"

namespace lychnite {

void setPose(Object& object, const std::string& clip, double seconds) {
  if (clip.empty()) {
    if (object.animation) object.mesh = object.animation->rest();
    object.clip.clear();
    object.time = 0;
    return;
  }
  std::vector<std::string> names;
  if (object.animation)
    for (const MeshAnimation::Clip& each : object.animation->clips()) names.push_back(each.name);
  const auto found = std::find(names.begin(), names.end(), clip);
  if (found == names.end()) {
    const std::string nearest = nearestName(clip, names);
    throw Error({.where = object.model,
                 .expected = names.empty() ? "no animation: nothing moves in it" : "the name of an animation",
                 .found = "'" + clip + "'",
                 .todo = nearest.empty() ? "`lychnite info` lists them" : "did you mean '" + nearest + "'?"},
                Error::Kind::kUsage);
  }
  const size_t number = size_t(found - names.begin());
  const double time = std::clamp(seconds, 0.0, object.animation->clips()[number].seconds);
  object.mesh = object.animation->pose(number, time);
  object.clip = clip;
  object.time = time;
}

}  // namespace lychnite
