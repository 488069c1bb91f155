// Decides how panels get curves of a file of traces: the head once, stretches as they are looked at, and
// what is in sight as a file.

import {useEffect, useState} from 'react';
import {api, Stretch} from '../data/api';
import {useStudio} from '../data/store';
import type {Point, TraceHead} from '../types';
import {csvOf, isEachRow, mostRows} from './csv';

export function useHead(path: string): TraceHead | null {
  const [head, setHead] = useState<{path: string; head: TraceHead} | null>(null);
  useEffect(() => {
    if (!path) return;
    let wanted = true;
    api.head(path).then((h) => wanted && setHead({path, head: h}), (e) => wanted && useStudio.getState().tell(e));
    return () => {
      wanted = false;
    };
  }, [path]);
  return head?.path === path ? head.head : null;
}

/// What is shown of these columns; the one before stays until the next is there.
export function useStretch(path: string, columns: string[], range: Point | null, pixels: number): Stretch | null {
  const [stretch, setStretch] = useState<{path: string; stretch: Stretch} | null>(null);
  const key = columns.join('\n');
  useEffect(() => {
    if (!path || !key) return;
    let wanted = true;
    api.trace(path, key.split('\n'), range?.[0] ?? 0, range?.[1] ?? 0, pixels)
      .then((s) => wanted && setStretch({path, stretch: s}), (e) => wanted && useStudio.getState().tell(e));
    return () => {
      wanted = false;
    };
  }, [path, key, range, pixels]);
  return stretch?.path === path ? stretch.stretch : null;
}

const none: Stretch[] = [];

/// The same columns of several files, as they come in.
export function useStretches(files: {path: string}[], columns: string[], range: Point | null, pixels: number): (Stretch | undefined)[] {
  const [found, setFound] = useState<{key: string; stretches: Stretch[]}>({key: '', stretches: []});
  const paths = files.map((f) => f.path).join('\n');
  const key = columns.join('\n');
  useEffect(() => {
    if (!paths || !key) return;
    let wanted = true;
    Promise.all(paths.split('\n').map((path) => api.trace(path, key.split('\n'), range?.[0] ?? 0, range?.[1] ?? 0, pixels)))
      .then((stretches) => wanted && setFound({key: paths, stretches}), () => wanted && setFound({key: '', stretches: []}));
    return () => {
      wanted = false;
    };
  }, [paths, key, range, pixels]);
  return found.key === paths ? found.stretches : none;
}

/// What is ticked and in sight, into the folder of downloads.
export async function saveCsv(path: string, head: TraceHead, columns: string[], range: Point | null): Promise<void> {
  const {say, tell} = useStudio.getState();
  try {
    const stretch = await api.trace(path, columns, range?.[0] ?? 0, range?.[1] ?? 0, mostRows);
    if (!isEachRow(stretch)) return say(`these are more than ${mostRows} rows: zoom in over time, or run with --traces csv in a terminal`, 'error');
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([csvOf(head, stretch, range)], {type: 'text/csv'}));
    link.download = `${path.slice(path.lastIndexOf('/') + 1).replace(/\.\w+$/, '')}.csv`;
    link.click();
    URL.revokeObjectURL(link.href);
  } catch (error) {
    tell(error);
  }
}
