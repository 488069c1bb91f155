// Decides what the blocks of this room are in C: the operations of their models, one by one. Does not write files
// (export/).
#include <vector>

#include "blocks/hysteresis/path_in_c.h"
#include "blocks/hysteresis/plays_in_c.h"
#include "engine/block/c_law.h"
#include "models/compensators/prandtl_ishlinskii_inverse.h"

namespace hysteron::blocks {

CLaw prandtl_ishlinskii_inverse_c() {
  return {"prandtl_ishlinskii_inverse", [](const CBlock& b) {
            CCode c;
            const bool one = b.choice("sides") == 0;
            const auto weights = b.list("weights");
            std::vector<double> reached(weights.size()), own;
            prandtl_ishlinskii::inverse_thresholds(b.list("thresholds"), weights, reached.data());
            double slope = 0, compliance = 0;  // as prandtl_ishlinskii::inverse_output goes through them
            for (const double weight : weights) {
              slope += weight;
              own.push_back(1 / slope - compliance);
              compliance = 1 / slope;
            }
            c.tables = {{"thresholds", "thresholds of the inverse, in the unit of its input", reached},
                        {"weights", "weights of the inverse", own}};
            c.functions = plays_in_c::functions(one);
            c.output = plays_in_c::move(one) +
                       "($x, $t.thresholds, $n.thresholds, $in.y);\n"
                       "$out.u = weighted_sum($t.weights, $x, $n.thresholds);";
            c.is_monotone = true;  // as the law that it undoes, which has to rise
            return c;
          }};
}

CLaw bouc_wen_inverse_c() { return {"bouc_wen_inverse", nullptr, "sampled_bouc_wen_inverse"}; }
CLaw sampled_bouc_wen_inverse_c() {
  return {"sampled_bouc_wen_inverse", [](const CBlock&) {
            CCode c;
            c.functions = {c_functions::larger, c_functions::smaller, path_in_c::follow, R"(struct bouc_wen_way {
    double alpha, beta, gamma, d_p, exponent, scale, move;
};

/* Slope of the hysteretic part z along a straight move of the wanted displacement; not a number where no command exists. */
static double bouc_wen_slope(const void *way, double s, double z)
{
    const struct bouc_wen_way *p = way;
    const double direction = p->move < 0.0 ? -1.0 : 1.0;
    double bend = p->beta * direction * z + p->gamma * fabs(z), slope, v;
    (void)s;
    if (p->exponent != 1.0)
        bend = bend * pow(fabs(z) / p->scale + ${DBL_MIN|FLT_MIN}, p->exponent - 1.0);
    slope = p->d_p - p->alpha + bend;
    v = slope * p->d_p > 0.0 ? p->move / slope : NAN;
    bend = p->beta * fabs(v) * z + p->gamma * v * fabs(z);
    if (p->exponent != 1.0)
        bend = bend * pow(fabs(z) / p->scale + ${DBL_MIN|FLT_MIN}, p->exponent - 1.0);
    return p->alpha * v - bend;
}
)"};
            c.output =
                "const struct bouc_wen_way way = {$p.alpha, $p.beta, $p.gamma, $p.d_p, $p.exponent, $p.scale, $in.y - "
                "$s.y};\n$s.z = follow_path(bouc_wen_slope, &way, $s.z);\n$s.y = $in.y;\n"
                "$out.u = ($in.y + $p.origin + $s.z) / $p.d_p;";
            return c;
          }};
}

}  // namespace hysteron::blocks
