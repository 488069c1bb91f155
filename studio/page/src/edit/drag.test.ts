import {describe, expect, it} from 'vitest';
import {dragged, numberParts, stepOf} from './drag';

describe('a number that is dragged', () => {
  it('is a number with or without a unit, and nothing else', () => {
    expect(numberParts('3.2 um/V')).toEqual({value: 3.2, unit: 'um/V'});
    expect(numberParts('-1e-3')).toEqual({value: -0.001, unit: ''});
    expect(numberParts('20 N m')).toEqual({value: 20, unit: 'N m'});
    for (const text of ['', '$kp', 'triangle', '[1, 2]', '5Hz', '1 + 2']) expect(numberParts(text)).toBeNull();
  });
  it('moves by a hundredth of its power of ten per pixel', () => {
    expect(stepOf(250, false)).toBe(1);
    expect(stepOf(250, true)).toBeCloseTo(0.1, 12);
    expect(stepOf(0, false)).toBe(0.01);
    expect(dragged('3.2 um/V', 10, false, false)).toBe('3.3 um/V');
    expect(dragged('3.2 um/V', -1, true, false)).toBe('3.199 um/V');
    expect(dragged('0.00152', 3, false, false)).toBe('0.00155');
    expect(dragged('5 Hz', 0, false, false)).toBe('5 Hz');
  });
  it('writes no digits that come of adding', () => {
    for (let k = -50; k < 50; ++k) expect(dragged('0.1 s', k, false, false)).toMatch(/^-?[\d.]{1,7} s$/);
  });
  it('stops before zero where the sign must stay', () => {
    expect(dragged('2 V', -500, false, true)).toBe('0.01 V');
    expect(dragged('2 V', -300, false, false)).toBe('-1 V');
    expect(dragged('-2 V', 500, false, true)).toBe('-0.01 V');
  });
  it('leaves what is no number as it is', () => expect(dragged('$kp', 5, false, false)).toBe('$kp'));
});
