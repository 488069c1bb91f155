// Decides how it is told in what two diagrams differ: place by place, in the words of their files. Plain functions.

import {jsonText, shownValue} from './document';

export interface Change {
  kind: 'added' | 'removed' | 'changed';
  section: string;  // "blocks"
  name: string;     // of the block, parameter, output ...; "" where the section itself is meant
  member: string;   // "gain", "in", "from › hybrid › gain"; "" for the whole block
  before: string;
  after: string;
}

const isObject = (v: unknown): v is Record<string, unknown> => v !== null && typeof v === 'object' && !Array.isArray(v);
const same = (a: unknown, b: unknown) => jsonText(a ?? null) === jsonText(b ?? null);
/// A block or another object in one line; numbers with units as fields show them.
const told = (value: unknown) => (value === undefined ? '' : shownValue(value));

function inside(section: string, name: string, member: string, before: unknown, after: unknown, list: Change[]): void {
  if (same(before, after)) return;
  const isNumber = (v: unknown) => isObject(v) && typeof v.value === 'number';
  if (isObject(before) && isObject(after) && !isNumber(before) && !isNumber(after)) {
    for (const key of new Set([...Object.keys(before), ...Object.keys(after)])) inside(section, name, member ? `${member} › ${key}` : key, before[key], after[key], list);
    return;
  }
  list.push({kind: before === undefined ? 'added' : after === undefined ? 'removed' : 'changed', section, name, member, before: told(before), after: told(after)});
}

/// What stands in the one diagram and not, or otherwise, in the other. Order of members means nothing.
export function changesOf(before: any, after: any): Change[] {
  const list: Change[] = [];
  for (const section of new Set([...Object.keys(before ?? {}), ...Object.keys(after ?? {})])) {
    if (section === '$schema' || section === 'format') continue;
    const [a, b] = [before?.[section], after?.[section]];
    if (!isObject(a) && !isObject(b)) {
      inside(section, '', '', a, b, list);
      continue;
    }
    const [from, to] = [isObject(a) ? a : {}, isObject(b) ? b : {}];
    for (const name of new Set([...Object.keys(from), ...Object.keys(to)])) {
      const whole = from[name] === undefined || to[name] === undefined;
      if (!whole) inside(section, name, '', from[name], to[name], list);
      else list.push({kind: from[name] === undefined ? 'added' : 'removed', section, name, member: '', before: told(from[name]), after: told(to[name])});
    }
  }
  return list;
}

/// The lines in which two texts differ: what stands between those that both begin and end with.
export function differingLines(a: string, b: string): [string, string] {
  const [left, right] = [a.split('\n'), b.split('\n')];
  const shorter = Math.min(left.length, right.length);
  let head = 0;
  while (head < shorter && left[head] === right[head]) ++head;
  let tail = 0;
  while (tail < shorter - head && left[left.length - 1 - tail] === right[right.length - 1 - tail]) ++tail;
  return [left.slice(head, left.length - tail).join('\n'), right.slice(head, right.length - tail).join('\n')];
}
