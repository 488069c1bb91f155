import {describe, expect, it} from 'vitest';
import {arrowHead, roundedPath} from '../canvas/paths';
import {lengthText, percent, short} from '../numbers';
import {zigzag} from './zigzag';

const values = (...v: number[]) => Float64Array.from(v);

describe('zigzag', () => {
  it('is the curve itself where a pixel holds one row', () => {
    expect(zigzag(values(0, 1), values(2, 3), values(2, 3))).toEqual([[0, 1], [2, 3]]);
  });
  it('draws smallest and largest value, the nearer one first', () => {
    expect(zigzag(values(0, 1), values(5, 1), values(6, 4))).toEqual([[0, 0, 1, 1], [5, 6, 4, 1]]);
  });
});

describe('numbers', () => {
  it('are short and keep their unit', () => {
    expect(short(0.0612195)).toBe('0.06122');
    expect(short(1234567)).toBe('1.235e6');
    expect(short(0)).toBe('0');
    expect(short(NaN)).toBe('–');
    expect(lengthText(0.000234444, 'um')).toBe('0.2344 nm');
    expect(lengthText(0.0612195, 'um')).toBe('61.22 nm');
    expect(lengthText(2, 'V')).toBe('2 V');
    expect(percent(0.0322)).toBe('3.22 %');
    expect(percent(1e-7)).toBe('< 0.01 %');
  });
});

describe('paths', () => {
  it('round corners as far as the pieces are long', () => {
    expect(roundedPath([[0, 0], [20, 0], [20, 30]])).toBe('M0 0L15 0Q20 0 20 5L20 30');
    expect(roundedPath([[0, 0], [4, 0], [4, 30]])).toBe('M0 0L2 0Q4 0 4 2L4 30');
  });
  it('end in an arrow that points along', () => {
    expect(arrowHead([0, 0], [10, 0], 5)).toBe('10.0,0.0 5.0,2.0 5.0,-2.0');
  });
});
