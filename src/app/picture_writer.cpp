#include <fmt/format.h>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

#include "lychnite/app/background.h"
#include "lychnite/app/image_maker.h"
#include "lychnite/base/error.h"

namespace lychnite {

void savePicture(Image& image, const std::filesystem::path& path, const PngOptions& png) {
  image.metadata["exposure"] = fmt::format("{}", png.toneMapping.exposure);
  std::erase_if(image.metadata,
                [](const auto& entry) { return entry.first == "seconds" || entry.first.ends_with("_ms"); });
  if (path.extension() == ".exr")
    writeExr(image, path);
  else
    writePng(image, path, png);
}

struct PictureWriter::Impl {
  void work(const std::stop_token& stop);
  std::string write(const PictureRequest& request);

  mutable std::mutex mutex;
  std::condition_variable_any wake;
  std::deque<PictureRequest> waiting;
  std::deque<Outcome> outcomes;
  bool working = false;
  std::atomic<bool> cancelled{false};
  std::atomic<double> fraction{0};
  std::jthread thread;  // last: it uses the members above
};

void PictureWriter::Impl::work(const std::stop_token& stop) {
  while (true) {
    PictureRequest request;
    {
      std::unique_lock lock(mutex);
      if (!wake.wait(lock, stop, [&] { return !waiting.empty(); })) return;
      request = std::move(waiting.front());
      waiting.pop_front();
      working = true;
      cancelled = false;
      fraction = 0;
    }
    std::string problem = write(request);
    const std::lock_guard lock(mutex);
    outcomes.push_back({request.output, std::move(problem)});
    working = false;
  }
}

std::string PictureWriter::Impl::write(const PictureRequest& request) {
  try {
    ImageMaker maker({.device = request.device, .debug = false, .log = {}});
    const Progress progress([this](const Progress::Update& update) {
      fraction = update.fraction;
      return !cancelled.load();
    });
    const bool exr = request.output.extension() == ".exr";
    Image image = maker.render(request.scene, request.settings, progress, {.keepState = exr});
    if (cancelled) return "cancelled";
    savePicture(image, request.output, request.png);
    return "";
  } catch (const Interrupted&) {
    return "cancelled";
  } catch (const std::exception& error) {
    return error.what();
  }
}

PictureWriter::PictureWriter() : impl_(std::make_unique<Impl>()) {
  impl_->thread = std::jthread([impl = impl_.get()](const std::stop_token& token) { impl->work(token); });
}

PictureWriter::~PictureWriter() {
  cancel();
  impl_->thread.request_stop();
}

void PictureWriter::start(PictureRequest request) {
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->waiting.push_back(std::move(request));
  }
  impl_->wake.notify_all();
}

bool PictureWriter::busy() const {
  const std::lock_guard lock(impl_->mutex);
  return impl_->working || !impl_->waiting.empty();
}

double PictureWriter::fraction() const {
  return impl_->fraction;
}

void PictureWriter::cancel() {
  const std::lock_guard lock(impl_->mutex);
  impl_->waiting.clear();
  impl_->cancelled = true;
}

std::optional<PictureWriter::Outcome> PictureWriter::takeOutcome() {
  const std::lock_guard lock(impl_->mutex);
  if (impl_->outcomes.empty()) return {};
  Outcome outcome = std::move(impl_->outcomes.front());
  impl_->outcomes.pop_front();
  return outcome;
}

}  // namespace lychnite
