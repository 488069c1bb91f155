import {describe, expect, it} from 'vitest';
import {liveOrder, runOrder} from './orders';

describe('what is asked while a number is dragged', () => {
  const run = runOrder('a.json', '', {blocks: {}});
  it('is the run or comparison that is shown, with one number more', () => {
    const compare = {verb: 'compare', diagram: 'a.json', options: {'--data': 'd.json', '--set': ['k=1']}};
    expect(liveOrder(compare, run, 'stage.gain=2 um/V')).toEqual({verb: 'compare', diagram: 'a.json', options: {'--data': 'd.json', '--set': ['k=1', 'stage.gain=2 um/V']}});
    expect(compare.options['--set']).toEqual(['k=1']);
  });
  it('is a run where nothing is shown, or a search for effects', () => {
    expect(liveOrder(undefined, run, 'k=2').verb).toBe('run');
    expect(liveOrder({verb: 'discover', diagram: 'a.json'}, run, 'k=2')).toEqual({verb: 'run', diagram: 'a.json', options: {'--traces': 'f64', '--set': ['k=2']}});
  });
  it('gives a diagram with inputs its data', () => {
    expect(runOrder('a.json', 'd.json', {inputs: {u: {}}}).options).toEqual({'--traces': 'f64', '--data': 'd.json'});
    expect(runOrder('a.json', 'd.json', {}).options).toEqual({'--traces': 'f64'});
  });
});
