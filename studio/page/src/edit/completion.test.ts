import {describe, expect, it} from 'vitest';
import type {BlockDeclaration} from '../types';
import {offersAt, signalsOf} from './completion';

const parameter = (name: string, more = {}) => ({name, unit: '', meaning: `the ${name}`, kind: 'number' as const, default: null, choices: [], minimum: null, exclusive_minimum: false, maximum: null, linear: false, ...more});
const port = (name: string) => ({name, unit: '', meaning: '', any_number: false, vector: false});
const declaration = (type: string, parameters: any[], outputs = ['out']): BlockDeclaration =>
  ({type, summary: `a ${type}`, group: '', law: '', source: '', remarks: [], inputs: [], outputs: outputs.map(port), parameters});
const blocks = [declaration('gain', [parameter('gain', {unit: 'um/V'})]), declaration('motor', [parameter('inertia')], ['angle', 'speed']),
                declaration('pid', [parameter('derivative_on', {kind: 'text', choices: ['error', 'measurement']}), parameter('filter', {default: '1 ms'})])];
const document = {inputs: {u: {}}, blocks: {a: {type: 'gain'}, m: {type: 'motor'}, c: {choose: 'x', from: {x: {type: 'pid'}}}}};
const labels = (path: string[], isKey: boolean, members = {}) => offersAt({path, isKey, members}, document, blocks).map((o) => o.label);

describe('what is offered while one types', () => {
  it('are keys that are not there yet', () => {
    expect(labels([], true, {format: 1, blocks: {}})).not.toContain('blocks');
    expect(labels([], true, {format: 1})).toContain('simulate');
    expect(labels(['blocks', 'a'], true, {type: 'gain', in: 'u'})).toEqual(['gain']);
    expect(labels(['blocks', 'c', 'from', 'x'], true, {type: 'pid'})).toEqual(['in', 'derivative_on', 'filter']);
    expect(labels(['blocks'], true)).toEqual([]);
  });
  it('are types, candidates, words of a parameter', () => {
    expect(labels(['blocks', 'a', 'type'], false)).toEqual(['gain', 'motor', 'pid']);
    expect(labels(['blocks', 'c', 'choose'], false, document.blocks.c)).toEqual(['x']);
    expect(labels(['blocks', 'c', 'from', 'x', 'derivative_on'], false, {type: 'pid'})).toEqual(['error', 'measurement']);
  });
  it('are signals where one is read', () => {
    expect(signalsOf(document, blocks)).toEqual(['u', 'a', 'm.angle', 'm.speed', 'c']);
    for (const path of [['blocks', 'a', 'in'], ['blocks', 'c', 'in', '0'], ['outputs', 'y'], ['record', '1']]) expect(labels(path, false)).toContain('m.speed');
    expect(labels(['blocks', 'a', 'gain'], false, {type: 'gain'})).toEqual([]);
  });
  it('write what they stand for', () => {
    expect(offersAt({path: ['blocks', 'c', 'from', 'x'], isKey: true, members: {type: 'pid'}}, document, blocks).map((o) => o.apply)).toEqual(['"in": ""', '"derivative_on": ""', '"filter": "1 ms"']);
  });
});
