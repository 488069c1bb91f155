import {describe, expect, it} from 'vitest';
import type {BlockDeclaration, Edit, Item} from '../types';
import * as doc from './document';

const item = (name: string, ins: [string, string][], outs: string[] = ['y'], type = 'gain'): Item =>
  ({name, path: name, type, in: ins.map(([n, reads]) => ({name: n, reads, x: 0, y: 0, side: 'left'})), out: outs.map((n) => ({name: n, x: 0, y: 0, unit: '', length: 1}))}) as unknown as Item;

/// What the edits make of a document: an independent, plain carrying out.
function carriedOut(document: any, edits: Edit[]): any {
  const result = structuredClone(document);
  for (const e of edits) {
    const keys = e.pointer.split('/').slice(1).map((k) => k.replace(/~1/g, '/').replace(/~0/g, '~'));
    const last = keys.pop();
    const parent = keys.reduce((v, k) => v[k], result);
    if (e.kind === 'replace') parent[last!] = JSON.parse(e.value);
    else if (e.kind === 'remove') Array.isArray(parent) ? parent.splice(Number(last), 1) : delete parent[last!];
    else if (e.kind === 'rename') {
      parent[e.key] = parent[last!];
      delete parent[last!];
    } else {
      const into = last === undefined ? result : parent[last];
      Array.isArray(into) ? into.push(JSON.parse(e.value)) : (into[e.key!] = JSON.parse(e.value));
    }
  }
  return result;
}

describe('values', () => {
  it('are written as they were meant', () => {
    expect(doc.typedValue('3')).toBe(3);
    expect(doc.typedValue(' -1.5e-3 ')).toBe(-0.0015);
    expect(doc.typedValue('5 Hz')).toBe('5 Hz');
    expect(doc.typedValue('$kp')).toBe('$kp');
    expect(doc.typedValue('["1 ms", 2]')).toEqual(['1 ms', 2]);
    expect(doc.typedValue('[1,')).toBe('[1,');
    expect(doc.typedValue('+-')).toBe('+-');
  });
  it('are shown with their unit and come back the same', () => {
    expect(doc.shownValue({value: 3, unit: 'um'})).toBe('3 um');
    expect(doc.shownValue('5 Hz')).toBe('5 Hz');
    expect(doc.shownValue([1, '2 ms'])).toBe('[1, "2 ms"]');
    for (const v of [3, '5 Hz', [1, '2 ms'], {value: [1, 2], unit: 'V'}]) expect(doc.typedValue(doc.shownValue(v))).toEqual(v);
  });
});

describe('wires', () => {
  it('of one port are a text, of several in order a list', () => {
    expect(doc.inWith(undefined, item('k', [['u', '']]), 0, 'drive')).toBe('drive');
    expect(doc.inWith('a', item('s', [['a', 'a'], ['b', '']]), 1, 'x.y')).toEqual(['a', 'x.y']);
  });
  it('are named where one before is open', () => {
    expect(doc.inWith(undefined, item('s', [['above', ''], ['control', '']]), 1, 'c')).toEqual({control: 'c'});
    expect(doc.inWith({control: 'c'}, item('s', [['above', ''], ['control', 'c']]), 0, 'a')).toEqual({above: 'a', control: 'c'});
  });
  it('are added to a port that takes any number', () => {
    expect(doc.inAppended('a', item('s', [['in', 'a']]), 'b')).toEqual(['a', 'b']);
    expect(doc.inAppended({in: ['a', 'b']}, item('s', [['in', 'a'], ['in', 'b']]), 'c')).toEqual({in: ['a', 'b', 'c']});
  });
  it('go, and what is left stays', () => {
    expect(doc.inWithout('a', item('k', [['u', 'a']]), 0)).toBeUndefined();
    expect(doc.inWithout(['a', 'b'], item('s', [['above', 'a'], ['below', 'b']]), 0)).toEqual({below: 'b'});
  });
});

const loop = {
  blocks: {
    drive: {type: 'sine'},
    stage: {type: 'lag', in: 'drive'},
    stage_2: {type: 'gain', in: {u: 'stage.y'}},
    sum: {type: 'sum', in: ['stage[0]', 'drive']},
  },
  outputs: {y: 'stage'},
  record: ['drive', 'stage/inner', 'stage_2'],
};

describe('blocks', () => {
  it('are renamed with every wire that reads them, and no other', () => {
    expect(carriedOut(loop, doc.renameBlock(loop, 'stage', 'axis'))).toEqual({
      blocks: {drive: {type: 'sine'}, axis: {type: 'lag', in: 'drive'}, stage_2: {type: 'gain', in: {u: 'axis.y'}}, sum: {type: 'sum', in: ['axis[0]', 'drive']}},
      outputs: {y: 'axis'},
      record: ['drive', 'axis/inner', 'stage_2'],
    });
  });
  it('are removed with their names in record and outputs, and wires that read them', () => {
    const items = [item('drive', []), item('stage', [['u', 'drive']]), item('stage_2', [['u', 'stage.y']]), item('sum', [['in', 'stage[0]'], ['in', 'drive']])];
    expect(carriedOut(loop, doc.removeBlocks(loop, ['stage'], items))).toEqual({
      blocks: {drive: {type: 'sine'}, stage_2: {type: 'gain'}, sum: {type: 'sum', in: {in: 'drive'}}},
      outputs: {},
      record: ['drive', 'stage_2'],
    });
  });
  it('get names that are free', () => {
    expect(doc.freeName(loop, 'gain')).toBe('gain');
    expect(doc.freeName(loop, 'stage')).toBe('stage_3');
  });
  it('are pasted beside themselves, wires among them follow', () => {
    const found = doc.pasted(loop, doc.copied(loop, ['stage', 'sum']))!;
    const after = carriedOut(loop, found.edits);
    expect(found.names).toEqual(['stage_3', 'sum_2']);
    expect(after.blocks.stage_3).toEqual({type: 'lag', in: 'drive'});
    expect(after.blocks.sum_2).toEqual({type: 'sum', in: ['stage_3[0]', 'drive']});
  });
  it('that are none are not pasted', () => {
    for (const text of ['hello', '3', '[1]', '{"a": 1}', '{"a": {"x": 1}}']) expect(doc.pasted(loop, text)).toBeNull();
  });
  it('get what their type cannot do without', () => {
    const parameters = [
      {name: 'gain', unit: '$b/$a', kind: 'number', default: null, choices: []},
      {name: 'lower', unit: 'V', kind: 'number', default: null, choices: []},
      {name: 'times', unit: 's', kind: 'list', default: null, choices: []},
      {name: 'is', unit: '', kind: 'text', default: 'less', choices: ['less']},
    ];
    expect(doc.newBlock({type: 't', parameters} as unknown as BlockDeclaration)).toEqual({type: 't', gain: 1, lower: '1 V', times: ['1 s']});
  });
});

describe('what enables a nested diagram', () => {
  const document = {blocks: {on: {type: 'step'}, a: {type: 'diagram', file: 'x.json', in: 'on', enable: {in: 'on', states: 'reset'}, trigger: 'on'}}};
  const nested = item('a', [['u', 'on'], ['enable', 'on'], ['trigger', 'on']], ['y'], 'diagram');
  it('is no input of it', () => {
    expect(doc.withoutSwitches(nested, document.blocks.a).in.map((p) => p.name)).toEqual(['u']);
  });
  it('follows another name, and goes with its block', () => {
    expect(carriedOut(document, doc.renameBlock(document, 'on', 'off')).blocks.a).toEqual({...document.blocks.a, in: 'off', enable: {in: 'off', states: 'reset'}, trigger: 'off'});
    expect(carriedOut(document, doc.removeBlocks(document, ['on'], [item('on', []), nested])).blocks).toEqual({a: {type: 'diagram', file: 'x.json'}});
  });
});

describe('changes between documents', () => {
  it('make the one of the other', () => {
    const after = structuredClone(loop) as any;
    after.blocks.stage = {type: 'lag', times: ['1 ms'], in: 'creep'};
    after.blocks.creep = {choose: 'on', in: 'drive'};
    delete after.blocks.stage_2;
    expect(carriedOut(loop, doc.changesBetween(loop, after))).toEqual(after);
  });
  it('leave names of files alone: they are relative to where a diagram lies', () => {
    expect(doc.changesBetween({$schema: 'a', blocks: {d: {file: 'x.json'}}}, {$schema: '../a', blocks: {d: {file: '../x.json'}}})).toEqual([]);
  });
});

describe('a list with its unit', () => {
  it('is shown as one writes it, and read back as the same value', () => {
    const value = {value: [0, 0.6, 5.4], unit: 'V'};
    expect(doc.shownValue(value)).toBe('[0, 0.6, 5.4] V');
    expect(doc.typedValue('[0, 0.6, 5.4] V')).toEqual(value);
    expect(doc.typedValue('["1 ms", "3 ms"]')).toEqual(['1 ms', '3 ms']);
    expect(doc.typedValue('[[1, 2], [3, 4]]')).toEqual([[1, 2], [3, 4]]);
    expect(doc.typedValue('[[1, 2], [3, 4]] N/m')).toEqual({value: [[1, 2], [3, 4]], unit: 'N/m'});
    expect(doc.typedValue('[1, 2')).toBe('[1, 2');
  });
  it('stays JSON where more is told of it', () => {
    expect(doc.shownValue({value: [1, 2], unit: 'V', free: true})).toBe('{"value": [1, 2], "unit": "V", "free": true}');
  });
});
