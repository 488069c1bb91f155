#include "blocks/hysteresis/relay.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void Relay::describe(BlockSpec<Relay>& spec) {
  spec.name("relay", "two values, switched with hysteresis").in_group("hysteresis").elementwise();
  spec.law("on when u rises to on_at, off when it falls to off_at, unchanged between; y = on_value or off_value")
      .from("Visintin, Differential Models of Hysteresis (1994)");
  spec.remark("The switching instants are located. The output jumps.");
  spec.remark("Between the levels the past decides: \"initial\" says what it was before the start.");
  spec.input(&In<double>::u, "u", "$a", "what switches it");
  spec.output(&Out<double>::y, "y", "$b", "the value in force");
  spec.param(&Params<double>::on_at, "on_at", "$a", "level that switches on, rising");
  spec.param(&Params<double>::off_at, "off_at", "$a", "level that switches off, falling; below on_at");
  spec.param(&Params<double>::on_value, "on_value", "$b", "output when on").linear();
  spec.param(&Params<double>::off_value, "off_value", "$b", "output when off").linear();
  spec.text("initial", {"off", "on"}, "before the start");
}

std::string Relay::check(const Params<double>& p) {
  if (p.off_at < p.on_at) return "";
  return "off_at, {off_at}, is not below on_at, {on_at}; leave a distance, or the relay chatters";
}

Kernel relay_block() { return kernel<Relay>(); }

}  // namespace hysteron::blocks
