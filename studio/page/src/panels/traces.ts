// Decides how panels get curves of a file of traces: the head once, stretches as they are looked at.

import {useEffect, useState} from 'react';
import {api, Stretch} from '../data/api';
import {useStudio} from '../data/store';
import type {Point, TraceHead} from '../types';

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
