import {describe, expect, it} from 'vitest';
import type {Item, Sheet} from '../types';
import {extent} from './extent';

const item = (values: Partial<Item>): Item => ({
  path: 'a', name: 'a', type: 'gain', x: 100, y: 50, width: 60, height: 40, in: [], out: [], caption: [], tip: '',
  symbol: {outline: 'box', picture: '', text: [], fraction: false, note: '', signs: '', port_names: false}, ...values,
});
const sheet = (items: Item[], path: [number, number][] = []): Sheet =>
  ({width: 0, height: 0, items, dots: [], wires: path.length ? [{from: 0, out: 0, to: 0, in: 0, signal: '', feedback: false, length: 1, path}] : []});

describe('what a sheet takes', () => {
  it('holds the captions, also where they are wider than their block', () => {
    const plain = extent(sheet([item({})]));
    expect(plain).toEqual({x: 100, y: 42, width: 60, height: 66});
    const told = extent(sheet([item({caption: ['weights [0.73465, 0.12605 ... 0.1033] um/V (10)']})]));
    expect(told.x).toBeLessThan(100);
    expect(told.x + told.width).toBeGreaterThan(160);
    expect(told.height).toBe(plain.height + 12);
  });

  it('holds the name of a sum, which stands to the right', () => {
    const box = extent(sheet([item({name: 'deviation', width: 20, height: 20, symbol: {...item({}).symbol, outline: 'circle'}})]));
    expect(box.x).toBe(100);
    expect(box.width).toBeGreaterThan(20 + 9 * 6);
  });

  it('holds wires that lead around everything', () => {
    expect(extent(sheet([item({})], [[90, 10], [90, 300]]))).toEqual({x: 90, y: 10, width: 70, height: 290});
  });
});
