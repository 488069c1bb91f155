// Decides what a tolerance allows around a curve, and how the verdict is told. Plain functions.

import {withUnit} from '../numbers';

/// What is allowed: between low and high at each x.
export interface Tube {
  x: Float64Array;
  low: Float64Array;
  high: Float64Array;
}

export interface SignalFacts {
  first: string;
  unit: string;
  points: number;
  outside?: number;
  furthest_beyond?: number;
  furthest_at?: number;
}

/// first +- allowed, widened by what may lie beside it in time: the largest and smallest within `along`.
export function tubeOf(x: Float64Array, low: Float64Array, high: Float64Array, allowed: Float64Array, along: number): Tube {
  const n = x.length;
  const tube = {x, low: new Float64Array(n), high: new Float64Array(n)};
  for (let i = 0, first = 0, last = 0; i < n; ++i) {
    while (x[first] < x[i] - along) ++first;
    while (last + 1 < n && x[last + 1] <= x[i] + along) ++last;
    let least = Infinity;
    let most = -Infinity;
    for (let k = first; k <= last; ++k) {
      least = Math.min(least, low[k]);
      most = Math.max(most, high[k]);
    }
    tube.low[i] = least - allowed[i];
    tube.high[i] = most + allowed[i];
  }
  return tube;
}

/// Of "2 nm + 0.1 %, 0.1 ms" the part behind the comma.
export const alongOf = (tolerance: string) => tolerance.split(',')[1]?.trim() ?? '';

/// "12 of 1001 points of y lie outside, furthest at 0.12 s by 3 nm"
export function verdictOf(signals: SignalFacts[], axisUnit: string): string {
  const judged = signals.filter((s) => s.outside !== undefined);
  if (judged.length === 0) return 'No signal has the unit of this tolerance';
  const outside = judged.filter((s) => s.outside! > 0);
  if (outside.length === 0) return `Within the tolerance: ${judged.map((s) => s.first).join(', ')}`;
  return outside.map((s) => `${s.outside} of ${s.points} points of ${s.first} lie outside, furthest at ${withUnit(s.furthest_at!, axisUnit)} by ${withUnit(s.furthest_beyond!, s.unit)}`).join('; ');
}
