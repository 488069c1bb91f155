// Decides what two cursors say: the rows of the file that lie nearest to them, whatever the curves show of it.

import {useEffect, useState} from 'react';
import {api} from '../data/api';
import {useStudio} from '../data/store';
import type {Point} from '../types';

export interface Row {
  at: number;
  values: Record<string, number>;
}

export interface AtCursors {
  first: Row | null;
  second: Row | null;
  putFirst: (at: number) => void;
  putSecond: (at: number) => void;
  /// The cursor that is nearer goes there.
  put: (at: number) => void;
}

const window = 1e-3;  // of what is shown, to either side: the server adds a row beyond
const most = 20000;   // rows that are asked for at once

export function nearestRow(x: ArrayLike<number>, columns: {name: string; low: ArrayLike<number>}[], at: number): Row | null {
  let best = -1;
  for (let i = 0; i < x.length; ++i) if (best < 0 || Math.abs(x[i] - at) < Math.abs(x[best] - at)) best = i;
  return best < 0 ? null : {at: x[best], values: Object.fromEntries(columns.map((c) => [c.name, c.low[best]]))};
}

function useRow(path: string, names: string[], at: number | null, span: number): Row | null {
  const [row, setRow] = useState<{path: string; row: Row | null}>({path: '', row: null});
  const key = names.join('\n');
  useEffect(() => {
    if (at === null || !key) return;
    let wanted = true;
    api.trace(path, key.split('\n'), at - window * span, at + window * span, most)
      .then((s) => wanted && setRow({path, row: nearestRow(s.x, s.columns, at)}), (e) => wanted && useStudio.getState().tell(e));
    return () => {
      wanted = false;
    };
  }, [path, key, at, span]);
  return at !== null && row.path === path ? row.row : null;
}

/// At first they stand at a third and at two thirds of what is shown.
export function useCursors(on: boolean, path: string, names: string[], shown: Point | null): AtCursors | null {
  const [places, setPlaces] = useState<Point | null>(null);
  useEffect(() => {
    if (!on) setPlaces(null);
    else if (!places && shown) setPlaces([shown[0] + (shown[1] - shown[0]) / 3, shown[0] + (2 * (shown[1] - shown[0])) / 3]);
  }, [on, places, shown]);
  useEffect(() => setPlaces(null), [path]);
  const span = shown ? shown[1] - shown[0] : 0;
  const first = useRow(path, names, places?.[0] ?? null, span);
  const second = useRow(path, names, places?.[1] ?? null, span);
  if (!on) return null;
  return {
    first,
    second,
    putFirst: (at) => setPlaces((now) => [at, now?.[1] ?? at]),
    putSecond: (at) => setPlaces((now) => [now?.[0] ?? at, at]),
    put: (at) => setPlaces((now) => (!now || Math.abs(at - now[0]) <= Math.abs(at - now[1]) ? [at, now?.[1] ?? at] : [now[0], at])),
  };
}
