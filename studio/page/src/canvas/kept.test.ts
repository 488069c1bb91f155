import {expect, test} from 'vitest';
import {same, withKept} from './kept';

test('values are the same by what they hold', () => {
  expect(same({a: [1, {b: 'x'}]}, {a: [1, {b: 'x'}]})).toBe(true);
  expect(same({a: [1, {b: 'x'}]}, {a: [1, {b: 'y'}]})).toBe(false);
  expect(same([1, 2], [1])).toBe(false);
  expect(same({a: undefined}, {b: undefined})).toBe(false);
  expect(same([], {})).toBe(false);
  expect(same(null, {})).toBe(false);
  expect(same(NaN, NaN)).toBe(true);
});

test('what holds the same stays the very object, in the new order', () => {
  const [a, b] = [{id: 'a', at: [1, 2]}, {id: 'b', at: [3, 4]}];
  const after = withKept([a, b], [{id: 'b', at: [3, 4]}, {id: 'c', at: [0, 0]}, {id: 'a', at: [1, 5]}]);
  expect(after.map((one) => one.id)).toEqual(['b', 'c', 'a']);
  expect(after[0]).toBe(b);
  expect(after[2]).toEqual({id: 'a', at: [1, 5]});
});

test('where all is the same the list is as well, whatever was measured meanwhile', () => {
  const before: {id: string; at: number; measured?: number}[] = [{id: 'a', at: 1, measured: 7}, {id: 'b', at: 2}];
  expect(withKept(before, [{id: 'a', at: 1}, {id: 'b', at: 2}])).toBe(before);
  expect(withKept(before, [{id: 'a', at: 1}])).toEqual([before[0]]);
});

test('what differs may keep a part of what was', () => {
  const before: {id: string; at: number; measured?: number}[] = [{id: 'a', at: 1, measured: 7}];
  expect(withKept(before, [{id: 'a', at: 2}], (was, now) => ({...now, measured: was.measured}))).toEqual([{id: 'a', at: 2, measured: 7}]);
});
