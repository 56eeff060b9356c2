#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "lychnite/app/background.h"
#include "lychnite/app/history.h"
#include "lychnite/app/view_state.h"

namespace lychnite {

/// A line for the person in front of the screen.
struct SessionMessage {
  std::string text;
  bool problem = false;
};

/// The document of a viewer, without a window: what is shown, how it got there, where it is kept. One thread;
/// loading and rendering to files go on behind it, and poll() takes in what they made.
class Session {
 public:
  explicit Session(std::string device = "auto");
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  bool empty() const { return state_.scene.objects.empty(); }
  ViewState& state() { return state_; }
  const ViewState& state() const { return state_; }
  /// Makes what changed since the last call one step of the history. Front ends call it when a gesture ends.
  void commit();
  bool canUndo() const { return history_ && history_->canUndo(); }
  bool canRedo() const { return history_ && history_->canRedo(); }
  void undo();
  void redo();

  /// Opens a scene (.toml), a picture (.exr, .png: for comparisons) or a model, by file or built-in name.
  /// What is there stays until it is loaded, and for good when it cannot be.
  void open(const std::string& path);
  bool loading() const;
  /// Takes in what was loaded or written and, twice a second of `seconds` (any clock that runs), looks for
  /// files that changed on disk. True when the state or the opened picture is another one.
  bool poll(double seconds);
  /// Waits for what open() began.
  void finishLoading();

  /// A picture that was opened, or nothing.
  const std::shared_ptr<const Image>& picture() const { return picture_; }
  const std::string& pictureName() const { return pictureName_; }
  /// The file or built-in model that is shown.
  const std::string& documentName() const { return documentName_; }

  /// Writes the scene to the file that it came from, or beside the working folder's other files under a new
  /// name; says where in a message. Returns the path, empty when it could not.
  std::filesystem::path saveScene();
  /// The same to a file of the person's choice, which becomes the scene's.
  std::filesystem::path saveSceneAs(const std::filesystem::path& path);
  const std::filesystem::path& scenePath() const { return scenePath_; }
  /// Begins to write the picture as `lychnite render` would; empty path: a new name beside the scene's, with
  /// the extension ".png" or ".exr".
  void savePicture(int width, int height, std::filesystem::path path = {},
                   const std::string& extension = ".png");
  PictureWriter& pictures() { return pictures_; }
  const PictureWriter& pictures() const { return pictures_; }

  /// Messages since the last call.
  std::vector<SessionMessage> takeMessages();
  void say(std::string text, bool problem = false);
  LogSink log();

 private:
  struct Loading;
  struct Watched {
    std::filesystem::path path;
    std::filesystem::file_time_type time{};
  };
  void take(Loading& done);
  void takeObject(Loading& done);
  void takeScene(Loading& done);
  void startLoading(const std::string& path, bool reload);
  void watch();
  void lookAtFiles(double seconds);
  Scene sceneForFile(const std::filesystem::path& path) const;

  std::string device_;
  ViewState state_;
  std::unique_ptr<History> history_;
  std::shared_ptr<const Image> picture_;
  std::string pictureName_, documentName_;
  std::filesystem::path scenePath_;
  std::unique_ptr<Loading> loading_;
  std::vector<std::pair<std::string, bool>> queue_;
  std::vector<Watched> watched_;
  double lastLook_ = 0;
  std::shared_ptr<struct SessionMessages> messages_;
  std::set<std::filesystem::path> promised_;  ///< pictures that are still to be written
  PictureWriter pictures_;
};

}  // namespace lychnite
