// Decides which numbers stand at an axis: multiples of 1, 2 or 5, or powers of ten. Plain functions.

/// About `count` round numbers between low and high.
export function roundTicks(low: number, high: number, count: number): number[] {
  if (!(high > low)) return [low];
  const raw = (high - low) / Math.max(1, count);
  const power = Math.pow(10, Math.floor(Math.log10(raw)));
  const step = power * ([1, 2, 5, 10].find((m) => m * power >= raw) ?? 10);
  const ticks: number[] = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push(Number((k * step).toPrecision(12)));
  return ticks;
}

/// Powers of ten between low and high (both above 0), at most `count` of them; round numbers where no power lies there.
export function powerTicks(low: number, high: number, count: number): number[] {
  const [first, last] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
  if (last - first < 1) return roundTicks(low, high, count);
  const every = Math.ceil((last - first + 1) / count);
  return Array.from({length: Math.floor((last - first) / every) + 1}, (_, i) => Number(`1e${first + i * every}`));
}
