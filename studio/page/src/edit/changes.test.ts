import {describe, expect, it} from 'vitest';
import {changesOf, differingLines} from './changes';

const before = {
  format: 1, title: 'Stage',
  parameters: {k: {value: 3, unit: 'um/V', free: true}},
  blocks: {a: {type: 'gain', gain: '$k', in: 'u'}, gone: {type: 'constant', value: '1 V'}, c: {choose: 'none', from: {none: {type: 'bypass'}, pi: {type: 'pid', kp: 1}}, in: 'a'}},
  record: ['a'],
};

describe('in what two diagrams differ', () => {
  it('is nothing where only the order is another', () => {
    expect(changesOf(before, {record: before.record, title: before.title, parameters: before.parameters, blocks: {c: before.blocks.c, gone: before.blocks.gone, a: {in: 'u', type: 'gain', gain: '$k'}}})).toEqual([]);
  });
  it('is told place by place', () => {
    const after = {
      ...before, title: 'Stage 2', record: ['a', 'c'],
      parameters: {k: {value: 4, unit: 'um/V', free: true}},
      blocks: {a: {...before.blocks.a, in: 'w'}, c: {...before.blocks.c, choose: 'pi', from: {...before.blocks.c.from, pi: {type: 'pid', kp: 2}}}, lag: {type: 'lag', times: ['1 ms'], in: 'a'}},
    };
    expect(changesOf(before, after).map((c) => [c.kind, c.section, c.name, c.member, c.before, c.after])).toEqual([
      ['changed', 'title', '', '', 'Stage', 'Stage 2'],
      ['changed', 'parameters', 'k', '', '3 um/V', '4 um/V'],
      ['changed', 'blocks', 'a', 'in', 'u', 'w'],
      ['removed', 'blocks', 'gone', '', '{"type": "constant", "value": "1 V"}', ''],
      ['changed', 'blocks', 'c', 'choose', 'none', 'pi'],
      ['changed', 'blocks', 'c', 'from › pi › kp', '1', '2'],
      ['added', 'blocks', 'lag', '', '', '{"type": "lag", "times": ["1 ms"], "in": "a"}'],
      ['changed', 'record', '', '', '["a"]', '["a", "c"]'],
    ]);
  });
});

it('of two texts the lines are told in which they differ', () => {
  expect(differingLines('a\nb\nc', 'a\nx\ny\nc')).toEqual(['b', 'x\ny']);
  expect(differingLines('a\nb', 'a\nb')).toEqual(['', '']);
  expect(differingLines('a\na', 'a\na\na')).toEqual(['', 'a']);
});
