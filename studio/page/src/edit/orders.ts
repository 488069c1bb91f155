// Decides which command lines the page asks for. Plain functions.

import type {JobOrder} from '../types';

/// The verb that the scopes show, else a run; of discover and others the curves are no function of one number.
export function liveOrder(shown: JobOrder | undefined, otherwise: JobOrder, set: string): JobOrder {
  const order = shown && ['run', 'compare'].includes(shown.verb) ? shown : otherwise;
  const before = order.options?.['--set'];
  const sets = Array.isArray(before) ? before : typeof before === 'string' ? [before] : [];
  return {verb: order.verb, diagram: order.diagram, options: {...order.options, '--set': [...sets, set]}};
}

export function runOrder(diagram: string, data: string, document: any): JobOrder {
  const options: Record<string, string> = {'--traces': 'f64'};
  if (data && Object.keys(document?.inputs ?? {}).length > 0) options['--data'] = data;
  return {verb: 'run', diagram, options};
}
