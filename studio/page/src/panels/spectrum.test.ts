import {describe, expect, it} from 'vitest';
import {evenly, spectrumOf, thinned, transform} from './spectrum';

const times = (n: number, step: number) => Float64Array.from({length: n}, (_, i) => i * step);

describe('spectrum', () => {
  it('transforms as the sum of the definition does', () => {
    const n = 16;
    const re = Float64Array.from({length: n}, (_, i) => Math.cos(i * i) + 0.1 * i);
    const im = Float64Array.from({length: n}, (_, i) => Math.sin(3 * i));
    const [a, b] = [re.slice(), im.slice()];
    transform(a, b);
    for (let k = 0; k < n; ++k) {
      let [x, y] = [0, 0];
      for (let i = 0; i < n; ++i) {
        const phase = (-2 * Math.PI * k * i) / n;
        x += re[i] * Math.cos(phase) - im[i] * Math.sin(phase);
        y += re[i] * Math.sin(phase) + im[i] * Math.cos(phase);
      }
      expect(a[k]).toBeCloseTo(x, 10);  // rounding of 16 terms of size 1
      expect(b[k]).toBeCloseTo(y, 10);
    }
  });

  it('shows a sine as a peak of its amplitude at its frequency, also between two lines, and no mean', () => {
    for (const f of [5, 5.37]) {
      const t = times(2000, 1e-3);
      const {frequency, amplitude} = spectrumOf(t, t.map((s) => 7 + 2 * Math.sin(2 * Math.PI * f * s)));
      const peak = amplitude.indexOf(Math.max(...amplitude));
      expect(Math.abs(frequency[peak] - f)).toBeLessThan(0.13);  // one line of 1/(4 * 2048 * 1 ms) Hz
      expect(amplitude[peak]).toBeGreaterThan(1.97);             // 1 % between lines, and leakage of the image at -f
      expect(amplitude[peak]).toBeLessThan(2.03);
    }
  });

  it('puts uneven rows on an even grid', () => {
    const {step, values} = evenly([0, 1, 3, 4], [0, 1, 3, 4]);
    expect(step).toBeCloseTo(4 / 3, 14);
    values.forEach((v, i) => expect(v).toBeCloseTo((4 / 3) * i, 12));
  });

  it('loses no peak when it is thinned', () => {
    const frequency = Float64Array.from({length: 5000}, (_, i) => i + 1);
    const amplitude = frequency.map((f) => (f === 4321 ? 9 : 1));
    const {x, y} = thinned({frequency, amplitude}, 200);
    expect(x.length).toBeLessThanOrEqual(202);
    expect(x[y.indexOf(9)]).toBe(4321);
  });

  it('of too few rows is empty', () => expect(spectrumOf([0, 1], [1, 2]).frequency.length).toBe(0));
});
