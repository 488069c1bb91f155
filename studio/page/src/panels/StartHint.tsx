// Decides what an empty panel says: what would fill it, and the one action that does.

import {currentPath, useStudio} from '../data/store';
import {runOrder} from '../edit/orders';
import {duration, wholePercent} from '../numbers';
import type {JobOrder} from '../types';

const needsData = ['compare', 'diagnose', 'discover'];
const name = (verb: string) => verb[0].toUpperCase() + verb.slice(1);

/// Of a diagram with inputs a run reads them from the data that were chosen.
export function orderOf(verb: string, diagram: string, data: string, document: any): JobOrder {
  if (verb === 'run') return runOrder(diagram, data, document);
  return {verb, diagram, options: data && needsData.includes(verb) ? {'--data': data} : {}};
}

export function StartHint({verb, what}: {verb: string; what: string}) {
  const diagram = useStudio(currentPath);
  const data = useStudio((s) => s.data);
  const begin = useStudio((s) => s.begin);
  const job = useStudio((s) => s.jobs.find((j) => j.id === s.shownJob));
  if (job && (job.state === 'running' || job.state === 'waiting')) return <Working />;
  const missing = needsData.includes(verb) && !data;
  return (
    <div className="start">
      <p>{missing ? `Choose data in the list of files, then here stand ${what}.` : `Here stand ${what}.`}</p>
      {!missing && diagram && <button className="primary" onClick={() => void begin(orderOf(verb, diagram, data, useStudio.getState().document))}>{name(verb)}</button>}
    </div>
  );
}

/// What is being done, how far it is, and a stop.
export function Working() {
  const job = useStudio((s) => s.jobs.find((j) => j.id === s.shownJob));
  const cancel = useStudio((s) => s.cancel);
  if (!job) return null;
  return (
    <div className="start">
      <p>{job.state === 'waiting' ? 'Waits for the job before it.' : job.what || `${job.verb} has begun`}</p>
      <progress max={1} {...(job.fraction >= 0 ? {value: job.fraction} : {})} />
      <p className="muted">{[job.fraction >= 0 && wholePercent(job.fraction), job.seconds_left > 0 && `${duration(job.seconds_left)} left`].filter(Boolean).join(', ')}</p>
      <button onClick={() => void cancel(job.id)}>Stop</button>
    </div>
  );
}
