#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lychnite/base/log.h"
#include "lychnite/base/progress.h"

namespace lychnite {

// The report behind `lychnite paper`: every figure and table of Yao & Wang 2009, reproduced and measured
// (docs/user/paper.md).

struct PaperSettings {
  std::filesystem::path output;   ///< folder of the report; made when it is missing
  std::filesystem::path models;   ///< folder of bunny.ply and dragon.ply; empty: none
  bool quick = false;             ///< small pictures, few photons
  std::vector<std::string> only;  ///< names of paperParts(); empty: all
  std::string device = "auto";    ///< as RendererOptions::device
  LogSink log;
};

struct PaperPartName {
  std::string name;   ///< of its folder and of `only`
  std::string title;  ///< of its section
};
/// In the order of the page.
std::vector<PaperPartName> paperParts();

/// Throws Error (Kind::kUsage): an unknown part, no folder of models.
void validate(const PaperSettings& settings);

struct PaperResult {
  std::filesystem::path page;
  std::vector<std::string> made, kept;  ///< names of parts: made now, found finished
};

/// Writes the report: index.html, and a folder a part with its pictures and numbers. A part whose stamp (of
/// program, settings, device and models) is the one on disk is kept; an interrupted part keeps the pictures
/// that it has, and goes on from them next time. The page holds what there is after each part. Throws Error,
/// and Interrupted when `progress` says stop.
PaperResult makePaper(const PaperSettings& settings, const Progress& progress = {});

}  // namespace lychnite
