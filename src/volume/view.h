#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "reference/single_light.h"
#include "reference/surface_samples.h"
#include "volume/gather.h"
#include "volume/photons.h"

namespace lychnite::volume {

/// What a camera sees, and which nodes' light makes each pixel. It goes with shapes, places and indices of
/// refraction only: lights, media and sizes may change under it. Nodes are numbered body after body.
class View {
 public:
  View(const RayScene& rays, const World& world, int width, int height);

  /// Whether it is what that camera sees of these bodies, whose shapes and places are those it was made for.
  bool isOf(const RayScene& rays, const World& world, int width, int height) const;
  const CameraReceivers& receivers() const { return receivers_; }
  /// Of what it sees of an object, the least distance along its axis; infinite where it sees nothing.
  float nearest(size_t object) const { return nearest_[object]; }
  /// Of the scene's media as they are now.
  const SingleLight& singleLight();

  /// What one unit of a node's flux adds to a pixel's radiosity and radiance, means over the whole pixel.
  struct Share {
    uint32_t node;
    float radiosity, radiance;
  };
  /// A point that a pixel sees, and what one unit of radiosity there adds to the pixel's.
  struct Spot {
    SurfacePoint point;  ///< of the smooth surface, so that facets do not show
    uint32_t object;
    float radiosity, radiance;
  };
  struct Pixel {
    uint32_t index;  ///< row * width + column
    std::span<const Share> shares;
    std::span<const Spot> spots;
  };
  /// Whether all pixels' shares were found out, and kept where that takes little memory.
  bool complete() const { return complete_; }
  /// Calls visit(pixel) for all pixels that see something, on several threads at once. Finds them out when
  /// first asked and keeps them as far as they take little memory.
  void forPixels(const std::function<void(const Pixel&)>& visit);

  /// Those of them that are kept, one after the other in order, once all were found out.
  template <class Visit>
  void forKeptPixels(Visit visit) const {
    for (size_t b = 0; b < blocks_.size(); ++b) visitBlock(b, blocks_[b], visit);
  }

  size_t memoryBytes() const;

 private:
  static constexpr size_t kBlock = 1024;  // pixels
  struct Block {
    std::vector<uint32_t> last, lastSpot;  ///< of each pixel, the share and the spot after its last one
    std::vector<Share> shares;
    std::vector<Spot> spots;
    size_t memoryBytes() const;
  };
  Block make(size_t block) const;
  template <class Visit>
  void visitBlock(size_t number, const Block& block, const Visit& visit) const {
    uint32_t begin = 0, beginSpot = 0;
    for (size_t i = 0; i < block.last.size(); ++i) {
      visit(Pixel{receivers_.receivers[first_[number * kBlock + i]].pixel,
                  std::span(block.shares).subspan(begin, block.last[i] - begin),
                  std::span(block.spots).subspan(beginSpot, block.lastSpot[i] - beginSpot)});
      begin = block.last[i];
      beginSpot = block.lastSpot[i];
    }
  }

  const RayScene& rays_;
  const World& world_;
  CameraFrame camera_;
  std::vector<float> etas_;
  CameraReceivers receivers_;
  std::vector<uint32_t> firstNode_;  ///< of each body
  std::vector<float> nearest_;       ///< of each object
  std::vector<size_t> first_;        ///< receiver of each pixel that sees something, and the end
  std::vector<Block> blocks_;        ///< empty ones are not kept
  std::atomic<size_t> kept_{0};      ///< bytes
  std::unique_ptr<SingleLight> singleLight_;
  bool complete_ = false;
};

}  // namespace lychnite::volume
