#include "gpu/timer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cassert>

#include "gpu/context_state.h"

namespace lychnite::gpu {
namespace {

uint32_t createQuery() {
  GLuint id = 0;
  glCreateQueries(GL_TIME_ELAPSED, 1, &id);
  return id;
}

void deleteQuery(uint32_t id) {
  glDeleteQueries(1, &id);
}

double readMs(uint32_t query) {
  GLuint64 nanoseconds = 0;
  glGetQueryObjectui64v(query, GL_QUERY_RESULT, &nanoseconds);
  return static_cast<double>(nanoseconds) * 1e-6;
}

}  // namespace

GpuTimer::Query::Query(const std::string& label) : Object(createQuery(), GL_QUERY, deleteQuery, label) {}

GpuTimer::GpuTimer(const std::string& label)
    : ring_{Query(label), Query(label), Query(label), Query(label)} {}

double GpuTimer::read(const Query& query) const {
  // llvmpipe's first query after a context is made reports the time since the machine was booted; no device
  // can have been busy for longer than has passed.
  const std::chrono::duration<double, std::milli> passed = Clock::now() - query.begun;
  return std::min(readMs(query.id()), passed.count());
}

void GpuTimer::begin() {
  Query& query = ring_[next_];
  assert(!query.state().timerRunning && "one timer at a time");
  if (query.ended) newestMs_ = read(query);
  query.ended = false;
  query.state().timerRunning = true;
  query.begun = Clock::now();
  glBeginQuery(GL_TIME_ELAPSED, query.id());
}

void GpuTimer::end() {
  Query& query = ring_[next_];
  assert(query.state().timerRunning);
  glEndQuery(GL_TIME_ELAPSED);
  query.state().timerRunning = false;
  query.ended = true;
  next_ = (next_ + 1) % kRing;
}

void GpuTimer::collect(bool wait) {
  for (int i = 0; i < kRing; ++i) {
    Query& query = ring_[(next_ + i) % kRing];
    if (!query.ended) continue;
    GLuint done = GL_TRUE;
    if (!wait) glGetQueryObjectuiv(query.id(), GL_QUERY_RESULT_AVAILABLE, &done);
    if (!done) return;
    newestMs_ = read(query);
    query.ended = false;
  }
}

std::optional<double> GpuTimer::poll() {
  collect(false);
  return newestMs_;
}

double GpuTimer::wait() {
  collect(true);
  return newestMs_.value_or(0.0);
}

}  // namespace lychnite::gpu
