import {describe, expect, it} from 'vitest';
import {looseWire, movesOf} from './moving';

describe('blocks that are moved', () => {
  it('stand on the grid', () => expect(movesOf({motor: {x: 101.7, y: -6.1}})).toEqual({motor: [25, -2]}));
  it('draw their wires behind them, level and upright', () => {
    for (const [a, b] of [[[0, 0], [100, 40]], [[0, 0], [-80, 40]], [[0, 0], [100, 0]], [[10, 5], [20, 5]]] as const) {
      const path = looseWire([...a], [...b]);
      expect(path[0]).toEqual(a);
      expect(path[path.length - 1]).toEqual(b);
      for (let i = 1; i < path.length; ++i) expect(path[i][0] === path[i - 1][0] || path[i][1] === path[i - 1][1]).toBe(true);
    }
  });
});
