#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "lychnite/base/log.h"

namespace lychnite::gpu {

/// One way to OpenGL on this machine.
struct DeviceInfo {
  int index = 0;  ///< what --device N means
  std::string
      platform;  ///< "device" or "surfaceless" (EGL_PLATFORM_DEVICE_EXT, EGL_PLATFORM_SURFACELESS_MESA)
  std::string renderer, vendor, version;
  bool software = false;  ///< llvmpipe, softpipe, swrast
  bool usable = false;    ///< desktop OpenGL 4.5 core could be made current
  std::string problem;    ///< why not, when not usable
};

/// Every EGL device and the surfaceless platform, tried in turn. Empty where there is no EGL. Never throws.
std::vector<DeviceInfo> listDevices();

struct ContextOptions {
  std::string device =
      "auto";  ///< "auto" prefers a real GPU, "gpu" insists on one, "cpu" the software driver, or an index
  bool debug = false;  ///< ask for a debug context; error messages of KHR_debug make checkErrors() throw
  /// Use the EGL context that is current on this thread (a window's) instead of making one; `device` is not
  /// looked at. Several Contexts may wrap the same one; the first must live longest, the window longer still.
  bool current = false;
};

/// An OpenGL 4.5 core context, its own or (ContextOptions::current) a window's. Current on the thread that
/// made it; move it nowhere else without makeCurrent(). Throws Error (Kind::kDevice) when there is no usable
/// one.
class Context {
 public:
  explicit Context(const ContextOptions& options = {}, LogSink log = {});
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  void makeCurrent();
  const DeviceInfo& device() const;
  /// Waits until the device has done all that was asked of it.
  void finish();
  /// Bytes held on the device by the buffers and textures made in this context.
  size_t allocatedBytes() const;
  /// Throws Error (Kind::kDevice) with the driver's text when an OpenGL error was reported since the last
  /// call (in a debug context: a KHR_debug error, which names the call), or when the device was reset.
  void checkErrors(const char* where);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lychnite::gpu
