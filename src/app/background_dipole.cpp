#include "app/refiner.h"
#include "lychnite/app/background.h"
#include "lychnite/reference/reference.h"

namespace lychnite {

using DipoleRefiner = Refiner<std::shared_ptr<const Image>>;

struct BackgroundDipole::Impl {
  int threads;
  DipoleRefiner refiner;
};

BackgroundDipole::BackgroundDipole(int threads, bool yields)
    : impl_(new Impl{backgroundThreads(threads),
                     {[](const RefinerJob& job, const DipoleRefiner::Ticket& ticket) {
                        const Progress progress([&](const Progress::Update&) { return ticket.valid(); });
                        ticket.publish(std::make_shared<const Image>(
                            renderReference(job.scene, job.settings, progress)));
                      },
                      yields ? 19 : 0}}) {}
BackgroundDipole::~BackgroundDipole() = default;

void BackgroundDipole::want(const Scene& scene, const RenderSettings& settings) {
  RenderSettings own = settings;
  own.method = Method::kDipole;
  own.aovs.clear();
  own.threads = impl_->threads;
  impl_->refiner.want(makeJob(scene, own));
}

void BackgroundDipole::stop() {
  impl_->refiner.stop();
}

std::shared_ptr<const Image> BackgroundDipole::newest() const {
  return impl_->refiner.newest().value_or(nullptr);
}

std::string BackgroundDipole::problem() const {
  return impl_->refiner.problem();
}

}  // namespace lychnite
