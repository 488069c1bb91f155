import {describe, expect, it} from 'vitest';
import type {BlockDeclaration} from '../types';
import {found} from './search';

const block = (type: string, summary: string, group = 'x') => ({type, summary, group}) as BlockDeclaration;
const all = [block('gain', 'multiplies'), block('again', 'x'), block('dead_time', 'delays a signal'), block('lag', 'a filter, no delay'), block('hidden', 'gain', 'internal')];
const types = (words: string) => found(all, words).map((b) => b.type);

describe('search', () => {
  it('finds by name first, then by what Simulink calls it, then by summary', () => {
    expect(types('gain')).toEqual(['gain', 'again']);
    expect(types('transport')).toEqual(['dead_time']);
    expect(types('filter')).toEqual(['lag']);
  });
  it('wants every word', () => expect(types('dead signal')).toEqual(['dead_time']));
  it('shows all without words, but for those inside', () => expect(types('')).toEqual(['gain', 'again', 'dead_time', 'lag']));
});
