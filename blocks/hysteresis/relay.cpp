#include "blocks/hysteresis/relay.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void Relay::describe(BlockSpec<Relay>& spec) {
  spec.name("relay", "relay: two output values, switched with hysteresis").in_group("hysteresis").elementwise();
  spec.law("on when u rises to on_at, off when it falls to off_at, unchanged between; y = on_value or off_value")
      .from("Visintin, Differential Models of Hysteresis (1994)");
  spec.remark("The switching instants are located. The output jumps.");
  spec.remark("Between the levels the relay keeps its state; \"initial\" is its state before the start.");
  spec.input(&In<double>::u, "u", "$a", "the signal that switches the relay");
  spec.output(&Out<double>::y, "y", "$b", "on_value or off_value");
  spec.param(&Params<double>::on_at, "on_at", "$a", "rising input switches on at this level");
  spec.param(&Params<double>::off_at, "off_at", "$a", "falling input switches off at this level; below on_at");
  spec.param(&Params<double>::on_value, "on_value", "$b", "output when on").linear();
  spec.param(&Params<double>::off_value, "off_value", "$b", "output when off").linear();
  spec.text("initial", {"off", "on"}, "state before the start");
}

std::string Relay::check(const Params<double>& p) {
  if (p.off_at < p.on_at) return "";
  return "off_at, {off_at}, is not below on_at, {on_at}; without a distance between them the relay chatters";
}

Kernel relay_block() { return kernel<Relay>(); }

}  // namespace hysteron::blocks
