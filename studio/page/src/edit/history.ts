// Decides what undo and redo are: texts spliced at one place, blocks moved to another, and their inverses, one entry per
// gesture.

import type {Moves} from '../types';

/// At `at`, `removed` became `inserted`.
export interface Splice {
  at: number;
  removed: string;
  inserted: string;
}

/// Blocks that were moved by hand, or (null) given back to the layout.
export interface Move {
  before: Moves;
  after: Moves;
}

export type Step = Splice | Move;

export interface History {
  done: Step[];
  undone: Step[];
}

export const isMove = (step: Step): step is Move => 'after' in step;

const most = 200;

export const emptyHistory = (): History => ({done: [], undone: []});

/// The smallest splice that makes one text the other.
export function spliceBetween(before: string, after: string): Splice {
  const shorter = Math.min(before.length, after.length);
  let head = 0;
  while (head < shorter && before[head] === after[head]) ++head;
  let tail = 0;
  while (tail < shorter - head && before[before.length - 1 - tail] === after[after.length - 1 - tail]) ++tail;
  return {at: head, removed: before.slice(head, before.length - tail), inserted: after.slice(head, after.length - tail)};
}

export const inverse = (s: Step): Step => (isMove(s) ? {before: s.after, after: s.before} : {at: s.at, removed: s.inserted, inserted: s.removed});

/// Null where the text is not the one that the splice was made for.
export function applySplice(text: string, s: Splice): string | null {
  if (text.slice(s.at, s.at + s.removed.length) !== s.removed) return null;
  return text.slice(0, s.at) + s.inserted + text.slice(s.at + s.removed.length);
}

export const push = (history: History, before: string, after: string): History => pushStep(history, spliceBetween(before, after));

export function pushStep(history: History, step: Step): History {
  return {done: [...history.done, step].slice(-most), undone: []};
}

export function undoStep(history: History): {step: Step; history: History} | null {
  const last = history.done[history.done.length - 1];
  if (!last) return null;
  return {step: inverse(last), history: {done: history.done.slice(0, -1), undone: [...history.undone, last]}};
}

export function redoStep(history: History): {step: Step; history: History} | null {
  const last = history.undone[history.undone.length - 1];
  if (!last) return null;
  return {step: last, history: {done: [...history.done, last], undone: history.undone.slice(0, -1)}};
}

const key = (path: string) => `hysteron.history.${path}`;

const restsFor = 300;  // [ms]: what is written is as long as the diagram, and nobody waits for it
const unsaved = new Map<string, {history: History; text: string}>();

function saveAll(): void {
  for (const [path, kept] of unsaved) {
    try {
      sessionStorage.setItem(key(path), JSON.stringify(kept));
    } catch {
      sessionStorage.removeItem(key(path));  // full: undo then begins anew after a reload
    }
  }
  unsaved.clear();
}

/// For a reload: soon, and at the latest when the page is left.
export function saveHistory(path: string, history: History, text: string): void {
  if (!unsaved.size) setTimeout(saveAll, restsFor);
  unsaved.set(path, {history, text});
  window.addEventListener('pagehide', saveAll, {once: true});  // the same function: it is heard once
}

/// What was kept over a reload. What has changed since is one more edit: that of somebody else, or one whose answer
/// came too late.
export function loadHistory(path: string, text: string): History {
  saveAll();
  try {
    return resumed(JSON.parse(sessionStorage.getItem(key(path)) ?? 'null'), text);
  } catch {
    return emptyHistory();
  }
}

export function resumed(kept: {history: History; text: string} | null, text: string): History {
  if (!kept) return emptyHistory();
  return kept.text === text ? kept.history : push(kept.history, kept.text, text);
}
