#include "blocks/continuous/tank.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void Tank::describe(BlockSpec<Tank>& spec) {
  spec.name("tank", "liquid level in a tank with an outlet and an overflow").in_group("continuous");
  spec.law(
          "area dh/dt = inflow - outflow; linear: outflow = outlet h/reference; square_root: outflow = outlet "
          "sqrt(h/reference); power: outflow = outlet (h/reference)^exponent; 0 <= h <= brim: at the overflow "
          "level (brim) the excess inflow is spilled")
      .from("Torricelli's law; Johansson, IEEE Trans. Control Syst. Technol. 8 (2000) 456-465");
  spec.remark(
      "outlet is the outflow at the level \"reference\", which may be any level at which the outflow was "
      "measured.");
  spec.remark("Spilled liquid is lost, whereas a saturated level sensor loses none.");
  spec.variation("square_root_outflow", "tank", {{"law", "linear"}}).variation("overflow", "tank", {{"brim", "0"}});
  spec.input(&In<double>::inflow, "inflow", "$b", "net inflow; negative = pumped out");
  spec.state(&State<double>::level, "level", "$a", "level");
  spec.state(&State<double>::spilled, "spilled", "$b*s", "spilled volume");
  spec.output(&Out<double>::level, "level", "$a", "level");
  spec.output(&Out<double>::outflow, "outflow", "$b", "flow through the outlet");
  spec.output(&Out<double>::spilled, "spilled", "$b*s", "volume spilled since the start");
  spec.param(&Params<double>::area, "area", "$b*s/$a", "cross-sectional area of the tank").positive();
  spec.param(&Params<double>::outlet, "outlet", "$b", "outflow at the reference level").optional("0").not_negative();
  spec.param(&Params<double>::reference, "reference", "$a", "level at which the outflow is \"outlet\"").positive();
  spec.text("law", {"linear", "square_root", "power"},
            "how the outflow depends on the level: linear, square root, or a power");
  spec.param(&Params<double>::exponent, "exponent", "1",
             "exponent of the law power: 1/2 = orifice, 1 = long narrow pipe (laminar)")
      .optional("1")
      .positive();
  spec.param(&Params<double>::brim, "brim", "$a", "overflow level; 0 = no overflow").optional("0").not_negative();
  spec.param(&Params<double>::initial, "initial", "$a", "initial level").optional("0").not_negative();
}

std::string Tank::check(const Params<double>& p) {
  if (p.brim > 0 && p.initial > p.brim)
    return "the initial level, {initial}, is above the overflow level, {brim}; give at most that level";
  return "";
}

Kernel tank_block() { return kernel<Tank>(); }

}  // namespace hysteron::blocks
