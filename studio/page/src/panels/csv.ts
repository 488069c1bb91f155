// Decides how curves are written to a file of the user's: rows as hysteron and others read them. Plain functions.

import type {Stretch} from '../data/api';
import type {Point, TraceHead} from '../types';

export const mostRows = 20000;  // as many as the server gives at once

export const isEachRow = (s: Stretch | null) => !s || s.columns.every((c) => c.low.every((v, i) => v === c.high[i] || Number.isNaN(v)));

/// "t [s],drive [V]" and a line per row of the stretch of time; NaN is an empty cell.
export function csvOf(head: TraceHead, stretch: Stretch, range: Point | null): string {
  const title = (c: {name: string; unit: string}) => {
    const text = c.unit ? `${c.name} [${c.unit}]` : c.name;
    return /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
  };
  const told = (v: number) => (Number.isNaN(v) ? '' : String(v));
  const lines = [[head.columns[0], ...stretch.columns.map((s) => head.columns.find((c) => c.name === s.name) ?? {name: s.name, unit: ''})].map(title).join(',')];
  stretch.x.forEach((t, i) => {
    if (!range || (t >= range[0] && t <= range[1])) lines.push([t, ...stretch.columns.map((c) => c.low[i])].map(told).join(','));
  });
  return `${lines.join('\n')}\n`;
}
