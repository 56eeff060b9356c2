#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "lychnite/base/log.h"
#include "lychnite/scene/settings.h"

namespace lychnite::viewer {

struct ViewOptions {
  std::string model = "figurine";    ///< file or built-in name; .toml is a scene
  std::filesystem::path screenshot;  ///< write the window here once the picture is whole, and quit
  std::filesystem::path play;        ///< an input script to play instead of a person
  std::optional<double> size;        ///< mm, of the model's longest side
  std::optional<Method> method;      ///< real-time or volume; empty: volume
  std::optional<double> scale;       ///< of everything in the window; empty: the display's
  int width = 0, height = 0;         ///< of the window at scale 1; 0: as it was last time
  int threads = 0;                   ///< of the background walk, 0 = one for two cores, half of them for more
  bool debug = false;                ///< OpenGL debug context; its errors end the program
  LogSink log;
};

/// `lychnite view`: opens the window and stays until it is closed. Throws Error: Kind::kDevice where there is
/// no display or no OpenGL 4.5, others when a script or a screenshot cannot be carried out.
void runViewer(const ViewOptions& options);

}  // namespace lychnite::viewer
