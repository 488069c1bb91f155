#include "blocks/continuous/tank.h"

#include <fmt/format.h>

namespace hysteron::blocks {

void Tank::describe(BlockSpec<Tank>& spec) {
  spec.name("tank", "level in a tank with an outlet and a brim").in_group("continuous");
  spec.law(
          "area dh/dt = inflow - outflow; linear: outflow = outlet h/reference; square_root: outflow = outlet "
          "sqrt(h/reference); power: outflow = outlet (h/reference)^exponent; at the brim the surplus is spilled, below 0 the level does not go")
      .from("Torricelli's law; Johansson, IEEE Trans. Control Syst. Technol. 8 (2000) 456-465");
  spec.remark("outlet is the flow that leaves at the level \"reference\": any level at which it was measured.");
  spec.remark("Spilled water is missing afterwards, unlike with a saturated sensor.");
  spec.variation("square_root_outflow", "tank", {{"law", "linear"}}).variation("overflow", "tank", {{"brim", "0"}});
  spec.input(&In<double>::inflow, "inflow", "$b", "what flows in; negative = a pump takes out");
  spec.state(&State<double>::level, "level", "$a", "level");
  spec.state(&State<double>::spilled, "spilled", "$b*s", "what has run over the brim");
  spec.output(&Out<double>::level, "level", "$a", "level");
  spec.output(&Out<double>::outflow, "outflow", "$b", "what leaves through the outlet");
  spec.output(&Out<double>::spilled, "spilled", "$b*s", "what has run over the brim since the start");
  spec.param(&Params<double>::area, "area", "$b*s/$a", "area of the surface").positive();
  spec.param(&Params<double>::outlet, "outlet", "$b", "outflow at the reference level").optional("0").not_negative();
  spec.param(&Params<double>::reference, "reference", "$a", "level for which outlet holds").positive();
  spec.text("law", {"linear", "square_root", "power"}, "outflow grows with the level, its root, or a power of it");
  spec.param(&Params<double>::exponent, "exponent", "1", "of law power: 1/2 an orifice, 1 a long narrow pipe")
      .optional("1")
      .positive();
  spec.param(&Params<double>::brim, "brim", "$a", "level at which it runs over; 0 = never")
      .optional("0")
      .not_negative();
  spec.param(&Params<double>::initial, "initial", "$a", "level at the start").optional("0").not_negative();
}

std::string Tank::check(const Params<double>& p) {
  if (p.brim > 0 && p.initial > p.brim)
    return "the level at the start, {initial}, is above the brim, {brim}; give at most the brim";
  return "";
}

Kernel tank_block() { return kernel<Tank>(); }

}  // namespace hysteron::blocks
