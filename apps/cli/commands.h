#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace lychnite::cli {

/// What a subcommand does once its flags are parsed; returns the exit status.
using Action = std::function<int()>;

/// Each adds its subcommand with flags and help, and sets `action` when it is chosen.
void addRender(CLI::App& app, Action& action);
void addView(CLI::App& app, Action& action);
void addCompare(CLI::App& app, Action& action);
void addSlab(CLI::App& app, Action& action);
void addBench(CLI::App& app, Action& action);
void addPaper(CLI::App& app, Action& action);
void addInfo(CLI::App& app, Action& action);
void addMaterials(CLI::App& app, Action& action);
void addModels(CLI::App& app, Action& action);
void addDevices(CLI::App& app, Action& action);

}  // namespace lychnite::cli
