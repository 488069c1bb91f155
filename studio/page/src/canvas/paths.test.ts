import {describe, expect, it} from 'vitest';
import type {Point, Wire} from '../types';
import {ownWays} from './paths';

const wire = (path: Point[], from = 0): Wire => ({from, out: 0, to: 1, in: 0, signal: 's', feedback: false, length: 1, path});

describe('wires of one output', () => {
  it('are drawn once where they go together', () => {
    const straight: Point[] = [[0, 0], [100, 0]];
    const down: Point[] = [[0, 0], [40, 0], [40, 50], [100, 50]];
    expect(ownWays([wire(straight), wire(down)])).toEqual([straight, [[40, 0], [40, 50], [100, 50]]]);
    expect(ownWays([wire(down), wire(straight)])).toEqual([down, [[40, 0], [100, 0]]]);
  });

  it('leave the one with which they go furthest', () => {
    const short: Point[] = [[0, 0], [20, 0], [20, -30]];
    const long: Point[] = [[0, 0], [40, 0], [40, 50], [100, 50]];
    const third: Point[] = [[0, 0], [40, 0], [40, 80], [100, 80]];
    expect(ownWays([wire(short), wire(long), wire(third)])[2]).toEqual([[40, 50], [40, 80], [100, 80]]);
  });

  it('of other outputs keep all of their way', () => {
    const path: Point[] = [[0, 0], [100, 0]];
    expect(ownWays([wire(path, 0), wire(path, 1)])).toEqual([path, path]);
  });

  it('never lose their last piece, at which the arrow stands', () => {
    const path: Point[] = [[0, 0], [40, 0], [40, 50]];
    for (const own of ownWays([wire(path), wire(path), wire([[0, 0], [40, 0]])])) expect(own.length).toBeGreaterThanOrEqual(2);
  });
});
