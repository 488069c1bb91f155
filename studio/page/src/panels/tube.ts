// Decides how a tolerance is drawn and judged: hysteron compare holds one run against the other, point by point; the tube
// is what it allows around the first one.

import {useEffect, useState} from 'react';
import {api, Refused, type Stretch} from '../data/api';
import {alongOf, tubeOf, verdictOf, type SignalFacts, type Tube} from './tolerance';

async function inUnit(text: string, unit: string): Promise<number> {
  const parts = (t: string) => /^([-+.\deE]+)\s*(.*)$/.exec(t);
  for (const t of [text, ...(await api.units(text)).map((u) => u.text)]) {
    const found = parts(t);
    if (found && found[2].trim() === unit) return Number(found[1]);
  }
  return 0;
}

async function tubesOf(first: string, second: string, tolerance: string) {
  const order = {verb: 'compare', diagram: first, other: second, options: {'--tolerance': [tolerance]}, columns: ['first', 'allowed'], from: 0, to: 0, pixels: 1200, patience: 20000};
  const answer = await api.live({...order, trace: ''});
  const signals: SignalFacts[] = answer.facts.signals;
  const axisUnit: string = answer.facts.over_unit;
  const along = alongOf(tolerance) ? await inUnit(alongOf(tolerance), axisUnit) : 0;
  const tubes: Record<string, Tube> = {};
  for (const [i, signal] of signals.entries()) {
    if (signal.outside === undefined) continue;
    const {stretch}: {stretch: Stretch} = await api.live({...order, trace: answer.traces[3 * i + 2]});
    const [value, allowed] = ['first', 'allowed'].map((name) => stretch.columns.find((c) => c.name === name));
    if (value && allowed) tubes[signal.first] = tubeOf(stretch.x, value.low, value.high, allowed.high, along);
  }
  return {tubes, verdict: verdictOf(signals, axisUnit), wrong: ''};
}

const nothing = {tubes: undefined as Record<string, Tube> | undefined, verdict: '', wrong: ''};

/// The tubes around the run in `first` of what is in `second`; none where no tolerance is written.
export function useTubes(first: string, second: string, tolerance: string): typeof nothing {
  const [found, setFound] = useState({key: '', answer: nothing});
  const key = first && second && tolerance ? `${first}\n${second}\n${tolerance}` : '';
  useEffect(() => {
    if (!key) return;
    let wanted = true;
    tubesOf(first, second, tolerance).then(
      (answer) => wanted && setFound({key, answer}),
      (error) => wanted && setFound({key, answer: {...nothing, wrong: error instanceof Refused ? error.problems.map((p) => `${p.what}: ${p.cure}`).join('; ') : String(error)}}));
    return () => {
      wanted = false;
    };
  }, [key, first, second, tolerance]);
  return found.key === key && key ? found.answer : nothing;
}
