import {expect, test} from 'vitest';
import {csvOf, isEachRow} from './csv';

const head = {rows: 3, from: 0, to: 2, columns: [{name: 't', unit: 's'}, {name: 'a', unit: 'V'}, {name: 'share, of b', unit: ''}]};
const of = (...values: number[]) => ({low: Float64Array.from(values), high: Float64Array.from(values)});
const stretch = {x: Float64Array.from([0, 1, 2]), columns: [{name: 'a', ...of(0.1, -2, 1e-9)}, {name: 'share, of b', ...of(1, NaN, 3)}]};

test('rows are written with names and units, every digit, and nothing where there is no number', () => {
  expect(csvOf(head, stretch, null)).toBe('t [s],a [V],"share, of b"\n0,0.1,1\n1,-2,\n2,1e-9,3\n');
});

test('of what is zoomed in the rows beyond its ends are not written', () => {
  expect(csvOf(head, stretch, [0.5, 1.5])).toBe('t [s],a [V],"share, of b"\n1,-2,\n');
});

test('smallest and largest values of several rows are no row', () => {
  expect(isEachRow(stretch)).toBe(true);
  expect(isEachRow({x: Float64Array.from([0]), columns: [{name: 'a', low: Float64Array.from([0]), high: Float64Array.from([1])}]})).toBe(false);
});
