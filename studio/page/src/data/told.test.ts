import {expect, test} from 'vitest';
import {toldOf, viewOf, type Told} from './told';

const item = (name: string, caption: string) => ({name, caption: [caption]}) as any;
const first: Told = {id: 's/1', view: {lines: ['{"a": 1,', '"b": 2}', ''], hash: 'x', problems: [], warnings: [], places: {}, sheet: {width: 1, height: 1, items: [item('a', '1'), item('b', '2')], wires: [], dots: []}}};

test('a view that is told whole is taken as it is, its lines as a text', () => {
  expect(toldOf(null, first)).toBe(first);
  expect(viewOf(first).text).toBe('{"a": 1,\n"b": 2}\n');
  expect('lines' in viewOf(first)).toBe(false);
});

test('of a difference only what differs is new', () => {
  const next = toldOf(first, {id: 's/2', of: 's/1', patch: [{op: 'replace', path: '/lines/1', value: '"b": 3}'}, {op: 'replace', path: '/sheet/items/1/caption/0', value: '3'}]});
  expect(viewOf(next).text).toBe('{"a": 1,\n"b": 3}\n');
  expect(next.view.sheet!.items[1]).toEqual(item('b', '3'));
  expect(next.view.sheet!.items[0]).toBe(first.view.sheet!.items[0]);
  expect(next.view.sheet!.wires).toBe(first.view.sheet!.wires);
  expect(first.view.sheet!.items[1]).toEqual(item('b', '2'));
  const same = toldOf(next, {id: 's/3', of: 's/2', patch: []});
  expect(same.view.sheet).toBe(next.view.sheet);
});

test('blocks come and go at the end of the list', () => {
  const more = toldOf(first, {id: 's/2', of: 's/1', patch: [{op: 'add', path: '/sheet/items/-', value: item('c', '3')}]});
  expect(more.view.sheet!.items.map((i) => i.name)).toEqual(['a', 'b', 'c']);
  const less = toldOf(more, {id: 's/3', of: 's/2', patch: [{op: 'remove', path: '/sheet/items/2'}, {op: 'remove', path: '/sheet/items/1'}]});
  expect(less.view.sheet!.items.map((i) => i.name)).toEqual(['a']);
});

test('a difference from another view is refused', () => {
  expect(() => toldOf(null, {id: 's/2', of: 's/1', patch: []})).toThrow('reload');
  expect(() => toldOf(first, {id: 's/3', of: 's/2', patch: []})).toThrow('reload');
});
