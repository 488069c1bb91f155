// Decides how the spectrum of a stretch of rows is made: amplitudes of its sines, with a Hann window. Plain functions.

/// Rows on an even grid between the first and the last time: as they are, or interpolated where steps differ.
export function evenly(times: ArrayLike<number>, values: ArrayLike<number>): {step: number; values: Float64Array} {
  const n = times.length;
  const step = n > 1 ? (times[n - 1] - times[0]) / (n - 1) : 0;
  const even = new Float64Array(n);
  for (let i = 0, k = 0; i < n; ++i) {
    const t = times[0] + i * step;
    if (Math.abs(times[i] - t) <= 1e-6 * step) {
      even[i] = values[i];
      continue;
    }
    while (k + 2 < n && times[k + 1] < t) ++k;
    const span = times[k + 1] - times[k];
    even[i] = span > 0 ? values[k] + ((values[k + 1] - values[k]) * (t - times[k])) / span : values[k];
  }
  return {step, values: even};
}

/// The discrete Fourier transform in place; the length is a power of two (Cooley and Tukey 1965).
export function transform(re: Float64Array, im: Float64Array): void {
  const n = re.length;
  for (let i = 1, j = 0; i < n; ++i) {
    let bit = n >> 1;
    for (; j & bit; bit >>= 1) j ^= bit;
    j ^= bit;
    if (i < j) {
      [re[i], re[j]] = [re[j], re[i]];
      [im[i], im[j]] = [im[j], im[i]];
    }
  }
  for (let size = 2; size <= n; size <<= 1) {
    const half = size >> 1;
    for (let k = 0; k < half; ++k) {
      const [c, s] = [Math.cos((2 * Math.PI * k) / size), -Math.sin((2 * Math.PI * k) / size)];
      for (let a = k; a < n; a += size) {
        const b = a + half;
        const [x, y] = [re[b] * c - im[b] * s, re[b] * s + im[b] * c];
        [re[b], im[b]] = [re[a] - x, im[a] - y];
        [re[a], im[a]] = [re[a] + x, im[a] + y];
      }
    }
  }
}

export interface Spectrum {
  frequency: Float64Array;  // of the unit of 1/time, from the first above 0
  amplitude: Float64Array;  // in the unit of the signal: a sine of amplitude a is a peak of height a
}

/// One-sided amplitudes of what is left without the mean. Hann window: a sine between two lines loses at most 15 %
/// without, and 1 % with the zeros that are put behind (four times the rows at least).
export function spectrumOf(times: ArrayLike<number>, values: ArrayLike<number>): Spectrum {
  const {step, values: even} = evenly(times, values);
  const n = even.length;
  if (n < 4 || !(step > 0)) return {frequency: new Float64Array(0), amplitude: new Float64Array(0)};
  const mean = even.reduce((a, b) => a + b, 0) / n;
  let size = 4;
  while (size < 4 * n) size <<= 1;
  const [re, im] = [new Float64Array(size), new Float64Array(size)];
  let sum = 0;
  for (let i = 0; i < n; ++i) {
    const window = 0.5 - 0.5 * Math.cos((2 * Math.PI * i) / n);
    sum += window;
    re[i] = window * (even[i] - mean);
  }
  transform(re, im);
  const half = size >> 1;
  const frequency = new Float64Array(half - 1);
  const amplitude = new Float64Array(half - 1);
  for (let k = 1; k < half; ++k) {
    frequency[k - 1] = k / (size * step);
    amplitude[k - 1] = (2 * Math.hypot(re[k], im[k])) / sum;
  }
  return {frequency, amplitude};
}

/// A spectrum with at most `most` points for drawing: of neighbours the largest stays, so that no peak gets lost.
export function thinned({frequency, amplitude}: Spectrum, most: number): {x: number[]; y: number[]} {
  const x: number[] = [];
  const y: number[] = [];
  const n = frequency.length;
  if (n === 0) return {x, y};
  const ratio = Math.pow(frequency[n - 1] / frequency[0], 1 / most);
  for (let i = 0; i < n;) {
    const end = frequency[i] * ratio;
    let best = i;
    let j = i + 1;
    for (; j < n && frequency[j] < end; ++j) if (amplitude[j] > amplitude[best]) best = j;
    x.push(frequency[best]);
    y.push(amplitude[best]);
    i = j;
  }
  return {x, y};
}
