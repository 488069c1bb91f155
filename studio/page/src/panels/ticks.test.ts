import {describe, expect, it} from 'vitest';
import {powerTicks, roundTicks} from './ticks';

describe('ticks', () => {
  it('are round and lie within', () => {
    expect(roundTicks(0, 1, 5)).toEqual([0, 0.2, 0.4, 0.6, 0.8, 1]);
    expect(roundTicks(-0.3, 5.9, 4)).toEqual([0, 2, 4]);
    expect(roundTicks(2, 2, 4)).toEqual([2]);
  });
  it('are powers of ten where there are two at least', () => {
    expect(powerTicks(0.25, 500, 8)).toEqual([1, 10, 100]);
    expect(powerTicks(1e-9, 1, 5)).toEqual([1e-9, 1e-7, 1e-5, 1e-3, 1e-1]);
    expect(powerTicks(2, 5, 3)).toEqual([2, 3, 4, 5]);
  });
});
