// Decides how panels learn how large they are.

import {useEffect, useState} from 'react';

type Holder = (element: HTMLDivElement | null) => void;

function useMeasured(initial: number, of: (element: HTMLDivElement) => number): [number, Holder] {
  const [size, setSize] = useState(initial);
  const [element, setElement] = useState<HTMLDivElement | null>(null);
  useEffect(() => {
    if (!element) return;
    const observer = new ResizeObserver(() => setSize(of(element)));
    observer.observe(element);
    return () => observer.disconnect();
    // eslint-disable-next-line react-hooks/exhaustive-deps
  }, [element]);
  return [size, setElement];
}

/// [px], and what is to be measured.
export const useHeight = (initial: number) => useMeasured(initial, (e) => e.clientHeight);
export const useWidth = (initial: number) => useMeasured(initial, (e) => e.clientWidth);
