#include "engine/diagram/stop.h"

#include <utility>

namespace hysteron {
namespace {

thread_local const StopScope::Asked* asked_here = nullptr;

}  // namespace

StopScope::StopScope(Asked asked)
    : own_(std::move(asked)), before_(std::exchange(asked_here, own_ ? &own_ : nullptr)) {}
StopScope::StopScope(const Asked* asked) : before_(std::exchange(asked_here, asked)) {}
StopScope::~StopScope() { asked_here = before_; }

const StopScope::Asked* current_stop() { return asked_here; }

bool stop_asked() { return asked_here != nullptr && (*asked_here)(); }

void look_up() {
  if (stop_asked()) throw Stopped{};
}

}  // namespace hysteron
