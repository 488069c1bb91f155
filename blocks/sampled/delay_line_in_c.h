// Decides the C function of a line of past samples (models/sampled/delay_line.h).
#pragma once

namespace hysteron::blocks {

inline constexpr char delay_line_push_in_c[] =
    R"(/* A line of past samples, the oldest first, behind the instant at which u came. */
static void push_sample(double *line, int n, double u)
{
    int i;
    for (i = 0; i + 1 < n; ++i)
        line[i] = line[i + 1];
    line[n - 1] = u;
}
)";

}  // namespace hysteron::blocks
