import {describe, expect, it} from 'vitest';
import {alongOf, tubeOf, verdictOf} from './tolerance';

const numbers = (...list: number[]) => new Float64Array(list);

describe('a tolerance tube', () => {
  const x = numbers(0, 1, 2, 3, 4);
  const y = numbers(0, 1, 5, 1, 0);
  it('is so much below and above', () => {
    const tube = tubeOf(x, y, y, numbers(0.5, 0.5, 0.5, 1, 1), 0);
    expect([...tube.low]).toEqual([-0.5, 0.5, 4.5, 0, -1]);
    expect([...tube.high]).toEqual([0.5, 1.5, 5.5, 2, 1]);
  });
  it('reaches over what is near enough in time', () => {
    const tube = tubeOf(x, y, y, numbers(0, 0, 0, 0, 0), 1);
    expect([...tube.low]).toEqual([0, 0, 1, 0, 0]);
    expect([...tube.high]).toEqual([1, 5, 5, 5, 1]);
  });
  it('says what lies outside, and where', () => {
    const y = {first: 'y', unit: 'um', points: 101, outside: 3, furthest_beyond: 0.25, furthest_at: 0.5};
    expect(verdictOf([y, {...y, first: 'u', outside: 0}], 's')).toBe('3 of 101 points of y lie outside, furthest at 0.5 s by 0.25 um');
    expect(verdictOf([{...y, outside: 0}], 's')).toBe('Within the tolerance: y');
    expect(verdictOf([{first: 'y', unit: 'V', points: 3}], 's')).toMatch(/^No signal/);
  });
  it('takes the time from behind the comma', () => {
    expect(alongOf('2 nm + 0.1 %, 0.1 ms')).toBe('0.1 ms');
    expect(alongOf('2 nm')).toBe('');
  });
});
