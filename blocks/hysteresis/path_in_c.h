// Decides the C function by which a rate-independent law follows a straight move of its input: models/path.h, operation
// by operation. Does not know the law: its slope is handed in.
#pragma once

namespace hysteron::blocks::path_in_c {

inline constexpr char follow[] =
    R"(/* x at s = 1 for dx/ds = slope(law, s, x), x(0) = start: Runge-Kutta 5(4) after Cash and Karp with controlled error. Not a
   number where the law has no solution on this way. */
static double follow_path(double (*slope)(const void *law, double s, double x), const void *law, double start)
{
    const double relative = ${1e-10|1e-5f}, shortest = ${1e-13|1e-6f};
    double x = start, s = 0.0, h = 1.0;
    int step;
    for (step = 0; step < 20000; ++step) {
        double k1, k2, k3, k4, k5, k6, to, error, steepest, admitted, factor;
        int counts;
        h = smaller(h, 1.0 - s);
        k1 = slope(law, s, x);
        k2 = slope(law, s + h / 5.0, x + h * (1.0 / 5.0 * k1));
        k3 = slope(law, s + h * 3.0 / 10.0, x + h * (3.0 / 40.0 * k1 + 9.0 / 40.0 * k2));
        k4 = slope(law, s + h * 3.0 / 5.0, x + h * (3.0 / 10.0 * k1 - 9.0 / 10.0 * k2 + 6.0 / 5.0 * k3));
        k5 = slope(law, s + h, x + h * (5.0 / 2.0 * k2 - 11.0 / 54.0 * k1 - 70.0 / 27.0 * k3 + 35.0 / 27.0 * k4));
        k6 = slope(law, s + h * 7.0 / 8.0,
                   x + h * (1631.0 / 55296.0 * k1 + 175.0 / 512.0 * k2 + 575.0 / 13824.0 * k3 +
                            44275.0 / 110592.0 * k4 + 253.0 / 4096.0 * k5));
        to = x + h * (37.0 / 378.0 * k1 + 250.0 / 621.0 * k3 + 125.0 / 594.0 * k4 + 512.0 / 1771.0 * k6);
        error = fabs((37.0 / 378.0 - 2825.0 / 27648.0) * k1 + (250.0 / 621.0 - 18575.0 / 48384.0) * k3 +
                     (125.0 / 594.0 - 13525.0 / 55296.0) * k4 - 277.0 / 14336.0 * k5 +
                     (512.0 / 1771.0 - 1.0 / 4.0) * k6);
        steepest = larger(larger(larger(larger(fabs(k1), fabs(k3)), fabs(k4)), fabs(k5)), fabs(k6));
        admitted = relative * steepest + 4.0 * ${DBL_EPSILON|FLT_EPSILON} * fabs(to) / h;
        counts = isfinite(error) && isfinite(to);
        if (counts && (error <= admitted || h <= shortest)) {
            if (h >= 1.0 - s)
                return to;
            s += h;
            x = to;
        } else if (h <= shortest) {
            break;
        }
        factor = !counts ? 0.1 : error > 0.0 ? 0.9 * pow(admitted / error, 0.2) : 5.0;
        h *= factor < 0.1 ? 0.1 : 5.0 < factor ? 5.0 : factor;
    }
    return NAN;
}
)";

}  // namespace hysteron::blocks::path_in_c
