// Decides how smallest and largest values become one line. Apart, since it needs no browser.

/// Each pixel as two points, smallest and largest, where they differ.
export function zigzag(x: Float64Array, low: Float64Array, high: Float64Array): [number[], number[]] {
  const xs: number[] = [];
  const ys: number[] = [];
  for (let i = 0; i < x.length; ++i) {
    if (low[i] === high[i]) {
      xs.push(x[i]);
      ys.push(low[i]);
      continue;
    }
    const rises = i === 0 || Math.abs(low[i] - ys[ys.length - 1]) <= Math.abs(high[i] - ys[ys.length - 1]);
    xs.push(x[i], x[i]);
    ys.push(rises ? low[i] : high[i], rises ? high[i] : low[i]);
  }
  return [xs, ys];
}
