#pragma once

#include "lychnite/scene/scene.h"

namespace lychnite {

// How front ends move the camera, the lights and the size by hand. Angles in degrees.

/// Turns the camera about what it looks at; elevations stop at 89 degrees either way.
void orbitCamera(Scene& scene, double azimuth, double elevation);
/// The same distance, so many times as far.
void zoomCamera(Scene& scene, double factor);
/// Moves camera and target across the picture by (x, y) in picture heights, x to the right and y up; an orbit
/// camera becomes a pinhole camera.
void panCamera(Scene& scene, double x, double y);
/// An orbit camera that frames the scene from where the camera is now.
void fitCamera(Scene& scene);
/// View 1 to 9 of an orbit camera: front, right, back, left, top, bottom, and three corners from above.
void setView(Scene& scene, int number);

/// Turns one light about the scene's centre.
void turnLight(Scene& scene, size_t light, double azimuth, double elevation);
/// All lights, or all objects, about y through the centre of the scene.
void turnLights(Scene& scene, double degrees);
void turnObjects(Scene& scene, double degrees);
/// setPose() on the scene's subject; the camera stays where it is, though a clip may reach farther than the
/// mesh at rest.
void showClip(Scene& scene, const std::string& clip, double seconds);
/// Moves every object that shows a clip so many seconds on, from its end back to its beginning.
void playClips(Scene& scene, double seconds);
/// The subject's animation that is shown, or its first one; nothing where it has none.
const MeshAnimation::Clip* clipOf(const Object& object);
/// A light of the other kind that gives the scene's centre the same irradiance from the same side.
Light asPoint(const Scene& scene, const ParallelLight& light);
Light asParallel(const Scene& scene, const PointLight& light);

/// Scales the scene so that its subject has `size`, in mm, > 0, clamped to [0.1 mm, 10 m]. The camera keeps
/// its view.
void setSubjectSize(Scene& scene, double size);

}  // namespace lychnite
