#include "volume/interruptible.h"

namespace lychnite::volume {

namespace {
thread_local const Interruptible* current = nullptr;
}  // namespace

Interruptible::Interruptible(const Progress& progress, const Progress::Update& step)
    : progress_(progress), step_(step), outer_(current) {
  progress_.check(step_);
  current = this;
}

Interruptible::~Interruptible() {
  current = outer_;
}

void Interruptible::check() {
  if (current) current->progress_.check(current->step_);
}

}  // namespace lychnite::volume
