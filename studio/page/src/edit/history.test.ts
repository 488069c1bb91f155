import {describe, expect, it} from 'vitest';
import {applySplice, emptyHistory, inverse, push, pushStep, redoStep, resumed, spliceBetween, undoStep, type Splice} from './history';

/// A small generator of numbers that are the same in every run.
function numbers(seed: number) {
  let state = seed;
  return (below: number) => {
    state = (state * 1664525 + 1013904223) % 4294967296;
    return Math.floor((state / 4294967296) * below);
  };
}

describe('history', () => {
  it('splices as little as there is', () => {
    expect(spliceBetween('abcdef', 'abXdef')).toEqual({at: 2, removed: 'c', inserted: 'X'});
    expect(spliceBetween('aaa', 'aaaa')).toEqual({at: 3, removed: '', inserted: 'a'});
    expect(spliceBetween('same', 'same')).toEqual({at: 4, removed: '', inserted: ''});
  });
  it('is refused by a text that it was not made for', () => {
    expect(applySplice('xyz', {at: 1, removed: 'q', inserted: ''})).toBeNull();
  });
  it('undoes 50 random edits to the byte, and redoes them', () => {
    const random = numbers(5);
    const first = '{"blocks": {"a": {"type": "gain"}}}\n';
    const texts = [first];
    let history = emptyHistory();
    for (let i = 0; i < 50; ++i) {
      const text = texts[texts.length - 1];
      const at = random(text.length + 1);
      const next = text.slice(0, at) + 'abc"{},'.slice(0, random(8)) + text.slice(at + random(4));
      history = push(history, text, next);
      texts.push(next);
    }
    let text = texts[50];
    for (let i = 49; i >= 0; --i) {
      const step = undoStep(history)!;
      text = applySplice(text, step.step as Splice)!;
      history = step.history;
      expect(text).toBe(texts[i]);
    }
    expect(undoStep(history)).toBeNull();
    for (let i = 1; i <= 50; ++i) {
      const step = redoStep(history)!;
      text = applySplice(text, step.step as Splice)!;
      history = step.history;
      expect(text).toBe(texts[i]);
    }
    expect(applySplice(text, inverse(spliceBetween(first, text)) as Splice)).toBe(first);
  });
  it('goes on after a reload, through what was changed in between', () => {
    const kept = {history: push(emptyHistory(), 'a', 'ab'), text: 'ab'};
    expect(resumed(kept, 'ab')).toBe(kept.history);
    const later = resumed(kept, 'xab');
    const first = undoStep(later)!;
    expect(applySplice('xab', first.step as Splice)).toBe('ab');
    expect(applySplice('ab', undoStep(first.history)!.step as Splice)).toBe('a');
    expect(resumed(null, 'a')).toEqual(emptyHistory());
  });
  it('forgets what was undone once something else is done', () => {
    let history = push(push(emptyHistory(), 'a', 'ab'), 'ab', 'abc');
    history = undoStep(history)!.history;
    expect(redoStep(push(history, 'ab', 'abd'))).toBeNull();
  });
  it('takes back where blocks were moved to, between edits of the text', () => {
    const moved = {before: {motor: null}, after: {motor: [4, 2] as [number, number]}};
    const history = push(pushStep(push(emptyHistory(), 'a', 'ab'), moved), 'ab', 'abc');
    const edit = undoStep(history)!;
    const move = undoStep(edit.history)!;
    expect(move.step).toEqual({before: {motor: [4, 2]}, after: {motor: null}});
    expect(redoStep(move.history)!.step).toEqual(moved);
    expect(applySplice('ab', undoStep(move.history)!.step as Splice)).toBe('a');
  });
});
