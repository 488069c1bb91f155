// Decides how the curves follow a number that is dragged: the server runs the diagram with the number as it is at the
// moment, and what came in meanwhile waits as one. Let go, the number is written and the run is made anew.

import {api, Refused, type LiveOrder} from './api';
import {currentPath, useStudio} from './store';
import {liveOrder, runOrder} from '../edit/orders';
import type {Point} from '../types';

/// What the scopes show: the same is asked for while a number is dragged.
export const looking = {trace: '', columns: [] as string[], range: null as Point | null, pixels: 800};

interface Wanted {
  set: string;    // "stage.gain=3 um/V"
  label: string;
}

let wanted: Wanted | null = null;
let asking = false;
let refused = '';    // why this diagram does not follow

async function ask(now: Wanted): Promise<void> {
  const {jobs, shownJob, data, document, set, say} = useStudio.getState();
  const shown = jobs.find((j) => j.id === shownJob)?.asked;
  const order: LiveOrder = {
    ...liveOrder(shown, runOrder(currentPath(useStudio.getState()), data, document), now.set),
    trace: looking.trace, columns: looking.columns, from: looking.range?.[0] ?? 0, to: looking.range?.[1] ?? 0, pixels: looking.pixels,
  };
  const begin = performance.now();
  try {
    const answer = await api.live(order);
    if (wanted) set({live: {...answer, label: now.label, milliseconds: performance.now() - begin}});
  } catch (error) {
    const problem = error instanceof Refused ? error.problems[0] : undefined;
    if (!problem) return;
    if (problem.code === 'took_too_long') refused = problem.what;
    if (wanted === now || refused) say(`${problem.what}: ${problem.cure}`, refused ? 'note' : 'error');
  }
}

/// Called at each step of a drag.
export async function follow(set: string, label: string): Promise<void> {
  wanted = {set, label};
  if (asking || refused) return;
  asking = true;
  for (let done: Wanted | null = null; wanted && wanted !== done && !refused;) {
    done = wanted;
    await ask(done);
  }
  asking = false;
}

/// The number was let go. `write` puts it into the file; where the curves followed, or were too slow to, they are made
/// anew of the file.
export async function letGo(write: () => Promise<unknown>): Promise<void> {
  const followed = wanted !== null;
  wanted = null;
  refused = '';
  await write();
  const {jobs, shownJob, data, document, begin, set} = useStudio.getState();
  const shown = jobs.find((j) => j.id === shownJob)?.asked;
  if (followed) await begin(shown && ['run', 'compare'].includes(shown.verb) ? shown : runOrder(currentPath(useStudio.getState()), data, document));
  set({live: null});
}

export function giveUp(): void {
  wanted = null;
  refused = '';
  useStudio.getState().set({live: null});
}
