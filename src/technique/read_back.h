#pragma once

#include <vector>

#include "gpu/texture.h"
#include "lychnite/image/image.h"
#include "technique/frame.h"

namespace lychnite {

/// Copies a picture-sized texture's rgb to a layer of the image ("" = the picture itself, with alpha), top
/// row first.
void readPicture(const gpu::Texture& texture, Image& image);
/// The sum of several layers.
void readLayer(const std::vector<const gpu::Texture*>& layers, Image& image, const std::string& name);
/// "depth.Z" in mm (mean over the covered samples; 0 where there are none) and "normal.X|Y|Z" (unit, world).
void readGeometry(const gpu::Texture& samples, const Frame& frame, Image& image, bool depth, bool normal);

}  // namespace lychnite
